#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <variant>

#include "gl/workers.h"
#include "node/backend/prepare/load_scene.h"
#include "objects/fluid/backend/fluid_backend.h"
#include "objects/fluid/backend/fluid_backend_type.h"
#include "objects/fluid/common/snapshot.h"
#include "pipeline/worker_pool.h"

namespace grove::objects::fluid {

inline node::LoadedScene fireOf(int grid) {
  node::BackendTypes types;
  types.add(std::make_unique<FluidBackendType>());
  const std::string text = "[[object]]\ntype = 'fluid'\ngrid = " + std::to_string(grid) + "\nsize = 4\nrate = 200\n";
  return loadScene(world::parseScene(text, "test"), types);
}

/// A world that is nothing but a fire.
class Fire : public ::testing::Test {
 protected:
  explicit Fire(int grid, double tickSeconds = FluidSimulation::kTick)
      : scene_(fireOf(grid)), backend_(services(), 0, tickSeconds) {}

  node::BackendServices services() {
    return {.scene = scene_,
            .geometry = geometry_,
            .obstacles = geometry_.obstacles(),
            .world = mirror_,
            .workers = workers_,
            .gl = gl_,
            .timeline = timeline_,
            .memory = memory_,
            .images = images_,
            .announce = [this](const node::Announcement& announcement) { take(announcement); },
            .progress = {}};
  }

  [[nodiscard]] world::ObjectId fire() const { return scene_.objects.front().id; }

  static node::Payload answerTo(FluidBackend& backend, world::ObjectId object, bool shared, node::Version known = 0) {
    node::Request request;
    request.known = known;
    request.object = object;
    request.shared = shared;
    node::Payload payload;
    backend.answer({&request, 1}, {&payload, 1});
    return payload;
  }
  /// What a frontend process is answered with.
  std::shared_ptr<const FluidSnapshot> ask() { return askFrom(backend_); }
  std::shared_ptr<const FluidSnapshot> askFrom(FluidBackend& backend) {
    const node::Payload payload = answerTo(backend, fire(), true);
    return std::dynamic_pointer_cast<const FluidSnapshot>(std::get<std::shared_ptr<const node::SharedData>>(payload));
  }

  /// The owner of the world says how many are there.
  void report(std::size_t visitors) {
    const auto update = std::make_shared<node::WorldUpdate>();
    update->number = ++updates_;
    update->clock = kClock;
    update->players.resize(visitors);
    mirror_.apply(1, update);
  }

  std::uint64_t ticks() { return timeline_.totals()["Simulation Tick"].runs; }

  /// On the simulation's thread.
  void take(const node::Announcement& announcement) {
    EXPECT_EQ(announcement.what, (node::SharedKey{fire(), {}}));
    EXPECT_GT(announcement.version, announced_) << "each tick once";
    announced_ = announcement.version;
  }

  /// The world's, which shows something else than the one of this process.
  static constexpr double kClock = 1.0e6;
  const node::LoadedScene scene_;
  const world::WorldGeometry geometry_{scene_.objects};
  node::WorldMirror mirror_;
  std::uint64_t updates_ = 0;
  std::atomic<node::Version> announced_ = 0;
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  raster::ImagePool images_;
  gl::ShaderLibrary shaders_;
  gl::Workers gl_{gl::ContextKind::kAuto, shaders_, 1};
  pipeline::WorkerPool workers_{1, "workers", {}, pipeline::WorkerPool::kMeasured};
  FluidBackend backend_;
};

}  // namespace grove::objects::fluid
