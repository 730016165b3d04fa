#pragma once

#include <string>
#include <vector>

#include "cli/bench/amortize/bench_amortize_figure.h"
#include "cli/bench/amortize/bench_amortize_law.h"
#include "cli/bench/amortize/bench_amortize_run.h"

namespace grove::cli {

/// All that `grove bench amortize` has measured.
struct AmortizeResult {
  std::vector<AmortizeRow> rows;  ///< of the first course and codec, for the fits
  std::vector<AmortizeRow> otherRows;
  std::vector<FigureColumn> figure;
  node::TransportKind transport = node::TransportKind::kReference;
  int cores = 1;  ///< of the machine
  bool interrupted = false;

  [[nodiscard]] std::vector<AmortizeRow> allRows() const {
    std::vector<AmortizeRow> all = rows;
    all.insert(all.end(), otherRows.begin(), otherRows.end());
    return all;
  }
};

/// The document of the contract, for machines. Unbounded values are null.
[[nodiscard]] std::string amortizeJson(const AmortizeResult& result);

/// Tables like the paper's, for people.
[[nodiscard]] std::string amortizeTables(const AmortizeResult& result);

/// Curves over the number of visitors, as SVG.
[[nodiscard]] std::string amortizePlot(const AmortizeResult& result);

}  // namespace grove::cli
