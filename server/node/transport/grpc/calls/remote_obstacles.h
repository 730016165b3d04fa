#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "node/messages/obstacle_messages.h"
#include "node/transport/grpc/tls/link_tls.h"
#include "world/voxel_obstacles.h"

namespace grove::node {

struct CallEnd;

/// Obstacles of a scene whose models another node has. Each request is a call on a connection of its own and blocks its
/// thread until the response arrives, for at most 20 seconds; so it must not run on gRPC's threads. Any other thread.
class RemoteObstacles final : public world::VoxelObstacles {
 public:
  /// For the node at HOST:PORT, which shows the scene with this hash; over TLS as GrpcFrontendEnd.
  RemoteObstacles(std::string address, std::uint64_t sceneHash, LinkTls tls);

  /// Waits for a response of the node. Throws EnvironmentError if none arrives within `patience`, or if the node
  /// refuses or its certificate is rejected.
  void waitForNode(std::chrono::milliseconds patience) const;

  [[nodiscard]] std::vector<std::uint8_t> solidCells(const world::Cube& cube) const override;
  [[nodiscard]] std::vector<std::uint8_t> sunlitCells(const world::Cube& cube, world::Vec3 towardsSun) const override;

 private:
  [[nodiscard]] CallEnd ask(const world::Cube& cube, std::optional<world::Vec3> towardsSun) const;
  [[nodiscard]] CubeCells cellsOf(const CallEnd& end, const world::Cube& cube) const;

  const std::string address_;
  const std::uint64_t sceneHash_;
  const LinkTls tls_;
};

}  // namespace grove::node
