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

/// What a backend node asks of another one that has the models of all objects, as bytes by the schema node.proto: see
/// world::VoxelObstacles. What is encoded here is decoded equal. Any thread.
namespace grove::node {

/// Cells along the edge of a cube.
inline constexpr int kMaxCubeCells = 128;
/// Metres, of its edge: less and more than any fluid of a scene measures.
inline constexpr float kMinCubeSize = 0.005F;
inline constexpr float kMaxCubeSize = 10'000.0F;
/// Metres from the origin to any side of it.
inline constexpr float kMaxCubePlace = 1.0e6F;

/// Of a cube, the solid cells, or those that the sun shines on.
struct ObstacleRequest {
  std::uint32_t protocol = kProtocol;
  std::uint64_t sceneHash = 0;  ///< of the scene file's text
  world::Cube cube;
  std::optional<world::Vec3> towardsSun = {};  ///< unit vector; nothing: the solid cells are asked for
};

/// Cells of a cube, one byte each, 0 or 1, x fastest.
using CubeCells = std::vector<std::uint8_t>;

[[nodiscard]] std::string encode(const ObstacleRequest& request);
/// Whoever asks: protocol and scene are for the node to judge.
[[nodiscard]] Decoded<ObstacleRequest> decodeObstacleRequest(std::string_view bytes);

/// A bit each, which LZ4 makes smaller.
[[nodiscard]] std::string encodeCells(std::span<const std::uint8_t> cells);
/// Of a cube with so many cells per edge, as it was asked for.
[[nodiscard]] Decoded<CubeCells> decodeCells(std::string_view bytes, int cellsPerEdge);

}  // namespace grove::node
