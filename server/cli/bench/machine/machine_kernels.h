#pragma once

#include <functional>
#include <string>
#include <vector>

namespace grove::cli {

/// A piece of Grove's work with fixed input, on one thread.
struct MachineKernel {
  std::string name;
  double referenceMilliseconds =
      0.0;  ///< CPU time on the reference core (EPYC, Zen 3, AVX2), geometric mean of hot and cold
  std::function<void()> run;
};

/// The mix behind the score of `grove bench machine`: a step of a fluid (shared work), and what a visitor's frame
/// consists of: triangles, a backdrop's warp, conversion of colours, JPEG. Changing it changes all scores. Making the
/// inputs takes about a second.
[[nodiscard]] std::vector<MachineKernel> machineKernels();

}  // namespace grove::cli
