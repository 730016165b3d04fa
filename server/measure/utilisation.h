#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "pipeline/timeline.h"

/// Utilisation of the pipeline, from a timeline's events: section 4.3 and Figures 4.3 and 4.4.
namespace grove::measure {

/// An interval of the monotonic clock.
struct Window {
  std::int64_t beginNanoseconds = 0;
  std::int64_t endNanoseconds = 0;

  [[nodiscard]] double seconds() const noexcept {
    return static_cast<double>(endNanoseconds - beginNanoseconds) * 1.0e-9;
  }
};

struct Use {
  std::uint64_t runs = 0;  ///< ended within the window
  double wallMillisecondsPerRun = 0.0;
  double cpuMillisecondsPerRun = 0.0;  ///< without other stages' runs within them
  double utilisation = 0.0;            ///< share of the window in which at least one run was active
};

struct StageUse {
  Use all;
  bool servesFrames = false;         ///< runs for a session, not by its own clock
  std::map<std::string, Use> types;  ///< by type of object, if the stage reports it; parts count per run of the stage
};

/// Returns the use of each stage, by its name; without runs if its events are all outside of the window.
[[nodiscard]] std::map<std::string, StageUse> stageUse(std::span<const pipeline::TimelineEvent> events,
                                                       const Window& window);

/// Returns the stage with the highest utilisation among those that serve frames, which "should be either parallelized
/// or optimized"; empty if there is none.
[[nodiscard]] std::string bottleneck(const std::map<std::string, StageUse>& stages);

/// The span of a delivered frame, from its first run's begin to the end of its encoding. The next frame may be in
/// flight by then, because the Compositor is done with this one.
struct FrameSpan {
  pipeline::TraceTag tag;
  std::int64_t beginNanoseconds = 0;
  std::int64_t endNanoseconds = 0;

  [[nodiscard]] double milliseconds() const noexcept {
    return static_cast<double>(endNanoseconds - beginNanoseconds) * 1.0e-6;
  }
};

/// Returns the frames that ended within the window, by session and number; earlier events supply their begins.
[[nodiscard]] std::vector<FrameSpan> deliveredFrames(std::span<const pipeline::TimelineEvent> events,
                                                     const Window& window);

/// Returns the mean number of frames in progress per session: by Little's law, the delivery rate times the latency.
[[nodiscard]] double overlap(std::span<const FrameSpan> frames, const Window& window, int sessions);

}  // namespace grove::measure
