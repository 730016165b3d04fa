#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <semaphore>
#include <stop_token>
#include <thread>
#include <vector>

#include "pipeline/clocks.h"
#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

using namespace std::chrono_literals;

/// A page since v1.2, which turns on the spot so that there is something to send.
class VideoPage {
 public:
  struct Heard {
    std::vector<PictureHeader> pictures;
    std::vector<Status> statuses;
  };

  VideoPage(int port, std::vector<std::uint8_t> codecs, std::optional<Limits> limits = {})
      : websocket_(port, "Sec-WebSocket-Protocol: grove.v1.2, grove.v1.1, grove.v1\r\n") {
    if (!codecs.empty()) say(Offer{std::move(codecs)});
    if (limits) say(*limits);
    say(Hello{"Ada", 640, 360});
  }

  template <class Message>
  void say(const Message& message) {
    websocket_.send(encode(message));
  }
  void acknowledge(const PictureHeader& picture) {
    say(Presented{picture.frame, 5, static_cast<std::uint32_t>(pipeline::wallSeconds() * 1e6)});
  }
  void turn() { say(world::Input{++input_, 0, 0.1F * static_cast<float>(input_), 0.0F}); }
  [[nodiscard]] std::uint32_t lastInput() const noexcept { return input_; }

  /// Listens and acknowledges until `enough` of what was heard; false at the end of the connection, or after 20
  /// seconds.
  bool listenUntil(const std::function<bool(const Heard&)>& enough, bool turning = true) {
    Heard heard;
    const double deadline = pipeline::wallSeconds() + 20.0;
    while (!enough(heard)) {
      if (pipeline::wallSeconds() > deadline) return false;
      const auto message = websocket_.receive();
      if (!message || message->opcode != RawWebsocket::kBinary) return false;
      const ServerMessage parsed = parseServerMessage(message->bytes);
      if (const auto* refusal = std::get_if<Refusal>(&parsed)) {
        ADD_FAILURE() << refusal->reason;
        return false;
      }
      if (const auto* status = std::get_if<Status>(&parsed)) heard.statuses.push_back(*status);
      if (const auto* picture = std::get_if<PictureMessage>(&parsed)) {
        heard.pictures.push_back(picture->header);
        acknowledge(picture->header);
        if (turning) turn();
      }
    }
    return true;
  }
  [[nodiscard]] RawWebsocket& websocket() noexcept { return websocket_; }

 private:
  RawWebsocket websocket_;
  std::uint32_t input_ = 0;
};

auto pictures(std::size_t count) {
  return [count](const VideoPage::Heard& heard) { return heard.pictures.size() >= count; };
}

class VideoTest : public ServedWorld {};

TEST_F(VideoTest, UsesTheFirstSupportedCodec) {
  VideoPage page(port(), {200, kCodecH264, kCodecJpeg});
  ASSERT_TRUE(page.listenUntil([](const VideoPage::Heard& heard) {
    if (heard.pictures.size() < 5) return false;
    for (const PictureHeader& each : heard.pictures) EXPECT_EQ(each.codec, kCodecH264);
    EXPECT_TRUE(heard.pictures.front().independent);
    EXPECT_FALSE(heard.pictures.back().independent);
    return true;
  }));
  // Whoever offers nothing that the server has, or nothing at all, is sent what every page can decode.
  for (const std::vector<std::uint8_t>& codecs : {std::vector<std::uint8_t>{200}, std::vector<std::uint8_t>{}}) {
    VideoPage old(port(), codecs);
    ASSERT_TRUE(old.listenUntil([](const VideoPage::Heard& heard) {
      return !heard.pictures.empty() && heard.pictures.back().codec == kCodecJpeg;
    }));
  }
}

TEST_F(VideoTest, NewOfferChangesTheCodec) {
  VideoPage page(port(), {kCodecH264});
  ASSERT_TRUE(page.listenUntil(pictures(3)));
  page.say(Offer{{kCodecJpeg}});
  ASSERT_TRUE(page.listenUntil([](const VideoPage::Heard& heard) {
    return !heard.pictures.empty() && heard.pictures.back().codec == kCodecJpeg;
  }));
  page.say(Offer{{kCodecH264}});
  // The first of the new codec must not depend on what the old one's decoder knew.
  ASSERT_TRUE(page.listenUntil([](const VideoPage::Heard& heard) {
    if (heard.pictures.empty() || heard.pictures.back().codec != kCodecH264) return false;
    EXPECT_TRUE(heard.pictures.back().independent);
    return true;
  }));
}

