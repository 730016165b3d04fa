#include "objects/sky/common/sky_data.h"

#include "node/messages/packing/packing.h"

namespace grove::objects::sky {
namespace {

constexpr int kMaxWidth = 1 << 13;
constexpr int kMaxHeight = 1 << 11;

}  // namespace

std::size_t SkyData::ownBytes() const noexcept { return maps_.sharp.bytes() + maps_.soft.bytes(); }

node::PackedBytes SkyData::pack() const {
  const Panorama& sharp = maps_.sharp;
  const auto texels = static_cast<std::size_t>(sharp.stride()) * static_cast<std::size_t>(sharp.height());
  node::PackWriter writer;
  writer.put(sharp.width()).put(sharp.height());
  writer.putPlanes(std::span<const std::uint32_t>(sharp.texels(), texels));
  return writer.take();
}

std::shared_ptr<SkyData> SkyData::unpack(std::span<const std::byte> bytes) {
  node::PackReader reader(bytes, "a sky");
  const int width = reader.takeWithin(4, kMaxWidth);
  const int height = reader.takeWithin(2, kMaxHeight);
  reader.expect(Panorama::texelsOf({width, height}) * sizeof(std::uint32_t));
  Panorama sharp({width, height});
  reader.takePlanes(sharp.texels());
  reader.finish();
  return std::make_shared<SkyData>(SkyMaps(std::move(sharp)));
}

}  // namespace grove::objects::sky
