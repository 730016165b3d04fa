#include "cli/bench/amortize/bench_amortize_law.h"

#include <algorithm>
#include <utility>

namespace grove::cli {
namespace {

constexpr std::size_t kFewestPoints = 5;

ModeFit fitOf(const std::vector<AmortizeRow>& rows, bool privateWorlds, int cores) {
  const auto ofMode = [&](const AmortizeRow& row) { return row.privateWorlds == privateWorlds; };
  ModeFit fit;
  std::vector<std::pair<double, double>> points;
  for (const AmortizeRow& row : rows) {
    if (!ofMode(row) || row.saturated()) continue;
    fit.capacity.served = std::max(fit.capacity.served, row.users);
    points.emplace_back(row.users, row.coresNeeded());
    fit.over.push_back(row.users);
  }
  for (const AmortizeRow& row : rows) {
    if (!ofMode(row) || row.users <= fit.capacity.served) continue;
    fit.capacity.unserved = std::min(fit.capacity.unserved.value_or(row.users), row.users);
  }
  if (points.size() >= kFewestPoints) fit.line = measure::linearFit(points);
  if (fit.line && fit.line->b.value > 0.0) {
    fit.capacity.fitted = std::max(0.0, (cores - fit.line->a.value) / fit.line->b.value);
  }
  return fit;
}

}  // namespace

const AmortizeRow* fullest(const std::vector<AmortizeRow>& rows, bool privateWorlds) {
  const AmortizeRow* found = nullptr;
  for (const AmortizeRow& row : rows) {
    if (row.privateWorlds == privateWorlds && (found == nullptr || row.users > found->users)) found = &row;
  }
  return found;
}

AmortizeLaw amortizeLaw(const std::vector<AmortizeRow>& rows, int cores) {
  AmortizeLaw law;
  law.cores = cores;
  law.shared = fitOf(rows, false, cores);
  law.unshared = fitOf(rows, true, cores);
  for (const AmortizeRow& row : rows) {
    if (row.privateWorlds || row.users != law.shared.capacity.served || row.saturated()) continue;
    law.alphaStages = measure::alpha1(row.cost());
  }
  if (law.shared.line && law.unshared.line && law.unshared.line->b.value > 0.0) {
    law.alphaFit = 1.0 - law.shared.line->b.value / law.unshared.line->b.value;
  }
  const std::optional<double> shared = law.shared.capacity.fitted;
  if (shared && law.alphaStages) law.lawStages = measure::privateVisitors(*shared, *law.alphaStages);
  if (shared && law.alphaFit) law.lawFit = measure::privateVisitors(*shared, *law.alphaFit);
  const std::optional<double> unshared = law.unshared.capacity.fitted;
  if (shared && unshared && *unshared > 0.0) law.gain = *shared / *unshared;
  return law;
}

}  // namespace grove::cli
