#include "stream/encode/h264/still_macroblocks.h"

#include <span>

#include "base/checksum.h"

namespace grove::stream::h264 {
namespace {

std::uint64_t checksumOfPixels(const MacroblockPixels& pixels) {
  return checksumOf(std::as_bytes(std::span(&pixels, 1)));
}

}  // namespace

StillMacroblocks::StillMacroblocks(int across, int down)
    : across_(across), down_(down), states_(static_cast<std::size_t>(across) * static_cast<std::size_t>(down)) {}

std::size_t StillMacroblocks::index(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(across_) + static_cast<std::size_t>(column);
}

void StillMacroblocks::nextPicture(bool independent) {
  ++picture_;
  if (!independent) return;
  for (State& state : states_) state.changed = picture_;
}

bool StillMacroblocks::isStill(const MacroblockPixels& source, int quantiser, int column, int row) const {
  const State& state = states_[index(column, row)];
  // A neighbour may have changed it in this picture, and that hides whether one did in the last.
  const bool changed = picture_ - state.changed <= 1;
  return !changed && quantiser >= state.quantiser && checksumOfPixels(source) == state.checksum;
}

void StillMacroblocks::keep(const MacroblockPixels& source, int quantiser, int column, int row) {
  State& state = states_[index(column, row)];
  state.checksum = checksumOfPixels(source);
  state.quantiser = quantiser;
}

void StillMacroblocks::change(int column, int row) {
  const auto mark = [&](int x, int y) {
    if (x >= 0 && x < across_ && y >= 0 && y < down_) states_[index(x, y)].changed = picture_;
  };
  mark(column, row);
  mark(column - 1, row);
  mark(column + 1, row);
  mark(column, row - 1);
  mark(column, row + 1);
}

}  // namespace grove::stream::h264
