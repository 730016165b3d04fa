#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "node/limits.h"
#include "node/messages/node.pb.h"
#include "node/messages/wire/decode_parts.h"

namespace grove::node {
namespace {

constexpr std::uint32_t kMaxBorderPercent = 100;

NodeHello decode(const v1::NodeHello& from, Checks& checks) {
  NodeHello to{.protocol = from.protocol(),
               .build = decodeName(from.build(), checks),
               .sceneHash = from.scene_hash(),
               .process = from.process(),
               .types = {}};
  checks.require(static_cast<std::size_t>(from.types_size()) <= kMaxTypes, "it has too many types");
  if (!checks.good()) return to;
  to.types.reserve(static_cast<std::size_t>(from.types_size()));
  for (const v1::TypeName& type : from.types()) to.types.push_back({type.id(), decodeName(type.name(), checks)});
  return to;
}

std::shared_ptr<const View> decode(const v1::View& from, Checks& checks) {
  requireFrame(from.session(), from.frame(), checks);
  checks.require(from.border_percent() <= kMaxBorderPercent, "its border is out of range");
  checks.require(isTime(from.time()), "its time is out of range");
  checks.require(from.deadline() >= -kMaxSeconds, "its deadline is out of range");
  checks.require(from.visitors() <= kMaxPlayers, "it has too many visitors");
  checks.require(static_cast<std::size_t>(from.lights_size()) <= kMaxLights, "it has too many lights");
  auto shared = std::make_shared<View>();
  View& to = *shared;
  to.session = from.session();
  to.frame = from.frame();
  to.viewer = from.viewer();
  to.lastInput = from.last_input();
  to.camera = decode(from.camera(), checks);
  if (from.has_backdrop_pose()) to.backdropPose = decode(from.backdrop_pose(), checks);
  to.borderPercent = static_cast<int>(from.border_percent());
  to.time = from.time();
  to.deadline = from.deadline();
  to.visitors = from.visitors();
  if (!checks.good()) return shared;
  to.lights.reserve(static_cast<std::size_t>(from.lights_size()));
  for (const v1::PointLight& light : from.lights()) to.lights.push_back(decode(light, checks));
  return shared;
}

Request decode(const v1::Request& from, Checks& checks) {
  if (from.session() != 0 || from.frame() != 0 || !from.shared()) requireFrame(from.session(), from.frame(), checks);
  checks.require(std::isfinite(from.distance()) && from.distance() >= 0.0F, "its distance is out of range");
  checks.require(from.urgency() >= 0.0F, "its urgency is out of range");
  checks.require(from.shared() || !from.subscribe(), "it subscribes to pictures");
  const auto process = static_cast<ProcessId>(from.session() >> 32U);
  return {.view = nullptr,
          .process = from.session() != 0 ? process : from.process(),
          .slot = from.slot(),
          .object = from.object(),
          .shared = from.shared(),
          .player = from.has_player() ? std::optional(decode(from.player(), checks)) : std::nullopt,
          .key = decodeKey(from.key(), checks),
          .rect = decode(from.rectangle(), checks),
          .distance = from.distance(),
          .urgency = from.urgency(),
          .known = from.known(),
          .subscribe = from.subscribe()};
}

Cancel decode(const v1::Cancel& from, Checks& checks) {
  requireFrame(from.session(), from.frame(), checks);
  return {.session = from.session(), .frame = from.frame()};
}

Quality decode(const v1::Quality& from, Checks& checks) {
  const bool known = from.step() <= static_cast<std::uint32_t>(kMaxQuality);
  checks.require(known, "its step is out of range");
  return {.step = known ? static_cast<int>(from.step()) : 0};
}

Forget decode(const v1::Forget& from, Checks& checks) {
  checks.require(from.session() != 0, "it names no session");
  return {.session = from.session()};
}

Acknowledgement decode(const v1::Acknowledgement& from, Checks& checks) {
  return {.what = decode(from.what(), checks), .version = from.version()};
}

Unsubscribe decode(const v1::Unsubscribe& from, Checks& checks) { return {.what = decode(from.what(), checks)}; }

TraceRequest decode(const v1::TraceRequest& from, Checks& /*checks*/) { return {.number = from.number()}; }

template <class From>
Decoded<ToBackend> backendMessage(std::string_view name, const From& from) {
  Checks checks(name);
  auto to = decode(from, checks);
  if (!checks.good()) return checks.error();
  return ToBackend(std::move(to));
}

WireError unknownView(SessionId session, FrameNumber frame) {
  std::string reason = "request: the view of session ";
  reason.append(std::to_string(session >> 32U)).append("/").append(std::to_string(numberOf(session)));
  reason.append(", frame ").append(std::to_string(frame)).append(", is unknown");
  return WireError{std::move(reason)};
}

Decoded<ToBackend> withView(const v1::Request& from, const ViewLookup& viewOf) {
  Decoded<ToBackend> decoded = backendMessage("request", from);
  auto* message = std::get_if<ToBackend>(&decoded);
  if (message == nullptr || from.session() == 0) return decoded;
  auto& request = std::get<Request>(*message);
  request.view = viewOf(from.session(), from.frame());
  if (!request.view && !from.shared()) return unknownView(from.session(), from.frame());
  if (!from.has_eye()) return decoded;
  request.eye = backdropEyeOf(viewOf(from.session(), from.eye()));
  if (!request.eye) return unknownView(from.session(), from.eye());
  return decoded;
}

}  // namespace

Decoded<ToBackend> decodeToBackend(std::string_view header, const ViewLookup& viewOf) {
  v1::ToBackend envelope;
  Checks checks("message to a backend node");
  if (!parse(header, envelope, checks)) return checks.error();
  switch (envelope.message_case()) {
    case v1::ToBackend::kHello:
      return backendMessage("hello", envelope.hello());
    case v1::ToBackend::kWorld:
      return backendMessage("world update", envelope.world());
    case v1::ToBackend::kView:
      return backendMessage("view", envelope.view());
    case v1::ToBackend::kRequest:
      return withView(envelope.request(), viewOf);
    case v1::ToBackend::kCancel:
      return backendMessage("cancel", envelope.cancel());
    case v1::ToBackend::kQuality:
      return backendMessage("quality", envelope.quality());
    case v1::ToBackend::kForget:
      return backendMessage("forget", envelope.forget());
    case v1::ToBackend::kAcknowledgement:
      return backendMessage("acknowledgement", envelope.acknowledgement());
    case v1::ToBackend::kUnsubscribe:
      return backendMessage("end of a subscription", envelope.unsubscribe());
    case v1::ToBackend::kTrace:
      return backendMessage("request for a trace", envelope.trace());
    case v1::ToBackend::MESSAGE_NOT_SET:
      break;
  }
  checks.require(false, "it is of an unknown kind");
  return checks.error();
}

}  // namespace grove::node
