#include "stream/encode/h264_decoder.h"

#include <gmock/gmock.h>

#include <array>
#include <bit>

#include "stream/encode/annex_b.h"
#include "stream/encode/h264_encoder.h"
#include "stream/encode/h264_stream.h"
#include "yuv_pictures.h"

namespace grove::stream {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::Not;

constexpr int kWidth = 64;
constexpr int kHeight = 48;

struct Colour {
  int red;
  int green;
  int blue;
};
Colour colourAt(const DecodedPicture& picture, int x, int y) {
  const auto index =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
  const auto bytes = std::bit_cast<std::array<std::uint8_t, 4>>(picture.colour[index]);
  EXPECT_EQ(bytes[3], 255);
  return {bytes[0], bytes[1], bytes[2]};
}

void expectColour(const DecodedPicture* picture, Colour wanted) {
  ASSERT_NE(picture, nullptr);
  EXPECT_EQ(picture->width, kWidth);
  EXPECT_EQ(picture->height, kHeight);
  const Colour found = colourAt(*picture, 10, 3);
  EXPECT_NEAR(found.red, wanted.red, 4);
  EXPECT_NEAR(found.green, wanted.green, 4);
  EXPECT_NEAR(found.blue, wanted.blue, 4);
}

/// By ITU-R BT.601: full red, green and blue, and grey, in 0 to 255.
TEST(H264Decoder, ConvertsColoursByTheStandard) {
  H264Stream stream(kWidth, kHeight);
  H264Decoder decoder;
  expectColour(decoder.decode(stream.next(76, 85, 255, 1, true)), {255, 0, 0});
  expectColour(decoder.decode(stream.next(150, 44, 21, 2, true)), {0, 255, 0});
  expectColour(decoder.decode(stream.next(29, 255, 107, 3, true)), {0, 0, 255});
  expectColour(decoder.decode(stream.next(0, 128, 128, 4, true)), {0, 0, 0});
  expectColour(decoder.decode(stream.next(220, 128, 128, 1, true)), {220, 220, 220});
}

TEST(H264Decoder, DecodesTheServersStream) {
  std::vector<std::uint32_t> pixels(std::size_t{kWidth} * kHeight, 0xFF2080E0U);  // 0xAABBGGRR
  raster::Image image;
  image.rect = {0, 0, kWidth, kHeight};
  image.colour = pixels;
  H264Encoder encoder;
  H264Decoder decoder;
  for (int i = 0; i < 4; ++i) {
    std::vector<std::uint8_t> bytes;
    EXPECT_EQ(encoder.encode(*tests::yuvOf(image), {.independent = i == 2}, bytes), i == 0 || i == 2);
    expectColour(decoder.decode(bytes), {0xE0, 0x80, 0x20});
  }
}

TEST(H264Decoder, DecodesAChain) {
  H264Stream stream(kWidth, kHeight);
  H264Decoder decoder;
  for (int i = 0; i < 20; ++i) {
    const DecodedPicture* picture = decoder.decode(stream.next(100, 128, 128, i % 4));
    ASSERT_NE(picture, nullptr) << i;
    EXPECT_GT(colourAt(*picture, 20, 8 * (i % 4) + 4).red, colourAt(*picture, 20, 44).red + 10)
        << "this picture, not the last one";
  }
}

TEST(H264Decoder, ResizesWithAnIndependentPicture) {
  H264Decoder decoder;
  H264Stream small(kWidth, kHeight);
  H264Stream large(160, 90);
  EXPECT_NE(decoder.decode(small.next(100, 128, 128, 1)), nullptr);
  const DecodedPicture* picture = decoder.decode(large.next(100, 128, 128, 1));
  ASSERT_NE(picture, nullptr);
  EXPECT_EQ(picture->width, 160);
  EXPECT_EQ(picture->height, 90) << "as it was cropped";
  EXPECT_NE(decoder.decode(large.next(100, 128, 128, 2)), nullptr);
}

TEST(H264Decoder, ReportsUnsupportedStreams) {
  H264Stream stream(kWidth, kHeight);
  const std::vector<std::uint8_t> independent = stream.next(100, 128, 128, 1);
  const std::vector<std::uint8_t> second = stream.next(100, 128, 128, 2);
  const std::vector<std::uint8_t> third = stream.next(100, 128, 128, 3);
  {
    H264Decoder decoder;
    EXPECT_EQ(decoder.decode(second), nullptr) << "it depends on one that never came";
    EXPECT_NE(decoder.decode(independent), nullptr);
    EXPECT_NE(decoder.decode(second), nullptr);
  }
  {
    H264Decoder decoder;
    EXPECT_NE(decoder.decode(independent), nullptr);
    EXPECT_EQ(decoder.decode(third), nullptr) << "the one before it is missing";
    EXPECT_NE(decoder.decode(stream.next(100, 128, 128, 4, true)), nullptr) << "an independent one mends it";
  }
  H264Decoder decoder;
  EXPECT_EQ(decoder.decode({}), nullptr);
  EXPECT_EQ(decoder.decode(std::vector<std::uint8_t>(1000, 0x55)), nullptr);
  EXPECT_EQ(decoder.decode(std::span(independent).first(independent.size() / 2)), nullptr);
  EXPECT_NE(decoder.decode(stream.next(100, 128, 128, 5, true)), nullptr);
}

TEST(AnnexB, ReadsNalUnitTypes) {
  H264Stream stream(kWidth, kHeight);
  const auto first = unitTypes(stream.next(100, 128, 128, 1));
  ASSERT_TRUE(first);
  EXPECT_THAT(*first, Contains(UnitType::kSequenceParameters));
  EXPECT_THAT(*first, Contains(UnitType::kPictureParameters));
  EXPECT_THAT(*first, Contains(UnitType::kIndependentSlice));
  EXPECT_THAT(*first, Not(Contains(UnitType::kSlice)));
  const auto second = unitTypes(stream.next(100, 128, 128, 2));
  ASSERT_TRUE(second);
  EXPECT_THAT(*second, Each(UnitType::kSlice));
  const std::vector<std::uint8_t> mixed = {0, 0, 0, 1, 0x09, 0xF0, 0, 0, 1, 0x41, 7, 0, 0, 3, 1, 0, 0, 1, 0x68};
  EXPECT_THAT(unitTypes(mixed).value_or(std::vector<UnitType>{}),
              ElementsAre(UnitType::kDelimiter, UnitType::kSlice, UnitType::kPictureParameters))
      << "three zeros, two zeros, and zeros within a unit";
}

TEST(AnnexB, RefusesOtherData) {
  using Bytes = std::vector<std::uint8_t>;
  for (const Bytes& bad : {Bytes{}, Bytes{0, 0}, Bytes{0, 0, 1}, Bytes{7, 0, 0, 1, 0x41}, Bytes{0, 0, 1, 0xC1},
                           Bytes{0, 0, 1, 0x41, 0, 0, 1}, Bytes{0xFF, 0xD8, 0xFF}, Bytes(100, 0)}) {
    EXPECT_FALSE(unitTypes(bad)) << testing::PrintToString(bad);
  }
}

}  // namespace
}  // namespace grove::stream
