#include "cli/bench/fluid/bench_fluid_solvers.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "measure/processor.h"
#include "measure/svg_plot.h"
#include "models/plants/plants.h"
#include "objects/fluid/backend/solver/diagnostics.h"
#include "objects/fluid/backend/solver/pressure/conjugate_gradients.h"
#include "objects/fluid/backend/solver/pressure/multigrid.h"
#include "objects/fluid/backend/solver/pressure/pressure_solver.h"
#include "objects/fluid/backend/solver/pressure/projection.h"
#include "objects/fluid/backend/solver/pressure/red_black.h"
#include "pipeline/clocks.h"
#include "world/rays/ray_scene.h"
#include "world/rays/voxelizer.h"

namespace grove::cli {
namespace {

namespace fluid = objects::fluid;
using fluid::Field;
using fluid::Layout;
using fluid::SolidGrid;

constexpr double kExact = 1.0e-6;            // relative residual, about the accuracy of floats
constexpr double kMaxCpuMsPerCell = 6.0e-4;  // time limit of a solver

struct Point {
  int iterations = 0;
  double cpuMs = 0.0;
  double residual = 0.0;
};

struct Case {
  std::string name;
  std::vector<std::uint8_t> solid;
};

std::vector<std::uint8_t> cellsWhere(int n, const std::function<bool(int, int, int)>& isSolid) {
  std::vector<std::uint8_t> solid;
  solid.reserve(static_cast<std::size_t>(n) * n * n);
  fluid::CellBox::whole(n).forEach([&](int x, int y, int z) { solid.push_back(isSolid(x, y, z) ? 1 : 0); });
  return solid;
}

/// The wood of an oak that fills the cube.
std::vector<std::uint8_t> tree(int n) {
  const models::Model oak = models::makePlant("oak", 1, models::Detail::kSmall);
  world::Triangles wood;
  wood.positions = oak.triangles.positions;
  float tallest = 0.0F;
  for (const world::Vec3& position : wood.positions) tallest = std::max(tallest, position.y);
  for (std::size_t i = 0; i < oak.triangles.indices.size(); ++i) {
    if (oak.materials[oak.materialOf[i]].solid) wood.indices.push_back(oak.triangles.indices[i]);
  }
  const float size = 1.1F * tallest;
  return world::voxelize(world::RayScene(wood), {{-0.5F * size, 0.0F, -0.5F * size}, size, n});
}

std::vector<Case> cases(int n) {
  const auto ball = [n](int x, int y, int z) {
    const int c = n / 2;
    return (x - c) * (x - c) + (y - c) * (y - c) + (z - c) * (z - c) < n * n / 25;
  };
  const auto wall = [n](int x, int y, int z) { return x == n / 2 && y < n * 3 / 4 && z > n / 8 && z < n - n / 8; };
  return {{"empty box", cellsWhere(n, [](int, int, int) { return false; })},
          {"sphere", cellsWhere(n, ball)},
          {"voxelised tree", tree(n)},
          {"one-cell wall", cellsWhere(n, wall)}};
}

/// Minus the divergence of a hot jet, a wind against the solids, and vortices of several sizes: the right-hand side of
/// the pressure equation.
Field rightHandSide(const SolidGrid& solids) {
  const Layout& layout = solids.layout();
  const int n = layout.cells;
  fluid::Velocity velocity(layout);
  fluid::CellBox::whole(n).forEach([&](int x, int y, int z) {
    const float fx = static_cast<float>(x) / static_cast<float>(n);
    const float fy = static_cast<float>(y) / static_cast<float>(n);
    const float fz = static_cast<float>(z) / static_cast<float>(n);
    const float aside = (fx - 0.45F) * (fx - 0.45F) + (fz - 0.55F) * (fz - 0.55F);
    const std::ptrdiff_t i = layout.index(x, y, z);
    velocity.x[i] = 0.5F + 0.3F * std::sin(19.0F * fx + 11.0F * fy);
    velocity.y[i] = 3.0F * std::exp(-150.0F * aside) * (1.0F - fy) + 0.2F * std::sin(31.0F * fy - 7.0F * fz);
    velocity.z[i] = -0.3F + 0.3F * std::sin(47.0F * fz + 5.0F * fx);
  });
  solids.enforce(velocity);
  fluid::Array<std::uint8_t> air(layout.size());
  for (std::size_t i = 0; i < layout.size(); ++i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    air[at] = solids.air()[at];
  }
  Field b(layout.size());
  fluid::Team alone(1);
  static_cast<void>(fluid::negativeDivergence(layout, velocity, air, b, alone));
  return b;
}

/// A solver: starts from zero, runs a number of iterations, and returns its pressure.
struct Solver {
  std::string name;
  std::function<void(int iterations)> solve;
  std::function<const Field&()> pressure;
};

/// Solvers of one case; it must outlive them.
class Solvers {
 public:
  explicit Solvers(const std::vector<std::uint8_t>& solid, int n)
      : layout_(n),
        solids_(layout_, fluid::Sides::outdoors()),
        ours_(layout_),
        multigrid_(layout_),
        gradients_(layout_),
        x_(layout_.size()),
        b_(layout_.size()) {
    solids_.setStatic(solid);
    b_ = rightHandSide(solids_);
    pockets_.find(solids_);
    ours_.solve(solids_, b_, {0.5F, 1});  // takes over the solids, and removes from b what no pressure can satisfy
    multigrid_.rebuild(solids_, fluid::CellBox::whole(n));
  }

