#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "stream/encode/bit_stream.h"
#include "stream/encode/jpeg/jpeg_encoder.h"
#include "stream/encode/jpeg/jpeg_patch_decoder.h"
#include "stream/encode/jpeg/jpeg_patch_encoder.h"
#include "stream/protocol/jpeg_patches.h"
#include "yuv_pictures.h"

namespace grove::stream {
namespace {

constexpr int kMeadowWidth = 326;  // no multiple of a block
constexpr int kMeadowHeight = 202;
constexpr Quantiser kUsual = 24.0;

/// A smooth meadow with a puff of smoke at `x`; none if that is negative.
class Meadow {
 public:
  explicit Meadow(int x, int width = kMeadowWidth, int height = kMeadowHeight)
      : pixels_(static_cast<std::size_t>(width * height)) {
    image_.rect = {0, 0, width, height};
    image_.colour = pixels_;
    for (int row = 0; row < height; ++row) {
      for (int column = 0; column < width; ++column) {
        const auto green = static_cast<std::uint32_t>(40 + row * 120 / height + column * 60 / width);
        image_.colourRow(row)[column] = 0xFF204060U + (green << 8U);
        if (x >= 0 && std::hypot(column - x, row - 90) < 20.0) image_.colourRow(row)[column] = 0xFFD0D0D0U;
      }
    }
  }
  [[nodiscard]] std::shared_ptr<const raster::YuvImage> yuv() const { return tests::yuvOf(image_); }
  [[nodiscard]] const std::vector<std::uint32_t>& pixels() const { return pixels_; }

 private:
  std::vector<std::uint32_t> pixels_;
  raster::Image image_;
};

/// An encoder, and a page that shows its pictures.
class JpegPatches : public testing::Test {
 protected:
  /// Encodes and shows a picture; returns its PSNR.
  double show(const Meadow& meadow, const EncodeOrder& order) {
    bytes_.clear();
    independent_ = encoder_.encode(*meadow.yuv(), order, bytes_);
    const DecodedPicture* const shown = decoder_.decode(bytes_, independent_);
    return shown == nullptr ? 0.0 : psnr(meadow.pixels(), shown->colour);
  }

  JpegPatchEncoder encoder_{75};
  JpegPatchDecoder decoder_;
  std::vector<std::uint8_t> bytes_;
  bool independent_ = false;
};

constexpr EncodeOrder kWalks{.quantiser = kUsual};
constexpr EncodeOrder kRests{.quantiser = kUsual, .still = true};

TEST_F(JpegPatches, AreJpegsOfWholePicturesWhileTheCameraMoves) {
  for (const int x : {50, 60, 70}) {
    EXPECT_GT(show(Meadow(x), kWalks), 34.0);
    EXPECT_TRUE(independent_);
    std::vector<std::uint8_t> jpeg;
    JpegEncoder(75).encode(*Meadow(x).yuv(), kWalks, jpeg);
    ASSERT_EQ(parsePatches(bytes_)->size(), 1U);
    EXPECT_TRUE(std::ranges::equal(parsePatches(bytes_)->front().jpeg, jpeg));
  }
}

/// Faults: everything is sent again; parts are missing, or at a wrong place.
TEST_F(JpegPatches, AreWhatHasChangedWhileTheCameraRests) {
  (void)show(Meadow(50), kRests);
  EXPECT_TRUE(independent_);
  const std::size_t whole = bytes_.size();
  for (int x = 52; x < 300; x += 8) {
    EXPECT_GT(show(Meadow(x), kRests), 34.0) << x;
    EXPECT_FALSE(independent_);
    EXPECT_LT(bytes_.size(), whole / 2);
  }
  EXPECT_GT(show(Meadow(-1), kRests), 34.0) << "the smoke is gone everywhere";
  EXPECT_GT(show(Meadow(-1), kRests), 34.0);
  EXPECT_TRUE(independent_) << "pages take no empty picture";
  EXPECT_FALSE(bytes_.empty());
}

TEST_F(JpegPatches, BeginAnewWhenTheyMust) {
  (void)show(Meadow(50), kRests);
  (void)show(Meadow(60), {.quantiser = kUsual, .independent = true, .still = true});
  EXPECT_TRUE(independent_) << "as ordered";
  (void)show(Meadow(60, 200, 100), kRests);
  EXPECT_TRUE(independent_) << "another size";
  (void)show(Meadow(70, 200, 100), kWalks);
  (void)show(Meadow(72, 200, 100), kRests);
  EXPECT_TRUE(independent_) << "the first picture at rest";
  (void)show(Meadow(74, 200, 100), kRests);
  EXPECT_FALSE(independent_);
}

/// Fault: what was coarse while the line was bad stays so where nothing moves.
TEST_F(JpegPatches, ReplaceCoarseParts) {
  const double coarse = show(Meadow(50), {.quantiser = 38.0, .still = true});
  const double fine = show(Meadow(50), {.quantiser = 20.0, .still = true});
  EXPECT_TRUE(independent_);
  EXPECT_GT(fine, coarse + 3.0);
  (void)show(Meadow(60), {.quantiser = 34.0, .still = true});
  EXPECT_FALSE(independent_);
  (void)show(Meadow(-1), {.quantiser = 20.0, .still = true});
  EXPECT_TRUE(independent_) << "where the smoke was is coarse";
}

TEST_F(JpegPatches, SendAllIfMostHasChanged) {
  (void)show(Meadow(50), kRests);

  const auto other = Meadow(100).yuv();
  std::vector<std::uint8_t> memory(other->bytes.begin(), other->bytes.end());
  for (std::uint8_t& byte : memory) byte ^= 2;
  raster::YuvImage changed;
  changed.rect = other->rect;
  changed.bytes = raster::Plane<std::uint8_t>(memory);
  bytes_.clear();
  EXPECT_TRUE(encoder_.encode(changed, kRests, bytes_));
}

TEST(JpegPatchDecoder, ReportsDamagedPictures) {
  JpegPatchEncoder encoder(75);
  std::vector<std::uint8_t> first;
  std::vector<std::uint8_t> second;
  encoder.encode(*Meadow(50).yuv(), kRests, first);
  ASSERT_FALSE(encoder.encode(*Meadow(60).yuv(), kRests, second));
  JpegPatchDecoder decoder;
  EXPECT_EQ(decoder.decode(second, false), nullptr) << "before the picture on which it depends";
  for (std::size_t length = 0; length < first.size(); length += 1 + length / 3) {
    EXPECT_EQ(decoder.decode(std::span(first).first(length), true), nullptr) << length;
  }
  ASSERT_NE(decoder.decode(first, true), nullptr);
  std::vector<std::uint8_t> outside = second;
  encodePatchHeader(kMeadowWidth - 8, 0, static_cast<std::uint32_t>(second.size() - kPatchHeaderBytes),
                    std::span(outside).first<kPatchHeaderBytes>());
  EXPECT_EQ(decoder.decode(outside, false), nullptr);
  std::mt19937 random(3);
  for (int i = 0; i < 500; ++i) {
    std::vector<std::uint8_t> noisy = i % 2 == 0 ? first : second;
    for (int k = 0; k < 4; ++k) noisy[random() % noisy.size()] = static_cast<std::uint8_t>(random());
    (void)decoder.decode(noisy, i % 2 == 0);
  }
}

}  // namespace
}  // namespace grove::stream
