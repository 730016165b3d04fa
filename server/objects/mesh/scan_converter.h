#pragma once

#include "objects/mesh/lanes.h"
#include "world/camera.h"

namespace grove::objects::mesh {

/// Of kLanes rows, the columns from `begin` to before `end`; none if `end` is not larger.
struct SpanRows {
  Ints begin;
  Ints end;
};

struct ScreenPoint {
  float x;  ///< pixels
  float y;
};

/// Which pixels a triangle covers: those whose centre is inside, or on its left or upper edge. An edge is cut with a
/// row the same way for both of its triangles, so that they leave no gap. Not compiled with fast arithmetic, which
/// might round the two differently.
class ScanConverter {
 public:
  /// The triangle's part within `limits`.
  ScanConverter(ScreenPoint a, ScreenPoint b, ScreenPoint c, const world::Rect& limits) noexcept;

  [[nodiscard]] int top() const noexcept { return top_; }
  [[nodiscard]] int bottom() const noexcept { return bottom_; }

  /// The rows from `firstRow` on; only those within top() and bottom() mean anything.
  void convert(int firstRow, SpanRows& rows) const noexcept;

 private:
  struct Edge {
    Edge(ScreenPoint from, ScreenPoint to) noexcept;
    float x;
    float top;
    float slope;
  };

  Edge long_;
  Edge upper_;
  Edge lower_;
  bool longIsLeft_;
  int top_;
  int middle_;  // first row of the lower edge
  int bottom_;
  world::Rect limits_;
};

}  // namespace grove::objects::mesh