TEST_F(VideoTest, BrokenPictureCausesAnIndependentOne) {
  VideoPage page(port(), {kCodecH264});
  ASSERT_TRUE(page.listenUntil(pictures(3)));
  page.say(Broken{1});
  ASSERT_TRUE(page.listenUntil(
      [](const VideoPage::Heard& heard) { return !heard.pictures.empty() && heard.pictures.back().independent; }));
}

TEST_F(VideoTest, RequestFloodMakesFewIndependentPictures) {
  VideoPage page(port(), {kCodecH264});
  ASSERT_TRUE(page.listenUntil(pictures(3)));
  const double begin = pipeline::wallSeconds();
  for (int i = 0; i < 200; ++i) page.say(Broken{1});
  int independent = 0;
  ASSERT_TRUE(page.listenUntil([&](const VideoPage::Heard& heard) {
    independent = static_cast<int>(std::ranges::count(heard.pictures, true, &PictureHeader::independent));
    return heard.pictures.size() >= 20;
  }));
  EXPECT_GE(independent, 1);
  EXPECT_LE(independent, 2 + (pipeline::wallSeconds() - begin) / 0.25);
}

TEST_F(VideoTest, PicturesCarryTheirCamera) {
  VideoPage page(port(), {kCodecJpeg});
  ASSERT_TRUE(page.listenUntil(pictures(2)));
  page.say(world::Input{1000, 0, 0.75F, -0.25F});
  ASSERT_TRUE(page.listenUntil(
      [](const VideoPage::Heard& heard) {
        if (heard.pictures.empty() || heard.pictures.back().lastInput != 1000) return false;
        const PictureHeader& header = heard.pictures.back();
        EXPECT_FLOAT_EQ(header.yaw, 0.75F);
        EXPECT_FLOAT_EQ(header.pitch, -0.25F);
        EXPECT_NEAR(header.tanHalfX / header.tanHalfY, 640.0 / 360.0, 1e-3);
        return true;
      },
      false));
}

TEST_F(VideoTest, StillViewsAreNotResent) {
  VideoPage page(port(), {kCodecH264});
  ASSERT_TRUE(page.listenUntil(pictures(1), false));
  // While it is refined, pictures come; then none, and word of the stream twice a second.
  ASSERT_TRUE(page.listenUntil([](const VideoPage::Heard& heard) { return heard.statuses.size() >= 3; }, false));
  const double begin = pipeline::wallSeconds();
  std::size_t sent = 0;
  ASSERT_TRUE(page.listenUntil(
      [&](const VideoPage::Heard& heard) {
        sent = heard.pictures.size();
        return heard.statuses.size() >= 4;
      },
      false));
  EXPECT_EQ(sent, 0U);
  EXPECT_GT(pipeline::wallSeconds() - begin, 1.0);
  // An input that changes nothing on the screen is answered all the same.
  page.say(world::Input{5000, 0, 0.0F, 0.0F});
  ASSERT_TRUE(page.listenUntil(
      [](const VideoPage::Heard& heard) {
        return (!heard.statuses.empty() && heard.statuses.back().lastInput == 5000) ||
               (!heard.pictures.empty() && heard.pictures.back().lastInput == 5000);
      },
      false));
}

TEST_F(VideoTest, HiddenPagesGetNothing) {
  VideoPage page(port(), {kCodecH264});
  ASSERT_TRUE(page.listenUntil(pictures(3)));
  page.say(Limits{.hidden = true});
  // What was under way comes before the answer to the ping; a turning page would be sent pictures after it.
  std::this_thread::sleep_for(300ms);
  page.turn();
  std::this_thread::sleep_for(300ms);
  page.websocket().send({}, RawWebsocket::kPing);
  std::vector<std::uint32_t> underWay;
  while (const auto message = page.websocket().receive()) {
    if (message->opcode != RawWebsocket::kBinary) break;
    const ServerMessage parsed = parseServerMessage(message->bytes);
    if (const auto* picture = std::get_if<PictureMessage>(&parsed)) {
      underWay.push_back(picture->header.lastInput);
      page.acknowledge(picture->header);
    }
  }
  for (const std::uint32_t input : underWay) EXPECT_LT(input, page.lastInput()) << "was drawn after it was hidden";
  page.say(Limits{});
  ASSERT_TRUE(page.listenUntil([](const VideoPage::Heard& heard) {
    if (heard.pictures.empty()) return false;
    EXPECT_TRUE(heard.pictures.front().independent) << "its decoder may be gone";
    return true;
  }));
}

