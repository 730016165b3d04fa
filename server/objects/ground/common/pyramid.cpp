#include "objects/ground/common/pyramid.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <utility>

namespace grove::objects::ground {
namespace {

std::uint32_t average(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  constexpr std::uint32_t kEven = 0x00FF00FFU;
  constexpr std::uint32_t kHalf = 0x00020002U;
  const std::uint32_t even = (a & kEven) + (b & kEven) + (c & kEven) + (d & kEven) + kHalf;
  const std::uint32_t odd =
      ((a >> 8U) & kEven) + ((b >> 8U) & kEven) + ((c >> 8U) & kEven) + ((d >> 8U) & kEven) + kHalf;
  return ((even >> 2U) & kEven) | ((odd >> 2U) & kEven) << 8U;
}

void halve(const std::uint32_t* fine, std::size_t size, std::uint32_t* coarse) {
  const std::size_t half = size / 2;
  for (std::size_t y = 0; y < half; ++y) {
    for (std::size_t x = 0; x < half; ++x) {
      const std::size_t at = 2 * y * size + 2 * x;
      coarse[y * half + x] = average(fine[at], fine[at + 1], fine[at + size], fine[at + size + 1]);
    }
  }
}

}  // namespace

Pyramid::Pyramid(int size) : size_(size) {
  assert(std::has_single_bit(static_cast<unsigned>(size)) && size >= 2 && size < (1 << kMaxLevels));
  levels_.reserve(static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(size))));
  // Finer levels come first.
  for (int at = size; at > 0; at /= 2) levels_.push_back(texelsOf(size) - texelsOf(at));
  texels_.resize(texelsOf(size));
}

std::size_t Pyramid::texelsOf(int size) noexcept {
  const auto side = static_cast<std::size_t>(size);
  return (4 * side * side - 1) / 3;
}

Pyramid::Pyramid(int size, std::vector<std::uint32_t> finest) : Pyramid(size) {
  assert(finest.size() == static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  std::ranges::copy(finest, texels_.begin());
  for (std::size_t i = 1; i < levels_.size(); ++i) {
    halve(texels_.data() + levels_[i - 1], static_cast<std::size_t>(size) >> (i - 1), texels_.data() + levels_[i]);
  }
}

const std::uint32_t* Pyramid::level(int index) const noexcept {
  return texels_.data() + levels_[static_cast<std::size_t>(index)];
}

Pyramid Pyramid::inBlocks() const {
  constexpr std::size_t kSide = kBlock;
  Pyramid blocks = *this;
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    const std::size_t size = static_cast<std::size_t>(size_) >> i;
    if (size < kSide) break;
    const std::uint32_t* from = texels_.data() + levels_[i];
    std::uint32_t* to = blocks.texels_.data() + levels_[i];
    for (std::size_t y = 0; y < size; ++y) {
      for (std::size_t x = 0; x < size; ++x) {
        const std::size_t block = y / kSide * kSide * size + x / kSide * kSide * kSide;
        to[block + y % kSide * kSide + x % kSide] = from[y * size + x];
      }
    }
  }
  return blocks;
}

std::uint32_t packTexel(float r, float g, float b, float a) noexcept {
  const auto byte = [](float value) {
    return static_cast<std::uint32_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
  };
  return byte(r) | byte(g) << 8U | byte(b) << 16U | byte(a) << 24U;
}

}  // namespace grove::objects::ground
