#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "node/messages/hello.h"
#include "node/messages/wire/wire.h"
#include "world/voxel_obstacles.h"

/// Requests of a backend node to one that has the models of all objects, as bytes by the schema node.proto: see
/// world::VoxelObstacles. Decoding returns what was encoded. Any thread.
namespace grove::node {

/// Cells along an edge of a cube.
inline constexpr int kMaxCubeCells = 128;
/// Metres of its edge: no fluid of a scene is smaller or larger.
inline constexpr float kMinCubeSize = 0.005F;
inline constexpr float kMaxCubeSize = 10'000.0F;
/// Metres from the origin to any side of it.
inline constexpr float kMaxCubePlace = 1.0e6F;

/// Requests the solid cells of a cube, or those that the sun shines on.
struct ObstacleRequest {
  std::uint32_t protocol = kProtocol;
  std::uint64_t sceneHash = 0;  ///< of the scene file's text
  world::Cube cube;
  std::optional<world::Vec3> towardsSun = {};  ///< unit vector; empty: requests the solid cells
};

/// Cells of a cube, one byte each, 0 or 1, x fastest.
using CubeCells = std::vector<std::uint8_t>;

[[nodiscard]] std::string encode(const ObstacleRequest& request);
/// Does not check protocol and scene, which the node does.
[[nodiscard]] Decoded<ObstacleRequest> decodeObstacleRequest(std::string_view bytes);

/// One bit per cell, compressed by LZ4.
[[nodiscard]] std::string encodeCells(std::span<const std::uint8_t> cells);
/// For a cube with this many cells per edge.
[[nodiscard]] Decoded<CubeCells> decodeCells(std::string_view bytes, int cellsPerEdge);

}  // namespace grove::node
