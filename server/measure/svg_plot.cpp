#include "measure/svg_plot.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "measure/plot_axis.h"

namespace grove::measure {
namespace {

// Pixels.
constexpr double kWidth = 500.0;
constexpr double kHeight = 380.0;
constexpr double kLeft = 74.0;
constexpr double kRight = 20.0;
constexpr double kTop = 48.0;
constexpr double kBottom = 52.0;
constexpr double kLegendRow = 18.0;
constexpr double kLetter = 6.6;  ///< mean width, an upper estimate
constexpr double kMargin = 12.0;
constexpr double kCaption = 18.0;

/// Okabe and Ito's colours, which most colour-blind people can distinguish.
constexpr std::array<std::string_view, 8> kColours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                      "#8a6d00", "#56b4e9", "#e69f00", "#404040"};

std::string text(double value, std::chars_format format, int precision) {
  std::array<char, 64> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, format, precision).ptr;
  return {buffer.data(), end};
}

/// Formats a coordinate.
std::string at(double value) { return text(value, std::chars_format::fixed, 1); }

std::string escaped(std::string_view raw) {
  std::string out;
  for (const char c : raw) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:  // XML 1.0 has no control characters
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

std::string label(double x, double y, std::string_view attributes, std::string_view words) {
  return "<text x=\"" + at(x) + "\" y=\"" + at(y) + "\" " + std::string(attributes) + ">" + escaped(words) +
         "</text>\n";
}

std::string stroke(double x1, double y1, double x2, double y2, std::string_view attributes) {
  return "<line x1=\"" + at(x1) + "\" y1=\"" + at(y1) + "\" x2=\"" + at(x2) + "\" y2=\"" + at(y2) + "\" " +
         std::string(attributes) + "/>\n";
}

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

std::string mark(double x, double y, std::size_t shape, std::string_view colour) {
  const std::string fill = "\" fill=\"" + std::string(colour) + "\" stroke=\"#fdfdfb\" stroke-width=\"0.8\"/>\n";
  const auto polygon = [&](std::initializer_list<std::pair<double, double>> corners) {
    std::string points;
    for (const auto& [dx, dy] : corners) points += at(x + dx) + "," + at(y + dy) + " ";
    points.pop_back();
    return "<polygon points=\"" + points + fill;
  };
  switch (shape % 4) {
    case 0:
      return "<circle cx=\"" + at(x) + "\" cy=\"" + at(y) + "\" r=\"4" + fill;
    case 1:
      return polygon({{-3.6, -3.6}, {3.6, -3.6}, {3.6, 3.6}, {-3.6, 3.6}});
    case 2:
      return polygon({{0.0, -4.8}, {4.4, 3.4}, {-4.4, 3.4}});
    default:
      return polygon({{0.0, -5.0}, {5.0, 0.0}, {0.0, 5.0}, {-5.0, 0.0}});
  }
}

/// A series with its drawable points and its style.
struct Drawn {
  const Series& series;
  std::vector<std::pair<double, double>> points;
  std::size_t style;
  bool fit;

  [[nodiscard]] std::string_view colour() const { return kColours[style % kColours.size()]; }
  [[nodiscard]] std::string lineStyle() const {
    return "fill=\"none\" stroke=\"" + std::string(colour()) + "\" stroke-width=\"1.8\" stroke-linejoin=\"round\"" +
           (fit ? " stroke-dasharray=\"6 4\"" : "");
  }
};

std::vector<Drawn> drawable(const Panel& panel) {
  std::vector<Drawn> drawn;
  std::size_t style = 0;
  const Series* before = nullptr;
  for (const Series& series : panel.series) {
    const bool fit = before != nullptr && series.line && !series.marks && before->marks && !before->line;
    if (before != nullptr && !fit) ++style;
    before = &series;
    Drawn one{series, {}, style, fit};
    std::ranges::copy_if(series.points, std::back_inserter(one.points), [&](const auto& point) {
      return std::isfinite(point.first) && std::isfinite(point.second) && (!panel.logX || point.first > 0.0) &&
             (!panel.logY || point.second > 0.0);
    });
    drawn.push_back(std::move(one));
  }
  return drawn;
}

/// Counts the letters of UTF-8: continuation bytes do not count.
double letters(std::string_view words) {
  return static_cast<double>(std::ranges::count_if(words, [](char c) { return (c & 0xC0) != 0x80; }));
}

/// Writes the legend's entries in rows from `y` on; returns the number of rows.
int legend(std::string& out, const std::vector<Drawn>& series, double y) {
  constexpr double kSample = 24.0;
  double x = kLeft;
  int rows = 1;
  for (const Drawn& one : series) {
    const double width = kSample + 8.0 + kLetter * letters(one.series.name) + 12.0;
    if (x > kLeft && x + width > kWidth - kRight) {
      x = kLeft;
      y += kLegendRow;
      ++rows;
    }
    if (one.series.line) out += stroke(x, y, x + kSample, y, one.lineStyle());
    if (one.series.marks) out += mark(x + 0.5 * kSample, y, one.style, one.colour());
    out += label(x + kSample + 6.0, y + 4.0, "font-size=\"12\" fill=\"#333\"", one.series.name);
    x += width;
  }
  return rows;
}

void grid(std::string& out, const PlotAxis& x, const PlotAxis& y, double top) {
  const double bottom = kHeight - kBottom;
  const double right = kWidth - kRight;
  const auto number = [](double value) { return text(value, std::chars_format::general, 6); };
  constexpr std::string_view kThin = "stroke=\"#e2e2dc\" stroke-width=\"1\"";
  for (const double tick : x.ticks()) {
    out += stroke(x.pixel(tick), top, x.pixel(tick), bottom, kThin);
    out += label(x.pixel(tick), bottom + 17.0, "font-size=\"11.5\" fill=\"#444\" text-anchor=\"middle\"", number(tick));
  }
  for (const double tick : y.ticks()) {
    out += stroke(kLeft, y.pixel(tick), right, y.pixel(tick), kThin);
    out +=
        label(kLeft - 7.0, y.pixel(tick) + 4.0, "font-size=\"11.5\" fill=\"#444\" text-anchor=\"end\"", number(tick));
  }
  out += stroke(kLeft, bottom, right, bottom, "stroke=\"#777\" stroke-width=\"1\"");
  out += stroke(kLeft, top, kLeft, bottom, "stroke=\"#777\" stroke-width=\"1\"");
}

std::string draw(const Panel& panel) {
  const std::vector<Drawn> series = drawable(panel);
  std::string out = label(kLeft, 26.0, "font-size=\"15\" font-weight=\"600\" fill=\"#1c1c1c\"", panel.title);
  const double top = kTop + kLegendRow * legend(out, series, kTop);
  const double middle = 0.5 * (top + kHeight - kBottom);
  Extent xs;
  Extent ys;
  for (const Drawn& one : series) {
    for (const auto& [x, y] : one.points) {
      xs.add(x);
      ys.add(y);
    }
  }
  out += label(0.5 * (kLeft + kWidth - kRight), kHeight - 14.0,
               "font-size=\"12.5\" fill=\"#333\" text-anchor=\"middle\"", panel.xLabel);
  out +=
      label(16.0, middle,
            "font-size=\"12.5\" fill=\"#333\" text-anchor=\"middle\" transform=\"rotate(-90 16 " + at(middle) + ")\"",
            panel.yLabel);
  if (xs.low > xs.high) {
    return out + label(0.5 * kWidth, middle, "font-size=\"13\" fill=\"#777\" text-anchor=\"middle\"", "no points");
  }
  const PlotAxis x(xs.low, xs.high, panel.logX, kLeft, kWidth - kRight);
  const PlotAxis y(ys.low, ys.high, panel.logY, kHeight - kBottom, top);
  grid(out, x, y, top);
  for (const Drawn& one : series) {
    if (!one.series.line || one.points.size() < 2) continue;
    std::string path;
    for (const auto& [px, py] : one.points) path += at(x.pixel(px)) + "," + at(y.pixel(py)) + " ";
    path.pop_back();
    out += "<polyline points=\"" + path + "\" " + one.lineStyle() + "/>\n";
  }
  for (const Drawn& one : series) {
    if (!one.series.marks) continue;
    for (const auto& [px, py] : one.points) out += mark(x.pixel(px), y.pixel(py), one.style, one.colour());
  }
  return out;
}

}  // namespace

