#include "objects/lightfield/backend/near/near_tiles.h"

#include <algorithm>
#include <array>

#include "pipeline/vector_bytes.h"

namespace grove::objects::lightfield {
namespace {

constexpr std::uint32_t kDigitBits = 7;
constexpr std::uint32_t kDigits = 1U << kDigitBits;

/// Metres; all nearer faces have the same key.
constexpr float kNearestKey = 0.25F;

std::uint32_t sortKey(const ScreenFace& face) {
  constexpr float kLast = kDigits * kDigits - 1;
  const float nearness = 0.25F * (face.nearness[0] + face.nearness[1] + face.nearness[2] + face.nearness[3]);
  return static_cast<std::uint32_t>((1.0F - std::min(1.0F, nearness * kNearestKey)) * kLast);
}

/// First and last block of a face's bounding box along one axis of the picture.
struct Range {
  int first;
  int last;

  Range(float from, float to, int tiles)
      : first(blockOf(from - kCoverageMargin, tiles)), last(blockOf(to + kCoverageMargin, tiles)) {}
  static int blockOf(float place, int tiles) {
    const auto end = static_cast<float>(tiles * kTileBlocks - 1);
    return static_cast<int>(std::clamp(place * (1.0F / kNearBlock), 0.0F, end));
  }
  /// The first and last block within a tile.
  [[nodiscard]] std::uint8_t firstIn(int tile) const {
    return static_cast<std::uint8_t>(std::max(first - tile * kTileBlocks, 0));
  }
  [[nodiscard]] std::uint8_t lastIn(int tile) const {
    return static_cast<std::uint8_t>(std::min(last - tile * kTileBlocks, kTileBlocks - 1));
  }
};

}  // namespace

void NearTiles::begin(int width, int height) {
  width_ = width;
  height_ = height;
  across_ = (width + kNearTile - 1) / kNearTile;
  down_ = (height + kNearTile - 1) / kNearTile;
  faces_.clear();
  const auto count = static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_);
  if (tiles_.size() < count) tiles_.resize(count);
  for (std::vector<TileFace>& tile : tiles_) tile.clear();
}

void NearTiles::add(const ScreenFace& face) {
  const Range columns(least(face.x), most(face.x), across_);
  const Range rows(least(face.y), most(face.y), down_);
  TileFace entry{};
  entry.key = sortKey(face);
  entry.face = static_cast<std::uint32_t>(faces_.size());
  entry.nearest = static_cast<std::int16_t>(std::clamp(most(face.nearness) * kNearnessUnit, 1.0F, 32767.0F));
  faces_.push_back(face);
  for (int row = rows.first / kTileBlocks; row <= rows.last / kTileBlocks; ++row) {
    entry.top = rows.firstIn(row);
    entry.bottom = rows.lastIn(row);
    for (int column = columns.first / kTileBlocks; column <= columns.last / kTileBlocks; ++column) {
      entry.left = columns.firstIn(column);
      entry.right = columns.lastIn(column);
      tiles_[tile(column, row)].push_back(entry);
    }
  }
}

world::Rect NearTiles::touched() const {
  world::Rect part{across_, down_, 0, 0};  // in tiles
  for (int row = 0; row < down_; ++row) {
    for (int column = 0; column < across_; ++column) {
      if (at(column, row).empty()) continue;
      part = {std::min(part.left, column), std::min(part.top, row), std::max(part.right, column + 1), row + 1};
    }
  }
  if (part.empty()) return {};
  return {part.left * kNearTile, part.top * kNearTile, std::min(part.right * kNearTile, width_),
          std::min(part.bottom * kNearTile, height_)};
}

void NearTiles::sort(int column, int row) {
  std::vector<TileFace>& entries = tiles_[tile(column, row)];
  sortBy(0, entries, sorted_);
  sortBy(kDigitBits, sorted_, entries);
}

/// One pass of a radix sort.
void NearTiles::sortBy(std::uint32_t shift, const std::vector<TileFace>& from, std::vector<TileFace>& to) {
  const auto digit = [&](const TileFace& entry) { return (entry.key >> shift) % kDigits; };
  std::array<std::uint32_t, kDigits + 1> next{};
  for (const TileFace& entry : from) ++next[digit(entry) + 1];
  for (std::size_t i = 1; i <= kDigits; ++i) next[i] += next[i - 1];
  to.resize(from.size());
  for (const TileFace& entry : from) to[next[digit(entry)]++] = entry;
}

std::size_t NearTiles::bytes() const noexcept {
  std::size_t sum = pipeline::vectorBytes(faces_, tiles_, sorted_);
  for (const std::vector<TileFace>& tile : tiles_) sum += pipeline::vectorBytes(tile);
  return sum;
}

}  // namespace grove::objects::lightfield
