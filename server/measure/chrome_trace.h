#pragma once

#include <span>
#include <string>

#include "pipeline/timeline.h"

namespace grove::measure {

/// Events that are shown as one process, from the time of the earliest of them on.
struct TraceSection {
  std::string name;
  std::span<const pipeline::TimelineEvent> events;
};

/// The sections one below the other, as JSON that Perfetto (ui.perfetto.dev) and chrome://tracing open: a row for each
/// thread, a slice for each run, arrows from run to run of a frame. Source: Google, "Trace Event Format" (2016). Any
/// thread.
[[nodiscard]] std::string chromeTrace(std::span<const TraceSection> sections);

}  // namespace grove::measure
