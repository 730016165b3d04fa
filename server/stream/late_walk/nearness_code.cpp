#include "stream/late_walk/nearness_code.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace grove::stream {
namespace {

/// Adaptive probability of a set bit, in 4096ths.
struct Chance {
  std::uint32_t ofOne = 2048;

  void learn(bool bit) {
    constexpr std::uint32_t kRate = 4;
    if (bit) {
      ofOne += (4096 - ofOne) >> kRate;
    } else {
      ofOne -= ofOne >> kRate;
    }
  }
};

/// The interval of an arithmetic coder; both ends belong to it.
struct Interval {
  std::uint32_t low = 0;
  std::uint32_t high = 0xFFFFFFFF;

  [[nodiscard]] std::uint32_t middle(const Chance& chance) const {
    // Neither half is empty, whatever the probability.
    return low + ((high - low) >> 12U) * std::clamp(chance.ofOne, 32U, 4064U);
  }
  void take(bool bit, std::uint32_t middle) {
    if (bit) {
      high = middle;
    } else {
      low = middle + 1;
    }
  }
  /// Whether the first byte is known.
  [[nodiscard]] bool isKnown() const { return ((low ^ high) & 0xFF000000U) == 0; }
  void shift() {
    low <<= 8U;
    high = high << 8U | 0xFFU;
  }
};

class BitEncoder {
 public:
  explicit BitEncoder(std::vector<std::uint8_t>& out) : out_(out) {}

  bool code(Chance& chance, bool bit) {
    interval_.take(bit, interval_.middle(chance));
    chance.learn(bit);
    for (; interval_.isKnown(); interval_.shift()) put(interval_.high);
    return bit;
  }
  /// The decoder reads zeros after the last byte, so one byte above the interval's begin is enough.
  void finish() {
    if (interval_.low > 0) put(interval_.low + 0x00FFFFFFU);
  }

 private:
  void put(std::uint32_t value) { out_.push_back(static_cast<std::uint8_t>(value >> 24U)); }

  std::vector<std::uint8_t>& out_;
  Interval interval_;
};

class BitDecoder {
 public:
  explicit BitDecoder(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
    for (std::size_t i = 0; i < kAhead; ++i) value_ = value_ << 8U | next();
  }

  bool code(Chance& chance, bool /*unused*/) {
    const std::uint32_t middle = interval_.middle(chance);
    const bool bit = value_ <= middle;
    interval_.take(bit, middle);
    chance.learn(bit);
    for (; interval_.isKnown(); interval_.shift()) value_ = value_ << 8U | next();
    return bit;
  }
  /// Whether an encoder would have written as many bytes.
  [[nodiscard]] bool isAtEnd() const { return bytes_.size() == read_ - kAhead + (interval_.low > 0 ? 1 : 0); }

 private:
  static constexpr std::size_t kAhead = sizeof(std::uint32_t);

  std::uint32_t next() {
    const std::size_t at = read_++;
    return at < bytes_.size() ? bytes_[at] : 0U;
  }

  std::span<const std::uint8_t> bytes_;
  std::size_t read_ = 0;
  Interval interval_;
  std::uint32_t value_ = 0;
};

/// Steps by which a value may come out wrong. Exact values take 1.8 times as many bytes, and moved pictures are up to
/// 0.3 dB closer to the true ones.
constexpr int kTolerance = 1;

constexpr int kCalm = 5;
constexpr int kSlopes = 3;
constexpr int kLengths = 8;

/// Codes errors of the prediction: whether there is one, its sign, and its size less one as an Exp-Golomb number.
template <class Coder>
class ErrorCode {
 public:
  explicit ErrorCode(Coder& coder) : coder_(coder) {}

  /// `activity`: sum of the errors beside it; `slope`: of the values. A decoder ignores `error`. Returns the error.
  int code(int activity, int slope, int error) {
    const std::size_t calm = activity == 0 ? 0 : activity < 2 ? 1 : activity < 5 ? 2 : activity < 12 ? 3 : 4;
    const std::size_t steep = slope == 0 ? 0 : slope < 4 ? 1 : 2;
    if (!coder_.code(isThere_[calm][steep], error != 0)) return 0;
    const bool isNegative = coder_.code(isNegative_[calm], error < 0);
    const int size = sizeOf(calm, std::abs(error) - 1) + 1;
    return isNegative ? -size : size;
  }

