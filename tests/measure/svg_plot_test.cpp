#include "measure/svg_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace grove::measure {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Reads the part of XML that a plot needs and says what is wrong with it, or nothing.
class XmlReader {
 public:
  explicit XmlReader(const std::string& text) : text_(text) {}

  std::optional<std::string> problem() {
    if (text_.starts_with("<?xml")) at_ = text_.find("?>") + 2;
    while (at_ < text_.size()) {
      const bool fine = text_[at_] == '<' ? tag() : content();
      if (!fine) return "at " + std::to_string(at_) + ": " + text_.substr(at_, 60);
    }
    if (!open_.empty()) return "not closed: " + open_.back();
    return std::nullopt;
  }

 private:
  bool content() {
    if (text_[at_] == '>' || static_cast<unsigned char>(text_[at_]) < 0x09) return false;
    if (text_[at_] == '&') {
      const std::string entity = text_.substr(at_, text_.find(';', at_) - at_ + 1);
      if (entity != "&amp;" && entity != "&lt;" && entity != "&gt;" && entity != "&quot;") return false;
    }
    ++at_;
    return true;
  }

  std::string name() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '-'))
      ++at_;
    return text_.substr(begin, at_ - begin);
  }

  bool tag() {
    ++at_;
    const bool closes = text_[at_] == '/';
    if (closes) ++at_;
    const std::string element = name();
    if (element.empty()) return false;
    if (closes) {
      if (open_.empty() || open_.back() != element || text_[at_] != '>') return false;
      open_.pop_back();
      ++at_;
      return true;
    }
    open_.push_back(element);
    while (text_[at_] == ' ') {
      ++at_;
      if (name().empty() || text_.compare(at_, 2, "=\"") != 0) return false;
      for (at_ += 2; text_[at_] != '"'; ++at_) {
        if (text_[at_] == '<') return false;
      }
      ++at_;
    }
    if (text_[at_] == '/') {
      open_.pop_back();
      ++at_;
    }
    return text_[at_++] == '>';
  }

  const std::string& text_;
  std::size_t at_ = 0;
  std::vector<std::string> open_;
};

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t found = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
  return found;
}

Panel panelOf(std::vector<Series> series) {
  return {.title = "t", .xLabel = "x", .yLabel = "y", .series = std::move(series)};
}

TEST(SvgPlot, EscapesTexts) {
  Panel panel = panelOf({{.name = "<b>\"5\" & 6</b>\n\x01", .points = {{1.0, 2.0}, {2.0, 3.0}}}});
  panel.title = "a < b && c > d";
  const std::string svg = svgPlot(std::vector{panel, panel, panel}, 2, "x86 & 2 cores");
  EXPECT_EQ(XmlReader(svg).problem(), std::nullopt);
  EXPECT_THAT(svg, HasSubstr("a &lt; b &amp;&amp; c &gt; d"));
  EXPECT_EQ(count(svg, "x86 &amp; 2 cores"), 1u) << "once for all panels";
  EXPECT_THAT(svg, Not(HasSubstr("\x01")));
}

TEST(SvgPlot, SkipsNotANumber) {
  const std::string svg = svgPlot(
      std::vector{panelOf({{.name = "s", .points = {{1.0, 1.0}, {2.0, kNan}, {kInfinite, 1.0}, {3.0, 2.0}}}})}, 1, "");
  EXPECT_EQ(XmlReader(svg).problem(), std::nullopt);
  EXPECT_EQ(count(svg, "<circle"), 3u) << "two points and the legend";
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

TEST(SvgPlot, SkipsNonPositiveOnLogAxes) {
  Panel panel = panelOf({{.name = "s", .points = {{1.0, 1e-4}, {2.0, 0.0}, {-1.0, 1.0}, {100.0, 1e-1}}}});
  panel.logX = panel.logY = true;
  const std::string svg = svgPlot(std::vector{panel}, 1, "");
  EXPECT_EQ(count(svg, "<circle"), 3u);
  for (const char* tick : {">0.0001<", ">0.001<", ">0.01<", ">0.1<", ">1<", ">10<", ">100<"}) {
    EXPECT_THAT(svg, HasSubstr(tick));
  }
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(SvgPlot, TicksAreRoundNumbersAroundThePoints) {
  const std::string svg = svgPlot(std::vector{panelOf({{.name = "s", .points = {{1.0, 0.7}, {8.0, 9.3}}}})}, 1, "");
  for (const char* tick : {">0<", ">2<", ">4<", ">6<", ">8<", ">10<"})
    EXPECT_EQ(count(svg, tick), tick[1] == '1' ? 1u : 2u) << tick;
}

TEST(SvgPlot, FitHasTheColourOfItsPoints) {
  const std::string svg =
      svgPlot(std::vector{panelOf({{.name = "a", .points = {{1.0, 1.0}, {2.0, 2.0}}, .line = false},
                                   {.name = "a, fitted", .points = {{0.0, 0.0}, {3.0, 3.0}}, .marks = false},
                                   {.name = "b", .points = {{1.0, 2.0}, {2.0, 4.0}}, .line = false}})},
              1, "");
  EXPECT_EQ(count(svg, "stroke-dasharray"), 2u) << "the line and its legend";
  EXPECT_EQ(count(svg, "<polyline"), 1u);
  EXPECT_EQ(count(svg, "<circle"), 3u) << "a";
  EXPECT_EQ(count(svg, "<polygon"), 3u) << "b";
}

TEST(SvgPlot, DrawsDegenerateData) {
  for (const bool logarithmic : {false, true}) {
    for (const auto& points : std::vector<std::vector<std::pair<double, double>>>{
             {{3.0, 7.0}}, {{3.0, 7.0}, {3.0, 7.0}}, {{10.0, 10.0}}, {{5.0, 0.0}}, {{5.0, -2.0}}, {}}) {
      Panel panel = panelOf({{.name = "s", .points = points}});
      panel.logX = panel.logY = logarithmic;
      const std::string svg = svgPlot(std::vector{panel}, 1, "");
      EXPECT_EQ(XmlReader(svg).problem(), std::nullopt);
      EXPECT_THAT(svg, Not(HasSubstr("nan")));
    }
  }
  EXPECT_THAT(svgPlot(std::vector{panelOf({})}, 1, ""), HasSubstr("no points"));
  EXPECT_EQ(XmlReader(svgPlot({}, 0, "")).problem(), std::nullopt);
}

}  // namespace
}  // namespace grove::measure
