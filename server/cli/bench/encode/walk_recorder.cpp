#include "cli/bench/encode/walk_recorder.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "base/error.h"
#include "node/frontend/frontend_node.h"
#include "node/transport/reference_transport.h"
#include "pipeline/clocks.h"
#include "pipeline/stage.h"
#include "stream/session/host.h"

namespace grove::cli {
namespace {

constexpr node::SessionId kSession = node::makeId(1, 1);
constexpr node::ProcessId kProcess = 1;
/// Until smoke has risen and the first views of plants are there.
constexpr double kSmokeRisesSeconds = 6.0;
constexpr auto kMaxWait = std::chrono::seconds(60);

int workerCount() { return static_cast<int>(std::max(1U, std::thread::hardware_concurrency())); }

/// Stands where the encoder would: the newest frame waits for whoever asked for it.
class FrameShelf final : public pipeline::Stage<node::FinishedFrame> {
 public:
  FrameShelf(pipeline::Executor& executor, pipeline::Timeline& timeline)
      : Stage({.name = "Recorder",
               .work = pipeline::Work::kPerUserFrontend,
               .capacity = 1,
               .overflow = pipeline::Overflow::kDropOldest,
               .finishes = true},
              executor, timeline) {}

  /// Nothing if it does not come.
  [[nodiscard]] std::optional<node::FinishedFrame> take() {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, kMaxWait, [this] { return frame_.has_value(); });
    return std::exchange(frame_, std::nullopt);
  }

 protected:
  void process(std::span<node::FinishedFrame> items, pipeline::Run& /*run*/) override {
    {
      const std::lock_guard lock(mutex_);
      frame_ = items.back();
    }
    arrived_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::optional<node::FinishedFrame> frame_;
};

void sleepUntil(double time) {
  std::this_thread::sleep_for(std::chrono::duration<double>(time - pipeline::wallSeconds()));
}

}  // namespace

WalkRecorder::WalkRecorder(const node::LoadedScene& scene, const node::ObjectTypes& types, gl::Workers& gl,
                           const std::function<void(std::string_view, float)>& progress)
    : players_(world::World::makePlayers(scene.layout)),
      images_(memory_),
      workers_(workerCount(), "grove-worker"),
      instance_(
          stream::WorldGround{scene,
                              std::make_shared<const world::WorldGeometry>(
                                  scene.objects, [&progress](float share) { progress("laying out the world", share); }),
                              players_, types, node::BackendMachine{workers_, gl, timeline_, memory_, images_},
                              stream::HostOptions().maxSharedBytes, kProcess},
          std::make_unique<node::ReferenceTransport>(), node::Haste::kAllCores, progress) {}

KeptFrames WalkRecorder::record(const world::Walk& walk, double seconds, int width, int height,
                                const std::stop_token& stop) {
  KeptFrames frames(width, height);
  const auto camera = std::make_shared<world::Camera>();
  camera->width = width;
  camera->height = height;
  const auto shelf = std::make_shared<FrameShelf>(workers_, timeline_);
  // The camera is set between two frames only: there is never one in progress then.
  const auto look = [this, camera](node::FrameNumber number) {
    node::View view;
    view.session = kSession;
    view.frame = number;
    view.camera = *camera;
    view.time = pipeline::wallSeconds();
    view.lights = instance_.world().layout().lightsAt(view.time, {});
    return view;
  };
  // Two, as the one before may still be ending when the next begins.
  node::FrontendNode node(
      kSession, {2, stream::HostOptions::kNoHurry}, look, shelf, [] {}, instance_.frontend());
  const auto frameAt = [&](double time) {
    camera->pose = walk.thereAndBack(time);
    if (!node.requestFrame()) return std::optional<node::FinishedFrame>();
    return shelf->take();
  };
  // Simulations tick while somebody is here.
  const world::PlayerId visitor = players_->join("Recorder", pipeline::wallSeconds());
  const double warmUp = std::exchange(warm_, true) ? 1.0 : kSmokeRisesSeconds;
  const double begin = pipeline::wallSeconds() + warmUp;
  const auto warmUpFrames = static_cast<int>(warmUp * kRecordedFramesPerSecond);
  const auto count = static_cast<int>(seconds * kRecordedFramesPerSecond);
  for (int i = -warmUpFrames; i < count && !stop.stop_requested(); ++i) {
    const double time = i / kRecordedFramesPerSecond;
    // A warm-up is over in its time, however few frames come of it.
    if (i < 0 && pipeline::wallSeconds() > begin) continue;
    sleepUntil(begin + time);
    instance_.publish();
    const auto frame = frameAt(std::max(0.0, time));
    if (!frame) throw EnvironmentError("a frame did not come within a minute", "recording", "");
    if (i >= 0) frames.add(camera->pose, *frame->image);
  }
  node.close();
  shelf->close();
  workers_.drain();
  players_->leave(visitor);
  instance_.publish();
  instance_.forget(kSession);
  return frames;
}

}  // namespace grove::cli
