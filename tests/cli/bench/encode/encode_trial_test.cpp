#include "cli/bench/encode/encode_trial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "node/messages.h"
#include "stream/encode/h264_decoder.h"
#include "stream/protocol/protocol.h"

namespace grove::cli {
namespace {

constexpr int kWidth = 160;
constexpr int kHeight = 90;

/// Stripes that move from frame to frame.
KeptFrames movingStripes(int count) {
  KeptFrames frames(kWidth, kHeight);
  raster::ImagePool images;
  for (int i = 0; i < count; ++i) {
    auto picture = raster::acquireYuv(images, {0, 0, kWidth, kHeight});
    std::ranges::fill(picture->bytes, std::uint8_t{128});
    for (std::size_t at = 0; at < picture->lumaBytes(); ++at) {
      picture->y()[at] = static_cast<std::uint8_t>(at % kWidth * 3 + 10 * static_cast<std::size_t>(i));
    }
    frames.add({.view = std::make_shared<node::View>(), .picture = picture});
  }
  return frames;
}

// Fault: what other programs decode is not what was measured: a picture is lost, or kept twice.
TEST(EncodeTrial, KeepsEverySentPictureOnce) {
  constexpr int kFrames = 5;
  KeptFrames frames = movingStripes(kFrames);
  const stream::EncoderRegistry encoders = stream::builtinEncoders(75);
  for (const stream::EncoderKind& kind : encoders.kinds()) {
    if (kind.codec != stream::kCodecH264) continue;
    stream::H264Decoder decoder;
    std::size_t bytes = 0;
    std::size_t shown = 0;
    const EncodeTrial trial = tryEncoder(encoders, kind, {30.0}, frames, {}, [&](auto picture) {
      bytes += picture.size();
      if (decoder.decode(picture) != nullptr) ++shown;
    });
    EXPECT_EQ(trial.pictures, kFrames) << kind.name;
    EXPECT_EQ(shown, trial.pictures) << kind.name;
    EXPECT_NEAR(trial.kilobitsPerSecond, 8e-3 * static_cast<double>(bytes) * 30.0 / kFrames, 0.1) << kind.name;
    EXPECT_GT(trial.meanMilliseconds, 0.0) << kind.name;
    EXPECT_LE(trial.meanMilliseconds, trial.p99Milliseconds) << kind.name;
  }
}

}  // namespace
}  // namespace grove::cli
