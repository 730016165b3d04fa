#pragma once

namespace grove::cli {

/// Options of `grove bench fluid`.
struct BenchFluidOptions {
  int grid = 64;    ///< cells per edge; a multiple of 8 from 16 to 128
  int steps = 100;  ///< measured, after a warm-up
  int threads = 1;  ///< per step, 1 to kMaxThreads
  bool json = false;

  static constexpr int kMaxThreads = 16;
};

/// Simulates a fire among standing stones, a ball and a walking visitor, and prints time and accuracy of a step.
/// Returns the process's exit code.
int runBenchFluid(const BenchFluidOptions& options);

}  // namespace grove::cli
