#include "stream/encode/h264/scene_encoder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <wels/codec_api.h>

#include <algorithm>
#include <cstring>
#include <random>
#include <vector>

#include "each_target.h"
#include "stream/encode/bit_stream.h"

namespace grove::stream::h264 {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr QuantiserRange kAllQuantisers{.finest = 0.0, .coarsest = kMaxQuantiser};

/// A picture's planes without gaps, and their memory.
struct Source {
  Bytes bytes;
  raster::YuvImage image;

  Source(int width, int height) : bytes(static_cast<std::size_t>(width * height / 2 * 3)) {
    image.rect = {0, 0, width, height};
    image.bytes = bytes;
  }
};

/// The part of an encoder's picture that is within its size.
Bytes shownBy(const SceneEncoder& encoder, int width, int height) {
  Bytes planes;
  for (std::size_t i = 0; i < 3; ++i) {
    const int part = i == 0 ? 1 : 2;
    for (int y = 0; y < height / part; ++y) {
      const std::uint8_t* const row = encoder.shown().plane(i).at(0, y);
      planes.insert(planes.end(), row, row + width / part);
    }
  }
  return planes;
}

/// OpenH264's decoder, plane by plane.
class OpenDecoder {
 public:
  OpenDecoder() {
    WelsCreateDecoder(&decoder_);
    SDecodingParam parameters{};
    parameters.sVideoProperty.eVideoBsType = VIDEO_BITSTREAM_AVC;
    parameters.eEcActiveIdc = ERROR_CON_DISABLE;
    decoder_->Initialize(&parameters);
  }
  ~OpenDecoder() {
    decoder_->Uninitialize();
    WelsDestroyDecoder(decoder_);
  }
  OpenDecoder(const OpenDecoder&) = delete;
  OpenDecoder& operator=(const OpenDecoder&) = delete;

  /// Empty if it fails.
  Bytes decode(const Bytes& unit) {
    unsigned char* planes[3] = {};
    SBufferInfo info{};
    if (decoder_->DecodeFrameNoDelay(unit.data(), static_cast<int>(unit.size()), planes, &info) != dsErrorFree)
      return {};
    if (info.iBufferStatus != 1) return {};
    const SSysMEMBuffer& buffer = info.UsrData.sSystemBuffer;
    Bytes result;
    for (int i = 0; i < 3; ++i) {
      const int part = i == 0 ? 1 : 2;
      for (int y = 0; y < buffer.iHeight / part; ++y) {
        const unsigned char* const row = planes[i] + std::ptrdiff_t{y} * buffer.iStride[i == 0 ? 0 : 1];
        result.insert(result.end(), row, row + buffer.iWidth / part);
      }
    }
    return result;
  }

 private:
  ISVCDecoder* decoder_ = nullptr;
};

/// Pictures that no renderer draws: of every contrast, some black and white noise, some moved by a vector.
class Wild {
 public:
  Wild(int width, int height, unsigned seed)
      : source(width, height),
        motion(static_cast<std::size_t>((width + 7) / 8) * static_cast<std::size_t>((height + 7) / 8)),
        random_(seed) {}

  void next() {
    const auto any = [&](int count) { return static_cast<int>(random_() % static_cast<unsigned>(count)); };
    const int kind = any(5);
    if (kind > 0) {  // else as before
      const int mean = any(256);
      const int range = kind == 1 ? 255 : 1 + any(40);
      std::ranges::generate(source.bytes, [&] {
        if (kind == 2) return static_cast<std::uint8_t>(any(2) * 255);
        return static_cast<std::uint8_t>(std::clamp(mean + any(range) - range / 2, 0, 255));
      });
    }
    const bool isUniform = any(2) == 0;
    const auto vector = [&] {
      return MotionVector{static_cast<std::int16_t>(any(1000) - 500), static_cast<std::int16_t>(any(1000) - 500)};
    };
    if (isUniform) {
      std::ranges::fill(motion, vector());
    } else {
      std::ranges::generate(motion, vector);
    }
    order = {.quantiser = static_cast<double>(any(kMaxQuantiser * 4)) / 4.0,
             .independent = any(20) == 0,
             .motion = any(4) == 0 ? std::span<const MotionVector>() : motion};
  }

  Source source;
  std::vector<MotionVector> motion;
  EncodeOrder order;

