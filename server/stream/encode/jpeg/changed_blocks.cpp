#include "stream/encode/jpeg/changed_blocks.h"

#include <algorithm>
#include <cassert>
#include <cstring>

namespace grove::stream {
namespace {

struct Rows {
  const std::uint8_t* before;
  const std::uint8_t* now;
  std::ptrdiff_t stride;
};

bool areSame(const Rows& rows, int width, int height) {
  for (int y = 0; y < height; ++y) {
    const std::ptrdiff_t at = y * rows.stride;
    if (std::memcmp(rows.before + at, rows.now + at, static_cast<std::size_t>(width)) != 0) return false;
  }
  return true;
}

/// Blocks without a change, side by side.
struct Gap {
  int begin = 0;
  int end = 0;

  [[nodiscard]] int width() const noexcept { return end - begin; }
};

/// Returns the widest gap between `begin` and `end`, whose first and last have changes.
template <class IsEmpty>
Gap widestGap(int begin, int end, const IsEmpty& isEmpty) {
  Gap widest;
  int first = begin;
  for (int i = begin; i < end; ++i) {
    if (isEmpty(i)) continue;
    if (i - first > widest.width()) widest = {first, i};
    first = i + 1;
  }
  return widest;
}

}  // namespace

ChangedBlocks::ChangedBlocks(const raster::YuvImage& before, const raster::YuvImage& now)
    : picture_(now.rect),
      across_((now.width() + kSide - 1) / kSide),
      down_((now.height() + kSide - 1) / kSide),
      changed_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_)) {
  assert(before.rect == now.rect);
  for (int row = 0; row < down_; ++row) {
    for (int column = 0; column < across_; ++column) {
      const int x = picture_.left + column * kSide;
      const int y = picture_.top + row * kSide;
      const int width = std::min(kSide, picture_.right - x);
      const int height = std::min(kSide, picture_.bottom - y);
      const std::ptrdiff_t luma = now.lumaAt(x, y);
      const std::ptrdiff_t chroma = now.chromaAt(x, y);
      const bool isSame = areSame({before.y() + luma, now.y() + luma, now.width()}, width, height) &&
                          areSame({before.u() + chroma, now.u() + chroma, now.width() / 2}, width / 2, height / 2) &&
                          areSame({before.v() + chroma, now.v() + chroma, now.width() / 2}, width / 2, height / 2);
      if (!isSame) changed_[indexOf(column, row)] = 1;
    }
  }
}

std::vector<world::Rect> ChangedBlocks::rectangles(int minSaved) const {
  std::vector<world::Rect> rectangles;
  cut({0, 0, across_, down_}, minSaved, rectangles);
  for (world::Rect& each : rectangles) {
    const world::Rect blocks{each.left * kSide, each.top * kSide, each.right * kSide, each.bottom * kSide};
    each = world::overlap(blocks.moved(picture_.left, picture_.top), picture_);
  }
  return rectangles;
}

std::size_t ChangedBlocks::indexOf(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(column);
}

bool ChangedBlocks::isChanged(int column, int row) const { return changed_[indexOf(column, row)] != 0; }

world::Rect ChangedBlocks::shrunk(const world::Rect& blocks) const {
  world::Rect least{blocks.right, blocks.bottom, blocks.left, blocks.top};
  for (int row = blocks.top; row < blocks.bottom; ++row) {
    for (int column = blocks.left; column < blocks.right; ++column) {
      if (!isChanged(column, row)) continue;
      least = {std::min(least.left, column), std::min(least.top, row), std::max(least.right, column + 1), row + 1};
    }
  }
  return least;
}

void ChangedBlocks::cut(const world::Rect& blocks, int minSaved, std::vector<world::Rect>& to) const {
  const world::Rect part = shrunk(blocks);
  if (part.left >= part.right) return;
  const auto hasChange = [&](const world::Rect& line) {
    for (int row = line.top; row < line.bottom; ++row) {
      for (int column = line.left; column < line.right; ++column) {
        if (isChanged(column, row)) return true;
      }
    }
    return false;
  };
  const Gap columns = widestGap(part.left, part.right, [&](int i) {
    return !hasChange({i, part.top, i + 1, part.bottom});
  });
  const Gap rows = widestGap(part.top, part.bottom, [&](int i) {
    return !hasChange({part.left, i, part.right, i + 1});
  });
  const int savedByColumns = columns.width() * part.height();
  const int savedByRows = rows.width() * part.width();
  if (std::max(savedByColumns, savedByRows) < minSaved) {
    to.push_back(part);
  } else if (savedByColumns > savedByRows) {
    cut({part.left, part.top, columns.begin, part.bottom}, minSaved, to);
    cut({columns.end, part.top, part.right, part.bottom}, minSaved, to);
  } else {
    cut({part.left, part.top, part.right, rows.begin}, minSaved, to);
    cut({part.left, rows.end, part.right, part.bottom}, minSaved, to);
  }
}

}  // namespace grove::stream
