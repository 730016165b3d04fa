#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "stream/encode/bit_stream.h"
#include "stream/encode/encoder_registry.h"
#include "stream/encode/h264_decoder.h"
#include "stream/encode/h264_encoder.h"
#include "stream/protocol/protocol.h"

namespace grove::stream {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Types of the units of an access unit.
std::vector<int> units(std::span<const std::uint8_t> bytes) {
  std::vector<int> types;
  for (std::size_t i = 0; i + 3 < bytes.size(); ++i) {
    if (bytes[i] == 0 && bytes[i + 1] == 0 && bytes[i + 2] == 1) types.push_back(bytes[i + 3] & 0x1F);
  }
  return types;
}

Bytes encodeOne(Encoder& encoder, const TestPicture& picture, const EncodeOrder& order, bool* independent = nullptr) {
  Bytes bytes;
  const bool is = encoder.encode(picture.yuv(), order, bytes);
  if (independent != nullptr) *independent = is;
  return bytes;
}

// Faults: planes swapped or of the wrong size, the wrong matrix or range, rows that do not fit, in any kind of encoder;
// a stream that only its own library can read.
TEST(Encoders, AreDecodedByReferenceDecoders) {
  const EncoderRegistry encoders = builtinEncoders(80);
  for (const EncoderKind& kind : encoders.kinds()) {
    for (const auto& [width, height] : {std::pair(1280, 720), std::pair(160, 90), std::pair(1082, 606)}) {
      const auto encoder = kind.make();
      Bytes stream;
      std::vector<std::uint32_t> drawn;
      const int pictures = kind.chained ? 5 : 1;
      for (int i = 0; i < pictures; ++i) {
        const TestPicture picture(width, height, i);
        drawn.insert(drawn.end(), picture.pixels.begin(), picture.pixels.end());
        EXPECT_EQ(encoder->encode(picture.yuv(), {encoder->range().usual, false}, stream), i == 0) << kind.name;
      }
      const StreamFile file(kind.chained ? "h264" : "jpg", stream);
      EXPECT_GT(psnr(file.pixels(), drawn), 30.0) << kind.name << ", " << width << " x " << height;
    }
  }
}

// Fault: our own decoder, which measurements go by, that shows other colours than others do.
TEST(H264Decoder, RoundTripsAPicture) {
  H264Encoder encoder;
  H264Decoder decoder;
  for (int i = 0; i < 5; ++i) {
    const TestPicture picture(640, 360, i);
    const DecodedPicture* decoded = decoder.decode(encodeOne(encoder, picture, {24.0, false}));
    ASSERT_NE(decoded, nullptr) << i;
    EXPECT_EQ(decoded->width, 640);
    EXPECT_GT(psnr(decoded->colour, picture.pixels), 30.0) << i;
  }
}

// Faults: a profile that not every page decodes; pictures that are held back or reordered; colours that a page has to
// guess.
TEST(H264Encoder, IsConstrainedBaselineWithoutDelay) {
  H264Encoder encoder;
  Bytes stream;
  for (int i = 0; i < 3; ++i) (void)encoder.encode(TestPicture(1280, 720, i).yuv(), {25.0, false}, stream);
  const StreamFile file("h264", stream);
  const std::vector<char> output = file.run("ffprobe -v error -show_streams @");
  const std::string reported(output.begin(), output.end());
  for (const char* line :
       {"profile=Constrained Baseline\n", "has_b_frames=0\n", "color_range=pc\n", "color_space=smpte170m\n",
        "color_primaries=smpte170m\n", "width=1280\n", "height=720\n", "field_order=progressive\n", "refs=1\n"}) {
    EXPECT_THAT(reported, ::testing::HasSubstr(line));
  }
  const std::vector<char> headers =
      file.run("ffmpeg -nostdin -v verbose -i @ -c copy -bsf:v trace_headers -f null - 2>&1");
  const std::string traced(headers.begin(), headers.end());
  EXPECT_THAT(traced, ::testing::ContainsRegex("max_num_reorder_frames[^\n]* = 0\n"));
  EXPECT_THAT(traced, ::testing::ContainsRegex("max_dec_frame_buffering[^\n]* = 1\n"));
}

// Faults: an independent picture that a page cannot begin with, since it does not say its parameters; one that comes
// although nobody asked; a dependent picture that repeats the parameters.
TEST(H264Encoder, MakesIndependentPicturesOnlyOnRequest) {
  H264Encoder encoder;
  for (int i = 0; i < 40; ++i) {
    bool independent = false;
    // Even if nothing of the picture is as before.
    const TestPicture picture(320, 180, i < 20 ? i : 1000 * i);
    const Bytes bytes = encodeOne(encoder, picture, {25.0, i == 10}, &independent);
    EXPECT_EQ(independent, i == 0 || i == 10) << i;
    if (independent) {
      EXPECT_EQ(units(bytes), (std::vector<int>{7, 8, 5})) << i;
      H264Decoder fresh;
      EXPECT_NE(fresh.decode(bytes), nullptr) << i;
    } else {
      EXPECT_EQ(units(bytes), std::vector<int>{1}) << i;
    }
  }
}

/// A dark body before a sky, with smooth edges, whose middle is at `x` and `y`.
raster::Image withFigure(std::vector<std::uint32_t>& pixels, float x, float y, float time) {
  constexpr int kSkyWidth = 480;
  constexpr int kSkyHeight = 240;
  for (int row = 0; row < kSkyHeight; ++row) {
    const auto height = static_cast<float>(row);
    const float down = height + 0.5F - y;
    const float width = 16.0F * std::sqrt(std::max(0.0F, 1.0F - down * down / 3600.0F)) + std::sin(0.2F * down + time);
    const auto colour = [&](float share) {
      const auto channel = [&](float sky, float body) {
        return static_cast<std::uint32_t>(std::lround(sky + share * (body - sky)));
      };
      return 0xFF000000U | channel(220.0F + 0.05F * height, 50.0F) << 16U |
             channel(180.0F + 0.15F * height, 60.0F) << 8U | channel(150.0F + 0.2F * height, 70.0F);
    };
    const auto first = pixels.begin() + std::ptrdiff_t{row} * kSkyWidth;
    std::fill_n(first, kSkyWidth, colour(0.0F));
    for (int column = 0; column < kSkyWidth; ++column) {
      const float share = width - std::abs(static_cast<float>(column) + 0.5F - x) + 0.5F;
      if (share > 0.0F) {
        first[column] = colour(std::min(share, 1.0F));
      }
    }
  }
  raster::Image image;
  image.rect = {0, 0, kSkyWidth, kSkyHeight};
  image.colour = pixels;
  return image;
}

// Fault: pixels of a figure that stay in a still sky. An encoder leaves errors below its quantiser's step.
TEST(H264Encoder, PassingFiguresLeaveNothingBehind) {
  for (int walk = 0; walk < 8; ++walk) {
    H264Encoder encoder;
    H264Decoder decoder;
    std::vector<std::uint32_t> pixels(std::size_t{480} * 240);
    const DecodedPicture* decoded = nullptr;
    for (int i = 0; i < 90; ++i) {  // it is gone after 80
      const float x = (6.6F + 0.37F * static_cast<float>(walk)) * static_cast<float>(i) - 30.0F;
      const raster::Image image = withFigure(pixels, x, 90.0F + 7.3F * static_cast<float>(walk), 0.07F * x);
      Bytes bytes;
      (void)encoder.encode(*tests::yuvOf(image), {encoder.range().finest, false}, bytes);
      decoded = decoder.decode(bytes);
    }
    ASSERT_NE(decoded, nullptr);
    std::uint32_t largest = 0;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      for (const unsigned shift : {0U, 8U, 16U}) {
        const std::uint32_t shown = (decoded->colour[i] >> shift) & 0xFFU;
        const std::uint32_t drawn = (pixels[i] >> shift) & 0xFFU;
        largest = std::max(largest, std::max(shown, drawn) - std::min(shown, drawn));
      }
    }
    EXPECT_LE(largest, 10U) << walk;
  }
}

