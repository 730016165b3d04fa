#include "objects/figure/backend/shadow/shadow_layer.h"

#include <algorithm>

#include "objects/figure/backend/shadow/contact_shadow.h"

namespace grove::objects::figure {
namespace {

/// Rows of pixels that cover more ground are made of several parts. Metres.
constexpr float kPart = 0.3F;
constexpr int kMostParts = 5;

/// Extends a row's span to these columns of the picture; fills the new ones with transparent pixels.
void widen(raster::Image& picture, int row, const Columns& columns) {
  if (picture.spans.empty()) return;
  raster::Span& span = picture.spans[static_cast<std::size_t>(row)];
  const bool isEmpty = span.begin >= span.end;
  const raster::Span wide{isEmpty ? columns.begin : std::min(columns.begin, span.begin),
                          isEmpty ? columns.end : std::max(columns.end, span.end)};
  const auto clear = [&](int begin, int end) {
    std::fill(picture.colourRow(row) + begin, picture.colourRow(row) + end, 0U);
    std::fill(picture.depthRow(row) + begin, picture.depthRow(row) + end, world::kInfiniteDepth);
  };
  clear(wide.begin, isEmpty ? wide.end : span.begin);
  if (!isEmpty) clear(span.end, wide.end);
  span = wide;
}

/// The used columns without those at both ends that would show nothing.
Columns visible(RowShade& shade) {
  constexpr float kLeast = 0.5F / 255.0F;
  const auto shows = [&](int x) { return std::max(*shade.sun(x), *shade.sky(x)) >= kLeast; };
  Columns columns = shade.used();
  while (!columns.empty() && !shows(columns.begin)) ++columns.begin;
  while (!columns.empty() && !shows(columns.end - 1)) --columns.end;
  return columns;
}

void addSun(const SunShadow& sun, int y, const GroundRows& rows, float length, RowShade& shade) {
  const int parts = std::clamp(static_cast<int>(length / kPart), 1, kMostParts);
  for (int part = 0; part < parts; ++part) {
    const float place = (static_cast<float>(part) + 0.5F) / static_cast<float>(parts);
    const auto row = rows.at(static_cast<float>(y) + place);
    if (row) sun.add(*row, 1.0F / static_cast<float>(parts), shade);
  }
}

/// The smallest rectangle around both.
world::Rect joined(const world::Rect& a, const world::Rect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

}  // namespace

world::Rect rectOf(const world::Bounds& figure, const std::optional<SunShadow>& sun, const world::Camera& camera) {
  world::Rect rect = camera.screenRect(figure);
  if (!sun) return rect;
  for (const world::Bounds& piece : sun->pieces()) rect = joined(rect, camera.screenRect(piece));
  return rect;
}

void layShadows(world::Vec3 place, const std::optional<SunShadow>& sun, const world::Camera& camera,
                raster::Image& picture) {
  const world::Rect& rect = picture.rect;
  const world::Vec3 sky = sun ? sun->colour() : world::Vec3(0.0F);
  const GroundRows rows(place.y, camera);
  RowShade shade({rect.left, rect.right});
  for (int y = rect.top; y < rect.bottom; ++y) {
    const auto row = rows.at(static_cast<float>(y) + 0.5F);
    if (!row) continue;
    shade.clear();
    if (sun) addSun(*sun, y, rows, row->length, shade);
    addContactShadow(place, *row, shade);
    const Columns columns = visible(shade);
    if (columns.empty()) continue;
    const int line = y - rect.top;
    widen(picture, line, {columns.begin - rect.left, columns.end - rect.left});
    const int first = columns.begin - rect.left;
    layShades(shade.sun(columns.begin), shade.sky(columns.begin), {sky, row->front}, columns.end - columns.begin,
              picture.colourRow(line) + first, picture.depthRow(line) + first);
  }
}

}  // namespace grove::objects::figure
