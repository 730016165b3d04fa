#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "base/error.h"
#include "node/transport/grpc/calls/remote_obstacles.h"
#include "node/transport/grpc/grpc_server.h"
#include "pipeline/worker_pool.h"
#include "world/rays/ray_obstacles.h"

namespace grove::node::testing {

inline constexpr std::uint64_t kScene = 77;
inline constexpr world::Cube kCube{{-1.0F, 0.0F, -1.0F}, 2.0F, 20};

/// A closed box, faces outwards.
inline world::Triangles stone() {
  world::Triangles box;
  for (int i = 0; i < 8; ++i) {
    box.positions.emplace_back((i & 1) != 0 ? 0.4F : -0.5F, (i & 2) != 0 ? 0.9F : 0.0F, (i & 4) != 0 ? 0.3F : -0.6F);
  }
  box.indices = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                 {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return box;
}

/// Those of a stone, counted. What is asked while they are held waits.
class StoneObstacles final : public world::VoxelObstacles {
 public:
  [[nodiscard]] std::vector<std::uint8_t> solidCells(const world::Cube& cube) const override {
    const int among = ++working_;
    mostAtOnce_ = std::max<int>(mostAtOnce_, among);
    while (isHeld) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    auto cells = stone_.solidCells(cube);
    ++answered;
    --working_;
    return cells;
  }
  [[nodiscard]] std::vector<std::uint8_t> sunlitCells(const world::Cube& cube, world::Vec3 towardsSun) const override {
    return stone_.sunlitCells(cube, towardsSun);
  }
  [[nodiscard]] int working() const { return working_; }
  [[nodiscard]] int mostAtOnce() const { return mostAtOnce_; }

  std::atomic<bool> isHeld{false};
  mutable std::atomic<int> answered{0};

 private:
  const world::RayScene surface_{stone()};
  const world::RayObstacles stone_{surface_, surface_};
  mutable std::atomic<int> working_{0};
  mutable std::atomic<int> mostAtOnce_{0};
};

/// A process that knows obstacles and listens.
struct TellingNode {
  explicit TellingNode(int port = 0, const LinkTls& tls = {}, bool tells = true)
      : server(
            "127.0.0.1:" + std::to_string(port), [](const auto&) { return nullptr; }, workers, timeline, tls,
            tells ? answers : nullptr) {}
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(server.port()); }

  pipeline::Timeline timeline;
  StoneObstacles obstacles;
  pipeline::WorkerPool workers{3};
  const std::shared_ptr<ObstacleAnswers> answers =
      std::make_shared<ObstacleAnswers>(obstacles, kScene, workers, timeline);
  GrpcServer server;
};

inline std::string errorOf(const world::VoxelObstacles& obstacles, const world::Cube& cube = kCube) {
  try {
    (void)obstacles.solidCells(cube);
    return "no error";
  } catch (const EnvironmentError& e) {
    return e.what();
  }
}

}  // namespace grove::node::testing