  [[nodiscard]] std::vector<Solver> all() {
    const auto own = [this]() -> const Field& { return x_; };
    const auto gradients = [this](int iterations, const fluid::ConjugateGradients::Preconditioner& preconditioner) {
      x_.clear();
      int done = 0;
      gradients_.solve(multigrid_.finest(), pockets_, preconditioner, b_, x_, 0.0, iterations, done);
    };
    return {{"multigrid cycles (ours)",
             [this](int iterations) {
               ours_.forget();
               ours_.solve(solids_, b_, {0.0F, iterations});
             },
             [this]() -> const Field& { return ours_.pressure(); }},
            {"multigrid-preconditioned CG",
             [this, gradients](int iterations) {
               gradients(iterations,
                         [this](const Field& r, Field& z, Field& az) { return multigrid_.apply(r, z, az); });
             },
             own},
            {"diagonally preconditioned CG",
             [this, gradients](int iterations) {
               gradients(iterations, [this](const Field& r, Field& z, Field& az) {
                 return fluid::applyDiagonal(layout_, multigrid_.finest(), r, z, az);
               });
             },
             own},
            {"red-black over-relaxation",
             [this](int iterations) {
               x_.clear();
               for (int i = 0; i < iterations; ++i) {
                 fluid::sweepRedBlack(layout_, multigrid_.finest(), b_, x_);
               }
             },
             own}};
  }

  [[nodiscard]] double residual(const Field& pressure) const { return fluid::relativeResidual(solids_, pressure, b_); }

 private:
  const Layout layout_;
  SolidGrid solids_;
  fluid::PressureSolver ours_;
  fluid::Multigrid multigrid_;
  fluid::Pockets pockets_;
  fluid::ConjugateGradients gradients_;
  Field x_;
  Field b_;
};

/// Runs until the residual is as small as floats allow, stops falling, or takes too long.
std::vector<Point> curve(const Solver& solver, const Solvers& solvers, double maxCpuMs) {
  constexpr int kRepeats = 3;
  std::vector<Point> points;
  for (int iterations = 1; iterations <= 4096; iterations += std::max(1, iterations / 3)) {
    Point point{iterations, 1.0e30, 0.0};
    for (int i = 0; i < kRepeats; ++i) {
      const std::int64_t begin = pipeline::threadCpuNanoseconds();
      solver.solve(iterations);
      point.cpuMs = std::min(point.cpuMs, static_cast<double>(pipeline::threadCpuNanoseconds() - begin) * 1.0e-6);
    }
    point.residual = solvers.residual(solver.pressure());
    points.push_back(point);
    const bool stuck =
        points.size() > 1 && iterations < 12 && point.residual > 0.9 * points[points.size() - 2].residual;
    if (point.residual < kExact || point.cpuMs > maxCpuMs || (stuck && point.residual < 1.0e-4)) break;
  }
  return points;
}

}  // namespace

int runBenchFluidSolvers(const BenchFluidSolversOptions& options) {
  const double cells = static_cast<double>(options.grid) * options.grid * options.grid;
  const double maxCpuMs = kMaxCpuMsPerCell * cells;
  nlohmann::ordered_json report = {{"grid", options.grid}, {"cases", nlohmann::ordered_json::array()}};
  std::vector<measure::Panel> panels;
  for (const Case& scene : cases(options.grid)) {
    Solvers solvers(scene.solid, options.grid);
    measure::Panel panel{scene.name, "CPU ms", "relative residual", true, true, {}};
    for (const Solver& solver : solvers.all()) {
      nlohmann::ordered_json points = nlohmann::ordered_json::array();
      measure::Series series{solver.name, {}};
      for (const Point& point : curve(solver, solvers, maxCpuMs)) {
        points.push_back({{"iterations", point.iterations}, {"cpu_ms", point.cpuMs}, {"residual", point.residual}});
        series.points.emplace_back(point.cpuMs, point.residual);
        if (!options.json) {
          std::printf("%-16s %-30s %5d iterations %9.2f ms %9.1e\n", scene.name.c_str(), solver.name.c_str(),
                      point.iterations, point.cpuMs, point.residual);
        }
      }
      report["cases"].push_back({{"case", scene.name}, {"solver", solver.name}, {"points", std::move(points)}});
      panel.series.push_back(std::move(series));
    }
    panels.push_back(std::move(panel));
  }
  if (options.json) std::printf("%s\n", report.dump(2).c_str());
  if (!options.plot.empty()) {
    std::ofstream file(options.plot, std::ios::binary);
    file << measure::svgPlot(panels, 2, measure::machineName());
    if (!file.flush()) {
      std::fprintf(stderr, "bench fluid: cannot write %s\n", options.plot.c_str());
      return 1;
    }
  }
  return 0;
}

}  // namespace grove::cli
