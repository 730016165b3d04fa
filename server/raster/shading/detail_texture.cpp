#include "raster/shading/detail_texture.h"

#include <algorithm>
#include <cmath>

#include "raster/shading/noise.h"

namespace grove::raster {
namespace {

constexpr std::uint32_t kSize = DetailTexture::kSize;
constexpr std::uint32_t kWrap = kSize - 1;

std::size_t indexOf(std::uint32_t x, std::uint32_t y, std::uint32_t z) { return (z * kSize + y) * kSize + x; }

/// Value noise with a period of `cells` smooth cells, which fill the cube.
class RepeatingNoise {
 public:
  RepeatingNoise(std::uint32_t cells, std::uint32_t seed) : cells_(cells) {
    for (std::uint32_t i = 0; i < cells * cells * cells; ++i) values_.push_back(random01(seed, i));
  }

  [[nodiscard]] float at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
    const Place px = placeOf(x);
    const Place py = placeOf(y);
    const Place pz = placeOf(z);
    const auto line = [&](std::uint32_t cy, std::uint32_t cz) {
      const std::size_t row = (cz * cells_ + cy) * cells_;
      return std::lerp(values_[row + px.low], values_[row + px.high], px.share);
    };
    const float front = std::lerp(line(py.low, pz.low), line(py.high, pz.low), py.share);
    const float back = std::lerp(line(py.low, pz.high), line(py.high, pz.high), py.share);
    return std::lerp(front, back, pz.share);
  }

 private:
  struct Place {
    std::uint32_t low;
    std::uint32_t high;
    float share;
  };

  [[nodiscard]] Place placeOf(std::uint32_t texel) const {
    const float at = (static_cast<float>(texel) + 0.5F) * static_cast<float>(cells_) / static_cast<float>(kSize);
    const auto cell = static_cast<std::uint32_t>(at);
    const float f = at - static_cast<float>(cell);
    return {cell, (cell + 1) % cells_, f * f * (3.0F - 2.0F * f)};
  }

  std::uint32_t cells_;
  std::vector<float> values_;
};

}  // namespace

DetailTexture::DetailTexture() {
  const RepeatingNoise layers(kSize / 8, 1);
  const RepeatingNoise lumps(kSize / 5, 2);
  const RepeatingNoise grains(kSize / 2, 3);
  const RepeatingNoise pits(kSize / 4, 4);
  std::vector<std::uint8_t> heights(std::size_t{kSize} * kSize * kSize);
  for (std::uint32_t z = 0; z < kSize; ++z) {
    for (std::uint32_t y = 0; y < kSize; ++y) {
      for (std::uint32_t x = 0; x < kSize; ++x) {
        const float deep = std::clamp((pits.at(x, y, z) - 0.62F) * 4.0F, 0.0F, 1.0F);
        const float height = 0.42F * layers.at(x, y, z) + 0.33F * lumps.at(x, y, z) + 0.25F * grains.at(x, y, z);
        const float stretched = 0.55F + 1.35F * (height - 0.5F) - 0.38F * deep * deep;
        heights[indexOf(x, y, z)] = static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(stretched, 0.0F, 1.0F)));
      }
    }
  }
  squares_.resize(std::size_t{kSize} * kSize * kLine);
  for (std::uint32_t y = 0; y < kSize; ++y) {
    for (std::uint32_t x = 0; x < kSize; ++x) {
      for (std::uint32_t z = 0; z <= kSize; ++z) {
        const auto at = [&](std::uint32_t dx, std::uint32_t dy) -> std::uint32_t {
          return heights[indexOf((x + dx) & kWrap, (y + dy) & kWrap, z & kWrap)];
        };
        squares_[(y * kSize + x) * kLine + z] = at(0, 0) | at(1, 0) << 8U | at(0, 1) << 16U | at(1, 1) << 24U;
      }
    }
  }
}

}  // namespace grove::raster
