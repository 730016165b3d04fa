#include "node/frontend/scene_analyzer.h"

#include <algorithm>
#include <utility>

#include "node/limits.h"
#include "pipeline/clocks.h"

namespace grove::node {

namespace {

/// Radians.
constexpr float kLookingDown = -0.55F;

float farthest(const world::Bounds& bounds, world::Vec3 from) {
  return glm::length(glm::max(glm::abs(bounds.low - from), glm::abs(bounds.high - from)));
}

}  // namespace

std::vector<VisibleObject> visibleObjects(const world::Layout& layout, const View& view) {
  std::vector<VisibleObject> visible;
  const auto consider = [&](const world::Object& object) {
    if (!view.camera.sees(object.bounds)) return;
    const world::Rect rect = view.camera.screenRect(object.bounds);
    if (rect.empty()) return;
    visible.push_back({object, rect, farthest(object.bounds, view.camera.pose.position)});
  };
  for (const world::Object& object : layout.objects) consider(object);
  const bool seesOwnBody = layout.visitor && layout.visitor->hasOwnBody && view.camera.pose.pitch < kLookingDown;
  for (const world::Player& player : view.players) {
    const bool isWhole = player.id != view.viewer || seesOwnBody;
    if (const auto object = isWhole ? layout.objectOf(player) : layout.shadowOf(player)) consider(*object);
  }
  // Ids decide between equal distances, so that the order does not depend on the order of the list.
  std::ranges::sort(visible, [](const VisibleObject& a, const VisibleObject& b) {
    return std::pair(-a.distance, a.object.id) < std::pair(-b.distance, b.object.id);
  });
  if (visible.size() > kMaxObjectsPerFrame) {
    visible.erase(visible.begin(), visible.end() - static_cast<std::ptrdiff_t>(kMaxObjectsPerFrame));
  }
  return visible;
}

SceneAnalyzer::SceneAnalyzer(const world::Layout& layout, Look look, double deadlineSeconds,
                             std::function<void()> frameFailed, pipeline::Executor& executor,
                             pipeline::Timeline& timeline)
    : Stage({.name = "Scene Analyzer", .work = pipeline::Work::kPerUserFrontend, .capacity = kMaxFramesInFlight},
            executor, timeline),
      layout_(layout),
      look_(std::move(look)),
      deadlineSeconds_(deadlineSeconds),
      frameFailed_(std::move(frameFailed)) {}

void SceneAnalyzer::connect(std::shared_ptr<pipeline::Inlet<FramePlannerInput>> framePlanner) {
  framePlanner_.connect(std::move(framePlanner));
  addOutlet(framePlanner_);
}

void SceneAnalyzer::process(std::span<FrameTicket> tickets, pipeline::Run& run) {
  for (const FrameTicket& ticket : tickets) {
    auto list = std::make_shared<FrameList>();
    View view = look_(ticket.frame);
    view.visitors = view.players.size();
    view.deadline = pipeline::wallSeconds() + deadlineSeconds_;
    list->view = std::make_shared<const View>(std::move(view));
    list->objects = visibleObjects(layout_, *list->view);
    framePlanner_.send(run, std::shared_ptr<const FrameList>(std::move(list)));
  }
}

void SceneAnalyzer::recover(FrameTicket&, const std::string&, pipeline::Run&) { frameFailed_(); }

}  // namespace grove::node
