#pragma once

#include <optional>
#include <vector>

#include "cli/bench/amortize/bench_amortize_run.h"
#include "measure/linear_fit.h"

namespace grove::cli {

/// How many visitors a mode serves at the nominal frame rate on the cores of this machine.
struct Capacity {
  int served = 0;                ///< most visitors that were, of the counts that were measured; 0: not even the fewest
  std::optional<int> unserved;   ///< the next larger count, which was not; none: the largest one was served
  std::optional<double> fitted;  ///< where the fitted line reaches the machine's cores; none without a rising line
};

/// Cores over visitors of one mode: CPU(N) = a + b N, for serving at the nominal rate. Only over numbers of visitors
/// that the machine served: a saturated one makes fewer frames, which differ more and cost more each.
struct ModeFit {
  std::optional<measure::LinearFit> line;  ///< none over fewer than five numbers
  std::vector<int> over;                   ///< numbers of visitors that were served
  Capacity capacity;
};

/// The paper's claims, tested: the across-user share as the stages report it against that of the slopes, and the law
/// M = N (1 - alpha) + alpha against what both modes serve.
struct AmortizeLaw {
  int cores = 1;
  ModeFit shared;
  ModeFit unshared;
  std::optional<double> alphaStages;  ///< alpha_1 with the most visitors that share and get their frame rate
  std::optional<double> alphaFit;     ///< 1 - b_shared / b_private
  std::optional<double> lawStages;    ///< visitors of private mode that the law expects of `alphaStages`
  std::optional<double> lawFit;       ///< and of `alphaFit`
  std::optional<double> gain;         ///< fitted capacities, shared over private
};

[[nodiscard]] AmortizeLaw amortizeLaw(const std::vector<AmortizeRow>& rows, int cores);

/// The row of a mode with the most visitors; null if there is none.
[[nodiscard]] const AmortizeRow* fullest(const std::vector<AmortizeRow>& rows, bool privateWorlds);

}  // namespace grove::cli
