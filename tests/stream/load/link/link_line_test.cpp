#include "stream/load/link/link_line.h"

#include <gtest/gtest.h>

#include "stream/load/link/counting_bytes.h"

namespace grove::stream {
namespace {

using namespace std::chrono_literals;

LinkSchedule steady(double bitsPerSecond) { return {{{0ns, bitsPerSecond}}, 0ns, 0ns}; }

/// Fetches all that has arrived.
std::vector<std::uint8_t> fetchAll(LinkLine& line, LinkTime now) {
  std::vector<std::uint8_t> all;
  for (auto bytes = line.arrived(now); !bytes.empty(); bytes = line.arrived(now)) {
    all.insert(all.end(), bytes.begin(), bytes.end());
    line.fetched(bytes.size());
  }
  return all;
}

TEST(LinkSchedule, ChangesItsRateWithinAPacket) {
  const LinkSchedule schedule({{0s, 8e6}, {1s, 8e3}, {3s, 8e6}}, 0ns, 0ns);
  EXPECT_EQ(schedule.finish(0s, 8e6), 1s);
  EXPECT_EQ(schedule.finish(500ms, 4e6 + 8e3), 2s);
  EXPECT_EQ(schedule.finish(900ms, 8e5 + 16e3 + 8e6), 4s);
  EXPECT_EQ(schedule.finish(1h, 8e6), 1h + 1s);
}

TEST(LinkSchedule, StallsAtTheEndOfEachPeriod) {
  const LinkSchedule schedule({{0s, 8e6}}, 1s, 10s);
  EXPECT_EQ(schedule.finish(0s, 8e6 * 9), 9s);
  EXPECT_EQ(schedule.finish(0s, 8e6 * 9 + 8e3), 10s + 1ms);
  EXPECT_EQ(schedule.finish(9500ms, 8e3), 10s + 1ms);
  EXPECT_EQ(schedule.finish(10s, 8e6 * 19), 31s) << "two stalls in between";
}

TEST(LinkLine, DelayIsPropagationPlusTransmission) {
  LinkLine line(steady(12e6), 40ms, 0ns, 1);  // 1500 bytes a millisecond
  line.put(counting(3000), 5ms);
  EXPECT_TRUE(line.arrived(46ms - 1ns).empty());
  EXPECT_EQ(line.nextArrival(), 46ms);
  EXPECT_EQ(fetchAll(line, 46ms).size(), 1500U);
  EXPECT_EQ(line.nextArrival(), 47ms);
  EXPECT_EQ(fetchAll(line, 47ms).size(), 1500U);
  EXPECT_FALSE(line.nextArrival());
  line.put(counting(15), 100ms);
  EXPECT_EQ(line.nextArrival(), 140ms + 10us) << "an idle line has forgotten what was before";
}

TEST(LinkLine, RateHoldsForAnySender) {
  for (const double rate : {1e5, 2e6, 5e6, 2e7, 1e9}) {
    LinkLine line(steady(rate), 100ms, 0ns, 1);
    const LinkTime until = rate < 1e6 ? 60s : 4s;
    std::size_t arrived = 0;
    std::size_t atSecond = 0;
    for (LinkTime now = 0ns; now < until; now += 1ms) {
      if (const std::size_t room = line.room(now); room > 0) line.put(counting(room), now);
      arrived += fetchAll(line, now).size();
      if (now == 1s) atSecond = arrived;
    }
    const double seconds = std::chrono::duration<double>(until - 1s).count();
    EXPECT_NEAR(static_cast<double>(arrived - atSecond) * 8.0 / seconds, rate, rate * 0.02) << rate;
  }
}

TEST(LinkLine, CapacityIsQueuePlusFlight) {
  for (const double rate : {1e5, 5e6, 1e8, 1e10}) {
    LinkLine line(steady(rate), 100ms, 50ms, 1);
    std::size_t max = 0;
    for (LinkTime now = 0ns; now < 20s; now += 10ms) {  // nobody fetches
      for (std::size_t room = line.room(now); room > 0; room = line.room(now)) {
        line.put(counting(std::min<std::size_t>(room, 60'000)), now);
      }
      max = std::max(max, line.bytes());
    }
    const double bound = std::min(rate / 8.0 * 0.4 + 2.0 * 65'536, 64.0 * 1024 * 1024);
    EXPECT_LE(static_cast<double>(max), bound) << rate;
    EXPECT_EQ(line.room(20s), 0U) << rate;
    EXPECT_EQ(fetchAll(line, 1h).size(), max) << rate;
    EXPECT_GT(line.room(1h), 0U) << rate;
  }
}

/// Or a bufferbloat of the kernel's making, seconds of it, would be measured for one of 250 ms.
TEST(LinkLine, QueuesAQuarterOfASecond) {
  LinkLine line(steady(8e6), 0ns, 0ns, 1);
  EXPECT_EQ(line.room(0ns), 250'000U);
  line.put(counting(250'000), 0ns);
  EXPECT_EQ(line.room(0ns), 0U);
  ASSERT_TRUE(line.nextRoom());
  EXPECT_EQ(*line.nextRoom(), 1500us);
  EXPECT_EQ(line.room(1500us), 1500U) << "what has left the bottleneck is not in its queue";
  EXPECT_EQ(fetchAll(line, 250ms).size(), 250'000U);
  EXPECT_EQ(LinkLine(steady(1e5), 0ns, 0ns, 1).room(0ns), 65'536U);
}

TEST(LinkLine, NeverReorders) {
  LinkLine line(steady(5e6), 20ms, 30ms, 3);
  std::size_t put = 0;
  std::vector<std::uint8_t> got;
  LinkTime min = 1h;
  LinkTime max = 0ns;
  for (LinkTime now = 0ns; now < 10s; now += 7ms) {
    line.put(counting(100, put), now);
    put += 100;
    const LinkTime delay = *line.nextArrival() - now - 160us;
    const auto arrived = fetchAll(line, now + 1h);
    EXPECT_EQ(arrived.size(), 100U);
    got.insert(got.end(), arrived.begin(), arrived.end());
    min = std::min(min, delay);
    max = std::max(max, delay);
  }
  EXPECT_EQ(got, counting(put));
  EXPECT_LT(min, 22ms);
  EXPECT_GT(max, 45ms);
  EXPECT_LE(max, 50ms);
}

TEST(LinkLine, JitterIsDeterministic) {
  const auto delays = [](std::uint64_t seed) {
    LinkLine line(steady(5e6), 0ns, 30ms, seed);
    std::vector<LinkTime> result;
    for (LinkTime now = 0ns; now < 2s; now += 50ms) {
      line.put(counting(10), now);
      result.push_back(*line.nextArrival() - now);
      fetchAll(line, now + 40ms);
    }
    return result;
  };
  EXPECT_EQ(delays(5), delays(5));
  EXPECT_NE(delays(5), delays(6));
}

TEST(LinkLine, EndsAfterTheLastByte) {
  LinkLine line(steady(12e6), 40ms, 0ns, 1);
  line.put(counting(1500), 0ns);
  line.end(500us);
  EXPECT_FALSE(line.isOver(10s)) << "nobody has fetched it";
  EXPECT_EQ(fetchAll(line, 41ms).size(), 1500U);
  EXPECT_TRUE(line.isOver(41ms));
  LinkLine idle(steady(12e6), 40ms, 0ns, 1);
  idle.end(1s);
  EXPECT_FALSE(idle.isOver(1039ms));
  EXPECT_EQ(idle.nextArrival(), 1040ms);
  EXPECT_TRUE(idle.isOver(1040ms));
}

TEST(LinkLine, PartialReads) {
  LinkLine line(steady(1e9), 0ns, 0ns, 1);
  line.put(counting(5000), 0ns);
  std::vector<std::uint8_t> got;
  while (!line.arrived(1s).empty()) {
    const auto bytes = line.arrived(1s);
    const auto part = bytes.first(std::min<std::size_t>(bytes.size(), 700));
    got.insert(got.end(), part.begin(), part.end());
    line.fetched(part.size());
  }
  EXPECT_EQ(got, counting(5000));
  EXPECT_EQ(line.bytes(), 0U);
}

}  // namespace
}  // namespace grove::stream
