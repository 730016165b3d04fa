#include "node/messages/obstacle_messages.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "node/messages/node.pb.h"
#include "node/messages/packing/packing.h"
#include "node/messages/wire/decode_parts.h"

namespace grove::node {
namespace {

// Scenes give the sun's direction in float.
constexpr float kSunTolerance = 1.0e-3F;
constexpr std::size_t kBitsPerByte = 8;

void putVector(const world::Vec3& from, v1::Vector* to) {
  to->set_x(from.x);
  to->set_y(from.y);
  to->set_z(from.z);
}

float farthest(const world::Vec3& place) { return std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)}); }

std::size_t cellsOf(int cellsPerEdge) {
  const auto edge = static_cast<std::size_t>(cellsPerEdge);
  return edge * edge * edge;
}

std::size_t bytesOfBits(std::size_t bits) { return (bits + kBitsPerByte - 1) / kBitsPerByte; }

}  // namespace

std::string encode(const ObstacleRequest& request) {
  v1::ObstacleRequest to;
  to.set_protocol(request.protocol);
  to.set_scene_hash(request.sceneHash);
  putVector(request.cube.low, to.mutable_low());
  to.set_size(request.cube.size);
  to.set_cells(static_cast<std::uint32_t>(request.cube.cells));
  if (request.towardsSun) putVector(*request.towardsSun, to.mutable_towards_sun());
  return to.SerializeAsString();
}

Decoded<ObstacleRequest> decodeObstacleRequest(std::string_view bytes) {
  v1::ObstacleRequest from;
  Checks checks("request for obstacles");
  if (!parse(bytes, from, checks)) return checks.error();
  checks.require(from.cells() >= 1 && from.cells() <= static_cast<std::uint32_t>(kMaxCubeCells),
                 "its number of cells is out of range");
  checks.require(from.size() >= kMinCubeSize && from.size() <= kMaxCubeSize, "its cube's size is out of range");
  ObstacleRequest to{.protocol = from.protocol(), .sceneHash = from.scene_hash(), .cube = {}};
  to.cube.low = decode(from.low(), checks);
  checks.require(farthest(to.cube.low) <= kMaxCubePlace, "its cube is too far away");
  if (from.has_towards_sun()) {
    to.towardsSun = decode(from.towards_sun(), checks);
    checks.require(std::abs(glm::length(*to.towardsSun) - 1.0F) <= kSunTolerance,
                   "its direction of the sun is not a unit vector");
  }
  if (!checks.good()) return checks.error();
  to.cube.size = from.size();
  to.cube.cells = static_cast<int>(from.cells());
  return to;
}

std::string encodeCells(std::span<const std::uint8_t> cells) {
  PackedBytes bits(bytesOfBits(cells.size()));
  for (std::size_t i = 0; i < cells.size(); ++i) {
    assert(cells[i] <= 1);
    bits[i / kBitsPerByte] |= static_cast<std::byte>(cells[i] << i % kBitsPerByte);
  }
  const PackedBytes packed = PackWriter(bits.size()).putBytes(bits).take();
  v1::ObstacleAnswer to;
  to.set_cells(packed.data(), packed.size());
  return to.SerializeAsString();
}

Decoded<CubeCells> decodeCells(std::string_view bytes, int cellsPerEdge) {
  assert(cellsPerEdge >= 1 && cellsPerEdge <= kMaxCubeCells);
  v1::ObstacleAnswer from;
  Checks checks("response with obstacles");
  if (!parse(bytes, from, checks)) return checks.error();
  const std::size_t count = cellsOf(cellsPerEdge);
  PackedBytes bits;
  try {
    PackReader reader(std::as_bytes(std::span(from.cells())), "its plane");
    reader.expect(bytesOfBits(count));
    bits.resize(bytesOfBits(count));
    reader.takeBytes(bits);
    reader.finish();
  } catch (const PackingError& e) {
    return WireError{std::string("response with obstacles: ") + e.what()};
  }
  CubeCells cells(count);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = static_cast<std::uint8_t>(bits[i / kBitsPerByte] >> i % kBitsPerByte & std::byte{1});
  }
  return cells;
}

}  // namespace grove::node
