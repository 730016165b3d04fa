#include <utility>

#include "node/messages/node.pb.h"
#include "node/messages/wire/decode_parts.h"
#include "node/messages/wire/report_wire.h"

namespace grove::node {
namespace {

world::Bounds decode(const v1::Bounds& from, Checks& checks) {
  const world::Bounds to{decode(from.low(), checks), decode(from.high(), checks)};
  const bool ordered = to.low.x <= to.high.x && to.low.y <= to.high.y && to.low.z <= to.high.z;
  checks.require(ordered, "an object's bounds are inverted");
  return to;
}

template <class Served>
world::Bounds boundsOf(const Served& from, Checks& checks) {
  return from.has_bounds() ? decode(from.bounds(), checks) : world::Bounds{};
}

NodeWelcome decode(const v1::NodeWelcome& from, Checks& checks) {
  NodeWelcome to{.protocol = from.protocol(),
                 .build = decodeName(from.build(), checks),
                 .sceneHash = from.scene_hash(),
                 .epoch = from.epoch(),
                 .objects = {}};
  checks.require(static_cast<std::size_t>(from.objects_size()) <= kMaxServedObjects, "it has too many objects");
  if (!checks.good()) return to;
  to.objects.reserve(static_cast<std::size_t>(from.objects_size()));
  for (const v1::ServedObject& object : from.objects()) {
    const float radius = object.obstacle_radius();
    checks.require(radius >= 0.0F && radius <= kMaxObstacleRadius, "an obstacle's radius is out of range");
    to.objects.push_back({.id = object.id(),
                          .type = object.type(),
                          .name = decodeName(object.name(), checks),
                          .bounds = boundsOf(object, checks),
                          .obstacleRadius = radius});
  }
  if (from.has_visitors()) {
    const v1::ServedVisitors& visitors = from.visitors();
    to.visitors = {boundsOf(visitors, checks), visitors.own_body(), visitors.shadow()};
  }
  return to;
}

NodeRefusal decode(const v1::NodeRefusal& from, Checks& checks) { return {decodeReason(from.reason(), checks)}; }

Result decode(const v1::Result& from, Checks& checks) {
  // Shared data may have no frame.
  if (!from.shared() || from.frame() != 0) requireFrame(from.session(), from.frame(), checks);
  Result to;
  to.session = from.session();
  to.frame = from.frame();
  to.slot = from.slot();
  to.what = decode(from.what(), checks);
  to.shared = from.shared();
  to.version = from.version();
  to.pushed = from.pushed();
  checks.require(from.shared() || !from.pushed(), "it pushes a picture");
  switch (from.payload_case()) {
    case v1::Result::kPicture:
    case v1::Result::kNothing:
      checks.require(!from.shared(), "it has a picture instead of shared data");
      break;
    case v1::Result::kData:
      checks.require(from.shared(), "it has shared data instead of a picture");
      break;
    case v1::Result::kFailure:
      to.payload = Failure{decodeReason(from.failure().reason(), checks), from.failure().not_now()};
      break;
    case v1::Result::PAYLOAD_NOT_SET:
      checks.require(false, "its payload is of an unknown kind");
      break;
  }
  return to;
}

Announcement decode(const v1::Announcement& from, Checks& checks) {
  return {.what = decode(from.what(), checks), .version = from.version()};
}

template <class From>
Decoded<ToFrontend> frontendMessage(std::string_view name, const From& from) {
  Checks checks(name);
  auto to = decode(from, checks);
  if (!checks.good()) return checks.error();
  return ToFrontend(std::move(to));
}

Decoded<ToFrontend> withBulk(const v1::Result& from, std::shared_ptr<const PackedBytes> bulk) {
  if ((from.has_picture() || from.has_data()) != (bulk != nullptr)) {
    return WireError{bulk ? "result: it has unexpected bulk bytes" : "result: its bulk bytes are missing"};
  }
  Decoded<ToFrontend> decoded = frontendMessage("result", from);
  if (auto* message = std::get_if<ToFrontend>(&decoded)) std::get<Result>(*message).packed = std::move(bulk);
  return decoded;
}

}  // namespace

Decoded<ToFrontend> decodeToFrontend(const Packet& packet) {
  v1::ToFrontend envelope;
  Checks checks("message to a frontend");
  if (!parse(packet.header, envelope, checks)) return checks.error();
  if (envelope.has_result()) return withBulk(envelope.result(), packet.bulk);
  checks.require(!packet.bulk, "it has unexpected bulk bytes");
  if (!checks.good()) return checks.error();
  switch (envelope.message_case()) {
    case v1::ToFrontend::kWelcome:
      return frontendMessage("welcome", envelope.welcome());
    case v1::ToFrontend::kRefusal:
      return frontendMessage("refusal", envelope.refusal());
    case v1::ToFrontend::kAnnouncement:
      return frontendMessage("announcement", envelope.announcement());
    case v1::ToFrontend::kWorld:
      return frontendMessage("world update", envelope.world());
    case v1::ToFrontend::kReport:
      return frontendMessage("report", envelope.report());
    case v1::ToFrontend::kTrace:
      return frontendMessage("trace", envelope.trace());
    case v1::ToFrontend::kResult:
    case v1::ToFrontend::MESSAGE_NOT_SET:
      break;
  }
  checks.require(false, "it is of an unknown kind");
  return checks.error();
}

}  // namespace grove::node
