#pragma once

#include <array>

#include "world/geometry.h"

namespace grove::objects::lightfield {

/// The positions of a light field's views: the vertices of a subdivided octahedron's upper hemisphere (Figure 5.2), as
/// directions from the centre. Unfolded, they are the lattice points |i| + |j| <= subdivision, so that the nearest ones
/// are found without a search.
class ViewSphere {
 public:
  static constexpr int kMaxSubdivision = 128;

  /// `subdivision` is the number of parts of each edge of the octahedron, 1 to kMaxSubdivision.
  explicit ViewSphere(int subdivision);

  [[nodiscard]] int subdivision() const noexcept { return n_; }
  /// 2n^2 + 2n + 1; 8,321 for n = 64.
  [[nodiscard]] int views() const noexcept { return 2 * n_ * (n_ + 1) + 1; }

  struct Point {
    int i = 0;
    int j = 0;
    friend bool operator==(const Point&, const Point&) = default;
  };
  /// Row by row of constant j, from j = -n. Asserts that the point is on the lattice.
  [[nodiscard]] int view(Point point) const noexcept;
  [[nodiscard]] Point point(int view) const noexcept;

  /// Unit vector from the centre, y >= 0.
  [[nodiscard]] world::Vec3 direction(int view) const noexcept;

  /// The corners of a direction's lattice cell and their bilinear weights, whose sum is 1. At the rim the last corner
  /// may be missing: its weight is 0, the others grow evenly, and its view repeats one of theirs. Directions below the
  /// rim are moved up to it.
  struct Nearest {
    std::array<int, 4> view{};
    std::array<float, 4> weight{};
  };
  [[nodiscard]] Nearest nearest(world::Vec3 direction) const noexcept;

 private:
  int n_;
};

}  // namespace grove::objects::lightfield
