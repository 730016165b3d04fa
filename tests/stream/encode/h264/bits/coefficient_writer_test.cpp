#include "stream/encode/h264/bits/coefficient_writer.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "stream/encode/h264/bits/coefficient_codes.h"

namespace grove::stream::h264 {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// The bits of coefficients, without what fills the last byte.
std::string bitsOf(const std::vector<std::int16_t>& levels, Context context) {
  BitWriter bits;
  writeCoefficients(levels, context, bits);
  bits.finish();
  std::string text;
  for (const std::uint8_t byte : bits.bytes()) {
    for (int i = 7; i >= 0; --i) text += (byte >> i & 1) != 0 ? '1' : '0';
  }
  return text.substr(0, text.rfind('1'));
}

// Faults: wrong tables, order, signs or suffixes. The examples of I. Richardson, The H.264 Advanced Video Compression
// Standard, section 7.4.2.
TEST(CoefficientWriter, WritesKnownBlocks) {
  EXPECT_EQ(bitsOf({0, 3, 0, 1, -1, -1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0}, 0), "000010001110010111101101");
  EXPECT_EQ(bitsOf({-2, 4, 3, -3, 0, 0, -1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, 0), "000000011010001001000010111001100");
}

// Faults: a block whose coefficients are written in another order than the scan's, or with one of frequency 0 that it
// does not have.
TEST(CoefficientWriter, WritesBlocksInTheOrderOfTheScan) {
  const auto bitsOfBlock = [](bool withoutDc) {
    const std::vector<std::int16_t> levels{0, 3, 0, 1, -1, -1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0};
    Block block{};
    for (std::size_t i = 0; i < 16; ++i) block[kScan[i]] = levels[i];
    BitWriter bits;
    writeBlock(block, {.nonZero = 0b10111010, .large = 0b10, .negative = 0b110000}, withoutDc, 0, bits);
    bits.finish();
    return Bytes(bits.bytes().begin(), bits.bytes().end());
  };
  const auto bytesOf = [](const std::vector<std::int16_t>& levels) {
    BitWriter bits;
    writeCoefficients(levels, 0, bits);
    bits.finish();
    return Bytes(bits.bytes().begin(), bits.bytes().end());
  };
  EXPECT_EQ(bitsOfBlock(false), bytesOf({0, 3, 0, 1, -1, -1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_EQ(bitsOfBlock(true), bytesOf({3, 0, 1, -1, -1, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0}));
}

// Faults: contexts that choose the wrong table (table 9-5), and what stands for nothing in each.
TEST(CoefficientWriter, WritesEmptyBlocks) {
  const std::vector<std::int16_t> block(16);
  for (const Context context : {0, 1}) EXPECT_EQ(bitsOf(block, context), "1");
  for (const Context context : {2, 3}) EXPECT_EQ(bitsOf(block, context), "11");
  for (const Context context : {4, 7}) EXPECT_EQ(bitsOf(block, context), "1111");
  for (const Context context : {8, 16}) EXPECT_EQ(bitsOf(block, context), "000011");
  EXPECT_EQ(bitsOf({0, 0, 0, 0}, kChromaDc), "01");
}

// Fault: a level whose code is longer than every profile permits, or wraps around.
TEST(CoefficientWriter, WritesTheGreatestLevels) {
  const std::string escape = "0000000000000001";
  EXPECT_EQ(bitsOf({kMaxLevel, 0, 0, 0}, kChromaDc), "000111" + escape + "111111111100" + "1");
  EXPECT_EQ(bitsOf({-kMaxLevel, 0, 0, 0}, kChromaDc), "000111" + escape + "111111111101" + "1");
}

/// Whether no code begins with another one.
template <class Codes>
void expectPrefixFree(const Codes& codes) {
  for (const Code& a : codes) {
    for (const Code& b : codes) {
      if (&a == &b || a.length == 0 || b.length == 0 || a.length > b.length) continue;
      EXPECT_NE(a.bits, b.bits >> (b.length - a.length)) << int{a.bits} << ", " << int{a.length};
    }
  }
}

template <class Table>
std::vector<Code> flat(const Table& table) {
  std::vector<Code> codes;
  for (const auto& row : table) codes.insert(codes.end(), row.begin(), row.end());
  return codes;
}

// Fault: a digit of a table mistyped: nearly every other code begins with, or is the beginning of, another one.
TEST(CoefficientCodes, ArePrefixFree) {
  for (const auto& table : kTokens) expectPrefixFree(flat(table));
  expectPrefixFree(flat(kChromaTokens));
  for (const auto& row : kTotalZeros) expectPrefixFree(row);
  for (const auto& row : kChromaTotalZeros) expectPrefixFree(row);
  for (const auto& row : kRuns) expectPrefixFree(row);
}

}  // namespace
}  // namespace grove::stream::h264
