#include "stream/load/load_visitor.h"

#include <gmock/gmock.h>

#include "stream/load/load_visitor_fixture.h"

namespace grove::stream {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST_F(LoadVisitorTest, LatencyIsFromInputToItsFrame) {
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
TEST_F(LoadVisitorTest, WalkDoesNotDependOnTheStartTime) {
  const auto steps = [&](double begin) {
    LoadVisitor visitor(0, plan_, decoder_);
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

TEST_F(LoadVisitorTest, ReportsBadFrames) {
  std::vector<std::uint8_t> damaged = frame(1, 0);
  damaged.resize(damaged.size() / 2);
  visitor_.receive(damaged, 1.0);
  visitor_.receive(frame(1, 0), 1.0);
  visitor_.receive(frame(2, 9), 1.0);
  visitor_.receive(std::vector<std::uint8_t>{0x99}, 1.0);
  EXPECT_THAT(visitor_.statistics().errors, ElementsAre(HasSubstr("frame 1"), HasSubstr("late or twice"),
                                                        HasSubstr("input 9"), HasSubstr("unknown message type 153")));
}

TEST_F(LoadVisitorTest, LooksOrStandsOnRequest) {
  const auto inputs = [&](Movement movement) {
    LoadPlan plan = smallPlan();
    plan.movement = movement;
    LoadVisitor visitor(0, plan, decoder_);
    (void)visitor.nextMessage(0.0);
    Welcome welcome;
    welcome.yaw = 0.5F;
    visitor.receive(encode(welcome), 0.0);
    std::vector<world::Input> result;
    for (int i = 0; i < 40; ++i) {
      visitor.inputDue();
      result.push_back(std::get<world::Input>(parseClientMessage(visitor.nextMessage(0.5 * i))));
    }
    return result;
  };
  float turned = 0.0F;
  for (const world::Input& input : inputs(Movement::kLook)) {
    EXPECT_EQ(input.keys, 0);
    turned = std::max(turned, std::abs(input.yaw - 0.5F));
  }
  EXPECT_GT(turned, 0.5F);
  std::uint32_t number = 0;
  for (const world::Input& input : inputs(Movement::kStand)) {
    EXPECT_EQ(input.number, ++number) << "latency is measured all the same";
    EXPECT_EQ(input.keys, 0);
    EXPECT_EQ(input.yaw, 0.5F);
    EXPECT_EQ(input.pitch, 0.0F);
  }
}

TEST_F(LoadVisitorTest, ReportsTheLongestGap) {
  visitor_.beginCounting(10.0);
  visitor_.receive(frame(1, 0), 10.2);
  visitor_.receive(frame(2, 0), 10.9);
  visitor_.receive(frame(3, 0), 11.0);
  EXPECT_NEAR(visitor_.statistics().longestGapSeconds, 0.7, 1e-9);
  visitor_.endCounting(12.5);
  EXPECT_NEAR(visitor_.statistics().longestGapSeconds, 1.5, 1e-9) << "up to the end";
}

}  // namespace
}  // namespace grove::stream
