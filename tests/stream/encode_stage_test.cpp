#include "stream/encode_stage.h"

#include <gtest/gtest.h>

#include <future>
#include <vector>

#include "pipeline/worker_pool.h"
#include "stream/encode/jpeg_decoder.h"
#include "world/world.h"

namespace grove::stream {
namespace {

TEST(EncodeStage, MakesAFrameMessageOfAFrame) {
  std::vector<std::uint32_t> pixels(200 * 120, 0xFF4080C0U);
  node::Image image;
  image.rect = {0, 0, 200, 120};
  image.colour = pixels;
  node::View view;
  view.session = 3;
  view.frame = 17;
  view.lastInput = 99;
  view.time = world::World::now() - 0.25;
  view.players.resize(2);

  const EncoderRegistry encoders = builtinEncoders(80);
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  std::promise<std::shared_ptr<const EncodedFrame>> promise;
  auto future = promise.get_future();
  pipeline::WorkerPool workers(1);
  const auto stage = std::make_shared<EncodeStage>(
      std::make_shared<StreamControl>(encoders, false, 30.0, 200, 120), false,
      [&](std::shared_ptr<const EncodedFrame> frame) { promise.set_value(std::move(frame)); }, memory, workers,
      timeline);
  stage->push({std::make_shared<const node::View>(view), std::make_shared<const node::Image>(image)});

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

}  // namespace
}  // namespace grove::stream
