#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "node/messages/envelope.h"

/// Encodes and decodes the messages between frontend and backend nodes, by the schema node.proto. Decoding returns what
/// was encoded. Any thread.
namespace grove::node {

inline constexpr std::size_t kMaxHeaderBytes = std::size_t{1} << 20U;
inline constexpr std::size_t kMaxNameBytes = 256;
inline constexpr std::size_t kMaxReasonBytes = 1024;
inline constexpr std::size_t kMaxPlayers = 4096;
/// As many as visitors of a world, and the breaths that world::Edits keeps.
inline constexpr std::size_t kMaxGusts = 1024 + 256;
/// Metres per second, and metres: a storm.
inline constexpr float kMaxGustSpeed = 100.0F;
inline constexpr float kMaxGustReach = 100.0F;
inline constexpr std::size_t kMaxLights = 4096;
inline constexpr std::size_t kMaxServedObjects = 65536;
/// Metres: more than any world measures.
inline constexpr float kMaxObstacleRadius = 1.0e6F;
inline constexpr std::size_t kMaxTypes = 65536;
/// Seconds that a clock may show: more than thirty years.
inline constexpr double kMaxSeconds = 1.0e9;
/// Pixels of a camera's picture, across and down.
inline constexpr int kMaxCameraSize = 8192;
/// Pixels from the origin to any edge of a rectangle.
inline constexpr int kMaxRectEdge = 16384;

/// A message as bytes.
struct Packet {
  std::string header;
  std::shared_ptr<const PackedBytes> bulk;  ///< of a result, never copied; null if it has none

  [[nodiscard]] std::size_t bytes() const noexcept { return header.size() + (bulk ? bulk->size() : 0); }
};

/// Encoding a message that decoding would refuse is a programming mistake, except for the reasons of failures and
/// refusals, which may be any text: their first kMaxReasonBytes are sent, with '?' for bytes that are not UTF-8.
[[nodiscard]] Packet encode(const ToBackend& message);
/// A result's bulk is its `packed`; its payload is a Failure or null.
[[nodiscard]] Packet encode(const ToFrontend& message);

/// Why bytes are no valid message, in one line.
struct WireError {
  std::string reason;
};

template <class Message>
using Decoded = std::variant<Message, WireError>;

/// The view of a session's frame; null if it is unknown.
using ViewLookup = std::function<std::shared_ptr<const View>(SessionId, FrameNumber)>;

/// Looks up a request's view. A picture's view must be known; shared data is for all visitors, so it needs no view.
[[nodiscard]] Decoded<ToBackend> decodeToBackend(std::string_view header, const ViewLookup& viewOf);

/// A result's bytes become its `packed`; unpacking checks them later.
[[nodiscard]] Decoded<ToFrontend> decodeToFrontend(const Packet& packet);

}  // namespace grove::node