// Fault: a change of the quantiser that restarts the encoder.
TEST(H264Encoder, ChangesItsQuantiserWithinTheChain) {
  H264Encoder encoder;
  H264Decoder decoder;
  std::vector<std::size_t> sizes;
  for (int i = 0; i < 30; ++i) {
    const TestPicture picture(640, 360, i);
    bool independent = false;
    const Bytes bytes = encodeOne(encoder, picture, {i % 2 == 0 ? 22.0 : 36.0, false}, &independent);
    EXPECT_EQ(independent, i == 0) << i;
    ASSERT_NE(decoder.decode(bytes), nullptr) << i;
    sizes.push_back(bytes.size());
  }
  EXPECT_GT(sizes[28], 2 * sizes[29]);
}

// Faults: pictures of a new size that depend on those of the old one; a decoder that has to be made anew.
TEST(H264Encoder, ChangesItsSizeWithinTheStream) {
  H264Encoder encoder;
  H264Decoder decoder;
  Bytes stream;
  for (const auto& [width, height] :
       {std::pair(1280, 720), std::pair(160, 90), std::pair(1920, 1080), std::pair(852, 480), std::pair(1280, 720)}) {
    for (int i = 0; i < 3; ++i) {
      const TestPicture picture(width, height, i);
      bool independent = false;
      const Bytes bytes = encodeOne(encoder, picture, {24.0, false}, &independent);
      EXPECT_EQ(independent, i == 0) << width << " x " << height;
      stream.insert(stream.end(), bytes.begin(), bytes.end());
      const DecodedPicture* decoded = decoder.decode(bytes);
      ASSERT_NE(decoded, nullptr) << width << " x " << height << ", " << i;
      ASSERT_EQ(std::pair(decoded->width, decoded->height), std::pair(width, height));
      EXPECT_GT(psnr(decoded->colour, picture.pixels), 28.0) << width << " x " << height << ", " << i;
    }
  }
  const StreamFile file("h264", stream);
  const std::vector<char> output = file.run("ffprobe -v error -show_entries frame=width,height -of csv=p=0 @");
  const std::string reported(output.begin(), output.end());
  EXPECT_THAT(reported, ::testing::StartsWith("1280,720\n1280,720\n1280,720\n160,90\n160,90\n160,90\n1920,1080\n"));
  EXPECT_THAT(reported, ::testing::EndsWith("852,480\n852,480\n852,480\n1280,720\n1280,720\n1280,720\n"));
}

