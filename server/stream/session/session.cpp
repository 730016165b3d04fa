#include "stream/session/session.h"

#include <algorithm>
#include <cmath>

#include "node/frontend/frontend_node.h"
#include "pipeline/clocks.h"
#include "stream/encode/encode_stage.h"
#include "stream/session/host.h"
#include "stream/session/world_instance.h"

namespace grove::stream {
namespace {

/// How often deadlines of frames are checked: this many times per deadline, and at least this often.
constexpr double kChecksInADeadline = 4.0;
constexpr double kMaxCheckSeconds = 0.1;

bool blows(const world::Player& player) { return (player.keys & world::kBlow) != 0; }

}  // namespace

Session::Session(Host& host, node::SessionId id, world::PlayerId player, int width, int height, FrameSink sink,
                 StreamTerms terms)
    : host_(host),
      id_(id),
      player_(player),
      sink_(std::move(sink)),
      terms_(std::move(terms)),
      control_(std::make_shared<StreamControl>(host.encoders(), host.governor(), terms_.page,
                                               host.options().framesPerSecond, width, height)) {
  if (terms_.offer) control_->offer(terms_.offer->codecs);
  if (terms_.limits) limit(*terms_.limits);
}

Session::~Session() { close(); }

void Session::begin(std::shared_ptr<WorldInstance> instance) {
  const std::weak_ptr<Session> weak = weak_from_this();
  EncodeStage::Outputs outputs;
  outputs.frame = [weak](const std::shared_ptr<const EncodedFrame>& frame) {
    if (const auto self = weak.lock()) self->deliver(frame);
  };
  outputs.captured = terms_.captured;
  std::vector<world::Vec3> fires;
  for (const world::FlickeringLight& each : host_.layout().lights) fires.push_back(each.light.position);
  auto encoder = std::make_shared<EncodeStage>(control_, terms_.page, std::move(fires), std::move(outputs),
                                               host_.memory_, host_.workers(), host_.timeline_);
  auto node = std::make_unique<node::FrontendNode>(
      id_, node::FramePolicy{host_.options().framesInFlight, host_.options().deadlineSeconds},
      [weak](node::FrameNumber frame) {
        const auto self = weak.lock();
        if (self) return self->look(frame);
        node::View nothing;
        nothing.frame = frame;
        return nothing;
      },
      encoder, [gate = host_.gate_] { gate->leave(); }, instance->frontend());
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    instance_ = std::move(instance);
    encoder_ = std::move(encoder);
    node_ = std::move(node);
  }
  reportBreath();
}

void Session::reportBreath() {
  // Under the lock, so that the last report has the newest state.
  const std::lock_guard lock(mutex_);
  const auto player = host_.players().find(player_, pipeline::wallSeconds());
  if (!instance_ || !player) return;
  if (blows(*player)) {
    instance_->world().edits().startBlowing(*player);
  } else {
    instance_->world().edits().stopBlowing(player_);
  }
}

Welcome Session::welcome() const {
  Welcome welcome;
  welcome.framesPerSecond = static_cast<std::uint16_t>(host_.options().framesPerSecond);
  welcome.visitor = node::numberOf(player_);
  welcome.world = host_.layout().name;
  if (const auto player = host_.players().find(player_, pipeline::wallSeconds())) {
    welcome.colour = player->colour;
    welcome.yaw = player->pose.yaw;
    welcome.pitch = player->pose.pitch;
  }
  return welcome;
}

void Session::refuse(Refusal why) {
  {
    const std::lock_guard lock(mutex_);
    if (!closed_) refusal_ = std::move(why);
  }
  close();
}

std::optional<Refusal> Session::refusal() const {
  const std::lock_guard lock(mutex_);
  return refusal_;
}

void Session::close() {
  std::shared_ptr<WorldInstance> instance;  // destroyed last: the others' last runs use it
  std::shared_ptr<EncodeStage> encoder;
  std::unique_ptr<node::FrontendNode> node;
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    closed_ = true;
    instance = std::move(instance_);
    encoder = std::move(encoder_);
    node = std::move(node_);
  }
  if (node) node->close();
  if (encoder) encoder->close();
  if (instance) instance->world().edits().stopBlowing(player_);
  host_.entries_.end(id_, pipeline::wallSeconds());
  host_.players().leave(player_);
  host_.remove(id_);
}

