#include "objects/lightfield/frontend/mixed_tiles.h"

#include <algorithm>
#include <cmath>

#include "world/camera.h"

namespace grove::objects::lightfield {
namespace {

constexpr std::uint32_t kWhole = 256;
/// Two of a colour's four bytes.
constexpr std::uint32_t kEven = 0x00FF00FFU;
/// One picture is rounded down and the other up: two equal colours give the same colour, and no sum overflows a byte.
constexpr std::uint32_t kDown = 0;
constexpr std::uint32_t kUp = kEven;

std::uint32_t scaled(std::uint32_t colour, std::uint32_t share, std::uint32_t rounding) {
  const std::uint32_t even = (((colour & kEven) * share + rounding) >> 8U) & kEven;
  const std::uint32_t odd = (((colour >> 8U) & kEven) * share + rounding) & ~kEven;
  return even | odd;
}

}  // namespace

MixedTiles::MixedTiles(float share)
    : share_(static_cast<std::uint32_t>(std::lround(static_cast<float>(kWhole) * std::clamp(share, 0.0F, 1.0F)))) {}

void MixedTiles::addLeaving(const world::Rect& part, const WarpTile& tile) { add(part, tile, kWhole - share_, kDown); }

void MixedTiles::addComing(const world::Rect& part, const WarpTile& tile) { add(part, tile, share_, kUp); }

void MixedTiles::add(const world::Rect& part, const WarpTile& tile, std::uint32_t share, std::uint32_t rounding) {
  const auto [place, isNew] = tiles_.try_emplace({part.top, part.left});
  Mixed& mixed = place->second;
  if (isNew) {
    mixed.part = part;
    std::ranges::fill(mixed.colour, 0U);
    std::ranges::fill(mixed.depth, world::kInfiniteDepth);
  }
  for (int i = 0; i < kTilePixels; ++i) {
    mixed.colour[i] += scaled(tile.colour[i], share, rounding);
    if (tile.depth[i] < world::kInfiniteDepth) mixed.depth[i] = tile.depth[i];
  }
}

void MixedTiles::forEach(const std::function<void(const world::Rect&, std::uint32_t*, const float*)>& lay) {
  for (auto& [place, mixed] : tiles_) lay(mixed.part, mixed.colour, mixed.depth);
}

}  // namespace grove::objects::lightfield