TEST_F(VideoTest, RespectsLimits) {
  VideoPage page(port(), {kCodecJpeg}, Limits{.framesPerSecond = 10, .lines = 180});
  ASSERT_TRUE(page.listenUntil([](const VideoPage::Heard& heard) {
    for (const PictureHeader& each : heard.pictures) EXPECT_EQ(each.height, 180);
    return heard.pictures.size() >= 3;
  }));
  const double begin = pipeline::wallSeconds();
  ASSERT_TRUE(page.listenUntil(pictures(10)));
  EXPECT_GT(pipeline::wallSeconds() - begin, 0.8);
  page.say(Limits{});
  ASSERT_TRUE(page.listenUntil(
      [](const VideoPage::Heard& heard) { return !heard.pictures.empty() && heard.pictures.back().height == 360; }));
}

/// Takes most of a host's processors.
class OtherWork {
 public:
  explicit OtherWork(Host& host) {
    for (int i = 0; i < host.workers().width(); ++i) {
      threads_.emplace_back([&workers = host.workers()](const std::stop_token& stop) {
        while (!stop.stop_requested()) {
          std::binary_semaphore done(0);
          workers.post([&] {
            for (const double end = pipeline::wallSeconds() + 0.100; pipeline::wallSeconds() < end;) {
            }
            done.release();
          });
          done.acquire();
          std::this_thread::sleep_for(5ms);
        }
      });
    }
  }

 private:
  std::vector<std::jthread> threads_;
};

// Faults: a busy machine whose visitors lose frames and keep their size; one visitor who pays for the other; a machine
// that is taken for a slow line; pictures that stay small when the machine has time again.
TEST_F(VideoTest, BusyMachineShrinksPicturesTemporarily) {
  VideoPage first(port(), {kCodecJpeg});
  VideoPage second(port(), {kCodecJpeg});
  const auto bothUntil = [&](const std::function<bool(const Status&)>& holds) {
    const auto enough = [&](const VideoPage::Heard& heard) {
      return !heard.statuses.empty() && holds(heard.statuses.back());
    };
    bool secondHeard = false;
    std::jthread other([&] { secondHeard = second.listenUntil(enough); });
    const bool firstHeard = first.listenUntil(enough);
    other.join();
    return firstHeard && secondHeard;
  };
  {
    const OtherWork work(host_);
    EXPECT_TRUE(bothUntil([](const Status& status) {
      EXPECT_NE(status.limitedBy, LimitedBy::kLine);
      return status.height == 180 && status.limitedBy == LimitedBy::kMachine;
    }));
  }
  EXPECT_TRUE(bothUntil([](const Status& status) { return status.height > 180; }));
}

TEST_F(VideoTest, RefusesVideoMessagesOfOlderPages) {
  for (const auto& message : {encode(Offer{{kCodecH264}}), encode(Limits{}), encode(Broken{1}), encode(Presented{})}) {
    GoodClient old(port());
    ASSERT_TRUE(old.receiveFrames(1));
    old.websocket().send(message);
    const auto close = old.websocket().receiveClose();
    ASSERT_TRUE(close);
    EXPECT_EQ(close->code, 4000);
  }
}

TEST_F(VideoTest, RefusesPresentationOfUnsentFrames) {
  VideoPage page(port(), {kCodecH264});
  ASSERT_TRUE(page.listenUntil(pictures(1)));
  page.say(Presented{4'000'000'000U, 0, 0});
  const auto close = page.websocket().receiveClose();
  ASSERT_TRUE(close);
  EXPECT_EQ(close->code, 4000);
}

}  // namespace
}  // namespace grove::stream
