#include "stream/encode/h264/bits/coefficient_writer.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdlib>
#include <utility>

#include "stream/encode/h264/bits/coefficient_codes.h"

namespace grove::stream::h264 {
namespace {

/// Coefficients in the order of the scan. Place i is values[order[i]].
struct Levels {
  const std::int16_t* values;
  const std::uint8_t* order;
  LevelBits bits;
  std::size_t places;

  [[nodiscard]] int at(int place) const { return values[order[place]]; }
  [[nodiscard]] int count() const { return std::popcount(bits.nonZero); }
  /// Those of level 1 or -1 at the highest frequencies, at most three.
  [[nodiscard]] int trailingOnes() const {
    return std::min(3, std::popcount(static_cast<std::uint32_t>(bits.nonZero) >> std::bit_width(bits.large)));
  }
};

/// Removes the highest place of a set of places that is not empty, and returns it.
int takeHighest(std::uint32_t& places) {
  const std::uint32_t highest = std::bit_floor(places);
  places ^= highest;
  return std::countr_zero(highest);
}

void put(const Code& code, BitWriter& out) { out.put(code.bits, code.length); }

Code tokenOf(std::size_t count, std::size_t trailingOnes, Context context) {
  if (context == kChromaDc) return kChromaTokens[count][trailingOnes];
  if (context >= 8) {
    Code code;
    code.bits = static_cast<std::uint16_t>(count == 0 ? 3 : 4 * (count - 1) + trailingOnes);
    code.length = 6;
    return code;
  }
  const std::size_t table = context < 2 ? 0 : context < 4 ? 1 : 2;
  return kTokens[table][count][trailingOnes];
}

/// Section 9.2.2.1, the other way round.
void writeLevel(int code, int suffixLength, BitWriter& out) {
  constexpr int kEscapePrefix = 15;
  constexpr int kEscapeBits = 12;
  const auto write = [&](int prefix, int suffix, int bits) {
    out.put(1U << bits | static_cast<std::uint32_t>(suffix), prefix + 1 + bits);
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

/// The token, the signs of trailing ones, and the other levels.
void writeLevels(const Levels& levels, Context context, BitWriter& out) {
  const int count = levels.count();
  const int ones = levels.trailingOnes();
  std::uint32_t left = levels.bits.nonZero;
  const Code token = tokenOf(static_cast<std::size_t>(count), static_cast<std::size_t>(ones), context);
  std::uint32_t signs = token.bits;
  for (int i = 0; i < ones; ++i) signs = 2 * signs + (levels.bits.negative >> takeHighest(left) & 1U);
  out.put(signs, token.length + ones);
  int suffixLength = count > 10 && ones < 3 ? 1 : 0;
  bool couldBeOne = ones == 3;
  while (left != 0) {
    const int level = levels.at(takeHighest(left));
    int code = level > 0 ? 2 * level - 2 : -2 * level - 1;
    // The first one would have been a trailing one.
    if (!std::exchange(couldBeOne, true)) code -= 2;
    writeLevel(code, suffixLength, out);
    suffixLength = std::max(suffixLength, 1);
    if (std::abs(level) > 3 << (suffixLength - 1) && suffixLength < 6) ++suffixLength;
  }
}

void writeRuns(const Levels& levels, BitWriter& out) {
  std::uint32_t left = levels.bits.nonZero;
  const auto count = static_cast<std::size_t>(levels.count());
  int last = takeHighest(left);
  int zeros = last + 1 - static_cast<int>(count);
  if (count < levels.places) {
    const auto all = static_cast<std::size_t>(zeros);
    put(levels.places == 4 ? kChromaTotalZeros[count - 1][all] : kTotalZeros[count - 1][all], out);
  }
  while (left != 0 && zeros > 0) {
    const int place = takeHighest(left);
    const int run = last - place - 1;
    put(kRuns[static_cast<std::size_t>(std::min(zeros, 7) - 1)][static_cast<std::size_t>(run)], out);
    zeros -= run;
    last = place;
  }
}

int writeAll(const Levels& levels, Context context, BitWriter& out) {
  writeLevels(levels, context, out);
  if (levels.bits.nonZero != 0) writeRuns(levels, out);
  return levels.count();
}

LevelBits bitsOf(std::span<const std::int16_t> levels) {
  std::uint32_t nonZero = 0;
  std::uint32_t large = 0;
  std::uint32_t negative = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    nonZero |= (levels[i] != 0 ? 1U : 0U) << i;
    large |= (std::abs(levels[i]) > 1 ? 1U : 0U) << i;
    negative |= (levels[i] < 0 ? 1U : 0U) << i;
  }
  return {static_cast<std::uint16_t>(nonZero), static_cast<std::uint16_t>(large), static_cast<std::uint16_t>(negative)};
}

}  // namespace

int writeCoefficients(std::span<const std::int16_t> levels, Context context, BitWriter& out) {
  constexpr std::array<std::uint8_t, 16> kAsTheyAre{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  return writeAll({levels.data(), kAsTheyAre.data(), bitsOf(levels), levels.size()}, context, out);
}

int writeBlock(const Block& block, const LevelBits& bits, bool withoutDc, Context context, BitWriter& out) {
  if (!withoutDc) return writeAll({block.data(), kScan.data(), bits, 16}, context, out);
  const auto next = [](std::uint16_t all) { return static_cast<std::uint16_t>(all >> 1); };
  const LevelBits rest{next(bits.nonZero), next(bits.large), next(bits.negative)};
  return writeAll({block.data(), kScan.data() + 1, rest, 15}, context, out);
}

}  // namespace grove::stream::h264
