#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

/// Plots of measurements as SVG: self-contained, readable on white and on dark pages.
namespace grove::measure {

/// Points of one kind. Those that are no finite numbers, or not positive where the axis is logarithmic, are left out.
struct Series {
  std::string name;  ///< for the legend
  std::vector<std::pair<double, double>> points;
  bool line = true;   ///< from point to point, in their order
  bool marks = true;  ///< at every point
};

/// One plot. Series take colours and marks in their order; one that is only a line and follows one that is only marks
/// is taken for its fit: drawn dashed in the same colour.
struct Panel {
  std::string title, xLabel, yLabel;
  bool logX = false, logY = false;
  std::vector<Series> series;
};

/// A picture of panels side by side, in rows of `columns`, as an SVG document. A panel without points says so.
std::string svgPlot(std::span<const Panel> panels, int columns);

}  // namespace grove::measure
