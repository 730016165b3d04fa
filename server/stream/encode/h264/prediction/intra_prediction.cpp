#include "stream/encode/h264/prediction/intra_prediction.h"

#include <algorithm>
#include <array>

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

template <int kSide, class Value>
void fill(std::uint8_t* to, const Value& value) {
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) to[y * kStride + x] = static_cast<std::uint8_t>(value(x, y));
  }
}

/// Sum of some of a line of pixels next to a square.
template <class Line>
int sumOf(const Line& line, int first, int count) {
  int sum = 0;
  for (int i = first; i < first + count; ++i) sum += line[static_cast<std::size_t>(i + 1)];
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
      sum += i * (line[static_cast<std::size_t>(kHalf + i)] - line[static_cast<std::size_t>(kHalf - i)]);
    }
    return (kFactor * sum + 32) >> 6;
  };
  const int middle = 16 * (frame.left.back() + frame.above.back());
  const int across = slope(frame.above);
  const int down = slope(frame.left);
  fill<kSide>(to, [&](int x, int y) {
    return std::clamp((middle + across * (x - kHalf + 1) + down * (y - kHalf + 1) + 16) >> 5, 0, 255);
  });
}

template <int kSide>
void predictLines(const Frame<kSide>& frame, IntraMode mode, std::uint8_t* to) {
  if (mode == IntraMode::kPlane) return predictPlane(frame, to);
  const bool isVertical = mode == IntraMode::kVertical;
  fill<kSide>(to, [&](int x, int y) {
    return isVertical ? frame.above[static_cast<std::size_t>(x + 1)] : frame.left[static_cast<std::size_t>(y + 1)];
  });
}

constexpr int kUnknown = 128;

void predictLumaMean(const Frame<16>& frame, int column, int row, std::uint8_t* to) {
  const int left = column > 0 ? sumOf(frame.left, 0, 16) : 0;
  const int above = row > 0 ? sumOf(frame.above, 0, 16) : 0;
  int mean = kUnknown;
  if (column > 0 && row > 0) {
    mean = (left + above + 16) >> 5;
  } else if (column > 0 || row > 0) {
    mean = (left + above + 8) >> 4;
  }
  fill<16>(to, [&](int, int) { return mean; });
}

/// Each 4 x 4 block has its own mean; those beside the diagonal use the line that is next to them.
void predictChromaMeans(const Frame<8>& frame, int column, int row, std::uint8_t* to) {
  std::array<int, 4> means{};
  for (int i = 0; i < 4; ++i) {
    const int x = i % 2 * 4;
    const int y = i / 2 * 4;
    const int left = sumOf(frame.left, y, 4);
    const int above = sumOf(frame.above, x, 4);
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
    means[static_cast<std::size_t>(i)] = mean;
  }
  fill<8>(to, [&](int x, int y) { return means[static_cast<std::size_t>(y / 4 * 2 + x / 4)]; });
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
  const Frame<16> frame(picture.plane(0), column, row);
  if (mode == IntraMode::kMean) return predictLumaMean(frame, column, row, to.luma.data());
  predictLines(frame, mode, to.luma.data());
}

void predictIntraChroma(const ReferencePicture& picture, int column, int row, IntraMode mode, MacroblockPixels& to) {
  for (std::size_t i = 1; i < 3; ++i) {
    const Frame<8> frame(picture.plane(i), column, row);
    std::uint8_t* const place = to.chroma.data() + (i == 1 ? 0 : 8);
    if (mode == IntraMode::kMean) {
      predictChromaMeans(frame, column, row, place);
    } else {
      predictLines(frame, mode, place);
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
