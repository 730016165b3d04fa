#include <gmock/gmock.h>

#include "stream/encode/h264_stream.h"
#include "stream/load/load_visitor_fixture.h"
#include "stream/protocol/jpeg_patches.h"

namespace grove::stream {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A visitor who has agreed on grove.v1.2; `index` 0 decodes what he gets.
class VideoVisitorTest : public LoadVisitorTest {
 protected:
  VideoVisitorTest() : video_(0, plan_, decoder_), second_(1, plan_, decoder_) {
    for (LoadVisitor* visitor : {&video_, &second_}) {
      visitor->agreedOn(kSubProtocolWithVideo);
      (void)visitor->nextMessage(0.0);
      (void)visitor->nextMessage(0.0);
      visitor->receive(encode(Welcome{}), 0.0);
    }
  }
  static std::vector<std::uint8_t> picture(std::uint32_t number, std::span<const std::uint8_t> bytes, bool independent,
                                           std::uint8_t codec = kCodecH264, std::uint32_t lastInput = 0) {
    PictureHeader header;
    header.codec = codec;
    header.width = 64;
    header.height = 48;
    header.frame = number;
    header.lastInput = lastInput;
    header.independent = independent;
    std::vector<std::uint8_t> message(kPictureHeaderBytes);
    encode(header, std::span(message).first<kPictureHeaderBytes>());
    message.insert(message.end(), bytes.begin(), bytes.end());
    return message;
  }
  std::vector<std::uint8_t> h264(std::uint32_t number, bool independent) {
    return picture(number, stream_.next(100, 128, 128, static_cast<int>(number % 48), independent), independent);
  }
  static std::vector<std::uint8_t> statusOf(std::uint32_t lastInput) {
    Status status;
    status.lastInput = lastInput;
    return encode(status);
  }
  static std::vector<std::uint8_t> jpegOf(const std::vector<std::uint8_t>& frame) {
    return {frame.begin() + kFrameHeaderBytes, frame.end()};
  }
  static std::vector<std::uint8_t> patchOf(std::uint16_t left, std::uint16_t top,
                                           const std::vector<std::uint8_t>& jpeg) {
    std::vector<std::uint8_t> patch(kPatchHeaderBytes);
    encodePatchHeader(left, top, static_cast<std::uint32_t>(jpeg.size()), std::span(patch).first<kPatchHeaderBytes>());
    patch.insert(patch.end(), jpeg.begin(), jpeg.end());
    return patch;
  }
  /// What he says without being asked for input.
  static std::vector<ClientMessage> saidBy(LoadVisitor& visitor) {
    std::vector<ClientMessage> messages;
    while (visitor.hasMessage()) messages.push_back(parseClientMessage(visitor.nextMessage(1.0)));
    return messages;
  }

