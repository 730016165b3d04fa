#include "objects/sky/panorama.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace grove::objects::sky {
namespace {

constexpr float kTurn = 2.0F * std::numbers::pi_v<float>;

world::Vec3 channels(std::uint32_t rgba) {
  const auto channel = [&](unsigned shift) { return static_cast<float>((rgba >> shift) & 0xFFU); };
  return {channel(0), channel(8), channel(16)};
}

}  // namespace

Panorama::Panorama(PanoramaSize size) : size_(size) {
  assert(size.width >= 4 && size.height >= 2);
  texels_.resize(static_cast<std::size_t>(stride()) * static_cast<std::size_t>(size.height));
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
  // The last row is the zenith, whose tangent is infinite; one that is far beyond the row before serves as well.
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
  const int column = std::min(static_cast<int>(x), size_.width - 1);
  const int row = std::min(static_cast<int>(y), size_.height - 2);
  const auto mixed = [&](int at) {
    return glm::mix(channels(texel(column, at)), channels(texel(column + 1, at)), x - static_cast<float>(column));
  };
  return glm::mix(mixed(row), mixed(row + 1), y - static_cast<float>(row));
}

}  // namespace grove::objects::sky
