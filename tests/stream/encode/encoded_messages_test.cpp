#include <gtest/gtest.h>

#include "stream/encode/encoded_stream.h"
#include "stream/encode/h264_decoder.h"
#include "stream/late_walk/nearness_code.h"

namespace grove::stream {
namespace {

// Faults: a name at another place than the visitor; a header that runs into the picture; bytes that older pages take
// for a part of the picture.
TEST(EncodeStage, SendsLabelsAndSoundsToNewPages) {
  for (const PageLevel page : {PageLevel::kTimed, PageLevel::kNaming}) {
    Stream stream(builtinEncoders(80), page);
    stream.labels = {{.object = world::kFirstPlayerObject + 7, .place = {160.0F, 180.0F}, .opacity = 1.0F},
                     {.object = world::kFirstPlayerObject + 9, .place = {0.0F, 45.0F}, .opacity = 0.001F}};
    const auto sent = stream.push(grain(1));
    ASSERT_NE(sent, nullptr);
    const ServerMessage message = parseServerMessage(sent->message());
    const auto* read = std::get_if<PictureMessage>(&message);
    ASSERT_NE(read, nullptr);
    const std::vector<Label> labels{{.visitor = 7, .x = 32768, .y = 65535, .opacity = 255},
                                    {.visitor = 9, .x = 0, .y = 16384, .opacity = 1}};
    EXPECT_EQ(read->header.labels, page == PageLevel::kNaming ? labels : std::vector<Label>{});
    // Half of the loudness beside it, three metres away.
    EXPECT_EQ(read->header.fire, page == PageLevel::kNaming ? 128 : 0);
    H264Decoder decoder;
    EXPECT_NE(decoder.decode(read->picture), nullptr);
  }
}

// Faults: depths that pages did not ask for, or do not know; an eye that is not the camera's; a picture that does not
// begin after the depths.
TEST(EncodeStage, SendsSpacesToPagesThatMovePictures) {
  for (const PageLevel page : {PageLevel::kNaming, PageLevel::kMoving}) {
    for (const bool wanted : {false, true}) {
      Stream stream(builtinEncoders(80), page);
      Limits limits;
      limits.nearness = wanted;
      stream.control().limit(limits);
      stream.movers = {{{8, 0, 40, 180}, 1.456F, 2.0F, {0.5F, 0.25F, -1.0F}}};
      const auto sent = stream.push(grain(1));
      ASSERT_NE(sent, nullptr);
      const ServerMessage message = parseServerMessage(sent->message());
      const auto* read = std::get_if<PictureMessage>(&message);
      ASSERT_NE(read, nullptr);
      EXPECT_EQ(read->header.space.has_value(), wanted && page == PageLevel::kMoving);
      if (const auto& space = read->header.space) {
        EXPECT_EQ(space->eye, world::Pose().position);
        EXPECT_EQ(space->visitor, world::Vec3(1.0F, 2.0F, 3.0F));
        EXPECT_EQ(space->velocity, world::Vec2(4.0F, 5.0F));
        EXPECT_EQ(space->sinceInputMicroseconds, 250'000U);
        EXPECT_EQ(space->moving, (std::vector{MovingPart{8, 0, 40, 180, 146, 200, {0.5F, -1.0F}}}));
        EXPECT_EQ(decodeNearness(space->nearness, 320, 180), NearnessGrid(320, 180));
      }
      H264Decoder decoder;
      EXPECT_NE(decoder.decode(read->picture), nullptr);
    }
  }
}

}  // namespace
}  // namespace grove::stream
