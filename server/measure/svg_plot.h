#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Plots of measurements as SVG: self-contained, readable on white and on dark pages.
namespace grove::measure {

/// A series of points. Skips points that are not finite, or not positive on a logarithmic axis.
struct Series {
  std::string name;  ///< for the legend
  std::vector<std::pair<double, double>> points;
  bool line = true;   ///< connects the points in order
  bool marks = true;  ///< marks every point
};

/// One plot. Series get colours and marks in order. A series with only a line after one with only marks is drawn as its
/// fit: dashed, in the same colour.
struct Panel {
  std::string title, xLabel, yLabel;
  bool logX = false, logY = false;
  std::vector<Series> series;
};

/// Returns an SVG document of panels side by side, in rows of `columns`, over a line of text. A panel without points
/// says so.
std::string svgPlot(std::span<const Panel> panels, int columns, std::string_view caption);

}  // namespace grove::measure
