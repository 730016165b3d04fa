#include "stream/encode/h264/bits/coefficient_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdlib>

#include "stream/encode/h264/bits/coefficient_codes.h"

namespace grove::stream::h264 {
namespace {

/// The coefficients that are not zero, the highest frequency first.
struct Found {
  std::array<int, 16> levels;
  std::array<int, 16> zeros;  ///< right before each of them
  std::size_t count = 0;
  std::size_t trailingOnes = 0;
};

/// Bit i: level i is not zero.
std::uint32_t nonZero(std::span<const std::int16_t> levels) {
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) bits |= (levels[i] != 0 ? 1U : 0U) << i;
  return bits;
}

Found find(std::span<const std::int16_t> levels) {
  Found found;
  std::uint32_t left = nonZero(levels);
  while (left != 0) {
    const int place = std::bit_width(left) - 1;
    left &= ~(1U << place);
    const int level = levels[static_cast<std::size_t>(place)];
    if (std::abs(level) == 1 && found.trailingOnes == found.count && found.count < 3) ++found.trailingOnes;
    found.levels[found.count] = level;
    found.zeros[found.count] = place - std::bit_width(left);
    ++found.count;
  }
  return found;
}

void put(const Code& code, BitWriter& out) { out.put(code.bits, code.length); }

void writeToken(const Found& found, Context context, BitWriter& out) {
  if (context == kChromaDc) return put(kChromaTokens[found.count][found.trailingOnes], out);
  if (context >= 8) {
    const std::size_t code = found.count == 0 ? 3 : 4 * (found.count - 1) + found.trailingOnes;
    return out.put(static_cast<std::uint32_t>(code), 6);
  }
  const std::size_t table = context < 2 ? 0 : context < 4 ? 1 : 2;
  put(kTokens[table][found.count][found.trailingOnes], out);
}

/// Section 9.2.2.1, the other way round.
void writeLevel(int code, int suffixLength, BitWriter& out) {
  constexpr int kEscapePrefix = 15;
  constexpr int kEscapeBits = 12;
  const auto write = [&](int prefix, int suffix, int bits) {
    out.put(1, prefix + 1);
    if (bits > 0) out.put(static_cast<std::uint32_t>(suffix), bits);
  };
  if (suffixLength == 0) {
    if (code < 14) return write(code, 0, 0);
    if (code < 30) return write(14, code - 14, 4);
    return write(kEscapePrefix, code - 30, kEscapeBits);
  }
  const int escape = kEscapePrefix << suffixLength;
  if (code >= escape) return write(kEscapePrefix, code - escape, kEscapeBits);
  write(code >> suffixLength, code & ((1 << suffixLength) - 1), suffixLength);
}

void writeLevels(const Found& found, BitWriter& out) {
  for (std::size_t i = 0; i < found.trailingOnes; ++i) out.put(found.levels[i] < 0 ? 1 : 0, 1);
  int suffixLength = found.count > 10 && found.trailingOnes < 3 ? 1 : 0;
  for (std::size_t i = found.trailingOnes; i < found.count; ++i) {
    const int level = found.levels[i];
    int code = level > 0 ? 2 * level - 2 : -2 * level - 1;
    // This one would have been a trailing one.
    if (i == found.trailingOnes && found.trailingOnes < 3) code -= 2;
    writeLevel(code, suffixLength, out);
    suffixLength = std::max(suffixLength, 1);
    if (std::abs(level) > 3 << (suffixLength - 1) && suffixLength < 6) ++suffixLength;
  }
}

void writeRuns(const Found& found, std::size_t places, BitWriter& out) {
  int left = 0;
  for (std::size_t i = 0; i < found.count; ++i) left += found.zeros[i];
  if (found.count < places) {
    const auto zeros = static_cast<std::size_t>(left);
    put(places == 4 ? kChromaTotalZeros[found.count - 1][zeros] : kTotalZeros[found.count - 1][zeros], out);
  }
  for (std::size_t i = 0; i + 1 < found.count && left > 0; ++i) {
    put(kRuns[static_cast<std::size_t>(std::min(left, 7) - 1)][static_cast<std::size_t>(found.zeros[i])], out);
    left -= found.zeros[i];
  }
}

}  // namespace

int writeCoefficients(std::span<const std::int16_t> levels, Context context, BitWriter& out) {
  const Found found = find(levels);
  writeToken(found, context, out);
  if (found.count > 0) {
    writeLevels(found, out);
    writeRuns(found, levels.size(), out);
  }
  return static_cast<int>(found.count);
}

}  // namespace grove::stream::h264
