#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "eventually.h"
#include "node/nodes_fixture.h"

/// One backend node, and frontend processes that share it.
namespace grove::node {

/// What a backend node stands on, with workers of its own beside those of the frontend processes.
class OneNode {
 public:
  const std::shared_ptr<testing::BoxControls> controls = std::make_shared<testing::BoxControls>();
  const BackendTypes types = testing::boxBackends(controls);
  const LoadedScene scene =
      loadScene(world::parseScene("[[object]]\ntype = \"box\"\nred = 90\nposition = [0, 1.7, -4]\n", "test"), types);
  const world::WorldGeometry geometry{scene.objects};
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;
  gl::ShaderLibrary shaders;
  gl::Workers gl{gl::ContextKind::kAuto, shaders, 1};
  pipeline::WorkerPool nodeWorkers{2};
  pipeline::WorkerPool workers{2};
  BackendNode backend{scene, geometry, geometry.obstacles(), types, {nodeWorkers, gl, timeline, memory, images}, {}};

  std::int64_t refused() { return timeline.counters()["refused messages"]; }
};

/// A frontend process with one visitor before the box.
class Process {
 public:
  Process(OneNode& node, TransportKind kind, ProcessId id, testing::BoxAsks asks = testing::BoxAsks::kPictures)
      : node_(node),
        types_(testing::boxFrontends(asks)),
        link_(transportFactory(kind)(node.workers, node.timeline)),
        served_(node.backend.accept(link_)),
        process_(id, node.scene.layout, types_, *link_,
                 {node.workers, node.timeline, node.memory, node.images, node.scene.layout.sky}, 1U << 20U),
        screen_(std::make_shared<testing::Screen>(node.workers, node.timeline)),
        visitor_(
            makeId(id, 1), {.framesInFlight = 1, .deadlineSeconds = 60.0},
            [id](FrameNumber frame) {
              View view;
              view.session = makeId(id, 1);
              view.frame = frame;
              view.camera.width = 320;
              view.camera.height = 180;
              view.camera.pose = {{0, 1.7F, 0}, 0, 0};
              return view;
            },
            screen_, {}, process_) {}
  ~Process() {
    visitor_.close();
    node_.workers.drain();
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool ask() { return visitor_.requestFrame(); }
  /// Red in the middle of the next frame.
  std::uint32_t red() {
    if (!tests::eventually([&] { return ask(); })) return 0;
    const auto image = screen_->waitFor(++frame_);
    return image ? image->colourRow(90)[160] & 0xFFU : 0;
  }
  void send(ToBackend message) { (void)process_.send(std::move(message)); }
  std::weak_ptr<Transport> link() { return link_; }

 private:
  OneNode& node_;
  const FrontendTypes types_;
  const std::shared_ptr<Transport> link_;
  const std::shared_ptr<void> served_;
  FrontendProcess process_;
  FrameNumber frame_ = 0;
  const std::shared_ptr<testing::Screen> screen_;
  FrontendNode visitor_;
};

/// A frontend process whose words the test chooses.
class RawPeer final : public FrontendPort {
 public:
  RawPeer(OneNode& node, TransportKind kind)
      : node_(node), link_(transportFactory(kind)(node.workers, node.timeline)), served_(node.backend.accept(link_)) {
    link_->connect(static_cast<FrontendPort&>(*this));
  }
  ~RawPeer() override {
    link_->leaveFrontend();
    node_.workers.drain();
  }
  RawPeer(const RawPeer&) = delete;
  RawPeer& operator=(const RawPeer&) = delete;

  void receive(ToFrontend message) override {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
  }
  pipeline::PushResult send(ToBackend message) { return link_->send(std::move(message)); }
  /// All that was sent has been heard.
  void settle() {
    for (int stage = 0; stage < 8; ++stage) {
      node_.workers.drain();
      node_.nodeWorkers.drain();
    }
  }
  /// The reason of the refusal; empty if it is welcome.
  std::string hello(ProcessId process, std::uint64_t sceneHash) {
    messages();
    (void)send(NodeHello{.build = "any", .sceneHash = sceneHash, .process = process, .types = {}});
    settle();
    const std::vector<ToFrontend> said = messages();
    if (said.size() != 1) return "no reply";
    const auto* const refusal = std::get_if<NodeRefusal>(said.data());
    return refusal == nullptr ? "" : refusal->reason;
  }
  std::string hello(ProcessId process) { return hello(process, node_.scene.layout.hash); }
  /// What came since the last call.
  std::vector<ToFrontend> messages() {
    const std::lock_guard lock(mutex_);
    return std::exchange(messages_, {});
  }

 private:
  OneNode& node_;
  const std::shared_ptr<Transport> link_;
  const std::shared_ptr<void> served_;
  std::mutex mutex_;
  std::vector<ToFrontend> messages_;
};

[[nodiscard]] inline std::shared_ptr<const WorldUpdate> updateOf(std::uint64_t number, world::PlayerId player) {
  auto update = std::make_shared<WorldUpdate>();
  update->number = number;
  update->players.emplace_back().id = player;
  return update;
}

[[nodiscard]] inline std::shared_ptr<const View> viewOf(SessionId session) {
  auto view = std::make_shared<View>();
  view->session = session;
  view->frame = 1;
  view->camera.width = 320;
  view->camera.height = 180;
  return view;
}

[[nodiscard]] inline Request pictureOf(const OneNode& node, std::shared_ptr<const View> view) {
  Request request;
  request.view = std::move(view);
  request.object = node.scene.objects[0].id;
  request.rect = {0, 0, 8, 8};
  return request;
}

}  // namespace grove::node
