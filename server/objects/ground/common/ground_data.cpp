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

}  // namespace

std::size_t GroundData::ownBytes() const noexcept {
  return sizeof maps_ + maps_.clearing.pyramid.bytes() + maps_.meadow.pyramid.bytes();
}

node::PackedBytes GroundData::pack() const {
  node::PackWriter writer;
  writer.put(maps_.clearing.metres).put(maps_.meadow.metres).put(maps_.meadow.tallest);
  putPyramid(writer, maps_.clearing.pyramid);
  putPyramid(writer, maps_.meadow.pyramid);
  return writer.take();
}

std::shared_ptr<GroundData> GroundData::unpack(std::span<const std::byte> bytes) {
  node::PackReader reader(bytes, "the ground");
  const float clearingMetres = reader.takeFinite(1.0e-3F, kMaxMetres);
  const float meadowMetres = reader.takeFinite(1.0e-3F, kMaxMetres);
  const float tallest = reader.takeFinite(0.0F, kTallest);
  Pyramid clearing = takePyramid(reader);
  Pyramid meadow = takePyramid(reader);
  reader.finish();
  return std::make_shared<GroundData>(
      GroundMaps{{std::move(clearing), clearingMetres}, {std::move(meadow), meadowMetres, tallest}});
}

}  // namespace grove::objects::ground