// Fault: a decoder that shows nonsense, or what it guesses, when a picture of the chain is missing or damaged.
TEST(H264Decoder, ReportsDamagedStreams) {
  H264Encoder encoder;
  const Bytes first = encodeOne(encoder, TestPicture(320, 180, 0), {24.0, false});
  const Bytes second = encodeOne(encoder, TestPicture(320, 180, 1), {24.0, false});
  H264Decoder decoder;
  EXPECT_EQ(decoder.decode(second), nullptr);
  EXPECT_NE(decoder.decode(first), nullptr);
  EXPECT_NE(decoder.decode(second), nullptr);
  EXPECT_EQ(H264Decoder().decode({}), nullptr);
  EXPECT_EQ(H264Decoder().decode(Bytes(1000, 0x5A)), nullptr);
  EXPECT_EQ(H264Decoder().decode(std::span(first).first(first.size() / 2)), nullptr);
}

// Fault: orders beyond the encoder's range that reach the library.
TEST(Encoders, ClampTheirSettings) {
  const EncoderRegistry encoders = builtinEncoders(80);
  for (const EncoderKind& kind : encoders.kinds()) {
    const QuantiserRange range = kind.make()->range();
    EXPECT_LT(range.finest, range.coarsest) << kind.name;
    const TestPicture picture(320, 180);
    const auto bytes = [&](Quantiser quantiser) { return encodeOne(*kind.make(), picture, {quantiser, true}).size(); };
    EXPECT_EQ(bytes(1000.0), bytes(range.coarsest)) << kind.name;
    EXPECT_EQ(bytes(-1000.0), bytes(range.finest)) << kind.name;
    EXPECT_GT(bytes(range.finest), 2 * bytes(range.coarsest)) << kind.name;
  }
}

}  // namespace
}  // namespace grove::stream
