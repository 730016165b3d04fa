#include "stream/encode/h264/prediction/intra_prediction.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

namespace grove::stream::h264 {
namespace {

constexpr std::ptrdiff_t kStride = MacroblockPixels::kStride;

/// The pixels around a square of kSide pixels; index 0 is the corner.
template <int kSide>
struct Frame {
  std::array<int, kSide + 1> left{};
  std::array<int, kSide + 1> above{};

  Frame(const BorderedPlane& plane, int column, int row) {
    for (int i = 0; i <= kSide; ++i) {
      const auto at = static_cast<std::size_t>(i);
      left[at] = *plane.at(column * kSide - 1, row * kSide + i - 1);
      above[at] = *plane.at(column * kSide + i - 1, row * kSide - 1);
    }
  }
};

template <int kSide>
void fill(std::uint8_t* to, int value) {
  for (int y = 0; y < kSide; ++y) std::memset(to + y * kStride, value, kSide);
}

int sumAbove(const BorderedPlane& plane, int x, int y, int count) {
  const std::uint8_t* const above = plane.at(x, y - 1);
  return std::accumulate(above, above + count, 0);
}

int sumLeft(const BorderedPlane& plane, int x, int y, int count) {
  int sum = 0;
  for (int i = 0; i < count; ++i) sum += *plane.at(x - 1, y + i);
  return sum;
}

/// Section 8.3.3.4 with 16 pixels, section 8.3.4.4 with 8.
template <int kSide>
void predictPlane(const Frame<kSide>& frame, std::uint8_t* to) {
  constexpr int kHalf = kSide / 2;
  constexpr int kFactor = kSide == 16 ? 5 : 34;
  const auto slope = [](const auto& line) {
    int sum = 0;
    for (int i = 1; i <= kHalf; ++i) {
      const int after = kHalf + i;
      const int before = kHalf - i;
      sum += i * (line[static_cast<std::size_t>(after)] - line[static_cast<std::size_t>(before)]);
    }
    return (kFactor * sum + 32) >> 6;
  };
  const int middle = 16 * (frame.left.back() + frame.above.back());
  const int across = slope(frame.above);
  const int down = slope(frame.left);
  for (int y = 0; y < kSide; ++y) {
    const int first = middle + across * (1 - kHalf) + down * (y - kHalf + 1) + 16;
    for (int x = 0; x < kSide; ++x) {
      to[y * kStride + x] = static_cast<std::uint8_t>(std::clamp((first + across * x) >> 5, 0, 255));
    }
  }
}

/// Repeats the pixels above the square, or those on its left.
template <int kSide>
void predictLines(const BorderedPlane& plane, int column, int row, bool above, std::uint8_t* to) {
  for (int y = 0; y < kSide; ++y) {
    std::uint8_t* const line = to + y * kStride;
    if (above) {
      std::memcpy(line, plane.at(column * kSide, row * kSide - 1), kSide);
    } else {
      std::memset(line, *plane.at(column * kSide - 1, row * kSide + y), kSide);
    }
  }
}

template <int kSide>
void predictSquare(const BorderedPlane& plane, int column, int row, IntraMode mode, std::uint8_t* to) {
  if (mode == IntraMode::kPlane) return predictPlane(Frame<kSide>(plane, column, row), to);
  predictLines<kSide>(plane, column, row, mode == IntraMode::kVertical, to);
}

constexpr int kUnknown = 128;

void predictLumaMean(const BorderedPlane& plane, int column, int row, std::uint8_t* to) {
  const int left = column > 0 ? sumLeft(plane, column * 16, row * 16, 16) : 0;
  const int above = row > 0 ? sumAbove(plane, column * 16, row * 16, 16) : 0;
  int mean = kUnknown;
  if (column > 0 && row > 0) {
    mean = (left + above + 16) >> 5;
  } else if (column > 0 || row > 0) {
    mean = (left + above + 8) >> 4;
  }
  fill<16>(to, mean);
}

/// Each 4 x 4 block has its own mean; those beside the diagonal use the line that is next to them.
void predictChromaMeans(const BorderedPlane& plane, int column, int row, std::uint8_t* to) {
  for (int i = 0; i < 4; ++i) {
    const int x = i % 2 * 4;
    const int y = i / 2 * 4;
    const int left = sumLeft(plane, column * 8, row * 8 + y, 4);
    const int above = sumAbove(plane, column * 8 + x, row * 8, 4);
    const bool prefersAbove = i == 1;
    const bool prefersLeft = i == 2;
    int mean = kUnknown;
    if (column > 0 && row > 0 && !prefersAbove && !prefersLeft) {
      mean = (left + above + 4) >> 3;
    } else if (row > 0 && (column == 0 || prefersAbove)) {
      mean = (above + 2) >> 2;
    } else if (column > 0) {
      mean = (left + 2) >> 2;
    }
    fill<4>(to + y * kStride + x, mean);
  }
}

}  // namespace

bool isPossible(IntraMode mode, int column, int row) {
  switch (mode) {
    case IntraMode::kVertical:
      return row > 0;
    case IntraMode::kHorizontal:
      return column > 0;
    case IntraMode::kMean:
      return true;
    case IntraMode::kPlane:
      return row > 0 && column > 0;
  }
  return false;
}

void predictIntraLuma(const ReferencePicture& picture, int column, int row, IntraMode mode, MacroblockPixels& to) {
  const BorderedPlane& plane = picture.plane(0);
  if (mode == IntraMode::kMean) {
    predictLumaMean(plane, column, row, to.luma.data());
  } else {
    predictSquare<16>(plane, column, row, mode, to.luma.data());
  }
}

void predictIntraChroma(const ReferencePicture& picture, int column, int row, IntraMode mode, MacroblockPixels& to) {
  for (std::size_t i = 1; i < 3; ++i) {
    const BorderedPlane& plane = picture.plane(i);
    std::uint8_t* const place = to.chroma.data() + (i == 1 ? 0 : 8);
    if (mode == IntraMode::kMean) {
      predictChromaMeans(plane, column, row, place);
    } else {
      predictSquare<8>(plane, column, row, mode, place);
    }
  }
}

std::uint32_t chromaModeNumber(IntraMode mode) {
  switch (mode) {
    case IntraMode::kMean:
      return 0;
    case IntraMode::kHorizontal:
      return 1;
    case IntraMode::kVertical:
      return 2;
    case IntraMode::kPlane:
      return 3;
  }
  return 0;
}

}  // namespace grove::stream::h264
