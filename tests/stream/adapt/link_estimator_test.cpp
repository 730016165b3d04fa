#include "stream/adapt/link_estimator.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stream/adapt/bottleneck.h"

namespace grove::stream {
namespace {

Bottleneck steady(double bitsPerSecond, double roundTrip) {
  return {.bitsPerSecond = [=](double) { return bitsPerSecond; }, .roundTrip = roundTrip};
}

// Faults: growth that is too slow or stops below the line's rate; no fall before frames queue.
TEST(LinkEstimator, FindsTheRateAndKeepsTheQueueShort) {
  for (const double rate : {2e6, 5e6, 20e6}) {
    for (const double roundTrip : {0.005, 0.020, 0.050}) {
      SimulatedStream stream(steady(rate, roundTrip));
      stream.runUntil(15.0);
      EXPECT_GE(stream.delivered(4.0, 5.0), 0.8 * rate) << rate << ", " << roundTrip;
      EXPECT_GE(stream.delivered(5.0, 15.0), 0.9 * rate) << rate << ", " << roundTrip;
      EXPECT_LT(stream.queued(0.0, 5.0, 0.95), 0.1) << rate << ", " << roundTrip;
      EXPECT_LT(stream.queued(5.0, 15.0, 0.95), 0.1) << rate << ", " << roundTrip;
      EXPECT_GT(stream.frameRate(5.0, 15.0), 28.0) << rate << ", " << roundTrip;
    }
  }
}

// Faults: a first guess that fills a slow line's queue for seconds.
TEST(LinkEstimator, StartDoesNotFloodASlowLine) {
  SimulatedStream stream(steady(0.6e6, 0.020));
  stream.runUntil(10.0);
  EXPECT_LT(stream.queued(0.0, 10.0, 1.0), 1.0);
  EXPECT_LT(stream.queued(2.0, 10.0, 0.95), 0.1);
  EXPECT_GE(stream.delivered(2.0, 10.0), 0.8 * 0.6e6);
}

// Fault: a window of frames under way that does not grow with the round trip, so that frames become fewer.
TEST(LinkEstimator, AllowsMoreFramesOnLongRoundTrips) {
  for (const double roundTrip : {0.080, 0.150, 0.250}) {
    SimulatedStream stream(steady(20e6, roundTrip));
    stream.setBest(6e6);
    stream.runUntil(10.0);
    EXPECT_GT(stream.frameRate(2.0, 10.0), 29.0) << roundTrip;
  }
}

// Faults: a fall that waits for acknowledgements that do not come; a window that lets frames queue meanwhile; growth
// that has not forgotten the bad time when it is over.
TEST(LinkEstimator, FollowsATenfoldDropAndRecovery) {
  constexpr double kFall = 8.0;
  constexpr double kReturn = 14.0;
  for (const double rate : {5e6, 10e6, 20e6}) {
    for (const double roundTrip : {0.020, 0.050, 0.150}) {
      Bottleneck line;
      line.roundTrip = roundTrip;
      line.bitsPerSecond = [=](double now) { return now > kFall && now < kReturn ? 0.1 * rate : rate; };
      SimulatedStream stream(line);
      stream.runUntil(kReturn + 7.0);
      // The first signs are a round trip old, and look like a queue of a good line until that would be overdue.
      const double noticed = kFall + roundTrip + 0.2;
      EXPECT_LT(stream.sent(noticed, noticed + 0.5), 0.2 * rate) << rate << ", " << roundTrip;
      EXPECT_LT(stream.queued(noticed, kReturn, 1.0), 1.0) << rate << ", " << roundTrip;
      EXPECT_LT(stream.queued(noticed + 2.0, kReturn, 0.95), 0.15) << rate << ", " << roundTrip;
      EXPECT_GE(stream.delivered(noticed + 2.0, kReturn), 0.07 * rate) << rate << ", " << roundTrip;
      EXPECT_GE(stream.delivered(kReturn + 4.0, kReturn + 5.0), 0.8 * rate) << rate << ", " << roundTrip;
    }
  }
}

// Faults: frames that are sent into a line that carries nothing; a rate that a stall has ruined for long.
TEST(LinkEstimator, SurvivesStallsOfASecond) {
  Bottleneck line;
  line.bitsPerSecond = [](double now) { return now > 6.0 && std::fmod(now, 6.0) < 1.0 ? 1e-3 : 5e6; };
  SimulatedStream stream(line);
  stream.runUntil(24.0);
  for (const double stall : {6.0, 12.0, 18.0}) {
    EXPECT_LT(stream.sent(stall + 0.3, stall + 1.0), 0.2e6) << stall;
    EXPECT_GE(stream.delivered(stall + 4.0, stall + 6.0), 0.8 * 5e6) << stall;
  }
  EXPECT_LT(stream.queued(0.0, 24.0, 1.0), 1.2);
}

// Fault: jitter that is taken for a queue, each time anew.
TEST(LinkEstimator, IgnoresJitter) {
  for (const double rate : {5e6, 20e6}) {
    for (const double jitter : {0.005, 0.010, 0.020}) {
      Bottleneck line = steady(rate, 0.030);
      line.jitter = jitter;
      SimulatedStream stream(line);
      stream.runUntil(20.0);
      EXPECT_GE(stream.delivered(5.0, 20.0), 0.6 * rate) << rate << ", " << jitter;
      EXPECT_GT(stream.frameRate(5.0, 20.0), 27.0) << rate << ", " << jitter;
    }
  }
}

/// The smallest estimate from one time to another.
double minEstimate(SimulatedStream& stream, double from, double to) {
  stream.runUntil(from);
  double smallest = stream.link().bitsPerSecond();
  while (stream.now() < to) {
    stream.runUntil(stream.now() + 0.02);
    smallest = std::min(smallest, stream.link().bitsPerSecond());
  }
  return smallest;
}

// Fault: a busy processor's hiccups that are taken for a queue of the line, until little is sent over a line that
// carries a hundred times as much.
TEST(LinkEstimator, IgnoresProcessorStalls) {
  for (const double best : {0.3e6, 5e6, 28e6}) {
    for (const double roundTrip : {0.001, 0.030, 0.150}) {
      Bottleneck line = steady(500e6, roundTrip);
      line.noticed = &noticedBetweenHiccups;
      SimulatedStream stream(line);
      stream.setBest(best);
      EXPECT_GE(minEstimate(stream, 5.0, 40.0), 1.2 * best) << best << ", " << roundTrip;
    }
  }
}

// Fault: a stream that takes little because little moves, whose estimate falls below what the line has carried before.
TEST(LinkEstimator, SmallStreamsDoNotLowerTheEstimate) {
  Bottleneck line = steady(20e6, 0.020);
  line.noticed = [](double arrival) { return arrival < 10.0 ? arrival : noticedBetweenHiccups(arrival); };
  SimulatedStream stream(line);
  stream.runUntil(10.0);
  const double before = stream.link().bitsPerSecond();
  stream.setBest(0.4e6);
  EXPECT_GE(minEstimate(stream, 10.5, 60.0), 0.9 * before);
}

// Fault: a line that gets slower than a stream that took little of it, and is never found out.
TEST(LinkEstimator, DetectsASlowdownWithASmallStream) {
  for (const double roundTrip : {0.005, 0.080}) {
    Bottleneck line;
    line.roundTrip = roundTrip;
    line.bitsPerSecond = [](double now) { return now > 8.0 ? 1e6 : 100e6; };
    SimulatedStream stream(line);
    stream.setBest(5e6);
    stream.runUntil(8.0);
    EXPECT_GT(stream.link().bitsPerSecond(), 8e6) << roundTrip;
    stream.runUntil(12.0);
    EXPECT_LT(stream.link().bitsPerSecond(), 1.3e6) << roundTrip;
    stream.runUntil(20.0);
    EXPECT_LT(stream.queued(12.0, 20.0, 0.95), 0.15) << roundTrip;
    EXPECT_GE(stream.delivered(12.0, 20.0), 0.7e6) << roundTrip;
  }
}

// Fault: a browser that decodes slowly, and so notices arrivals late, whose line is thought to be slow for it.
TEST(LinkEstimator, SeparatesBrowserFromLine) {
  Bottleneck line = steady(100e6, 0.001);
  line.noticed = [](double arrival) { return std::fmod(arrival, 0.2) < 0.02 ? arrival : arrival + 0.050; };
  SimulatedStream stream(line);
  stream.setBest(5e6);
  stream.play([](std::uint32_t, Arrival& arrival) {
    arrival.browserBusy = true;
    return 1;
  });
  EXPECT_GE(minEstimate(stream, 2.0, 20.0), 6e6);
}

// Faults: an acknowledgement that counts twice; frames that stay under way for ever because later ones came first.
TEST(LinkEstimator, ToleratesDuplicateAndMissingAcknowledgements) {
  for (const SimulatedStream::Mischief& mischief :
       {SimulatedStream::Mischief([](std::uint32_t, Arrival&) { return 2; }),
        SimulatedStream::Mischief([](std::uint32_t frame, Arrival&) { return frame % 3 == 0 ? 0 : 1; })}) {
    SimulatedStream stream(steady(5e6, 0.020));
    stream.play(mischief);
    stream.runUntil(15.0);
    EXPECT_GE(stream.delivered(5.0, 15.0), 0.8 * 5e6);
    EXPECT_LE(stream.delivered(5.0, 15.0), 1.05 * 5e6);
    EXPECT_LT(stream.queued(5.0, 15.0, 0.95), 0.12);
  }
}

// Fault: an acknowledgement of an older frame, after that of a newer one, that brings it back or counts its bytes
// again.
TEST(LinkEstimator, IgnoresAcknowledgementsOutOfOrder) {
  LinkEstimator link;
  for (const std::uint32_t frame : {1U, 2U, 3U}) link.sent(frame, 10'000, 10'000, 0.01 * frame);
  link.arrived(3, {.acknowledged = 0.06});
  EXPECT_EQ(link.framesUnderWay(), 0U);
  const double rate = link.bitsPerSecond();
  const double roundTrip = link.roundTrip();
  link.arrived(1, {.acknowledged = 0.07});
  link.arrived(3, {.acknowledged = 0.90});
  link.arrived(4'000'000'000U, {.acknowledged = 0.91});
  EXPECT_EQ(link.bitsPerSecond(), rate);
  EXPECT_EQ(link.roundTrip(), roundTrip);
  EXPECT_EQ(link.framesUnderWay(), 0U);
}

// Faults: frames sent on and on to somebody who never says that they come; a rate that falls to nothing for it.
TEST(LinkEstimator, StopsWithoutAcknowledgements) {
  SimulatedStream stream(steady(5e6, 0.020));
  stream.play([](std::uint32_t frame, Arrival&) { return frame > 100 ? 0 : 1; });
  stream.runUntil(20.0);
  EXPECT_LT(stream.frames().size(), 110U);
  EXPECT_TRUE(stream.link().isFull(stream.now(), 30.0, 0));
  EXPECT_GT(stream.link().bitsPerSecond(), 0.5e6);
}

// Faults: a jump of the page's clock that looks like a queue of that length for as long as the smallest transit is
// kept; a clock of which nonsense comes that starves the stream, or lets it flood the line.
TEST(LinkEstimator, ToleratesAnyPageClock) {
  using Clock = void (*)(std::uint32_t frame, Arrival & arrival);
  const std::pair<const char*, Clock> clocks[] = {
      {"jumps on", [](std::uint32_t frame, Arrival& a) { *a.pageSeconds += frame > 250 ? 1.0 : 0.0; }},
      {"jumps far", [](std::uint32_t frame, Arrival& a) { *a.pageSeconds += frame > 250 ? 4000.0 : 0.0; }},
      {"jumps back", [](std::uint32_t frame, Arrival& a) { *a.pageSeconds -= frame > 250 ? 100.0 : 0.0; }},
      {"runs backwards", [](std::uint32_t, Arrival& a) { *a.pageSeconds = -*a.pageSeconds; }},
      {"stands", [](std::uint32_t, Arrival& a) { a.pageSeconds = 5.0; }},
      {"is fast", [](std::uint32_t, Arrival& a) { *a.pageSeconds *= 1.01; }},
      {"is slow", [](std::uint32_t, Arrival& a) { *a.pageSeconds *= 0.99; }},
      {"is nonsense", [](std::uint32_t frame, Arrival& a) { *a.pageSeconds = (frame * 7919U) % 1000U; }},
      {"is none", [](std::uint32_t, Arrival& a) { a.pageSeconds.reset(); }},
      {"is none, and all is held", [](std::uint32_t, Arrival& a) {
         a.pageSeconds.reset();
         a.held = 6.5;
       }}};
  for (const auto& [name, clock] : clocks) {
    SimulatedStream stream(steady(5e6, 0.020));
    stream.play([clock = clock](std::uint32_t frame, Arrival& arrival) {
      clock(frame, arrival);
      return 1;
    });
    stream.runUntil(20.0);
    EXPECT_GE(stream.delivered(8.0, 11.0), 0.8 * 5e6) << name;
    EXPECT_GE(stream.delivered(10.0, 20.0), 0.8 * 5e6) << name;
    EXPECT_LT(stream.queued(10.0, 20.0, 1.0), 0.4) << name;
  }
}

}  // namespace
}  // namespace grove::stream
