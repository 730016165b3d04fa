#include "objects/lightfield/bake/texture_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace grove::bake {

using world::Vec2;
using world::Vec3;
using world::Vec4;

namespace {

std::array<float, 256> makeLinear() {
  std::array<float, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const float x = static_cast<float>(i) / 255.0F;
    table[i] = x <= 0.04045F ? x / 12.92F : std::pow((x + 0.055F) / 1.055F, 2.4F);
  }
  return table;
}

int wrapped(int at, int count) noexcept {
  const int rest = at % count;
  return rest < 0 ? rest + count : rest;
}

/// A coordinate with more repetitions has no useful fraction left. Also keeps the conversion to int defined, including
/// for NaN (which std::clamp() does not change).
float boundedCoordinate(float uv) noexcept { return std::min(65536.0F, std::max(-65536.0F, uv)); }

}  // namespace

TextureSampler::TextureSampler(const models::Texture& texture) {
  const std::array<float, 256> linear = makeLinear();
  Level finest{texture.width, texture.height, {}};
  finest.texels.reserve(texture.texels.size());
  for (const std::uint32_t texel : texture.texels) {
    const float alpha = static_cast<float>(texel >> 24U) / 255.0F;
    const Vec3 colour(linear[texel & 0xFFU], linear[texel >> 8U & 0xFFU], linear[texel >> 16U & 0xFFU]);
    // A small weight preserves the colour of wholly transparent texels.
    finest.texels.emplace_back(colour * std::max(alpha, 1.0e-3F), std::max(alpha, 1.0e-3F));
  }
  levels_.push_back(std::move(finest));
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& fine = levels_.back();
    Level coarse{std::max(1, fine.width / 2), std::max(1, fine.height / 2), {}};
    for (int y = 0; y < coarse.height; ++y) {
      for (int x = 0; x < coarse.width; ++x) {
        const auto at = [&](int dx, int dy) {
          const int column = std::min(2 * x + dx, fine.width - 1);
          const int row = std::min(2 * y + dy, fine.height - 1);
          return fine.texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(fine.width) +
                             static_cast<std::size_t>(column)];
        };
        coarse.texels.push_back((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) * 0.25F);
      }
    }
    levels_.push_back(std::move(coarse));
  }
  const Vec4 all = levels_.back().texels.front();
  mean_ = Vec3(all) / all.a;
  size_ = std::sqrt(static_cast<float>(texture.width) * static_cast<float>(texture.height));
}

Vec3 TextureSampler::colour(Vec2 uv, float texels) const noexcept {
  constexpr float kMaxTexels = 65536.0F;  // no texture is larger, and infinity has no logarithm to round
  const int wanted = texels > 1.0F ? static_cast<int>(std::lround(std::log2(std::min(texels, kMaxTexels)))) : 0;
  const Level& level = levels_[static_cast<std::size_t>(std::min(wanted, static_cast<int>(levels_.size()) - 1))];
  const float x = boundedCoordinate(uv.x) * static_cast<float>(level.width) - 0.5F;
  const float y = boundedCoordinate(uv.y) * static_cast<float>(level.height) - 0.5F;
  const float left = std::floor(x);
  const float top = std::floor(y);
  const int column = static_cast<int>(left);
  const int row = static_cast<int>(top);
  const auto at = [&](int dx, int dy) {
    return level
        .texels[static_cast<std::size_t>(wrapped(row + dy, level.height)) * static_cast<std::size_t>(level.width) +
                static_cast<std::size_t>(wrapped(column + dx, level.width))];
  };
  const float fx = x - left;
  const float fy = y - top;
  const Vec4 sum = glm::mix(glm::mix(at(0, 0), at(1, 0), fx), glm::mix(at(0, 1), at(1, 1), fx), fy);
  return Vec3(sum) / sum.a;
}

float TextureSampler::alpha(Vec2 uv) const noexcept {
  const Level& level = levels_.front();
  const int column =
      wrapped(static_cast<int>(std::floor(boundedCoordinate(uv.x) * static_cast<float>(level.width))), level.width);
  const int row =
      wrapped(static_cast<int>(std::floor(boundedCoordinate(uv.y) * static_cast<float>(level.height))), level.height);
  const float weight = level
                           .texels[static_cast<std::size_t>(row) * static_cast<std::size_t>(level.width) +
                                   static_cast<std::size_t>(column)]
                           .a;
  return weight > 1.0e-3F ? weight : 0.0F;
}

}  // namespace grove::bake
