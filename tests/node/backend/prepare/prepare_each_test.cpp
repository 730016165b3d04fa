#include "node/backend/prepare/prepare_each.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <new>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "gl/workers.h"
#include "node/backend/backend_half.h"
#include "pipeline/worker_pool.h"

namespace grove::node {
namespace {

class PrepareEach : public ::testing::Test {
 protected:
  BackendServices services(std::function<void(std::string_view, float)> progress) {
    return services(std::move(progress), workers_);
  }
  BackendServices services(std::function<void(std::string_view, float)> progress, pipeline::Executor& workers) {
    return {.scene = scene_,
            .geometry = geometry_,
            .obstacles = geometry_.obstacles(),
            .world = world_,
            .workers = workers,
            .gl = gl_,
            .timeline = timeline_,
            .memory = memory_,
            .images = images_,
            .announce = {},
            .progress = std::move(progress)};
  }

  const LoadedScene scene_{};
  const world::WorldGeometry geometry_{scene_.objects};
  const WorldMirror world_{};
  pipeline::WorkerPool workers_{2};
  gl::ShaderLibrary shaders_;
  gl::Workers gl_{gl::ContextKind::kAuto, shaders_, 1};
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  raster::ImagePool images_;
};

// Fault: a preparation whose world is not wanted any more goes on to its last part.
TEST_F(PrepareEach, StopsWhenProgressThrows) {
  std::atomic<int> done = 0;
  const auto progress = [](std::string_view label, float) {
    EXPECT_EQ(label, "parts");
    throw std::runtime_error("not wanted");
  };
  const auto work = [&](std::size_t) {
    ++done;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  };
  EXPECT_THROW(prepareEach(services(progress), "parts", 10'000, work), std::runtime_error);
  EXPECT_LT(done, 10'000);
}

TEST_F(PrepareEach, WaitsForHelpers) {
  std::array<std::atomic<int>, 64> done{};
  std::atomic<bool> here = false;
  const std::thread::id self = std::this_thread::get_id();
  prepareEach(services({}), "parts", done.size(), [&](std::size_t i) {
    if (std::this_thread::get_id() == self) here = true;
    ++done[i];
  });
  EXPECT_FALSE(here);
  EXPECT_TRUE(std::ranges::all_of(done, [](const auto& times) { return times == 1; }));
}

TEST_F(PrepareEach, RethrowsExceptionsOfHelpers) {
  std::atomic<int> done = 0;
  std::atomic<bool> throws = false;
  const auto all = [&] {
    prepareEach(services({}), "parts", 1000, [&](std::size_t i) {
      ++done;
      if (i == 10) {
        throws = true;
        throws.notify_all();
        throw std::runtime_error("ten");
      }
      if (i < 10) return;
      // Else the other helper may do all the rest before this one has thrown.
      throws.wait(false);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
  };
  EXPECT_THROW(all(), std::runtime_error);
  EXPECT_LT(done, 1000);
}

/// An executor that takes one task and then has no memory for more.
class Short final : public pipeline::Executor {
 public:
  [[nodiscard]] int width() const noexcept override { return 3; }

 private:
  void enqueue(std::function<void()> task, Place /*place*/) override {
    if (std::exchange(taken_, true)) throw std::bad_alloc();
    pool_.post(std::move(task));
  }
  bool taken_ = false;
  pipeline::WorkerPool pool_{1};
};

TEST_F(PrepareEach, WaitsForPostedTasksWhenPostingFails) {
  Short executor;
  EXPECT_THROW(prepareEach(services({}, executor), "parts", 1000, [](std::size_t) {}), std::bad_alloc);
}

}  // namespace
}  // namespace grove::node
