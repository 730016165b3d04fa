#include "objects/ground/common/ground_data.h"

#include <bit>
#include <vector>

#include "node/messages/packing/packing.h"

namespace grove::objects::ground {
namespace {

constexpr int kMaxSize = 1 << 12;
constexpr float kMaxMetres = 1.0e5F;

/// Writes all levels: in a map that is in blocks, the coarser levels cannot be computed from the finest.
void putPyramid(node::PackWriter& writer, const Pyramid& pyramid) {
  writer.put(pyramid.size());
  writer.putPlanes(pyramid.texels());
}

Pyramid takePyramid(node::PackReader& reader) {
  const int size = reader.takeWithin(2, kMaxSize);
  if (!std::has_single_bit(static_cast<unsigned>(size))) reader.fail("has a size that is not a power of two");
  reader.expect(Pyramid::texelsOf(size) * sizeof(std::uint32_t));
  Pyramid pyramid(size);
  reader.takePlanes(pyramid.texels());
  return pyramid;
}

void putHills(node::PackWriter& writer, const std::vector<world::Hill>& hills) {
  writer.put(static_cast<int>(hills.size()));
  for (const world::Hill& hill : hills) writer.put(hill.centre.x).put(hill.centre.y).put(hill.radius).put(hill.height);
}

std::vector<world::Hill> takeHills(node::PackReader& reader) {
  const int count = reader.takeWithin(0, static_cast<int>(world::kMaxHills));
  reader.expect(static_cast<std::size_t>(count) * 4 * sizeof(float));
  std::vector<world::Hill> hills(static_cast<std::size_t>(count));
  for (world::Hill& hill : hills) {
    hill.centre.x = reader.takeFinite(-kMaxMetres, kMaxMetres);
    hill.centre.y = reader.takeFinite(-kMaxMetres, kMaxMetres);
    hill.radius = reader.takeFinite(1.0e-3F, kMaxMetres);
    hill.height = reader.takeFinite(0.0F, world::kMaxGroundHeight);
  }
  return hills;
}

}  // namespace

std::size_t GroundData::ownBytes() const noexcept {
  return sizeof maps_ + pipeline::vectorBytes(maps_.hills) + maps_.clearing.pyramid.bytes() +
         maps_.meadow.pyramid.bytes();
}

node::PackedBytes GroundData::pack() const {
  node::PackWriter writer;
  writer.put(maps_.clearing.metres).put(maps_.meadow.metres).put(maps_.meadow.tallest);
  putPyramid(writer, maps_.clearing.pyramid);
  putPyramid(writer, maps_.meadow.pyramid);
  putHills(writer, maps_.hills);
  return writer.take();
}

std::shared_ptr<GroundData> GroundData::unpack(std::span<const std::byte> bytes) {
  node::PackReader reader(bytes, "the ground");
  const float clearingMetres = reader.takeFinite(1.0e-3F, kMaxMetres);
  const float meadowMetres = reader.takeFinite(1.0e-3F, kMaxMetres);
  const float tallest = reader.takeFinite(0.0F, kTallest);
  Pyramid clearing = takePyramid(reader);
  Pyramid meadow = takePyramid(reader);
  std::vector<world::Hill> hills = takeHills(reader);
  reader.finish();
  return std::make_shared<GroundData>(
      GroundMaps{{std::move(clearing), clearingMetres}, {std::move(meadow), meadowMetres, tallest}, std::move(hills)});
}

}  // namespace grove::objects::ground
