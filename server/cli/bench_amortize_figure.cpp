#include "cli/bench_amortize_figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "pipeline/log.h"

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

/// A tick's time grows with the number of cells.
int gridForPapersTick(double tickOfDefault) {
  const double edge = kDefaultGrid * std::cbrt(kPapersTick / std::max(0.1, tickOfDefault));
  return std::clamp(kGridStep * static_cast<int>(std::lround(edge / kGridStep)), kGridStep * 2, kLargestGrid);
}

}  // namespace

std::vector<FigureColumn> runFigure(const gl::ShaderLibrary& shaders, int width, int height,
                                    const std::stop_token& stop) {
  constexpr std::array<std::pair<int, int>, 4> kColumns = {{{1, 100}, {4, 100}, {1, 500}, {4, 500}}};
  std::vector<FigureColumn> figure;
  int grid = kDefaultGrid;
  for (int half = 0; half < 2; ++half) {
    const world::Scene scene = fluidAlone(grid);
    for (const auto& [frontends, frames] : kColumns) {
      log::info("Figure 5.6: grid " + std::to_string(grid) + ", " + std::to_string(frames) + " frames");
      const AmortizeRun run{.users = frontends, .frames = frames, .width = width, .height = height};
      const auto row = runAmortize(scene, shaders, run, stop);
      if (!row) return figure;
      const auto cost = row->costs.find("fluid");
      figure.push_back({grid, frontends, frames, cost != row->costs.end() ? cost->second : measure::FrameCost()});
    }
    grid = gridForPapersTick(figure.front().cost.acrossUser);
    if (grid == kDefaultGrid) break;
  }
  return figure;
}

}  // namespace grove::cli
