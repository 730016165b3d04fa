#include "node/messages/wire/decode_parts.h"

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "base/utf8.h"
#include "node/messages/node.pb.h"
#include "node/messages/packing/picture_packing.h"

namespace grove::node {
namespace {

// Directions are computed from two angles, in float.
constexpr float kUnitTolerance = 1e-3F;
constexpr std::uint32_t kMaxKeys = 255;

bool isSize(std::uint32_t pixels) { return pixels >= 1 && pixels <= static_cast<std::uint32_t>(kMaxCameraSize); }
bool isEdge(std::int32_t pixels) { return pixels >= -kMaxRectEdge && pixels <= kMaxRectEdge; }
bool isPositive(float value) { return std::isfinite(value) && value >= 0.0F; }

}  // namespace

std::string decodeName(const std::string& from, Checks& checks) {
  checks.require(from.size() <= kMaxNameBytes, "a name is too long");
  checks.require(utf8::isValid(from), "a name is not UTF-8");
  return from;
}

std::string decodeReason(const std::string& from, Checks& checks) {
  checks.require(from.size() <= kMaxReasonBytes, "its reason is too long");
  checks.require(utf8::isValid(from), "its reason is not UTF-8");
  return from;
}

Key decodeKey(const std::string& from, Checks& checks) {
  checks.require(from.size() <= kMaxKeyBytes, "its key is too long");
  return from;
}

SharedKey decode(const v1::SharedKey& from, Checks& checks) { return {from.object(), decodeKey(from.key(), checks)}; }

world::Vec3 decode(const v1::Vector& from, Checks& checks) {
  const world::Vec3 to{from.x(), from.y(), from.z()};
  checks.require(std::isfinite(to.x) && std::isfinite(to.y) && std::isfinite(to.z), "a vector is not finite");
  return to;
}

world::Pose decode(const v1::Pose& from, Checks& checks) {
  checks.require(std::isfinite(from.yaw()), "a yaw is not finite");
  checks.require(std::abs(from.pitch()) <= world::kMaxPitch, "a pitch is out of range");
  return {.position = decode(from.position(), checks), .yaw = from.yaw(), .pitch = from.pitch()};
}

world::Camera decode(const v1::Camera& from, Checks& checks) {
  checks.require(isSize(from.width()) && isSize(from.height()), "its camera's size is out of range");
  const float fov = from.vertical_fov();
  checks.require(fov > 0.0F && fov < glm::pi<float>(), "its camera's field of view is out of range");
  const bool ordered = from.near_depth() > 0.0F && from.near_depth() < from.far_depth();
  checks.require(ordered && std::isfinite(from.far_depth()), "its camera's depths are out of order");
  return {.pose = decode(from.pose(), checks),
          .width = static_cast<int>(from.width()),
          .height = static_cast<int>(from.height()),
          .verticalFov = fov,
          .nearDepth = from.near_depth(),
          .farDepth = from.far_depth()};
}

world::Rect decode(const v1::Rectangle& from, Checks& checks) {
  const bool inRange = isEdge(from.left()) && isEdge(from.top()) && isEdge(from.right()) && isEdge(from.bottom());
  checks.require(inRange, "its rectangle is out of range");
  checks.require(from.left() <= from.right() && from.top() <= from.bottom(), "its rectangle is inverted");
  const auto along = [](std::int32_t begin, std::int32_t end) { return std::int64_t{end} - begin; };
  const std::int64_t pixels = along(from.left(), from.right()) * along(from.top(), from.bottom());
  checks.require(!inRange || pixels <= std::int64_t{kMaxPicturePixels}, "its rectangle is too large");
  return {from.left(), from.top(), from.right(), from.bottom()};
}

world::Player decode(const v1::Player& from, Checks& checks) {
  checks.require(from.keys() <= kMaxKeys, "a player's keys are out of range");
  checks.require(isPositive(from.stride()), "a player's stride is out of range");
  return {.id = from.id(),
          .name = decodeName(from.name(), checks),
          .colour = from.colour(),
          .pose = decode(from.pose(), checks),
          .velocity = decode(from.velocity(), checks),
          .stride = from.stride(),
          .lastInput = from.last_input(),
          .keys = static_cast<std::uint8_t>(from.keys())};
}

world::Gust decode(const v1::Gust& from, Checks& checks) {
  const world::Vec3 direction = decode(from.direction(), checks);
  checks.require(std::abs(glm::length(direction) - 1.0F) <= kUnitTolerance, "a gust's direction is not a unit vector");
  const bool isBlown = from.speed() >= 0.0F && from.speed() <= kMaxGustSpeed;
  checks.require(isBlown && from.reach() >= 0.0F && from.reach() <= kMaxGustReach,
                 "a gust's speed or reach is out of range");
  return {.origin = decode(from.origin(), checks),
          .direction = direction,
          .speed = from.speed(),
          .reach = from.reach(),
          .visitor = from.visitor()};
}

world::PointLight decode(const v1::PointLight& from, Checks& checks) {
  return {.position = decode(from.position(), checks), .colour = decode(from.colour(), checks)};
}

std::shared_ptr<const WorldUpdate> decode(const v1::WorldUpdate& from, Checks& checks) {
  checks.require(from.number() != 0, "it has no number");
  checks.require(isTime(from.clock()) && isTime(from.sent()), "its clock is out of range");
  auto shared = std::make_shared<WorldUpdate>();
  WorldUpdate& to = *shared;
  to.number = from.number();
  to.clock = from.clock();
  to.sent = from.sent();
  checks.require(static_cast<std::size_t>(from.gusts_size()) <= kMaxGusts, "it has too many gusts");
  to.players = decodePlayers(from.players(), checks);
  if (!checks.good()) return shared;
  to.gusts.reserve(static_cast<std::size_t>(from.gusts_size()));
  for (const v1::Gust& gust : from.gusts()) to.gusts.push_back(decode(gust, checks));
  return shared;
}

bool isTime(double seconds) { return std::abs(seconds) <= kMaxSeconds; }

void requireFrame(SessionId session, FrameNumber frame, Checks& checks) {
  checks.require(session != 0, "it names no session");
  checks.require(frame != 0, "it names no frame");
}

}  // namespace grove::node
