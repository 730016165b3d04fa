#include "cli/bench/walk/walk_world.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "pipeline/clocks.h"
#include "stream/session/host.h"

namespace grove::cli {
namespace {

constexpr node::ProcessId kProcess = 1;
/// Until smoke has risen and the first views of plants are made.
constexpr double kSmokeRisesSeconds = 6.0;
constexpr double kFurtherWarmUpSeconds = 1.0;
/// A simulation continues for two seconds after the last visitor.
constexpr auto kUntilRest = std::chrono::milliseconds(2500);

double rateOf(Pace pace) { return pace == Pace::kSixtyASecond ? kDisplayFramesPerSecond : kWalkFramesPerSecond; }

void sleepUntil(double time) {
  std::this_thread::sleep_for(std::chrono::duration<double>(time - pipeline::wallSeconds()));
}

/// Keeps a visitor in the world, so that simulations tick.
class Presence {
 public:
  Presence(world::Players& players, stream::WorldInstance& instance)
      : players_(players), instance_(instance), id_(players.join("Walker", pipeline::wallSeconds())) {}
  ~Presence() {
    players_.leave(id_);
    instance_.publish();
  }
  Presence(const Presence&) = delete;
  Presence& operator=(const Presence&) = delete;

 private:
  world::Players& players_;
  stream::WorldInstance& instance_;
  const world::PlayerId id_;
};

}  // namespace

WalkWorld::WalkWorld(node::LoadedScene scene, const node::ObjectTypes& types, gl::Workers& gl,
                     const std::function<void(std::string_view, float)>& progress, double busyShare)
    : images_(memory_),
      workers_(pipeline::coreCount(), "grove-worker", {}, busyShare),
      nodes_(std::move(scene), types.backends, gl, {workers_, timeline_, memory_, images_}, progress),
      players_(world::World::makePlayers(nodes_.layout())),
      instance_({.nodes = nodes_,
                 .players = players_,
                 .types = types.frontends,
                 .machine = {workers_, timeline_, memory_, images_},
                 .maxSharedBytes = stream::HostOptions().maxSharedBytes,
                 .process = kProcess}) {}

void WalkWorld::walk(const world::Walk& walk, double seconds, Pace pace, const Look& warmUp, const Look& look,
                     const std::stop_token& stop) {
  const Presence presence(*players_, instance_);
  const double warmUpSeconds = std::exchange(warm_, true) ? kFurtherWarmUpSeconds : kSmokeRisesSeconds;
  const double begin = pipeline::wallSeconds() + warmUpSeconds;
  const double rate = rateOf(pace);
  const auto warmUpFrames = static_cast<int>(warmUpSeconds * rate);
  const auto count = static_cast<int>(seconds * rate);
  for (int i = -warmUpFrames; i < count && !stop.stop_requested(); ++i) {
    const double time = i / rate;
    // A warm-up ends on time, however few frames it had.
    if (i < 0 && pipeline::wallSeconds() > begin) continue;
    if (i < 0 || pace != Pace::kOneAfterOther) sleepUntil(begin + time);
    instance_.publishIfDue(pipeline::wallSeconds());
    (i < 0 ? warmUp : look)(momentAt(walk.thereAndBack(std::max(0.0, time))));
  }
}

void WalkWorld::awaitRest() { std::this_thread::sleep_for(kUntilRest); }

Moment WalkWorld::momentAt(const world::Pose& pose) {
  const world::Layout& layout = instance_.world().layout();
  const double now = pipeline::wallSeconds();
  return {world::onGround(pose, layout.hills), now, layout.lightsAt(now, {})};
}

}  // namespace grove::cli
