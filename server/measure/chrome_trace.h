#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "pipeline/timeline.h"

namespace grove::measure {

/// Events shown as one process.
struct TraceSection {
  std::string name;
  std::span<const pipeline::TimelineEvent> events;
};

/// How sections share the time axis.
enum class TraceClock : std::uint8_t {
  kOfEach,  ///< each section begins at 0; arrows stay within a section
  kOfAll,   ///< the earliest event of all begins at 0; arrows connect sections
};

/// Returns the sections, one below the other, as JSON for Perfetto (ui.perfetto.dev) and chrome://tracing: a row per
/// thread, a slice per run, arrows from run to run of a frame. Source: Google, "Trace Event Format" (2016). Any thread.
[[nodiscard]] std::string chromeTrace(std::span<const TraceSection> sections, TraceClock clock = TraceClock::kOfEach);

}  // namespace grove::measure
