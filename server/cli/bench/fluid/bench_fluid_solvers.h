#pragma once

#include <filesystem>

namespace grove::cli {

/// Options of `grove bench fluid --solvers`.
struct BenchFluidSolversOptions {
  int grid = 64;  ///< cells per edge; a multiple of 8 from 16 to 128
  bool json = false;
  std::filesystem::path plot;  ///< SVG to write; empty: none
};

/// Compares the convergence of pressure solvers in four scenes, and prints relative residual against CPU time. Returns
/// the process's exit code: 0, 1 if the plot cannot be written, or 2 with a line on stderr if an option is out of
/// range.
int runBenchFluidSolvers(const BenchFluidSolversOptions& options);

}  // namespace grove::cli
