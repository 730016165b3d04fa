#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pipeline/timeline.h"

namespace grove::measure {

/// Events that are shown as one process.
struct TraceSection {
  std::string name;
  std::span<const pipeline::TimelineEvent> events;
};

/// How sections share the axis of time.
enum class TraceClock : std::uint8_t {
  kOfEach,  ///< each section begins at 0, and arrows stay within it
  kOfAll,   ///< the earliest event of all begins at 0, and arrows lead from section to section
};

/// The sections one below the other, as JSON that Perfetto (ui.perfetto.dev) and chrome://tracing open: a row for each
/// thread, a slice for each run, arrows from run to run of a frame. Source: Google, "Trace Event Format" (2016). Any
/// thread.
[[nodiscard]] std::string chromeTrace(std::span<const TraceSection> sections, TraceClock clock = TraceClock::kOfEach);

}  // namespace grove::measure
