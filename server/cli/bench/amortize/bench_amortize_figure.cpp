#include "cli/bench/amortize/bench_amortize_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/log.h"
#include "cli/bench/amortize/row_processes.h"

namespace grove::cli {
namespace {

constexpr int kDefaultGrid = 64;
constexpr int kLargestGrid = 128;
constexpr int kGridStep = 8;

/// The fire of the default world by night: nothing else is there.
world::Scene fluidAlone(int grid) {
  const std::string text = R"(
name = "fluid alone"
spawn = [4.6, 0, 10.4]
spawn_yaw_degrees = 24
[visitor]
type = "figure"
[[object]]
type = "fluid"
size = 12
radius = 0.32
rate = 2300
wind = [0.22, 0, -0.06]
grid = )" + std::to_string(grid) +
                           "\n";
  return world::parseScene(text, "fluid alone");
}

/// Milliseconds of a tick with one visitor; nothing if it was stopped.
std::optional<double> tickOf(int grid, Interruption& interruption) {
  const auto row = measureRow(fluidAlone(grid), {.frames = 30, .size = {160, 90}}, interruption);
  return row ? std::optional(row->tick) : std::nullopt;
}

/// The grid whose tick takes as long as the paper's, found step by step as a tick's time grows about with the number of
/// cells, but faster where caches overflow; nothing if it was stopped.
std::optional<int> gridForPapersTick(double tickOfDefault, Interruption& interruption) {
  constexpr int kSteps = 3;
  const auto error = [](double milliseconds) { return std::abs(std::log(milliseconds / kPapersTick)); };
  int grid = kDefaultGrid;
  double tick = std::max(0.1, tickOfDefault);
  std::pair nearest(error(tick), grid);
  for (int i = 0; i < kSteps; ++i) {
    const double edge = grid * std::cbrt(kPapersTick / tick);
    const int next =
        std::clamp(kGridStep * static_cast<int>(std::lround(edge / kGridStep)), 2 * kGridStep, kLargestGrid);
    if (next == grid) break;
    grid = next;
    log::info("Figure 5.6: trying grid " + std::to_string(grid));
    const auto measured = tickOf(grid, interruption);
    if (!measured) return std::nullopt;
    tick = std::max(0.1, *measured);
    nearest = std::min(nearest, {error(tick), grid});
  }
  return nearest.second;
}

/// The four columns with a grid; false if it was stopped before the last.
bool measureColumns(std::vector<FigureColumn>& figure, int grid, AmortizeRun run, Interruption& interruption) {
  constexpr std::array<std::pair<int, int>, 4> kColumns = {{{1, 100}, {4, 100}, {1, 500}, {4, 500}}};
  const world::Scene scene = fluidAlone(grid);
  for (const auto& [frontends, frames] : kColumns) {
    log::info("Figure 5.6: grid " + std::to_string(grid) + ", " + std::to_string(frames) + " frames");
    run.users = frontends;
    run.frames = frames;
    const auto row = measureRow(scene, run, interruption);
    if (!row) return false;
    const auto cost = row->costs.find("fluid");
    figure.push_back({.grid = grid,
                      .frontends = frontends,
                      .frames = frames,
                      .tick = row->tick,
                      .cost = cost != row->costs.end() ? cost->second : measure::FrameCost()});
  }
  return true;
}

}  // namespace

std::vector<FigureColumn> runFigure(PictureSize size, Interruption& interruption) {
  std::vector<FigureColumn> figure;
  // The paper counts what packing takes, and what comes before it.
  AmortizeRun run{.size = size};
  run.transport = node::TransportKind::kBytes;
  if (!measureColumns(figure, kDefaultGrid, run, interruption)) return figure;
  const auto grid = gridForPapersTick(figure.front().tick, interruption);
  if (grid && *grid != kDefaultGrid) measureColumns(figure, *grid, run, interruption);
  return figure;
}

}  // namespace grove::cli
