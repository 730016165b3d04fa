#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "pipeline/timeline.h"

/// How well the pipeline is used, of a timeline's events: section 4.3 and Figures 4.3 and 4.4.
namespace grove::measure {

/// A while of the monotonic clock.
struct Window {
  std::int64_t beginNanoseconds = 0;
  std::int64_t endNanoseconds = 0;

  [[nodiscard]] double seconds() const noexcept {
    return static_cast<double>(endNanoseconds - beginNanoseconds) * 1.0e-9;
  }
};

struct Use {
  std::uint64_t runs = 0;  ///< that ended within the window
  double wallMillisecondsPerRun = 0.0;
  double cpuMillisecondsPerRun = 0.0;  ///< less what work of other stages within it has used
  double utilisation = 0.0;            ///< share of the window in which at least one run was active
};

struct StageUse {
  Use all;
  bool servesFrames = false;  ///< of a session, and not a clock of its own
  std::map<std::string, Use>
      types;  ///< by type of object, where the stage says it; parts count by the run of the stage
};

/// By name of stage.
[[nodiscard]] std::map<std::string, StageUse> stageUse(std::span<const pipeline::TimelineEvent> events,
                                                       const Window& window);

/// The stage with the highest utilisation of those that serve frames, "and should be either parallelized or optimized";
/// empty if there is none.
[[nodiscard]] std::string bottleneck(const std::map<std::string, StageUse>& stages);

/// A frame that was delivered: from its first run's begin to the end of its encoding. By then the next one may be in
/// flight, as the Compositor has done with this one.
struct FrameSpan {
  pipeline::TraceTag tag;
  std::int64_t beginNanoseconds = 0;
  std::int64_t endNanoseconds = 0;

  [[nodiscard]] double milliseconds() const noexcept {
    return static_cast<double>(endNanoseconds - beginNanoseconds) * 1.0e-6;
  }
};

/// Those that ended within the window, by session and number; the events from before it say when they began.
[[nodiscard]] std::vector<FrameSpan> deliveredFrames(std::span<const pipeline::TimelineEvent> events,
                                                     const Window& window);

/// Mean number of delivered frames of one session that are in progress at a time: by Little's law, how many come in a
/// second times how long one takes.
[[nodiscard]] double overlap(std::span<const FrameSpan> frames, const Window& window, int sessions);

}  // namespace grove::measure
