#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "gl/workers.h"
#include "node/backend/backend_node.h"
#include "node/boxes.h"
#include "node/faulty_transport.h"
#include "node/frontend/frontend_node.h"
#include "node/tested_transports.h"
#include "pipeline/worker_pool.h"
#include "yuv_pictures.h"

namespace grove::node::testing {

/// The end of a visitor's pipeline: keeps the finished frames.
class Screen final : public pipeline::Stage<FinishedFrame> {
 public:
  Screen(pipeline::Executor& executor, pipeline::Timeline& timeline)
      : Stage({.name = "Screen", .work = pipeline::Work::kPerUserFrontend, .capacity = 4}, executor, timeline) {}

  std::shared_ptr<const raster::Image> waitFor(FrameNumber frame,
                                               std::chrono::milliseconds max = std::chrono::seconds(10)) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, max, [&] { return newest_.view && newest_.view->frame >= frame; });
    return newest_.view && newest_.view->frame >= frame ? tests::rgbaOf(*newest_.picture) : nullptr;
  }
  std::vector<FrameNumber> order() {
    const std::lock_guard lock(mutex_);
    return order_;
  }

 protected:
  void process(std::span<FinishedFrame> frames, pipeline::Run&) override {
    const std::lock_guard lock(mutex_);
    for (FinishedFrame& frame : frames) {
      order_.push_back(frame.view->frame);
      newest_ = std::move(frame);
    }
    arrived_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable arrived_;
  FinishedFrame newest_;
  std::vector<FrameNumber> order_;
};

/// Both halves of Figure 4.2 around either wire: a small near box of red 90 before a far one of red 200. The frontend
/// process has what a process of its own would have, but for the workers and the timeline, by which tests wait.
class Nodes : public ::testing::TestWithParam<TransportKind> {
 public:
  explicit Nodes(BoxAsks asks = BoxAsks::kPictures) : frontends(boxFrontends(asks)) {}
  ~Nodes() override { workers.drain(); }

 protected:
  /// The pipeline of the visitor of this number, who looks along `yaw`.
  std::unique_ptr<FrontendNode> frontend(std::uint32_t number, float yaw, const std::shared_ptr<Screen>& screen,
                                         int framesInFlight = 2) {
    const SessionId session = makeId(kProcess, number);
    return std::make_unique<FrontendNode>(
        session, FramePolicy{framesInFlight, deadlineSeconds},
        [session, yaw](FrameNumber frame) {
          View view;
          view.session = session;
          view.frame = frame;
          view.camera.width = 320;
          view.camera.height = 180;
          view.camera.pose = {{0, 1.7F, 0}, yaw, 0};
          return view;
        },
        screen, [this] { ++ended; }, process);
  }

  static constexpr ProcessId kProcess = 1;
  double deadlineSeconds = 60.0;
  std::atomic<int> ended{0};  ///< frames of all frontends
  const std::shared_ptr<BoxControls> controls = std::make_shared<BoxControls>();
  const BackendTypes backends = boxBackends(controls);
  const FrontendTypes frontends;
  const LoadedScene scene = loadScene(world::parseScene(R"(
[[object]]
type = "box"
red = 200
position = [0, 1.7, -10]
[[object]]
type = "box"
red = 90
size = 0.2
position = [0, 1.7, -4]
)",
                                                        "test"),
                                      backends);
  const world::WorldGeometry geometry{scene.objects};
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;
  gl::ShaderLibrary shaders;
  gl::Workers gl{gl::ContextKind::kAuto, shaders, 1};
  pipeline::WorkerPool workers{3};
  const std::shared_ptr<FaultyTransport> link =
      std::make_shared<FaultyTransport>(transportFactory(GetParam())(workers, timeline));
  FaultyTransport& transport = *link;
  BackendNode backend{scene, geometry, geometry.obstacles(), backends, {workers, gl, timeline, memory, images}, {}};
  const std::shared_ptr<void> served = backend.accept(link);
  const world::Layout layout = scene.layout;
  pipeline::MemoryLedger frontendMemory;
  raster::ImagePool frontendImages;
  FrontendProcess process{kProcess,
                          layout,
                          frontends,
                          transport,
                          {workers, timeline, frontendMemory, frontendImages, layout.sky},
                          std::size_t{1} << 20U};
};

}  // namespace grove::node::testing