  H264Stream stream_{64, 48};
  LoadVisitor video_;
  LoadVisitor second_;
};

TEST_F(VideoVisitorTest, OffersItsCodecsBeforeHello) {
  LoadVisitor visitor(0, plan_, decoder_);
  visitor.agreedOn(kSubProtocolWithVideo);
  const ClientMessage first = parseClientMessage(visitor.nextMessage(0.0));
  ASSERT_TRUE(std::holds_alternative<Offer>(first));
  EXPECT_THAT(std::get<Offer>(first).codecs, ElementsAre(kCodecH264, kCodecJpegPatches, kCodecJpeg));
  EXPECT_TRUE(std::holds_alternative<Hello>(parseClientMessage(visitor.nextMessage(0.0))));
  EXPECT_FALSE(visitor.hasMessage());

  LoadVisitor older(0, plan_, decoder_);
  older.agreedOn(kSubProtocolWithWaiting);
  EXPECT_TRUE(std::holds_alternative<Hello>(parseClientMessage(older.nextMessage(0.0))));
}

// Faults: a visitor who asks for late walk and does not tell the server; one who did not, and tells it.
TEST_F(VideoVisitorTest, AsksForNearnessOfANewServerOnly) {
  LoadVisitor visitor(0, plan_, decoder_);
  visitor.agreedOn(kSubProtocolWithNearness);
  EXPECT_TRUE(std::holds_alternative<Offer>(parseClientMessage(visitor.nextMessage(0.0))));
  EXPECT_TRUE(std::holds_alternative<Hello>(parseClientMessage(visitor.nextMessage(0.0))));
  const ClientMessage limits = parseClientMessage(visitor.nextMessage(0.0));
  ASSERT_TRUE(std::holds_alternative<Limits>(limits));
  EXPECT_TRUE(std::get<Limits>(limits).nearness);
  EXPECT_TRUE(std::get<Limits>(limits).border);
  EXPECT_FALSE(visitor.hasMessage());
}

TEST_F(VideoVisitorTest, ReportsWhenEachPictureArrived) {
  video_.receive(h264(7, true), 5000.25);
  video_.receive(h264(9, false), 5000.5);
  const auto said = saidBy(video_);
  ASSERT_EQ(said.size(), 2U) << "each arrival says something about the line";
  const auto& first = std::get<Presented>(said[0]);
  EXPECT_EQ(first.frame, 7U);
  EXPECT_EQ(first.heldTenthsOfMilliseconds, 0);
  EXPECT_EQ(first.arrivedMicroseconds, static_cast<std::uint32_t>(5'000'250'000U % (1ULL << 32U)));
  EXPECT_EQ(std::get<Presented>(said[1]).frame, 9U);
  EXPECT_EQ(std::get<Presented>(said[1]).arrivedMicroseconds - first.arrivedMicroseconds, 250'000U);
  EXPECT_THAT(video_.statistics().errors, IsEmpty());
}

TEST_F(VideoVisitorTest, AcceptsAChainThatSkipsNumbers) {
  std::uint32_t number = 0;
  for (int i = 0; i < 12; ++i) {
    const auto message = h264(number += 1 + static_cast<std::uint32_t>(i % 3), i % 8 == 0);
    video_.receive(message, i);
    second_.receive(message, i);
  }
  EXPECT_THAT(video_.statistics().errors, IsEmpty());
  EXPECT_THAT(second_.statistics().errors, IsEmpty());
  EXPECT_EQ(video_.statistics().shown.at({kCodecH264, 48}), 12U);
}

TEST_F(VideoVisitorTest, RequestsAnIndependentPictureAfterAGap) {
  video_.receive(h264(1, true), 1.0);
  (void)h264(2, false);  // never comes
  video_.receive(h264(3, false), 1.1);
  EXPECT_THAT(video_.statistics().errors, ElementsAre(HasSubstr("frame 3 is damaged")));
  auto said = saidBy(video_);
  ASSERT_EQ(said.size(), 3U);
  ASSERT_TRUE(std::holds_alternative<Broken>(said[1]));
  EXPECT_EQ(std::get<Broken>(said[1]).frame, 3U);
  EXPECT_TRUE(std::holds_alternative<Presented>(said[2]));

  video_.receive(h264(4, false), 1.2);  // was under way
  video_.receive(h264(5, true), 1.3);
  video_.receive(h264(6, false), 1.4);
  EXPECT_EQ(video_.statistics().errors.size(), 1U) << "told once";
  said = saidBy(video_);
  EXPECT_EQ(said.size(), 3U);
  for (const ClientMessage& message : said) EXPECT_TRUE(std::holds_alternative<Presented>(message));
}

/// Those who do not decode look at what kind of pictures they get.
TEST_F(VideoVisitorTest, DetectsMislabelledPictures) {
  const auto faultOf = [&](const std::vector<std::vector<std::uint8_t>>& messages) {
    LoadVisitor visitor(1, plan_, decoder_);
    visitor.agreedOn(kSubProtocolWithVideo);
    (void)visitor.nextMessage(0.0);
    (void)visitor.nextMessage(0.0);
    visitor.receive(encode(Welcome{}), 0.0);
    for (const auto& message : messages) visitor.receive(message, 1.0);
    const auto& errors = visitor.statistics().errors;
    return errors.empty() ? std::string() : errors.front();
  };
  const auto first = stream_.next(100, 128, 128, 1, true);
  const auto second = stream_.next(100, 128, 128, 2);
  EXPECT_EQ(faultOf({picture(1, first, true), picture(2, second, false)}), "");
  EXPECT_THAT(faultOf({picture(1, second, false)}), HasSubstr("depends on a picture that was not sent"));
  EXPECT_THAT(faultOf({picture(1, second, true)}), HasSubstr("its slices are not"));
  EXPECT_THAT(faultOf({picture(1, first, true), picture(2, first, false)}), HasSubstr("has independent slices"));
  EXPECT_THAT(faultOf({picture(1, std::vector<std::uint8_t>{1, 2, 3}, true)}), HasSubstr("not an Annex B byte stream"));
  EXPECT_THAT(faultOf({picture(1, std::vector<std::uint8_t>{0, 0, 1, 0x65, 1}, true)}), HasSubstr("no parameters"));
  EXPECT_THAT(faultOf({picture(1, std::vector<std::uint8_t>{0, 0, 1, 0x62, 1}, true)}), HasSubstr("another kind"));
  EXPECT_THAT(
      faultOf({picture(1, first, true), picture(2, jpegOf(frame(1, 0)), true, kCodecJpeg), picture(3, second, false)}),
      HasSubstr("depends on a picture that was not sent"))
      << "the picture before it is a JPEG";
  EXPECT_THAT(faultOf({picture(1, jpegOf(frame(1, 0)), false, kCodecJpeg)}), HasSubstr("JPEG that depends"));
  const auto whole = patchOf(0, 0, jpegOf(frame(1, 0)));
  const auto patches = [&](std::uint32_t number, const std::vector<std::uint8_t>& bytes, bool independent) {
    return picture(number, bytes, independent, kCodecJpegPatches);
  };
  EXPECT_EQ(faultOf({patches(1, whole, true), patches(2, whole, false)}), "");
  EXPECT_THAT(faultOf({patches(1, whole, false)}), HasSubstr("depends on a picture that was not sent"));
  EXPECT_THAT(faultOf({patches(1, {}, true)}), HasSubstr("invalid message from the server")) << "as pages say";
  std::vector<std::uint8_t> twice = whole;
  twice.insert(twice.end(), whole.begin(), whole.end());
  EXPECT_THAT(faultOf({patches(1, twice, true)}), HasSubstr("not one JPEG"));
  EXPECT_THAT(faultOf({patches(1, whole, true), patches(2, patchOf(2, 0, jpegOf(frame(1, 0))), false)}),
              HasSubstr("a part outside"));
  EXPECT_THAT(faultOf({patches(1, whole, true), patches(2, {whole.begin(), whole.end() - 1}, false)}),
              HasSubstr("cut off"));
  EXPECT_THAT(faultOf({frame(1, 0)}), HasSubstr("a Frame arrived"));
}

TEST_F(VideoVisitorTest, SizeChangesOnlyWithAnIndependentPicture) {
  auto message = h264(2, false);
  message[6] = 40;  // the height
  second_.receive(h264(1, true), 1.0);
  second_.receive(message, 1.1);
  EXPECT_THAT(second_.statistics().errors, ElementsAre(HasSubstr("another size")));
}

TEST_F(VideoVisitorTest, StatusConfirmsTheScreen) {
  const auto input = [&](double now) {
    video_.inputDue();
    (void)video_.nextMessage(now);
  };
  video_.receive(h264(1, true), 1.0);
  (void)saidBy(video_);
  video_.beginCounting(1.0);
  input(1.1);
  input(1.2);
  video_.receive(statusOf(2), 1.5);
  const VisitorStatistics& seen = video_.statistics();
  EXPECT_THAT(seen.latencyMilliseconds, ElementsAre(testing::FloatNear(400, 0.1F), testing::FloatNear(300, 0.1F)));
  EXPECT_NEAR(seen.longestGapSeconds, 0.5, 1e-9);
  video_.receive(statusOf(2), 3.0);  // says nothing new of the screen
  video_.endCounting(3.5);
  EXPECT_NEAR(seen.longestGapSeconds, 2.0, 1e-9);
  EXPECT_THAT(seen.errors, IsEmpty());
  EXPECT_TRUE(seen.shown.empty());
  EXPECT_EQ(seen.screenAtFirst, (ShownPicture{kCodecH264, 48}));
  video_.receive(statusOf(3), 4.0);
  EXPECT_THAT(seen.errors, ElementsAre(HasSubstr("input 3, which was not sent")));
}

TEST_F(VideoVisitorTest, AcceptsOtherServerMessages) {
  video_.receive(encode(Refining{}), 1.0);
  video_.receive(encode(Waiting{}), 1.0);
  EXPECT_THAT(video_.statistics().errors, IsEmpty());
  visitor_.receive(h264(1, true), 1.0);
  EXPECT_THAT(visitor_.statistics().errors, Contains(HasSubstr("a Picture arrived")));
}

}  // namespace
}  // namespace grove::stream
