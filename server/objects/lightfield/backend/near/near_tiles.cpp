#include "objects/lightfield/backend/near/near_tiles.h"

#include <algorithm>
#include <array>

#include "pipeline/vector_bytes.h"

namespace grove::objects::lightfield {
namespace {

constexpr std::uint32_t kDigitBits = 7;
constexpr std::uint32_t kDigits = 1U << kDigitBits;

/// The distance below which all faces have the same key, metres.
constexpr float kNearestKey = 0.25F;

std::uint32_t sortKey(const ScreenFace& face) {
  constexpr float kLast = kDigits * kDigits - 1;
  const float nearness = 0.25F * (face.nearness[0] + face.nearness[1] + face.nearness[2] + face.nearness[3]);
  return static_cast<std::uint32_t>((1.0F - std::min(1.0F, nearness * kNearestKey)) * kLast);
}

int tileOf(float place, int count) {
  return static_cast<int>(std::clamp(place * (1.0F / kNearTile), 0.0F, static_cast<float>(count - 1)));
}

}  // namespace

void NearTiles::begin(int width, int height) {
  width_ = width;
  height_ = height;
  across_ = (width + kNearTile - 1) / kNearTile;
  down_ = (height + kNearTile - 1) / kNearTile;
  faces_.clear();
  const auto count = static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_);
  if (tiles_.size() < count) tiles_.resize(count);
  for (std::vector<Entry>& tile : tiles_) tile.clear();
}

void NearTiles::add(const ScreenFace& face) {
  const Entry entry{sortKey(face), static_cast<std::uint32_t>(faces_.size())};
  faces_.push_back(face);
  const auto least = [](const float(&v)[4]) { return std::min(std::min(v[0], v[1]), std::min(v[2], v[3])); };
  const auto most = [](const float(&v)[4]) { return std::max(std::max(v[0], v[1]), std::max(v[2], v[3])); };
  const int left = tileOf(least(face.x) - kCoverageMargin, across_);
  const int right = tileOf(most(face.x) + kCoverageMargin, across_);
  const int top = tileOf(least(face.y) - kCoverageMargin, down_);
  const int bottom = tileOf(most(face.y) + kCoverageMargin, down_);
  for (int row = top; row <= bottom; ++row) {
    for (int column = left; column <= right; ++column) tiles_[tile(column, row)].push_back(entry);
  }
}

void NearTiles::sort(int column, int row) {
  std::vector<Entry>& entries = tiles_[tile(column, row)];
  sortBy(0, entries, sorted_);
  sortBy(kDigitBits, sorted_, entries);
}

/// One pass of a radix sort.
void NearTiles::sortBy(std::uint32_t shift, const std::vector<Entry>& from, std::vector<Entry>& to) {
  const auto digit = [&](const Entry& entry) { return (entry.key >> shift) % kDigits; };
  std::array<std::uint32_t, kDigits + 1> next{};
  for (const Entry& entry : from) ++next[digit(entry) + 1];
  for (std::size_t i = 1; i <= kDigits; ++i) next[i] += next[i - 1];
  to.resize(from.size());
  for (const Entry& entry : from) to[next[digit(entry)]++] = entry;
}

std::size_t NearTiles::bytes() const noexcept {
  std::size_t sum = pipeline::vectorBytes(faces_, tiles_, sorted_);
  for (const std::vector<Entry>& tile : tiles_) sum += pipeline::vectorBytes(tile);
  return sum;
}

}  // namespace grove::objects::lightfield
