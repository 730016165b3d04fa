#include <cassert>
#include <utility>

#include "base/utf8.h"
#include "node/messages/node.pb.h"
#include "node/messages/wire/report_wire.h"
#include "node/messages/wire/wire.h"

namespace grove::node {
namespace {

void put(const world::Vec3& from, v1::Vector* to) {
  to->set_x(from.x);
  to->set_y(from.y);
  to->set_z(from.z);
}

void put(const world::Pose& from, v1::Pose* to) {
  put(from.position, to->mutable_position());
  to->set_yaw(from.yaw);
  to->set_pitch(from.pitch);
}

void put(const world::Camera& from, v1::Camera* to) {
  put(from.pose, to->mutable_pose());
  to->set_width(static_cast<std::uint32_t>(from.width));
  to->set_height(static_cast<std::uint32_t>(from.height));
  to->set_vertical_fov(from.verticalFov);
  to->set_near_depth(from.nearDepth);
  to->set_far_depth(from.farDepth);
}

void put(const world::Rect& from, v1::Rectangle* to) {
  to->set_left(from.left);
  to->set_top(from.top);
  to->set_right(from.right);
  to->set_bottom(from.bottom);
}

void put(const world::Player& from, v1::Player* to) {
  to->set_id(from.id);
  to->set_name(from.name);
  to->set_colour(from.colour);
  put(from.pose, to->mutable_pose());
  put(from.velocity, to->mutable_velocity());
  to->set_stride(from.stride);
  to->set_last_input(from.lastInput);
  to->set_keys(from.keys);
}

void put(const world::Gust& from, v1::Gust* to) {
  put(from.origin, to->mutable_origin());
  put(from.direction, to->mutable_direction());
  to->set_speed(from.speed);
  to->set_reach(from.reach);
  to->set_visitor(from.visitor);
}

void put(const SharedKey& from, v1::SharedKey* to) {
  to->set_object(from.object);
  to->set_key(from.key);
}

void put(const Failure& from, v1::Failure* to) {
  to->set_reason(utf8::repaired(from.reason, kMaxReasonBytes));
  to->set_not_now(from.notNow);
}

void put(const NodeHello& from, v1::ToBackend& envelope) {
  v1::NodeHello& to = *envelope.mutable_hello();
  to.set_protocol(from.protocol);
  to.set_build(from.build);
  to.set_scene_hash(from.sceneHash);
  to.set_process(from.process);
  for (const TypeName& type : from.types) {
    v1::TypeName& name = *to.add_types();
    name.set_id(type.id);
    name.set_name(type.name);
  }
}

template <class Envelope>
void put(const std::shared_ptr<const WorldUpdate>& update, Envelope& envelope) {
  const WorldUpdate& from = *update;
  v1::WorldUpdate& to = *envelope.mutable_world();
  to.set_number(from.number);
  to.set_clock(from.clock);
  to.set_sent(from.sent);
  for (const world::Player& player : from.players) put(player, to.add_players());
  for (const world::Gust& gust : from.gusts) put(gust, to.add_gusts());
}

void put(const std::shared_ptr<const View>& view, v1::ToBackend& envelope) {
  const View& from = *view;
  v1::View& to = *envelope.mutable_view();
  to.set_session(from.session);
  to.set_frame(from.frame);
  to.set_viewer(from.viewer);
  to.set_last_input(from.lastInput);
  put(from.camera, to.mutable_camera());
  if (from.backdropPose) put(*from.backdropPose, to.mutable_backdrop_pose());
  to.set_border_percent(static_cast<std::uint32_t>(from.borderPercent));
  to.set_time(from.time);
  to.set_deadline(from.deadline);
  to.set_visitors(static_cast<std::uint32_t>(from.visitors));
  for (const world::PointLight& light : from.lights) {
    v1::PointLight& added = *to.add_lights();
    put(light.position, added.mutable_position());
    put(light.colour, added.mutable_colour());
  }
}

void put(const Request& from, v1::ToBackend& envelope) {
  v1::Request& to = *envelope.mutable_request();
  if (from.view) {
    to.set_session(from.view->session);
    to.set_frame(from.view->frame);
    if (from.eye) to.set_eye(from.eye->frame);
  } else {
    to.set_process(from.process);
  }
  to.set_slot(from.slot);
  to.set_object(from.object);
  to.set_shared(from.shared);
  to.set_key(from.key);
  put(from.rect, to.mutable_rectangle());
  to.set_distance(from.distance);
  to.set_urgency(from.urgency);
  to.set_known(from.known);
  to.set_subscribe(from.subscribe);
  if (from.player) put(*from.player, to.mutable_player());
}

void put(const Cancel& from, v1::ToBackend& envelope) {
  v1::Cancel& to = *envelope.mutable_cancel();
  to.set_session(from.session);
  to.set_frame(from.frame);
}

void put(const Quality& from, v1::ToBackend& envelope) {
  envelope.mutable_quality()->set_step(static_cast<std::uint32_t>(from.step));
}

void put(const Forget& from, v1::ToBackend& envelope) { envelope.mutable_forget()->set_session(from.session); }

void put(const Acknowledgement& from, v1::ToBackend& envelope) {
  v1::Acknowledgement& to = *envelope.mutable_acknowledgement();
  put(from.what, to.mutable_what());
  to.set_version(from.version);
}

void put(const Unsubscribe& from, v1::ToBackend& envelope) {
  put(from.what, envelope.mutable_unsubscribe()->mutable_what());
}

void put(const TraceRequest& from, v1::ToBackend& envelope) { envelope.mutable_trace()->set_number(from.number); }

template <class Served>
void putBounds(const world::Bounds& from, Served& to) {
  if (from.empty()) return;
  put(from.low, to.mutable_bounds()->mutable_low());
  put(from.high, to.mutable_bounds()->mutable_high());
}

void put(const NodeWelcome& from, v1::ToFrontend& envelope) {
  v1::NodeWelcome& to = *envelope.mutable_welcome();
  to.set_protocol(from.protocol);
  to.set_build(from.build);
  to.set_scene_hash(from.sceneHash);
  to.set_epoch(from.epoch);
  if (from.visitors) {
    putBounds(from.visitors->bounds, *to.mutable_visitors());
    to.mutable_visitors()->set_own_body(from.visitors->hasOwnBody);
    to.mutable_visitors()->set_shadow(from.visitors->castsShadow);
  }
  for (const ServedObject& object : from.objects) {
    v1::ServedObject& served = *to.add_objects();
    served.set_id(object.id);
    served.set_type(object.type);
    served.set_name(object.name);
    putBounds(object.bounds, served);
    served.set_obstacle_radius(object.obstacleRadius);
  }
}

void put(const NodeRefusal& from, v1::ToFrontend& envelope) {
  envelope.mutable_refusal()->set_reason(utf8::repaired(from.reason, kMaxReasonBytes));
}

void put(const Result& from, v1::ToFrontend& envelope) {
  v1::Result& to = *envelope.mutable_result();
  to.set_session(from.session);
  to.set_frame(from.frame);
  to.set_slot(from.slot);
  put(from.what, to.mutable_what());
  to.set_shared(from.shared);
  to.set_version(from.version);
  to.set_pushed(from.pushed);
  if (const auto* failure = std::get_if<Failure>(&from.payload)) {
    put(*failure, to.mutable_failure());
  } else if (from.packed && from.shared) {
    to.mutable_data();
  } else if (from.packed) {
    to.mutable_picture();
  } else {
    to.mutable_nothing();
  }
}

void put(const Announcement& from, v1::ToFrontend& envelope) {
  v1::Announcement& to = *envelope.mutable_announcement();
  put(from.what, to.mutable_what());
  to.set_version(from.version);
}

[[maybe_unused]] bool mayTravel(const Result& result) {
  if (std::holds_alternative<Failure>(result.payload)) return !result.packed;
  return std::visit(
      []<class Held>(const Held& held) {
        if constexpr (std::is_same_v<Held, Failure>)
          return true;
        else
          return held == nullptr;
      },
      result.payload);
}

template <class Envelope, class Message>
std::string headerOf(const Message& message) {
  Envelope envelope;
  std::visit([&](const auto& value) { put(value, envelope); }, message);
  return envelope.SerializeAsString();
}

}  // namespace

Packet encode(const ToBackend& message) { return {headerOf<v1::ToBackend>(message), nullptr}; }

Packet encode(const ToFrontend& message) {
  const auto* result = std::get_if<Result>(&message);
  assert(result == nullptr || mayTravel(*result));
  return {headerOf<v1::ToFrontend>(message), result == nullptr ? nullptr : result->packed};
}

}  // namespace grove::node
