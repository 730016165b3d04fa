#include "stream/encode/encode_stage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <future>
#include <thread>
#include <utility>
#include <vector>

#include "base/error.h"
#include "pipeline/clocks.h"
#include "pipeline/worker_pool.h"
#include "stream/encode/encoded_stream.h"
#include "stream/encode/h264_decoder.h"
#include "stream/encode/jpeg/jpeg_decoder.h"
#include "yuv_pictures.h"

namespace grove::stream {
namespace {

TEST(EncodeStage, EncodesAFrameMessage) {
  std::vector<std::uint32_t> pixels(200 * 120, 0xFF4080C0U);
  raster::Image image;
  image.rect = {0, 0, 200, 120};
  image.colour = pixels;
  node::View view;
  view.session = 3;
  view.frame = 17;
  view.lastInput = 99;
  view.time = pipeline::wallSeconds() - 0.25;
  view.players.resize(2);

  const EncoderRegistry encoders = builtinEncoders(80);
  const auto governor = std::make_shared<Governor>([] { return 0.0; });
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  std::promise<std::shared_ptr<const EncodedFrame>> promise;
  auto future = promise.get_future();
  pipeline::WorkerPool workers(1);
  const auto stage = std::make_shared<EncodeStage>(
      std::make_shared<StreamControl>(encoders, governor, PageLevel::kBasic, 30.0, 200, 120), PageLevel::kBasic,
      std::vector<world::Vec3>{},
      EncodeStage::Outputs{
          .frame = [&](std::shared_ptr<const EncodedFrame> frame) { promise.set_value(std::move(frame)); }},
      memory, workers, timeline);
  stage->push({std::make_shared<const node::View>(view), tests::yuvOf(image)});

  const auto frame = future.get();
  EXPECT_GE(memory.totals().at({"encoders", ""}).bytes, static_cast<std::int64_t>(frame->bytes.size()));
  const ServerMessage message = parseServerMessage(frame->message());
  const auto* read = std::get_if<FrameMessage>(&message);
  ASSERT_NE(read, nullptr);
  EXPECT_EQ(read->header.codec, kCodecJpeg);
  EXPECT_EQ(read->header.width, 200);
  EXPECT_EQ(read->header.height, 120);
  EXPECT_EQ(read->header.visitors, 2);
  EXPECT_EQ(read->header.frame, 17U);
  EXPECT_EQ(read->header.lastInput, 99U);
  EXPECT_GE(read->header.serverMicroseconds, 250'000U);
  JpegDecoder decoder;
  const DecodedPicture* picture = decoder.decode(read->picture);
  ASSERT_NE(picture, nullptr);
  EXPECT_NEAR(static_cast<int>(picture->colour[5000] & 0xFFU), 0xC0, 4);
}

/// An encoder that fails at its nth picture; 0: it cannot even be made.
class FailingEncoder final : public Encoder {
 public:
  explicit FailingEncoder(int at) : at_(at) {
    if (at == 0) throw EnvironmentError("cannot start", "test encoder", "");
  }
  [[nodiscard]] std::uint8_t codec() const noexcept override { return kCodecH264; }
  [[nodiscard]] QuantiserRange range() const noexcept override { return {}; }
  bool encode(const raster::YuvImage& /*picture*/, const EncodeOrder& /*order*/,
              std::vector<std::uint8_t>& out) override {
    out.push_back(1);
    if (++made_ == at_) throw EnvironmentError("cannot encode", "test encoder", "");
    return made_ == 1;
  }
  [[nodiscard]] std::size_t bytes() const noexcept override { return 0; }

 private:
  const int at_;
  int made_ = 0;
};

/// Notes the motion in its orders; it may not want any.
class MovingEncoder final : public Encoder {
 public:
  using Motions = std::vector<std::vector<MotionVector>>;
  MovingEncoder(bool wants, Motions& motions) : wants_(wants), motions_(motions) {}
  [[nodiscard]] std::uint8_t codec() const noexcept override { return kCodecH264; }
  [[nodiscard]] QuantiserRange range() const noexcept override { return {}; }
  bool encode(const raster::YuvImage& /*picture*/, const EncodeOrder& order, std::vector<std::uint8_t>& out) override {
    out.push_back(1);
    motions_.emplace_back(order.motion.begin(), order.motion.end());
    return motions_.size() == 1;
  }
  [[nodiscard]] bool usesMotion() const noexcept override { return wants_; }
  [[nodiscard]] std::size_t bytes() const noexcept override { return 0; }

 private:
  const bool wants_;
  Motions& motions_;
};

// Faults: a picture that stands still and is sent thirty times a second; one that never gets as fine as it could; an
// input that changed nothing and is never told of.
TEST(EncodeStage, ResendsAStillFrameOnlyToRefine) {
  Stream stream;
  const std::vector<std::uint32_t> pixels = grain(1);
  ASSERT_NE(stream.push(pixels), nullptr);
  int quiet = 0;
  for (int i = 0; i < 60 && quiet < 5; ++i) quiet = stream.push(pixels) ? 0 : quiet + 1;
  EXPECT_EQ(quiet, 5);
  EXPECT_GE(stream.sent().size(), 2U);
  EXPECT_LE(stream.sent().size(), 20U);
  EXPECT_EQ(stream.control().status().lastInput, 10 * stream.pushed());
  EXPECT_EQ(stream.control().status().quality, 100);
  // A blade of grass moves, and a key frame is asked for.
  std::vector<std::uint32_t> other = pixels;
  other[1000] ^= 0xFFU;
  EXPECT_NE(stream.push(other), nullptr);
  EXPECT_NE(stream.push(other, 0.1F), nullptr);
}

// Fault: a page that has lost its decoder while nothing moves, and waits for a picture for ever.
TEST(EncodeStage, SendsIndependentPicturesOfStillViews) {
  Stream stream;
  const std::vector<std::uint32_t> pixels = grain(1);
  for (int i = 0; i < 40; ++i) (void)stream.push(pixels);
  ASSERT_EQ(stream.push(pixels), nullptr);
  stream.control().broken();
  std::shared_ptr<const EncodedFrame> picture;
  for (int i = 0; i < 200 && !picture; ++i) {
    picture = stream.push(pixels);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  ASSERT_NE(picture, nullptr);
  EXPECT_TRUE(picture->header.independent);
}

// Fault: a frame that was dropped once it was encoded, which those after it need.
TEST(EncodeStage, DropsFramesOnlyBeforeEncoding) {
  Stream stream;
  for (std::uint32_t i = 0; i < 60; ++i) {
    stream.rush(grain(i));
    if (i % Stream::kMaxRushed == Stream::kMaxRushed - 1) stream.drain();
  }
  EXPECT_GE(stream.sent().size(), 15U);
  H264Decoder decoder;
  for (const auto& frame : stream.sent()) {
    const ServerMessage message = parseServerMessage(frame->message());
    const auto* read = std::get_if<PictureMessage>(&message);
    ASSERT_NE(read, nullptr);
    EXPECT_EQ(read->header.independent, frame == stream.sent().front());
    EXPECT_NE(decoder.decode(read->picture), nullptr) << read->header.frame;
  }
  EXPECT_EQ(stream.sent().back()->header.frame, stream.pushed());
}

// Faults: an encoder that fails and takes the stream with it, at its start or in the midst of it; half of a picture
// that is sent.
TEST(EncodeStage, FallsBackToJpeg) {
  for (const int at : {0, 1, 3}) {
    EncoderRegistry encoders = builtinEncoders(80);
    encoders.add({kCodecH264, true, "failing", "test", [at] { return std::make_unique<FailingEncoder>(at); }});
    Stream stream(std::move(encoders));
    for (std::uint32_t i = 0; i < 8; ++i) (void)stream.push(grain(i));
    ASSERT_GE(stream.sent().size(), 6U) << at;
    const ServerMessage message = parseServerMessage(stream.sent().back()->message());
    const auto* read = std::get_if<PictureMessage>(&message);
    ASSERT_NE(read, nullptr);
    EXPECT_EQ(read->header.codec, kCodecJpeg) << at;
    EXPECT_TRUE(read->header.independent) << at;
    JpegDecoder decoder;
    EXPECT_NE(decoder.decode(read->picture), nullptr) << at;
  }
}

// Faults: motion since a frame that was not encoded, as a capture is not; motion from a picture of another encoder;
// none; work for encoders that do not want it.
TEST(EncodeStage, TellsTheMotionSinceTheLastEncodedPicture) {
  for (const bool wants : {false, true}) {
    MovingEncoder::Motions motions;
    EncoderRegistry encoders = builtinEncoders(80);
    encoders.add({kCodecH264, true, "moving", "test", [&] { return std::make_unique<MovingEncoder>(wants, motions); }});
    Stream stream(std::move(encoders));
    (void)stream.push(grain(1), 0.0F);
    (void)stream.push(grain(2), 0.01F);
    stream.control().capture(7);
    world::Camera camera;
    (void)stream.control().aim(camera, stream.pushed() + 1, pipeline::wallSeconds());
    (void)stream.push(grain(3), 0.1F);
    (void)stream.push(grain(4), 0.03F);
    ASSERT_EQ(motions.size(), 3U);
    EXPECT_TRUE(motions[0].empty());
    if (!wants) {
      EXPECT_TRUE(motions[1].empty() && motions[2].empty());
      continue;
    }
    ASSERT_EQ(motions[1].size(), 40U * 23U);
    ASSERT_EQ(motions[2].size(), 40U * 23U);
    // In the middle, a turn to the left moves everything to the right: so the content was farther left.
    const float focal = 4.0F * 90.0F / std::tan(1.05F / 2.0F);
    constexpr std::size_t kMiddle = 11 * 40 + 20;
    EXPECT_NEAR(motions[1][kMiddle].x, -0.01F * focal, 1.0F);
    EXPECT_NEAR(motions[2][kMiddle].x, -0.02F * focal, 1.0F);
  }
}

}  // namespace
}  // namespace grove::stream
