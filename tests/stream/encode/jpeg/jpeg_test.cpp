#include <gtest/gtest.h>

#include "stream/encode/bit_stream.h"
#include "stream/encode/jpeg/jpeg_decoder.h"
#include "stream/encode/jpeg/jpeg_encoder.h"
#include "yuv_pictures.h"

namespace grove::stream {
namespace {

/// A smooth picture with its memory.
struct Picture {
  Picture(int width, int height) : pixels(static_cast<std::size_t>(width * height)) {
    image.rect = {0, 0, width, height};
    image.colour = pixels;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const auto red = static_cast<std::uint32_t>(x * 255 / width);
        const auto green = static_cast<std::uint32_t>(y * 255 / height);
        image.colourRow(y)[x] = red | (green << 8U) | ((255 - red) << 16U) | 0xFF000000U;
      }
    }
  }
  [[nodiscard]] std::shared_ptr<const raster::YuvImage> yuv() const { return tests::yuvOf(image); }

  std::vector<std::uint32_t> pixels;
  raster::Image image;
};

TEST(JpegEncoder, KeepsThePictureAtAnyEvenSize) {
  JpegEncoder encoder(80);
  JpegDecoder decoder;
  for (const auto& [width, height] :
       {std::pair(1280, 720), std::pair(162, 90), std::pair(334, 18), std::pair(16, 16)}) {
    const Picture picture(width, height);
    std::vector<std::uint8_t> jpeg;
    encoder.encode(*picture.yuv(), {encoder.range().usual}, jpeg);
    EXPECT_EQ(decoder.size(jpeg), std::pair(width, height));
    const DecodedPicture* decoded = decoder.decode(jpeg);
    ASSERT_NE(decoded, nullptr) << width << " x " << height;
    EXPECT_GT(psnr(picture.pixels, decoded->colour), 30.0) << width << " x " << height;
  }
}

TEST(JpegEncoder, Appends) {
  JpegEncoder encoder(80);
  const Picture picture(64, 48);
  std::vector<std::uint8_t> bytes = {1, 2, 3};
  encoder.encode(*picture.yuv(), {encoder.range().usual}, bytes);
  EXPECT_EQ(bytes[2], 3);
  JpegDecoder decoder;
  EXPECT_NE(decoder.decode(std::span(bytes).subspan(3)), nullptr);
}

TEST(JpegEncoder, SpendsBytesOnQuality) {
  const Picture picture(640, 360);
  std::vector<std::uint8_t> low;
  std::vector<std::uint8_t> usual;
  std::vector<std::uint8_t> high;
  JpegEncoder encoder(75);
  encoder.encode(*picture.yuv(), {encoder.range().coarsest}, low);
  encoder.encode(*picture.yuv(), {encoder.range().usual}, usual);
  encoder.encode(*picture.yuv(), {encoder.range().finest}, high);
  EXPECT_LT(1.5 * low.size(), usual.size());
  EXPECT_LT(1.5 * usual.size(), high.size());
}

TEST(JpegDecoder, ReportsDamagedPictures) {
  JpegDecoder decoder;
  std::vector<std::uint8_t> jpeg;
  JpegEncoder(80).encode(*Picture(320, 200).yuv(), {}, jpeg);
  EXPECT_EQ(decoder.decode(std::span(jpeg).first(jpeg.size() / 2)), nullptr);
  for (std::size_t length = 0; length < jpeg.size(); length = length * 5 / 4 + 1) {
    EXPECT_EQ(decoder.decode(std::span(jpeg).first(length)), nullptr) << length;
    EXPECT_NE(decoder.decode(jpeg), nullptr) << "after " << length;
  }
  EXPECT_FALSE(decoder.size(std::vector<std::uint8_t>(100, 7)));
}

}  // namespace
}  // namespace grove::stream
