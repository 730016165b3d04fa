#include "raster/outline/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "pipeline/vector_bytes.h"

namespace grove::raster {
namespace {

world::Vec2 placeOf(const Corner& corner) { return {corner.x, corner.y}; }

/// As drawTriangles() decides it.
bool isFront(const Triangle& triangle, std::span<const Corner> corners) {
  const world::Vec2 a = placeOf(corners[triangle[0]]);
  const world::Vec2 ab = placeOf(corners[triangle[1]]) - a;
  const world::Vec2 ac = placeOf(corners[triangle[2]]) - a;
  return ab.x * ac.y - ac.x * ab.y < 0.0F;
}

/// Each channel times `share` / 256, rounded.
std::uint32_t scaled(std::uint32_t colour, std::uint32_t share) {
  constexpr std::uint32_t kTwoChannels = 0x00FF00FFU;
  constexpr std::uint32_t kHalf = 0x00800080U;
  const std::uint32_t even = ((colour & kTwoChannels) * share + kHalf) >> 8U & kTwoChannels;
  const std::uint32_t odd = ((colour >> 8U & kTwoChannels) * share + kHalf) & ~kTwoChannels;
  return even | odd;
}

/// The nearest pixels first.
constexpr std::array<std::pair<int, int>, 8> kNeighbours{
    {{0, -1}, {0, 1}, {-1, 0}, {1, 0}, {-1, -1}, {-1, 1}, {1, -1}, {1, 1}}};

}  // namespace

void Outline::find(const Drawing& drawing, const ScreenSurface& surface) {
  rect_ = drawing.rect;
  pixels_.clear();
  coverage_.begin(rect_);
  addSilhouettes(surface);
  for (const CoveredPixels& covered : coverage_.partly()) {
    const auto share = static_cast<std::uint32_t>(std::floor(covered.share * 256.0F + 0.5F));
    for (int column = covered.begin; column < covered.end; ++column) pixels_.push_back({covered.row, column, share});
  }
}

void Outline::addSilhouettes(const ScreenSurface& surface) {
  const std::span<const Triangle> triangles = surface.triangles();
  const std::span<const Corner> corners = surface.corners();
  const auto add = [&](std::uint32_t from, std::uint32_t to) {
    coverage_.add(placeOf(corners[from]), placeOf(corners[to]));
  };
  if (surface.edges().empty()) {
    // The edges between two fronts cancel each other.
    for (const Triangle& triangle : triangles) {
      if (!isFront(triangle, corners)) continue;
      for (std::size_t i = 0; i < 3; ++i) add(triangle[i], triangle[(i + 1) % 3]);
    }
    return;
  }
  // A missing triangle is none in front.
  const auto none = static_cast<std::uint32_t>(triangles.size());
  isFront_.resize(triangles.size() + 1);
  isFront_[none] = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) isFront_[i] = isFront(triangles[i], corners) ? 1 : 0;
  for (const SurfaceEdge& edge : surface.edges()) {
    const std::uint8_t left = isFront_[edge.left];
    // One predictable branch: most edges have both triangles on the same side, but which side is unpredictable.
    if (left == isFront_[std::min(edge.right, none)]) continue;
    if (left != 0) {
      add(edge.from, edge.to);
    } else {
      add(edge.to, edge.from);
    }
  }
}

void Outline::finish(const OpenFragments& fragments, const Drawing& drawing, const DetailTexture& texture,
                     Image& image) {
  complete(fragments);
  raster::finish({fragments.surface, fragments.depth, fragments.stride, fragments.spans}, drawing, texture, image);
  scale(image);
}

void Outline::complete(const OpenFragments& fragments) {
  copies_.clear();
  for (const Pixel& pixel : pixels_) {
    const std::ptrdiff_t to = fragments.at(pixel.row, pixel.column);
    if (fragments.depth[to] > 0.0F) continue;
    const auto isCovered = [&](const std::pair<int, int>& step) {
      const int row = pixel.row + step.first;
      const int column = pixel.column + step.second;
      return row >= 0 && row < rect_.height() && column >= 0 && column < rect_.width() &&
             fragments.depth[fragments.at(row, column)] > 0.0F;
    };
    const auto* const step = std::ranges::find_if(kNeighbours, isCovered);
    if (step == kNeighbours.end()) continue;
    copies_.push_back({to, to + fragments.at(step->first, step->second)});
    if (fragments.spans.empty()) continue;
    Span& span = fragments.spans[static_cast<std::size_t>(pixel.row)];
    const bool isEmpty = span.begin >= span.end;
    span = {isEmpty ? pixel.column : std::min(span.begin, pixel.column),
            isEmpty ? pixel.column + 1 : std::max(span.end, pixel.column + 1)};
  }
  // After the search, so that no pixel copies a copy.
  for (const Copy& each : copies_) {
    fragments.surface[each.to] = fragments.surface[each.from];
    fragments.depth[each.to] = fragments.depth[each.from];
  }
}

void Outline::scale(Image& image) const {
  for (const Pixel& pixel : pixels_) {
    const Span span = image.span(pixel.row);
    if (pixel.column < span.begin || pixel.column >= span.end) continue;
    std::uint32_t& colour = image.colourRow(pixel.row)[pixel.column];
    colour = scaled(colour, pixel.share);
  }
}

std::size_t Outline::bytes() const noexcept {
  return coverage_.bytes() + pipeline::vectorBytes(isFront_, pixels_, copies_);
}

}  // namespace grove::raster
