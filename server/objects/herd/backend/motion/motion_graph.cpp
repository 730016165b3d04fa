#include "objects/herd/backend/motion/motion_graph.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>

#include "objects/herd/backend/motion/pose_window.h"
#include "objects/herd/backend/motion/strong_component.h"
#include "pipeline/vector_bytes.h"

namespace grove::objects::herd {
namespace {

using Frame = MotionDatabase::Frame;

/// Pieces that differ by more do not blend well. Metres.
constexpr float kMaxCost = 0.075F;
constexpr float kMaxSpeedDifference = 0.5F;
constexpr float kGoodCost = 0.03F;
constexpr Frame kEveryOfMany = 10;
constexpr Frame kEvery = 2;  ///< frames between two that are looked at
/// A jump within a clip leads on at least so far.
constexpr Frame kLeastJump = 12;

/// Windows by contacts, sorted by speed.
using Windows = std::array<std::vector<PoseWindow>, 16>;

Windows windowsOf(const MotionDatabase& database) {
  Windows windows;
  for (Frame frame = 0; frame < database.frames().size(); ++frame) {
    if (frame % kEvery != 0 || !hasWindow(database, frame)) continue;
    const PoseWindow window = windowAt(database, frame);
    windows[window.contacts].push_back(window);
  }
  for (auto& same : windows) std::ranges::stable_sort(same, {}, &PoseWindow::speed);
  return windows;
}

/// The best transition from one frame to each clip.
void findFrom(const MotionDatabase& database, const PoseWindow& from, const std::vector<PoseWindow>& targets,
              std::vector<Transition>& found) {
  std::map<std::size_t, Transition> best;
  auto target = std::ranges::lower_bound(targets, from.speed - kMaxSpeedDifference, {}, &PoseWindow::speed);
  for (; target != targets.end() && target->speed <= from.speed + kMaxSpeedDifference; ++target) {
    const Frame apart = std::max(from.frame, target->frame) - std::min(from.frame, target->frame);
    if (apart < kLeastJump) continue;
    const float cost = distance(from, *target);
    if (cost > kMaxCost) continue;
    const auto [it, isNew] =
        best.try_emplace(database.clipOf(target->frame), Transition{from.frame, target->frame, cost, {}});
    if (!isNew && cost < it->second.cost) it->second = {from.frame, target->frame, cost, {}};
  }
  for (const auto& [clip, transition] : best) found.push_back(transition);
}

/// Keeps the local minima over `from` of the transitions to each clip, and some of many good ones: standing animals can
/// then leave soon.
std::vector<Transition> localMinima(const MotionDatabase& database, const std::vector<Transition>& found) {
  std::map<std::pair<Frame, std::size_t>, float> costs;
  for (const Transition& one : found) costs[{one.from, database.clipOf(one.to)}] = one.cost;
  std::vector<Transition> minima;
  for (const Transition& one : found) {
    const std::size_t clip = database.clipOf(one.to);
    const auto costFrom = [&](Frame from) {
      const auto cost = costs.find({from, clip});
      return cost == costs.end() ? std::numeric_limits<float>::infinity() : cost->second;
    };
    const float before = one.from >= kEvery ? costFrom(one.from - kEvery) : costFrom(one.from + 1);
    const bool isMinimum = one.cost <= before && one.cost < costFrom(one.from + kEvery);
    const bool isOneOfMany = one.cost < kGoodCost && one.from % kEveryOfMany == 0;
    if (isMinimum || isOneOfMany) minima.push_back(one);
  }
  return minima;
}

/// Keeps transitions within the largest part of the graph in which every frame reaches every other.
void dropDeadEnds(const MotionDatabase& database, std::vector<Transition>& transitions) {
  std::vector<Edge> edges;
  const auto count = static_cast<Frame>(database.frames().size());
  for (std::size_t clip = 0; clip < database.clips(); ++clip) {
    const Frame end = database.endOf(database.beginOf(clip));
    for (Frame frame = database.beginOf(clip); frame + 1 < end; ++frame) edges.emplace_back(frame, frame + 1);
  }
  for (const Transition& one : transitions) edges.emplace_back(one.from, one.arrival());
  const std::vector<bool> stays = largestComponent(count, edges);
  std::erase_if(transitions, [&](const Transition& one) { return !stays[one.from] || !stays[one.arrival()]; });
}

RootMove blendMove(const MotionDatabase& database, const Transition& transition) {
  RootMove root;
  for (Frame i = 0; i < kBlendFrames; ++i) root = root.then(blendedStep(database, transition, i));
  return root;
}

}  // namespace

Frame Transition::arrival() const noexcept { return to + kBlendFrames; }

RootMove blendedStep(const MotionDatabase& database, const Transition& transition, Frame i) {
  const RootMove a = database[transition.from + i].root.to(database[transition.from + i + 1].root);
  const RootMove b = database[transition.to + i].root.to(database[transition.to + i + 1].root);
  const float share = blendShare(i);
  return {a.place + share * (b.place - a.place), a.yaw + share * (b.yaw - a.yaw)};
}

MotionGraph::MotionGraph(const MotionDatabase& database, const std::function<void(float)>& progress)
    : database_(database) {
  const Windows windows = windowsOf(database);
  std::vector<Transition> found;
  for (std::size_t contacts = 0; contacts < windows.size(); ++contacts) {
    if (progress) progress(static_cast<float>(contacts) / static_cast<float>(windows.size()));
    for (const PoseWindow& from : windows[contacts]) findFrom(database, from, windows[contacts], found);
  }
  transitions_ = localMinima(database, found);
  dropDeadEnds(database, transitions_);
  for (Transition& transition : transitions_) transition.move = blendMove(database, transition);
  std::ranges::sort(transitions_, {}, [](const Transition& one) { return std::pair(one.from, one.to); });
}

std::span<const Transition> MotionGraph::onwardsFrom(Frame frame) const {
  const auto first = std::ranges::lower_bound(transitions_, frame, {}, &Transition::from);
  const auto last = std::ranges::lower_bound(first, transitions_.end(), database_.endOf(frame), {}, &Transition::from);
  return {first, last};
}

Frame MotionGraph::someFrame(Activity activity, std::size_t number) const {
  std::vector<Frame> frames;
  for (const Transition& one : transitions_) {
    if (database_[one.arrival()].activity == activity) frames.push_back(one.arrival());
  }
  assert(!frames.empty() && "every activity is in the graph");
  return frames[number % frames.size()];
}

std::size_t MotionGraph::bytes() const noexcept { return pipeline::vectorBytes(transitions_); }

}  // namespace grove::objects::herd