 private:
  std::mt19937 random_;
};

// Faults: any difference between what the encoder believes and what decoders show: prediction, transform, quantisers,
// deblocking, codes of coefficients and vectors, contexts at edges, sizes that are no multiple of 16, vectors beyond
// the edges, several independent pictures.
TEST(SceneEncoder, IsDecodedToTheBit) {
  tests::onEachTarget([] {
    for (const auto& [width, height] : {std::pair(80, 64), std::pair(86, 54), std::pair(16, 16), std::pair(2, 2)}) {
      SCOPED_TRACE(testing::Message() << width << " x " << height);
      SceneEncoder encoder(kAllQuantisers);
      OpenDecoder open;
      Wild wild(width, height, 1);
      Bytes stream;
      Bytes shown;
      int differences = 0;
      for (int i = 0; i < 120; ++i) {
        wild.next();
        Bytes unit;
        encoder.encode(wild.source.image, wild.order, unit);
        const Bytes own = shownBy(encoder, width, height);
        if (width >= 16 && open.decode(unit) != own) ++differences;  // it refuses smaller ones
        stream.insert(stream.end(), unit.begin(), unit.end());
        shown.insert(shown.end(), own.begin(), own.end());
      }
      EXPECT_EQ(differences, 0) << "OpenH264";
      EXPECT_TRUE(StreamFile("h264", stream).planes() == shown) << "ffmpeg";
    }
  });
}

// Fault: rounding that adds up, or frame numbers that go wrong when they start again.
TEST(SceneEncoder, DoesNotDrift) {
  SceneEncoder encoder;
  OpenDecoder open;
  Bytes decoded;
  int lost = 0;
  for (int i = 0; i < 10000; ++i) {
    const TestPicture picture(96, 64, i % 500);
    const std::vector<MotionVector> motion(12 * 8, {12, 0});
    Bytes unit;
    encoder.encode(picture.yuv(), {.quantiser = 20.0 + i % 20, .motion = motion}, unit);
    decoded = open.decode(unit);
    if (decoded.empty()) ++lost;
  }
  EXPECT_EQ(lost, 0);
  EXPECT_TRUE(decoded == shownBy(encoder, 96, 64));
}

// Fault: targets whose streams differ, so that a fault shows on some processors only.
TEST(SceneEncoder, WritesTheSameOnEveryTarget) {
  std::vector<Bytes> streams;
  tests::onEachTarget([&] {
    SceneEncoder encoder(kAllQuantisers);
    Wild wild(86, 54, 2);
    Bytes stream;
    for (int i = 0; i < 30; ++i) {
      wild.next();
      encoder.encode(wild.source.image, wild.order, stream);
    }
    streams.push_back(std::move(stream));
  });
  EXPECT_EQ(std::ranges::count(streams, streams.front()), std::ssize(streams));
}

std::size_t bytesOf(SceneEncoder& encoder, const TestPicture& picture, const EncodeOrder& order) {
  Bytes bytes;
  encoder.encode(picture.yuv(), order, bytes);
  return bytes.size();
}

// Fault: vectors that are ignored, or taken with the wrong sign or unit.
TEST(SceneEncoder, NeedsFewBytesWhereTheMotionIsKnown) {
  const auto secondPicture = [](std::int16_t x) {
    SceneEncoder encoder;
    bytesOf(encoder, TestPicture(320, 240, 0), {.quantiser = 24.0});
    const std::vector<MotionVector> motion(40 * 30, {x, 0});
    return bytesOf(encoder, TestPicture(320, 240, 1), {.quantiser = 24.0, .motion = motion});
  };
  // A step of a TestPicture moves it to the left by three pixels.
  EXPECT_LT(4 * secondPicture(12), secondPicture(-12));
  EXPECT_LT(2 * secondPicture(12), secondPicture(3));
}

// Fault: vectors that are nearly right are taken as they are, although a step of a quarter pixel saves a fifth.
TEST(SceneEncoder, CorrectsVectorsThatAreNearlyRight) {
  const auto secondPicture = [](std::int16_t x, std::int16_t y) {
    SceneEncoder encoder;
    bytesOf(encoder, TestPicture(320, 240, 0), {.quantiser = 24.0});
    const std::vector<MotionVector> motion(40 * 30, {x, y});
    return bytesOf(encoder, TestPicture(320, 240, 1), {.quantiser = 24.0, .motion = motion});
  };
  EXPECT_LT(static_cast<double>(secondPicture(11, 1)), 1.5 * static_cast<double>(secondPicture(12, 0)));
}

// Faults: a still picture that is sent again and again, or an order for an independent picture that is ignored.
TEST(SceneEncoder, SkipsWhatDoesNotChange) {
  SceneEncoder encoder;
  const TestPicture picture(320, 240);
  Bytes bytes;
  EXPECT_TRUE(encoder.encode(picture.yuv(), {.quantiser = 24.0}, bytes));
  const std::size_t whole = bytes.size();
  bytes.clear();
  EXPECT_FALSE(encoder.encode(picture.yuv(), {.quantiser = 24.0}, bytes));
  bytes.clear();
  EXPECT_FALSE(encoder.encode(picture.yuv(), {.quantiser = 24.0}, bytes));
  EXPECT_LT(100 * bytes.size(), whole);
  bytes.clear();
  EXPECT_TRUE(encoder.encode(picture.yuv(), {.quantiser = 24.0, .independent = true}, bytes));
  EXPECT_GT(2 * bytes.size(), whole);
}

// Faults: vectors outside of every range, or too few pixels for a macroblock, make the encoder read other memory
// (which the address sanitizer sees) or write what no decoder reads.
TEST(SceneEncoder, StandsAnyVectors) {
  std::mt19937 random(4);
  for (const auto& [width, height] : {std::pair(34, 18), std::pair(128, 96)}) {
    SceneEncoder encoder(kAllQuantisers);
    Bytes stream;
    Bytes shown;
    Wild wild(width, height, 5);
    for (int i = 0; i < 60; ++i) {
      wild.next();
      const auto any = [&] { return static_cast<std::int16_t>(random() % 65536); };
      std::ranges::generate(wild.motion, [&] { return MotionVector{any(), any()}; });
      wild.order.motion = wild.motion;
      encoder.encode(wild.source.image, wild.order, stream);
      const Bytes own = shownBy(encoder, width, height);
      shown.insert(shown.end(), own.begin(), own.end());
    }
    EXPECT_TRUE(StreamFile("h264", stream).planes() == shown);
  }
}

}  // namespace
}  // namespace grove::stream::h264
