#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include "integration/picture.h"
#include "integration/served_scene.h"
#include "measure/chrome_trace.h"
#include "measure/trace_faults.h"
#include "stream/session/headless_session.h"

namespace grove::integration {
namespace {

using pipeline::TimelineEvent;

const std::string kSmallFire = R"(
name = "test clearing"
spawn = [0, 0, 9]
[[object]]
type = "mesh"
shape = "stone"
position = [-3, 0, 0]
[[object]]
type = "fluid"
grid = 16
size = 8
)";

stream::HostOptions inFlight(int frames) {
  stream::HostOptions options;
  options.framesInFlight = frames;
  options.framesPerSecond = 1000;  // the clock is to be no limit
  return options;
}

/// The most frames of a visitor that are in flight at a time. A frame is until its composition begins, the last of its
/// runs before the encoding. Begins alone are looked at: a thread may be put to sleep after the last deed of its run,
/// so that the run ends, for the timeline, when the next frame is long under way.
int maxInFlight(const std::vector<TimelineEvent>& events) {
  struct Span {
    std::int64_t first = std::numeric_limits<std::int64_t>::max();
    std::int64_t last = 0;
  };
  std::map<std::uint32_t, Span> frames;
  for (const TimelineEvent& event : events) {
    if (event.tag.session == 0 || std::string_view(event.stage) == "Encoder") continue;
    Span& frame = frames[event.tag.frame];
    frame.first = std::min(frame.first, event.beginNanoseconds);
    frame.last = std::max(frame.last, event.beginNanoseconds);
  }
  std::vector<std::pair<std::int64_t, int>> changes;
  for (const auto& [number, frame] : frames) {
    changes.emplace_back(frame.first, 1);
    changes.emplace_back(frame.last, -1);
  }
  std::ranges::sort(changes);
  int now = 0;
  int max = 0;
  for (const auto& [time, change] : changes) max = std::max(max, now += change);
  return max;
}

TEST(FramesInFlight, OneAtATime) {
  ServedScene served(kSmallFire, inFlight(1));
  stream::HeadlessSession visitor(served.host, "a", 640, 360);
  ASSERT_TRUE(visitor.frameAfter(100, kPatience));
  EXPECT_EQ(maxInFlight(served.host.timeline().events()), 1);
}

TEST(FramesInFlight, FourOverlap) {
  ServedScene served(kSmallFire, inFlight(4));
  stream::HeadlessSession visitor(served.host, "a", 1920, 1080);
  int max = 0;
  for (node::FrameNumber seen = 0; max < 2;) {
    const auto frame = visitor.frameAfter(seen, kPatience);
    ASSERT_TRUE(frame);
    ASSERT_LT(seen, 1000U) << "one after the other, all of them";
    seen = frame->header.frame;
    max = maxInFlight(served.host.timeline().events());
  }
  EXPECT_LE(max, 4);
}

TEST(FramesInFlight, TraceOfARealServerIsSound) {
  ServedScene served(kSmallFire, inFlight(4));
  stream::HeadlessSession a(served.host, "a", 320, 180);
  stream::HeadlessSession b(served.host, "b", 320, 180);
  ASSERT_TRUE(a.frameAfter(50, kPatience));
  ASSERT_TRUE(b.frameAfter(50, kPatience));
  const auto events = served.host.timeline().events();
  const measure::TraceSection section{"test", events};
  const auto document = nlohmann::json::parse(measure::chromeTrace({&section, 1}));
  EXPECT_EQ(measure::traceFault(document), "");
  const auto& entries = document.at("traceEvents");
  const auto flows = std::ranges::count_if(entries, [](const auto& entry) { return entry.at("ph") == "f"; });
  EXPECT_GE(flows, 100) << "a flow for each frame";
  EXPECT_TRUE(std::ranges::any_of(entries, [](const auto& entry) { return entry.at("name") == "Compositor: fluid"; }));
}

TEST(FramesInFlight, TimelineKeepsTheRequestedRuns) {
  stream::HostOptions options = inFlight(1);
  options.timelineEvents = 64;
  ServedScene served(kSmallFire, options);
  stream::HeadlessSession visitor(served.host, "a", 160, 90);
  ASSERT_TRUE(visitor.frameAfter(30, kPatience));
  // The server goes on, and what it overwrites while it is read is left out.
  std::size_t kept = 0;
  for (int reading = 0; reading < 1000 && kept < 64; ++reading) {
    kept = served.host.timeline().events().size();
    ASSERT_LE(kept, 64U);
  }
  EXPECT_EQ(kept, 64U);
}

}  // namespace
}  // namespace grove::integration