std::string svgPlot(std::span<const Panel> panels, int columns, std::string_view caption) {
  const auto across = std::clamp<std::size_t>(panels.size(), 1, static_cast<std::size_t>(std::max(1, columns)));
  const std::size_t down = std::max<std::size_t>(1, (panels.size() + across - 1) / across);
  const double wide = static_cast<double>(across) * kWidth + 2.0 * kMargin;
  const double high = static_cast<double>(down) * kHeight + kCaption + 2.0 * kMargin;
  const std::string width = at(wide);
  const std::string height = at(high);
  std::string out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" +
                    width + "\" height=\"" + height + "\" viewBox=\"0 0 " + width + " " + height +
                    "\" font-family=\"system-ui, 'DejaVu Sans', Helvetica, Arial, sans-serif\">\n" +
                    "<rect x=\"0.5\" y=\"0.5\" width=\"" + at(wide - 1.0) + "\" height=\"" + at(high - 1.0) +
                    "\" rx=\"10\" fill=\"#fdfdfb\" stroke=\"#d4d4cc\"/>\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const std::size_t row = i / across;
    const std::size_t column = i % across;
    out += "<g transform=\"translate(" + at(kMargin + static_cast<double>(column) * kWidth) + " " +
           at(kMargin + static_cast<double>(row) * kHeight) + ")\">\n" + draw(panels[i]) + "</g>\n";
  }
  out += label(kMargin + kLeft, high - kMargin, "font-size=\"12\" fill=\"#555\"", caption);
  return out + "</svg>\n";
}

}  // namespace grove::measure
