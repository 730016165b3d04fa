#include "measure/pictures/block_jumps.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

namespace grove::measure {
namespace {

constexpr int kSize = BlockJumps::kBlock;
constexpr int kSearch = BlockJumps::kSearch;

struct Shift {
  int x = 0;
  int y = 0;
};

std::vector<std::uint8_t> lumaOfAll(const Picture& picture) {
  std::vector<std::uint8_t> luma(picture.colour.size());
  std::ranges::transform(picture.colour, luma.begin(), [](std::uint32_t colour) {
    return static_cast<std::uint8_t>(lumaOf(colour & 0xFFU, (colour >> 8U) & 0xFFU, (colour >> 16U) & 0xFFU));
  });
  return luma;
}

/// One block in two consecutive pictures.
class BlockPair {
 public:
  BlockPair(std::span<const std::uint8_t> now, std::span<const std::uint8_t> last, int width, int left, int top)
      : now_(now), last_(last), width_(width), left_(left), top_(top) {}

  /// Returns the sum of absolute differences from the shifted block of the last picture; may stop once it exceeds
  /// `limit`.
  [[nodiscard]] int difference(Shift shift, int limit = std::numeric_limits<int>::max()) const {
    int sum = 0;
    for (int y = 0; y < kSize && sum <= limit; ++y) {
      const std::uint8_t* const now = now_.data() + at(0, y);
      const std::uint8_t* const last = last_.data() + at(shift.x, y + shift.y);
      for (int x = 0; x < kSize; ++x) sum += std::abs(int{now[x]} - int{last[x]});
    }
    return sum;
  }

  /// Returns the shift with the minimum difference and that difference; prefers no shift if others are only as good.
  [[nodiscard]] std::pair<Shift, int> best() const {
    Shift best;
    int least = difference(best);
    for (int y = -kSearch; y <= kSearch; ++y) {
      for (int x = -kSearch; x <= kSearch; ++x) {
        const int sum = difference({x, y}, least);
        if (sum < least) std::tie(best.x, best.y, least) = std::tuple(x, y, sum);
      }
    }
    return {best, least};
  }

  /// Returns the minimum difference over the shift and its neighbours.
  [[nodiscard]] int differenceAround(Shift shift) const {
    int least = std::numeric_limits<int>::max();
    for (int y = shift.y - 1; y <= shift.y + 1; ++y) {
      for (int x = shift.x - 1; x <= shift.x + 1; ++x) least = std::min(least, difference({x, y}, least));
    }
    return least;
  }

 private:
  [[nodiscard]] std::ptrdiff_t at(int x, int y) const { return std::ptrdiff_t{top_ + y} * width_ + left_ + x; }

  const std::span<const std::uint8_t> now_;
  const std::span<const std::uint8_t> last_;
  const int width_;
  const int left_;
  const int top_;
};

bool hasJumped(const BlockPair& shown, const BlockPair& reference) {
  const Shift expected = reference.best().first;
  if (std::max(std::abs(expected.x), std::abs(expected.y)) >= kSearch) return false;
  const int asExpected = shown.differenceAround(expected);
  constexpr int kLeastGain = BlockJumps::kGain * kSize * kSize;
  if (asExpected <= kLeastGain) return false;
  const int least = shown.best().second;
  return asExpected - least > kLeastGain && least < (1.0 - BlockJumps::kGainShare) * asExpected;
}

}  // namespace

void BlockJumps::add(const Picture& shown, const Picture& reference) {
  assert(shown.width == reference.width && shown.colour.size() == reference.colour.size());
  Luma shownLuma = lumaOfAll(shown);
  Luma referenceLuma = lumaOfAll(reference);
  if (!lastShown_.empty()) {
    assert(lastShown_.size() == shownLuma.size());
    for (int top = kBlock; top + kBlock + kSearch <= shown.height(); top += kBlock) {
      for (int left = kBlock; left + kBlock + kSearch <= shown.width; left += kBlock) {
        if (hasJumped({shownLuma, lastShown_, shown.width, left, top},
                      {referenceLuma, lastReference_, shown.width, left, top})) {
          ++jumps_;
        }
      }
    }
    ++pairs_;
  }
  lastShown_ = std::move(shownLuma);
  lastReference_ = std::move(referenceLuma);
}

}  // namespace grove::measure
