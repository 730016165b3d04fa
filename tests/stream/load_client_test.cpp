#include "stream/load_client.h"

#include <gmock/gmock.h>

#include <tuple>

#include "stream/load_visitor.h"
#include "stream/served_world.h"

namespace grove::stream {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using LoadClientTest = ServedWorld;

TEST_F(LoadClientTest, MeasuresRealSessions) {
  const LoadReport report = runLoadClients({"127.0.0.1", port()}, 2, 1.0, 320, 180);
  EXPECT_EQ(report.sessions, 2);
  EXPECT_THAT(report.errors, IsEmpty());
  EXPECT_GT(report.frames, 2U);
  EXPECT_GT(report.fpsMin, 0.0);
  EXPECT_GE(report.fpsP50, report.fpsMin);
  EXPECT_GT(report.latencyP50Milliseconds, 0.0);
  EXPECT_GE(report.latencyP99Milliseconds, report.latencyP50Milliseconds);
  EXPECT_GT(report.mbitPerSecond, 0.0);
  EXPECT_TRUE(becomesEmpty());
}

TEST_F(LoadClientTest, CountsThoseThatFindNoPlace) {
  const LoadReport report = runLoadClients({"127.0.0.1", port()}, kMostVisitors + 2, 0.3, 320, 180);
  EXPECT_EQ(report.sessions, kMostVisitors);
  EXPECT_EQ(report.errors.size(), 2U);
  EXPECT_THAT(report.errors, Contains(HasSubstr("4002")));
}

TEST_F(LoadClientTest, SaysWhyNobodyCouldConnect) {
  server_.stop();
  const LoadReport report = runLoadClients({"127.0.0.1", port()}, 2, 0.3, 320, 180);
  EXPECT_EQ(report.sessions, 0);
  ASSERT_EQ(report.errors.size(), 2U);
  EXPECT_FALSE(report.errors.front().empty());
}

TEST(LoadUrl, IsReadOrRefused) {
  const auto target = parseLoadUrl("ws://127.0.0.1:8099/");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->host, "127.0.0.1");
  EXPECT_EQ(target->port, 8099);
  EXPECT_EQ(parseLoadUrl("ws://grove.example")->port, 80);
  EXPECT_EQ(parseLoadUrl("ws://[::1]:9")->host, "::1");
  EXPECT_FALSE(target->isSecure);
  EXPECT_TRUE(parseLoadUrl("wss://grove.example:8443/")->isSecure);
  EXPECT_EQ(parseLoadUrl("wss://grove.example")->port, 443);
  for (const char* bad : {"", "http://x/", "ws://", "ws://x:", "ws://x:0/", "ws://x:70000", "ws://x:1a", "ws://x/path",
                          "wss://", "wsss://x"}) {
    EXPECT_FALSE(parseLoadUrl(bad)) << bad;
  }
}

TEST(Percentile, IsTheNearestRank) {
  EXPECT_EQ(percentile({}, 0.5), 0.0);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.5), 2.0);
  EXPECT_EQ(percentile({4, 1, 3, 2}, 0.99), 4.0);
  EXPECT_EQ(percentile({5}, 0.0), 5.0);
}

class LoadVisitorTest : public testing::Test {
 protected:
  LoadVisitorTest() : visitor_(0, 64, 48, decoder_) {
    std::ignore = visitor_.nextMessage(0.0);
    visitor_.receive(encode(Welcome{}), 0.0);
  }
  static std::vector<std::uint8_t> frame(std::uint32_t number, std::uint32_t lastInput) {
    std::vector<std::uint32_t> pixels(std::size_t{64} * 48, 0xFF808080U);
    node::Image image;
    image.rect = {0, 0, 64, 48};
    image.colour = pixels;
    std::vector<std::uint8_t> bytes(kFrameHeaderBytes);
    FrameHeader header;
    header.width = 64;
    header.height = 48;
    header.frame = number;
    header.lastInput = lastInput;
    encode(header, std::span(bytes).first<kFrameHeaderBytes>());
    JpegEncoder(80).encode(image, bytes);
    return bytes;
  }
  void sendInput(double now) {
    visitor_.inputDue();
    const ClientMessage message = parseClientMessage(visitor_.nextMessage(now));
    EXPECT_TRUE(std::holds_alternative<world::Input>(message));
  }

  JpegDecoder decoder_;
  LoadVisitor visitor_;
};

TEST_F(LoadVisitorTest, MeasuresFromEachInputToTheFirstFrameThatShowsIt) {
  sendInput(1.000);
  sendInput(1.016);
  visitor_.receive(frame(1, 0), 1.020);
  visitor_.receive(frame(2, 1), 1.050);
  visitor_.receive(frame(5, 2), 1.096);
  const VisitorStatistics& seen = visitor_.statistics();
  ASSERT_EQ(seen.latencyMilliseconds.size(), 2U);
  EXPECT_NEAR(seen.latencyMilliseconds[0], 50.0F, 0.01F);
  EXPECT_NEAR(seen.latencyMilliseconds[1], 80.0F, 0.01F);
  EXPECT_EQ(seen.dropped, 2U);
  EXPECT_THAT(seen.errors, IsEmpty());
}

/// Or one measurement would walk among trees and the next one on the meadow.
TEST_F(LoadVisitorTest, WalksTheSameWayWheneverItBegins) {
  const auto steps = [&](double begin) {
    LoadVisitor visitor(0, 64, 48, decoder_);
    (void)visitor.nextMessage(begin);
    visitor.receive(encode(Welcome{}), begin);
    std::vector<world::Input> inputs;
    for (int i = 0; i < 40; ++i) {
      visitor.inputDue();
      const auto message = parseClientMessage(visitor.nextMessage(begin + 0.5 * i));
      inputs.push_back(std::get<world::Input>(message));
    }
    return inputs;
  };
  const auto first = steps(100.0);
  const auto second = steps(7777.25);
  bool walks = false;
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].keys, second[i].keys);
    EXPECT_NEAR(first[i].yaw, second[i].yaw, 1e-5F);
    walks = walks || first[i].keys != 0;
  }
  EXPECT_TRUE(walks);
}

TEST_F(LoadVisitorTest, AcknowledgesBeforeItSteers) {
  visitor_.receive(frame(3, 0), 1.0);
  visitor_.inputDue();
  const ClientMessage first = parseClientMessage(visitor_.nextMessage(1.0));
  ASSERT_TRUE(std::holds_alternative<Ack>(first));
  EXPECT_EQ(std::get<Ack>(first).frame, 3U);
  EXPECT_TRUE(std::holds_alternative<world::Input>(parseClientMessage(visitor_.nextMessage(1.0))));
  EXPECT_FALSE(visitor_.hasMessage());
}

TEST_F(LoadVisitorTest, TellsBadFrames) {
  std::vector<std::uint8_t> damaged = frame(1, 0);
  damaged.resize(damaged.size() / 2);
  visitor_.receive(damaged, 1.0);
  visitor_.receive(frame(1, 0), 1.0);
  visitor_.receive(frame(2, 9), 1.0);
  visitor_.receive(std::vector<std::uint8_t>{0x99}, 1.0);
  EXPECT_THAT(visitor_.statistics().errors, ElementsAre(HasSubstr("frame 1"), HasSubstr("late or twice"),
                                                        HasSubstr("input 9"), HasSubstr("unknown message type 153")));
}

}  // namespace
}  // namespace grove::stream
