#pragma once

#include <vector>

#include "cli/bench/amortize/bench_amortize_run.h"
#include "cli/bench/amortize/interruption.h"

namespace grove::cli {

/// A column of the paper's Figure 5.6: a fluid simulation alone in the world.
struct FigureColumn {
  int grid = 64;  ///< cells per edge
  int frontends = 1;
  int frames = 100;
  double tick = 0.0;        ///< ms of CPU of one step of the simulation
  measure::FrameCost cost;  ///< of the type of object "fluid" only
};

/// What a tick of the paper's own simulation took on its GPU, rounded, in milliseconds: c_i of Figure 5.6.
inline constexpr double kPapersTick = 60.0;

/// The figure's four columns with the default world's fluid, and again with the grid whose tick takes nearest to
/// the paper's here (128 at most). Only the columns that were measured before it was stopped. Throws as measureRow().
[[nodiscard]] std::vector<FigureColumn> runFigure(PictureSize size, Interruption& interruption);

}  // namespace grove::cli