 private:
  int sizeOf(std::size_t calm, int size) {
    std::size_t length = 0;
    int first = 0;
    while (length + 1 < kLengths && coder_.code(isLonger_[calm][length], size >= first + (1 << length))) {
      first += 1 << length++;
    }
    int rest = 0;
    for (std::size_t bit = length; bit-- > 0;) {
      rest |= static_cast<int>(coder_.code(bits_[length][bit], ((size - first) >> bit & 1) != 0)) << bit;
    }
    return first + rest;
  }

  Coder& coder_;
  std::array<std::array<Chance, kSlopes>, kCalm> isThere_{};
  std::array<Chance, kCalm> isNegative_{};
  std::array<std::array<Chance, kLengths>, kCalm> isLonger_{};
  std::array<std::array<Chance, kLengths>, kLengths> bits_{};
};

int median(int left, int above, int corner) {
  if (corner >= std::max(left, above)) return std::min(left, above);
  if (corner <= std::min(left, above)) return std::max(left, above);
  return left + above - corner;
}

/// Encodes or decodes all values. `errorOf` returns the error to code of a value and its prediction; the grid gets what
/// a decoder makes of it. Returns whether the values are in range.
template <class Coder, class ErrorOf>
bool codeAll(Coder& coder, NearnessGrid& grid, const ErrorOf& errorOf) {
  ErrorCode<Coder> code(coder);
  const int across = grid.across;
  std::vector<int> errors(grid.values.size());
  const auto indexOf = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(across) + static_cast<std::size_t>(x);
  };
  for (int y = 0; y < grid.down; ++y) {
    for (int x = 0; x < across; ++x) {
      const auto value = [&](int column, int row) { return static_cast<int>(grid.values[indexOf(column, row)]); };
      const int left = x > 0 ? value(x - 1, y) : y > 0 ? value(x, y - 1) : 0;
      const int above = y > 0 ? value(x, y - 1) : left;
      const int corner = x > 0 && y > 0 ? value(x - 1, y - 1) : above;
      const int next = y > 0 && x + 1 < across ? value(x + 1, y - 1) : above;
      const auto size = [&](bool isThere, int column, int row) {
        return isThere ? std::abs(errors[indexOf(column, row)]) : 0;
      };
      const int activity = size(x > 0, x - 1, y) + size(y > 0, x, y - 1) + size(y > 0 && x + 1 < across, x + 1, y - 1);
      const int predicted = median(left, above, corner);
      std::uint8_t& own = grid.values[indexOf(x, y)];
      const int error = code.code(activity, std::abs(left - above) + std::abs(above - next), errorOf(own, predicted));
      const int decoded = predicted + error;
      if (decoded < 0 || decoded > NearnessGrid::kMax) return false;
      errors[indexOf(x, y)] = error;
      own = static_cast<std::uint8_t>(decoded);
    }
  }
  return true;
}

}  // namespace

void encodeNearness(const NearnessGrid& grid, std::vector<std::uint8_t>& out) {
  BitEncoder coder(out);
  NearnessGrid copy = grid;
  static_cast<void>(codeAll(coder, copy, [](int value, int predicted) {
    const int error = value - predicted;
    return std::abs(error) <= kTolerance ? 0 : error;
  }));
  coder.finish();
}

std::optional<NearnessGrid> decodeNearness(std::span<const std::uint8_t> bytes, int width, int height) {
  NearnessGrid grid(width, height);
  BitDecoder coder(bytes);
  const auto unknown = [](int /*value*/, int /*predicted*/) { return 0; };
  if (!codeAll(coder, grid, unknown) || !coder.isAtEnd()) return std::nullopt;
  return grid;
}

}  // namespace grove::stream
