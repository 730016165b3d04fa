#include <algorithm>

#include "cli/bench/amortize/bench_amortize_report.h"
#include "cli/bench/codec_names.h"
#include "measure/processor.h"
#include "measure/svg_plot.h"

namespace grove::cli {
namespace {

using measure::Panel;
using measure::Series;

constexpr const char* kVisitors = "visitors";

/// A value of each row of a mode over its visitors.
template <class Value>
Series over(const std::string& name, const std::vector<AmortizeRow>& rows, bool privateWorlds, Value value) {
  Series series{.name = name, .points = {}};
  for (const AmortizeRow& row : rows) {
    if (row.privateWorlds == privateWorlds) series.points.emplace_back(row.users, value(row));
  }
  std::ranges::sort(series.points);
  return series;
}

Panel coresPanel(const AmortizeResult& result) {
  const AmortizeLaw law = amortizeLaw(result.rows, result.cores);
  Panel panel{.title = "Cores for 30 frames a second each", .xLabel = kVisitors, .yLabel = "cores", .series = {}};
  int max = 1;
  for (const AmortizeRow& row : result.rows) max = std::max(max, row.users);
  panel.series.push_back({.name = "this machine", .points = {{0.0, law.cores}, {max, law.cores}}, .marks = false});
  const auto add = [&](const char* name, const char* fitName, bool privateWorlds, const ModeFit& fit) {
    Series& points = panel.series.emplace_back(
        over(name, result.rows, privateWorlds, [](const AmortizeRow& row) { return row.coresNeeded(); }));
    points.line = false;
    if (!fit.line) return;
    // Nobody needs fewer than no cores.
    const double from =
        fit.line->at(0.0) < 0.0 && fit.line->b.value > 0.0 ? -fit.line->a.value / fit.line->b.value : 0.0;
    panel.series.push_back(
        {.name = fitName, .points = {{from, fit.line->at(from)}, {max, fit.line->at(max)}}, .marks = false});
  };
  add("shared", "fit", false, law.shared);
  add("private", "fit", true, law.unshared);
  return panel;
}

Panel alphaPanel(const std::vector<AmortizeRow>& rows) {
  const auto alpha0 = [](const AmortizeRow& row) { return measure::alpha0(row.cost()); };
  const auto alpha1 = [](const AmortizeRow& row) { return measure::alpha1(row.cost()); };
  const auto beta = [](const AmortizeRow& row) { return measure::sum(row.memory).beta(); };
  return {.title = "Across-user share",
          .xLabel = kVisitors,
          .yLabel = "of computation (α) and memory (β)",
          .series = {over("α0", rows, false, alpha0), over("α1", rows, false, alpha1), over("β", rows, false, beta)}};
}

/// What the process used, in any class or none.
Panel visitorPanel(const AmortizeResult& result) {
  const auto perFrame = [](const AmortizeRow& row) { return 1e3 * row.cpuCores / (row.fps() * row.users); };
  Panel panel{.title = "CPU for a frame of one visitor", .xLabel = kVisitors, .yLabel = "ms", .series = {}};
  std::vector<std::uint8_t> codecs;
  for (const AmortizeRow& row : result.allRows()) {
    if (std::ranges::find(codecs, row.codec) == codecs.end()) codecs.push_back(row.codec);
  }
  for (const std::uint8_t codec : codecs) {
    std::vector<AmortizeRow> rows = result.allRows();
    std::erase_if(
        rows, [&](const AmortizeRow& row) { return row.codec != codec || row.course != result.rows.front().course; });
    for (const bool privateWorlds : {false, true}) {
      const std::string name = codecName(codec) + (privateWorlds ? ", private" : ", shared");
      panel.series.push_back(over(name, rows, privateWorlds, perFrame));
    }
  }
  return panel;
}

Panel memoryPanel(const std::vector<AmortizeRow>& rows) {
  const auto resident = [](const AmortizeRow& row) { return static_cast<double>(row.process.resident) * 1e-6; };
  const auto reported = [](const AmortizeRow& row) { return row.reportedBytes * 1e-6; };
  return {.title = "Memory of all processes",
          .xLabel = kVisitors,
          .yLabel = "MB",
          .series = {over("resident, shared", rows, false, resident), over("resident, private", rows, true, resident),
                     over("reported by holders, shared", rows, false, reported),
                     over("reported by holders, private", rows, true, reported)}};
}

}  // namespace

std::string amortizePlot(const AmortizeResult& result) {
  const std::vector<Panel> panels = {visitorPanel(result), coresPanel(result), alphaPanel(result.rows),
                                     memoryPanel(result.rows)};
  return measure::svgPlot(panels, 2, measure::machineName());
}

}  // namespace grove::cli
