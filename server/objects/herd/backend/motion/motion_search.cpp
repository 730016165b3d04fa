#include "objects/herd/backend/motion/motion_search.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>
#include <utility>

#include "objects/herd/backend/motion/pose_window.h"
#include "pipeline/vector_bytes.h"

namespace grove::objects::herd {
namespace {

using world::Vec2;
using Frame = MotionDatabase::Frame;

constexpr float kHorizon = 2.0F;  ///< seconds
/// Seconds. Shorter paths are extended to this time with their last activity, so that their costs compare.
constexpr float kCompared = 3.5F;
constexpr std::size_t kBeam = 8;
constexpr int kDepth = 4;
constexpr std::size_t kFrames = static_cast<std::size_t>(kFramesPerSecond);
/// A transition after this time is only an option if there is no earlier one.
constexpr float kLatest = 2.6F;
/// Seconds that a blend costs per metre of pose distance.
constexpr float kCostOfBlend = 3.0F;
constexpr float kCostOfTurning = 0.7F;  ///< seconds per radian away from the goal
constexpr float kNearPlace = 0.5F;      ///< metres

/// Metres per second at which an animal goes.
float speedOf(Activity activity) {
  constexpr std::array<float, kActivities> kSpeeds{0.5F, 0.25F, 0.5F, 1.05F, 3.0F, 6.0F};
  return kSpeeds[static_cast<std::size_t>(activity)];
}

/// Penalty per second for another activity than the wanted one, in seconds. A faster gait costs more than it gains.
float mismatch(Activity wanted, Activity done) {
  if (wanted == done) return 0.0F;
  using enum Activity;
  const auto isStill = [](Activity one) { return one == kStand || one == kGraze || one == kAlert; };
  if (isStill(wanted) && isStill(done)) return 0.8F;
  return std::max(1.0F, 2.0F * speedOf(done) / speedOf(wanted));
}

/// A way through the graph.
struct Path {
  const Transition* first = nullptr;
  Frame frame = 0;
  RootMove root;
  float seconds = 0.0F;
  float cost = 0.0F;   ///< so far
  float total = 0.0F;  ///< with what is left to the goal
};

/// Seconds that are left to the goal, by the most direct way.
float remaining(const MotionGoal& goal, const RootMove& root) {
  float seconds = 0.0F;
  if (goal.place) {
    const Vec2 way = *goal.place - root.place;
    const float distance = glm::length(way);
    seconds += distance / speedOf(goal.activity);
    if (distance > kNearPlace) {
      const float ahead = std::clamp(glm::dot(way, root.heading()) / distance, -1.0F, 1.0F);
      seconds += kCostOfTurning * std::acos(ahead);
    }
  }
  if (goal.facing) seconds += kCostOfTurning * std::abs(std::remainder(*goal.facing - root.yaw, kTurn));
  return seconds;
}

/// Cost per second of going on with an activity.
float costRate(const MotionGoal& goal, Activity done) {
  const float going = goal.place ? std::max(0.0F, 1.0F - speedOf(done) / speedOf(goal.activity)) : 0.0F;
  return mismatch(goal.activity, done) + going;
}

/// Cost of obstacles ahead, up to where an animal that goes so fast can stop.
float costAhead(const RootMove& root, Activity activity, const Hindrance& hindrance) {
  constexpr std::array<float, kActivities> kStops{0.9F, 0.9F, 0.9F, 1.2F, 4.0F, 9.0F};  // metres
  const float far = kStops[static_cast<std::size_t>(activity)];
  float cost = 0.0F;
  for (const float share : {0.33F, 0.66F, 1.0F}) cost += hindrance(root.place + share * far * root.heading());
  return 0.5F * cost;
}

Path extended(const Path& path, const Option& option, Activity arrived, const MotionGoal& goal,
              const Hindrance& hindrance) {
  Path next;
  next.first = path.first != nullptr ? path.first : option.transition;
  next.frame = option.transition->arrival();
  next.root = path.root.then(option.move);
  next.seconds = path.seconds + option.seconds;
  next.cost = path.cost + kCostOfBlend * option.transition->cost;
  if (goal.place) next.cost += option.seconds;
  for (std::size_t i = 0; i < kActivities; ++i) {
    next.cost += option.activities[i] * mismatch(goal.activity, static_cast<Activity>(i));
  }
  for (const Vec2& place : option.way) next.cost += hindrance(path.root.place + path.root.turned(place));
  const float rest = std::max(0.0F, kCompared - next.seconds) * costRate(goal, arrived);
  next.total = next.cost + costAhead(next.root, arrived, hindrance) + remaining(goal, next.root) + rest;
  return next;
}

}  // namespace

MotionSearch::MotionSearch(const MotionGraph& graph) : graph_(graph), options_(graph.database().frames().size()) {}

const Transition& MotionSearch::next(Frame frame, const RootMove& root, const MotionGoal& goal,
                                     const Hindrance& hindrance) {
  std::vector<Path> beam{{nullptr, frame, root, 0.0F, 0.0F, 0.0F}};
  std::vector<Path> ended;
  for (int depth = 0; depth < kDepth && !beam.empty(); ++depth) {
    std::vector<Path> found;
    for (const Path& path : beam) {
      for (const Option& option : optionsAt(path.frame)) {
        const Activity arrived = graph_.database()[option.transition->arrival()].activity;
        const Path one = extended(path, option, arrived, goal, hindrance);
        (one.seconds >= kHorizon ? ended : found).push_back(one);
      }
    }
    const auto kept = static_cast<std::ptrdiff_t>(std::min(kBeam, found.size()));
    std::ranges::partial_sort(found, found.begin() + kept, {}, &Path::total);
    found.erase(found.begin() + kept, found.end());
    beam = std::move(found);
  }
  ended.insert(ended.end(), beam.begin(), beam.end());
  assert(!ended.empty() && "everything in the graph leads on");
  return *std::ranges::min_element(ended, {}, &Path::total)->first;
}

const MotionSearch::Options& MotionSearch::optionsAt(Frame frame) {
  std::unique_ptr<const Options>& options = options_[frame];
  ++lookups_.all;
  if (options) {
    ++lookups_.cached;
  } else {
    options = std::make_unique<const Options>(makeOptions(frame));
    bytes_ += pipeline::vectorBytes(*options);
  }
  return *options;
}

MotionSearch::Options MotionSearch::makeOptions(Frame frame) const {
  const MotionDatabase& database = graph_.database();
  Options options;
  std::set<std::size_t> clips;
  for (const Transition& transition : graph_.onwardsFrom(frame)) {
    const float wait = static_cast<float>(transition.from - frame) / kFramesPerSecond;
    if (wait > kLatest && !options.empty()) break;
    if (!clips.insert(database.clipOf(transition.to)).second) continue;
    Option option;
    option.transition = &transition;
    option.seconds = wait + static_cast<float>(kBlendFrames) / kFramesPerSecond;
    const RootMove& begin = database[frame].root;
    option.move = begin.to(database[transition.from].root).then(transition.move);
    for (Frame i = frame; i < transition.from; ++i) {
      option.activities[static_cast<std::size_t>(database[i].activity)] += 1.0F / static_cast<float>(kFrames);
    }
    const Activity arrived = database[transition.arrival()].activity;
    option.activities[static_cast<std::size_t>(arrived)] +=
        static_cast<float>(kBlendFrames) / static_cast<float>(kFrames);
    for (std::size_t i = 0; i + 1 < Option::kSamples; ++i) {
      const auto part = static_cast<Frame>((transition.from - frame) * (i + 1) / (Option::kSamples - 1));
      option.way[i] = begin.to(database[frame + part].root).place;
    }
    option.way.back() = option.move.place;
    options.push_back(option);
  }
  return options;
}

}  // namespace grove::objects::herd
