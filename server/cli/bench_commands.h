#pragma once

#include <string>

#include "cli/bench/amortize/bench_amortize.h"
#include "cli/bench/capacity/bench_capacity.h"
#include "cli/bench/encode/bench_encode.h"
#include "cli/bench/fluid/bench_fluid.h"
#include "cli/bench/lightfield/bench_lightfield.h"
#include "cli/bench/pipeline/bench_pipeline.h"
#include "cli/bench/view/bench_view.h"
#include "cli/bench/warp/bench_warp.h"

namespace CLI {
class App;
}

namespace grove::cli {

/// `grove bench` with its sub-commands and their options.
class BenchCommands {
 public:
  /// This outlives parsing.
  void addTo(CLI::App& app);
  /// Runs the selected sub-command; returns its exit code.
  [[nodiscard]] int run() const;

 private:
  /// Without `solvers`, whole steps are measured.
  struct Fluid {
    BenchFluidOptions options;
    bool solvers = false;
    std::string plot;
  };

  void addAmortize();
  void addEncode();
  void addFluid();
  void addLightfield();
  void addMachine();
  void addPipeline();
  void addView();
  void addWarp();
  [[nodiscard]] int runCapacity() const;

  CLI::App* bench_ = nullptr;
  BenchAmortizeOptions amortize_;
  bool findsCapacity_ = false;
  BenchEncodeOptions encode_;
  Fluid fluid_;
  BenchLightfieldOptions lightfield_;
  bool machineJson_ = false;
  BenchPipelineOptions pipeline_;
  BenchViewOptions view_;
  BenchWarpOptions warp_;
};

}  // namespace grove::cli
