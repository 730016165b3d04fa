#include "objects/sky/common/panorama.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

namespace grove::objects::sky {
namespace {

constexpr float kTurn = 2.0F * std::numbers::pi_v<float>;

world::Vec3 channels(std::uint32_t rgba) {
  const auto channel = [&](unsigned shift) { return static_cast<float>((rgba >> shift) & 0xFFU); };
  return {channel(0), channel(8), channel(16)};
}

/// Averages the texels around each texel of the smaller map.
Panorama softened(const Panorama& sharp) {
  const PanoramaSize size{std::max(4, sharp.width() / kSoftColumns), std::max(2, sharp.height() / kSoftRows)};
  Panorama soft(size);
  const float across = static_cast<float>(sharp.width()) / static_cast<float>(size.width);
  const float along = static_cast<float>(sharp.height() - 1) / static_cast<float>(size.height - 1);
  for (int row = 0; row < size.height; ++row) {
    for (int column = 0; column < size.width; ++column) {
      world::Vec3 sum(0.0F);
      for (const float up : {-0.25F, 0.25F}) {
        for (const float aside : {-0.375F, -0.125F, 0.125F, 0.375F}) {
          sum += sharp.at((static_cast<float>(column) + aside) * across, (static_cast<float>(row) + up) * along);
        }
      }
      const world::Vec3 mean = sum * (1.0F / 8.0F) + 0.5F;
      const auto byte = [](float channel) { return static_cast<std::uint32_t>(channel); };
      soft.set(column, row, byte(mean.r) | byte(mean.g) << 8U | byte(mean.b) << 16U | 0xFF000000U);
    }
  }
  return soft;
}

}  // namespace

Panorama::Panorama(PanoramaSize size) : size_(size) {
  assert(size.width >= 4 && size.height >= 2);
  texels_.resize(texelsOf(size));
}

std::uint32_t Panorama::texel(int column, int row) const noexcept {
  return texels_[static_cast<std::size_t>(row) * static_cast<std::size_t>(stride()) + static_cast<std::size_t>(column)];
}

void Panorama::set(int column, int row, std::uint32_t rgba) noexcept {
  const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(stride());
  texels_[first + static_cast<std::size_t>(column)] = rgba;
  if (column == 0) texels_[first + static_cast<std::size_t>(size_.width)] = rgba;
}

float Panorama::heading(int column) const noexcept {
  return kTurn * static_cast<float>(column) / static_cast<float>(size_.width);
}

float Panorama::tangent(int row) const noexcept {
  // The last row is the zenith, whose tangent is infinite; a tangent far beyond the previous row's replaces it.
  const float s = std::min(static_cast<float>(row) / static_cast<float>(size_.height - 1), 0.9999F);
  return kSpread * s / (1.0F - s) - kBelow;
}

world::Vec3 Panorama::direction(float heading, float tangent) noexcept {
  return glm::normalize(world::Vec3(std::sin(heading), tangent, -std::cos(heading)));
}

world::Vec3 Panorama::sample(world::Vec3 direction) const noexcept {
  const float across = std::hypot(direction.x, direction.z);
  const float above = std::max(0.0F, direction.y + kBelow * across);
  const float turns = std::atan2(direction.x, -direction.z) / kTurn;
  const float x = (turns - std::floor(turns)) * static_cast<float>(size_.width);
  const float y = above / (above + kSpread * across) * static_cast<float>(size_.height - 1);
  return at(x, y);
}

world::Vec3 Panorama::at(float x, float y) const noexcept {
  const auto width = static_cast<float>(size_.width);
  const float along = x - std::floor(x / width) * width;
  const float up = std::clamp(y, 0.0F, static_cast<float>(size_.height - 1));
  const int column = std::min(static_cast<int>(along), size_.width - 1);
  const int row = std::min(static_cast<int>(up), size_.height - 2);
  const auto mixed = [&](int line) {
    return glm::mix(channels(texel(column, line)), channels(texel(column + 1, line)),
                    along - static_cast<float>(column));
  };
  return glm::mix(mixed(row), mixed(row + 1), up - static_cast<float>(row));
}

SkyMaps::SkyMaps(Panorama map) : sharp(std::move(map)), soft(softened(sharp)) {}

}  // namespace grove::objects::sky