double Session::tick(double now) {
  {
    const std::lock_guard lock(mutex_);
    if (node_ && now >= nextDeadlineCheck_) {
      node_->checkDeadline();
      nextDeadlineCheck_ = now + std::min(kMaxCheckSeconds, host_.options().deadlineSeconds / kChecksInADeadline);
    }
  }
  if (terms_.status) {
    if (const auto status = control_->takeStatus(now, host_.players().count())) terms_.status(*status);
  }
  if (terms_.times) {
    if (const auto times = control_->takeTimes(now)) terms_.times(*times);
  }
  return startIfDue(now);
}

double Session::secondsUnacknowledged(double now) const { return control_->secondsUnacknowledged(now); }

double Session::startIfDue(double now) {
  const double period = 1.0 / control_->framesPerSecond();
  std::unique_lock lock(mutex_);
  if (closed_ || !node_ || control_->isHidden()) return now + 1.0;
  if (now < cadence_.due()) return cadence_.due();
  if (waits_) return now + period;
  if (!entered_ && !host_.entries_.mayBegin(id_, now)) {
    control_->waitsForServer(now);
    return now + period / 8;
  }
  // A frame that cannot start stays due: the acknowledgement or a later check starts it.
  if (isBehind(now)) return now + period / 8;
  if (node_->full()) {
    control_->waitsForServer(now);
    return now + period / 8;
  }
  const auto onTurn = [weak = weak_from_this()] {
    const auto self = weak.lock();
    if (self) self->takeTurn();
    return self != nullptr;
  };
  waits_ = !host_.gate_->enter(onTurn);
  if (waits_) {
    control_->waitsForServer(now);
    return now + period;
  }
  if (startFrame(now)) return cadence_.due();
  // The next session in turn then begins its frame at once.
  lock.unlock();
  host_.gate_->leave();
  return now + period / 8;
}

bool Session::isBehind(double now) const { return !control_->mayBegin(now, encoder_->idle() ? 0 : 1); }

bool Session::startFrame(double now) {
  if (closed_ || !node_ || now < cadence_.due() || isBehind(now)) return false;
  if (!node_->requestFrame()) return false;
  control_->begins(now);
  cadence_.begins(now, 1.0 / control_->framesPerSecond());
  return true;
}

void Session::takeTurn() {
  {
    const std::lock_guard lock(mutex_);
    waits_ = false;
    if (startFrame(pipeline::wallSeconds())) return;
  }
  host_.gate_->leave();
}

node::View Session::look(node::FrameNumber frame) {
  const double now = pipeline::wallSeconds();
  node::View view;
  view.session = id_;
  view.frame = frame;
  const std::shared_ptr<WorldInstance> instance = currentInstance();
  if (!instance) return view;
  world::World& world = instance->world();
  view.viewer = player_;
  view.time = instance->worldSeconds(now);
  view.players = world.players().all(now);
  const auto self = std::ranges::find(view.players, player_, &world::Player::id);
  if (self != view.players.end()) {
    view.lastInput = self->lastInput;
    view.inputAge = now - self->inputTime;
    view.viewerEye = self->pose.position;
    view.viewerVelocity = self->velocity;
    // Their own lantern and shadow are where they will be, too.
    self->pose = lead_.poseAhead(world.players(), *self, control_->leadSeconds(), now);
    view.camera.pose = self->pose;
  }
  view.lights = world.layout().lightsAt(view.time, view.players);
  view.borderPercent = control_->aim(view.camera, view.frame, now);
  return view;
}

std::shared_ptr<WorldInstance> Session::currentInstance() const {
  const std::lock_guard lock(mutex_);
  return instance_;
}

void Session::deliver(const std::shared_ptr<const EncodedFrame>& frame) {
  {
    const std::lock_guard lock(mutex_);
    if (closed_) return;
    if (!std::exchange(entered_, true)) host_.entries_.end(id_, pipeline::wallSeconds());
  }
  control_->sent(frame->header.frame, frame->header.lastInput, frame->message().size(), frame->allowedBytes,
                 pipeline::wallSeconds());
  sink_(frame);
}

}  // namespace grove::stream
