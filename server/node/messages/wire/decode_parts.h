#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "node/messages/ids.h"
#include "node/messages/shared_key.h"
#include "node/messages/wire/nesting.h"
#include "node/messages/wire/wire.h"
#include "world/camera.h"
#include "world/edits.h"
#include "world/light.h"
#include "world/players.h"

/// Decoders for parts of messages in both directions, from the schema's types, with every value checked.
namespace grove::node {

namespace v1 {
class Camera;
class Gust;
class Player;
class PointLight;
class Pose;
class Rectangle;
class SharedKey;
class Vector;
class WorldUpdate;
}  // namespace v1

/// The first error in one message.
class Checks {
 public:
  /// `message` is its name in error texts, and outlives the checks.
  explicit Checks(std::string_view message) : message_(message) {}

  /// If `good` is false, `what` describes the error; it outlives the checks.
  void require(bool good, std::string_view what) {
    if (!good && wrong_.empty()) wrong_ = what;
  }
  [[nodiscard]] bool good() const noexcept { return wrong_.empty(); }
  [[nodiscard]] WireError error() const {
    std::string reason(message_);
    return {reason.append(": ").append(wrong_)};
  }

 private:
  std::string_view message_;
  std::string_view wrong_;
};

/// Parses a header; returns false, with the reason in `checks`, if it does not match this schema.
template <class Envelope>
bool parse(std::string_view header, Envelope& envelope, Checks& checks) {
  checks.require(header.size() <= kMaxHeaderBytes, "it is too long");
  if (!checks.good()) return false;
  checks.require(isNested(header, *Envelope::descriptor()), "it is damaged");
  if (!checks.good()) return false;
  checks.require(envelope.ParseFromArray(header.data(), static_cast<int>(header.size())), "it is damaged");
  return checks.good();
}

[[nodiscard]] std::string decodeName(const std::string& from, Checks& checks);
[[nodiscard]] std::string decodeReason(const std::string& from, Checks& checks);
[[nodiscard]] Key decodeKey(const std::string& from, Checks& checks);
[[nodiscard]] SharedKey decode(const v1::SharedKey& from, Checks& checks);
[[nodiscard]] world::Vec3 decode(const v1::Vector& from, Checks& checks);
[[nodiscard]] world::Pose decode(const v1::Pose& from, Checks& checks);
[[nodiscard]] world::Camera decode(const v1::Camera& from, Checks& checks);
[[nodiscard]] world::Rect decode(const v1::Rectangle& from, Checks& checks);
[[nodiscard]] world::Player decode(const v1::Player& from, Checks& checks);
[[nodiscard]] world::Gust decode(const v1::Gust& from, Checks& checks);
[[nodiscard]] world::PointLight decode(const v1::PointLight& from, Checks& checks);

template <class Repeated>
[[nodiscard]] std::vector<world::Player> decodePlayers(const Repeated& from, Checks& checks) {
  checks.require(static_cast<std::size_t>(from.size()) <= kMaxPlayers, "it has too many players");
  std::vector<world::Player> to;
  if (!checks.good()) return to;
  to.reserve(static_cast<std::size_t>(from.size()));
  for (const auto& player : from) to.push_back(decode(player, checks));
  return to;
}
[[nodiscard]] std::shared_ptr<const WorldUpdate> decode(const v1::WorldUpdate& from, Checks& checks);

/// Whether it can be a time of a clock; false for infinity and NaN.
[[nodiscard]] bool isTime(double seconds);

/// Requires both numbers of a frame.
void requireFrame(SessionId session, FrameNumber frame, Checks& checks);

}  // namespace grove::node
