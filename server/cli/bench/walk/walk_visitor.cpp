#include "cli/bench/walk/walk_visitor.h"

#include <utility>

#include "base/error.h"
#include "stream/adapt/stream_policy.h"
#include "stream/session/host.h"

namespace grove::cli {
namespace {

constexpr std::uint32_t kFirstPart = 1;

[[noreturn]] void failToDraw() { throw EnvironmentError("a frame did not come within a minute", "drawing a walk", ""); }

}  // namespace

node::FramePolicy walkPolicy() { return {.framesInFlight = 2, .deadlineSeconds = stream::HostOptions::kNoHurry}; }

node::FramePolicy wholePolicy() {
  node::FramePolicy policy = walkPolicy();
  policy.backdrops = false;
  return policy;
}

WalkVisitor::WalkVisitor(WalkWorld& world, const Terms& terms, std::unique_ptr<stream::Encoder> encoder)
    : world_(world),
      session_(node::makeId(kFirstPart, terms.number)),
      size_(terms.size),
      borderPercent_(terms.borderPercent),
      shelf_(std::make_shared<FrameShelf>(std::move(encoder), world.workers(), world.timeline())),
      node_(
          session_, terms.policy, [this](node::FrameNumber number) { return look(number); }, shelf_, [] {},
          world.instance().frontend()) {}

WalkVisitor::~WalkVisitor() {
  node_.close();
  shelf_->close();
  world_.workers().drain();
  world_.instance().forget(session_);
}

void WalkVisitor::begin(const Moment& moment) {
  moment_ = moment;
  if (!node_.requestFrame()) failToDraw();
}

node::FinishedFrame WalkVisitor::take() {
  auto frame = shelf_->take();
  if (!frame) failToDraw();
  return std::move(*frame);
}

node::View WalkVisitor::look(node::FrameNumber number) const {
  node::View view;
  view.session = session_;
  view.frame = number;
  view.camera.width = size_.width;
  view.camera.height = size_.height;
  if (borderPercent_ > 0) view.camera = stream::withBorder(view.camera, borderPercent_);
  view.borderPercent = borderPercent_;
  view.camera.pose = moment_.pose;
  view.time = moment_.time;
  view.lights = moment_.lights;
  return view;
}

}  // namespace grove::cli
