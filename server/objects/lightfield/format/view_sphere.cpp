#include "objects/lightfield/format/view_sphere.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

namespace grove::objects::lightfield {

ViewSphere::ViewSphere(int subdivision) : n_(subdivision) { assert(n_ >= 1 && n_ <= kMaxSubdivision); }

int ViewSphere::view(Point point) const noexcept {
  const auto [i, j] = point;
  assert(std::abs(i) + std::abs(j) <= n_);
  // Rows have 1, 3, 5, ... 2n+1, ... 3, 1 points: their sums are squares.
  const int start = j <= 0 ? (j + n_) * (j + n_) : views() - (n_ - j + 1) * (n_ - j + 1);
  return start + i + n_ - std::abs(j);
}

ViewSphere::Point ViewSphere::point(int view) const noexcept {
  assert(view >= 0 && view < views());
  const bool lower = view < (n_ + 1) * (n_ + 1);
  const int fromEnd = lower ? view : views() - 1 - view;
  int root = static_cast<int>(std::sqrt(static_cast<double>(fromEnd)));
  while (root * root > fromEnd) --root;
  while ((root + 1) * (root + 1) <= fromEnd) ++root;
  const int i = fromEnd - root * root - root;
  return lower ? Point{i, root - n_} : Point{-i, n_ - root};
}

world::Vec3 ViewSphere::direction(int view) const noexcept {
  const Point at = point(view);
  const float u = static_cast<float>(at.i) / static_cast<float>(n_);
  const float v = static_cast<float>(at.j) / static_cast<float>(n_);
  return glm::normalize(world::Vec3(u, std::max(0.0F, 1.0F - std::abs(u) - std::abs(v)), v));
}

ViewSphere::Nearest ViewSphere::nearest(world::Vec3 direction) const noexcept {
  const world::Vec3 d(direction.x, std::max(direction.y, 0.0F), direction.z);
  const float sum = std::max(std::abs(d.x) + d.y + std::abs(d.z), 1.0e-20F);
  // The four quarters of the lattice are mirror images. In this one the cell at (i, j) has i + j < n, so at most its
  // far corner is missing.
  const float u = std::abs(d.x) / sum * static_cast<float>(n_);
  const float v = std::abs(d.z) / sum * static_cast<float>(n_);
  const int i = std::min(static_cast<int>(u), n_ - 1);
  const int j = std::min(static_cast<int>(v), n_ - 1 - i);
  const float fu = std::min(u - static_cast<float>(i), 1.0F);
  const float fv = std::min(v - static_cast<float>(j), 1.0F);
  const auto at = [&](int x, int y) { return view({d.x < 0.0F ? -x : x, d.z < 0.0F ? -y : y}); };
  const bool whole = i + j + 2 <= n_;
  const float far = whole ? fu * fv : 0.0F;
  const float total = (1 - fu) * (1 - fv) + fu * (1 - fv) + (1 - fu) * fv + far;
  return {{at(i, j), at(i + 1, j), at(i, j + 1), whole ? at(i + 1, j + 1) : at(i, j)},
          {(1 - fu) * (1 - fv) / total, fu * (1 - fv) / total, (1 - fu) * fv / total, far / total}};
}

}  // namespace grove::objects::lightfield
