#pragma once

#include <optional>

#include "cli/bench/amortize/amortize_row.h"
#include "cli/bench/amortize/bench_amortize_run.h"
#include "cli/bench/amortize/interruption.h"

namespace grove::cli {

/// Measures a row in processes of its own: one for all visitors or, in private mode, one for each, all at the same
/// time. So no row is measured in what another one has left behind. A private visitor walks as the shared one of the
/// same number, and is alone: there is nobody else to draw. Reports on stderr how far it is. Returns nothing after a
/// signal. Throws what the measurement throws, as std::runtime_error.
[[nodiscard]] std::optional<AmortizeRow> measureRow(const world::Scene& scene, const AmortizeRun& run,
                                                    Interruption& interruption);

}  // namespace grove::cli
