#include "stream/encode/h264/bits/bit_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace grove::stream::h264 {
namespace {

std::string written(const BitWriter& bits) {
  std::string text;
  for (const std::uint8_t byte : bits.bytes()) {
    for (int i = 7; i >= 0; --i) text += (byte >> i & 1) != 0 ? '1' : '0';
  }
  return text;
}

// Faults: codes that are off by one, signs swapped, bits in the wrong order (ITU-T H.264, tables 9-2 and 9-3).
TEST(BitWriter, WritesTheCodesOfTheStandard) {
  BitWriter bits;
  for (const std::uint32_t value : {0U, 1U, 2U, 3U, 6U, 7U}) bits.putUnsigned(value);
  for (const int value : {0, 1, -1, 2, -2}) bits.putSigned(value);
  bits.finish();
  EXPECT_EQ(written(bits),
            "1"
            "010"
            "011"
            "00100"
            "00111"
            "0001000"
            "1"
            "010"
            "011"
            "00100"
            "00101"
            "1000000");
}

// Faults: bits lost where a number fills all of them, or crosses bytes.
TEST(BitWriter, WritesLongNumbers) {
  BitWriter bits;
  bits.put(1, 3);
  bits.put(0xDEADBEEF, 32);
  bits.putUnsigned(0xFFFE);
  bits.finish();
  EXPECT_EQ(written(bits),
            "001"
            "11011110101011011011111011101111"
            "000000000000000"
            "1111111111111111"
            "10"
            "0000");
}

// Faults: a payload that ends without its last bit, or with a byte too many.
TEST(BitWriter, EndsPayloads) {
  BitWriter bits;
  bits.put(0b101, 3);
  bits.finish();
  EXPECT_EQ(written(bits), "10110000");
  bits.clear();
  bits.put(0xFF, 8);
  bits.finish();
  EXPECT_EQ(written(bits), "1111111110000000");
}

TEST(BitWriter, CountsTheBitsOfSignedNumbers) {
  for (const int value : {0, 1, -1, 2, -2, 3, 100, -2048}) {
    BitWriter bits;
    bits.putSigned(value);
    bits.finish();
    const auto length = static_cast<std::size_t>(signedBits(value));
    EXPECT_EQ(written(bits).rfind('1'), length) << value;
    EXPECT_EQ(written(bits).find('1'), length / 2) << value;
  }
}

}  // namespace
}  // namespace grove::stream::h264
