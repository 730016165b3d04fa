#include "raster/surface.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace grove::raster {
namespace {

using world::Vec3;

/// Pixels, root mean square: a few places differ by several times that.
constexpr float kErrorPixels = 1.0F;

/// The triangulated surface of a cube before its deformation. Halving keeps the vertices and appends new ones.
struct Lattice {
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  explicit Lattice(std::array<int, 3> cells) {
    std::map<std::tuple<int, int, int>, std::uint32_t> known;
    const auto corner = [&](std::array<int, 3> at) {
      const auto [it, isNew] = known.try_emplace({at[0], at[1], at[2]}, static_cast<std::uint32_t>(points.size()));
      if (isNew) {
        Vec3 p;
        for (int a = 0; a < 3; ++a) {
          const auto axis = static_cast<std::size_t>(a);
          p[a] = 2.0F * static_cast<float>(at[axis]) / static_cast<float>(cells[axis]) - 1.0F;
        }
        points.push_back(p);
      }
      return it->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t u = (axis + 1) % 3;
      const std::size_t v = (axis + 2) % 3;
      for (const bool high : {false, true}) {
        for (int i = 0; i < cells[u]; ++i) {
          for (int j = 0; j < cells[v]; ++j) {
            const auto at = [&](int di, int dj) {
              std::array<int, 3> c{};
              c[axis] = high ? cells[axis] : 0;
              c[u] = i + di;
              c[v] = j + dj;
              return corner(c);
            };
            std::array<std::uint32_t, 4> q = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
            if (!high) std::swap(q[1], q[3]);
            // Alternating diagonals are less visible.
            if ((i + j) % 2 == 0) {
              triangles.push_back({q[0], q[1], q[2]});
              triangles.push_back({q[0], q[2], q[3]});
            } else {
              triangles.push_back({q[0], q[1], q[3]});
              triangles.push_back({q[1], q[2], q[3]});
            }
          }
        }
      }
    }
  }

  void halve() {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const auto [it, isNew] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
      if (isNew) points.push_back((points[a] + points[b]) * 0.5F);
      return it->second;
    };
    std::vector<Triangle> finer;
    finer.reserve(triangles.size() * 4);
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = middle(a, b);
      const std::uint32_t bc = middle(b, c);
      const std::uint32_t ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
};

std::size_t verticesUsed(const std::vector<Triangle>& triangles) {
  std::uint32_t last = 0;
  for (const auto& [a, b, c] : triangles) last = std::max({last, a, b, c});
  return last + std::size_t{1};
}

/// Mean square distance by which halving the edges of `coarse` moves the surface at their middles.
float halvingError(const std::vector<Vertex>& vertices, const Level& coarse, const Level& fine) {
  float sum = 0.0F;
  const auto add = [&](std::uint32_t from, std::uint32_t middle, std::uint32_t to) {
    const Vec3 straight = 0.5F * (vertices[from].position + vertices[to].position);
    const float off = glm::dot(vertices[middle].position - straight, vertices[middle].normal);
    sum += off * off;
  };
  for (std::size_t i = 0; i < coarse.triangles.size(); ++i) {
    const auto& [a, b, c] = coarse.triangles[i];
    const auto& [ab, bc, ca] = fine.triangles[4 * i + 3];
    add(a, ab, b);
    add(b, bc, c);
    add(c, ca, a);
  }
  return sum / static_cast<float>(3 * coarse.triangles.size());
}

}  // namespace

void Surface::append(const Surface& other, const world::Mat4& matrix) {
  if (levels.empty()) levels.resize(other.levels.size());
  weathered = weathered || other.weathered;
  marked = marked || other.marked;
  gloss = std::max(gloss, other.gloss);
  assert(levels.size() == other.levels.size());
  const auto first = static_cast<std::uint32_t>(vertices.size());
  for (Vertex vertex : other.vertices) {
    vertex.position = Vec3(matrix * world::Vec4(vertex.position, 1.0F));
    vertex.normal = glm::normalize(glm::mat3(matrix) * vertex.normal);
    vertices.push_back(vertex);
  }
  for (std::size_t i = 0; i < levels.size(); ++i) {
    for (const auto& [a, b, c] : other.levels[i].triangles)
      levels[i].triangles.push_back({a + first, b + first, c + first});
    levels[i].error = std::max(levels[i].error, other.levels[i].error * glm::length(Vec3(matrix[0])));
    levels[i].vertexCount = verticesUsed(levels[i].triangles);
  }
}

std::vector<std::uint32_t> Surface::putCoarseFirst() {
  constexpr std::uint32_t kUnplaced = ~std::uint32_t{0};
  std::vector<std::uint32_t> places(vertices.size(), kUnplaced);
  std::vector<std::uint32_t> order;
  order.reserve(vertices.size());
  const auto place = [&](std::uint32_t vertex) {
    if (places[vertex] == kUnplaced) {
      places[vertex] = static_cast<std::uint32_t>(order.size());
      order.push_back(vertex);
    }
    return places[vertex];
  };
  for (Level& level : levels) {
    for (Triangle& triangle : level.triangles) {
      for (std::uint32_t& corner : triangle) corner = place(corner);
    }
    level.vertexCount = order.size();
  }
  for (std::uint32_t vertex = 0; vertex < vertices.size(); ++vertex) place(vertex);
  std::vector<Vertex> sorted;
  sorted.reserve(vertices.size());
  for (const std::uint32_t vertex : order) sorted.push_back(vertices[vertex]);
  vertices = std::move(sorted);
  return order;
}

void Surface::computeNormals() {
  for (Vertex& vertex : vertices) vertex.normal = Vec3(0.0F);
  for (const auto& [a, b, c] : levels.back().triangles) {
    const Vec3 p = vertices[a].position;
    const Vec3 normal = glm::cross(vertices[b].position - p, vertices[c].position - p);
    for (const std::uint32_t i : {a, b, c}) vertices[i].normal += normal;
  }
  for (Vertex& vertex : vertices) {
    const float length = glm::length(vertex.normal);
    vertex.normal = length > 0.0F ? vertex.normal / length : Vec3(0.0F, 1.0F, 0.0F);
  }
}

world::Bounds Surface::bounds() const {
  world::Bounds all;
  for (const Vertex& vertex : vertices) all.add(vertex.position);
  return all;
}

std::size_t Surface::bytes() const noexcept {
  std::size_t sum = pipeline::vectorBytes(vertices);
  for (const Level& level : levels) sum += pipeline::vectorBytes(level.triangles);
  return sum;
}

world::Triangles Surface::triangles() const {
  world::Triangles all;
  for (const Vertex& vertex : vertices) all.positions.push_back(vertex.position);
  all.indices = levels.back().triangles;
  return all;
}

const Level& Surface::levelFor(float distance, float focalPixels) const noexcept {
  const float max = kErrorPixels * distance / focalPixels;
  const auto it = std::ranges::find_if(levels, [&](const Level& level) { return level.error <= max; });
  return it == levels.end() ? levels.back() : *it;
}

Surface makeDeformedBox(std::array<int, 3> cells, int halvings, const Deform& deform) {
  Lattice lattice(cells);
  Surface surface;
  for (int i = 0;; ++i) {
    surface.levels.push_back({lattice.triangles, 0.0F, lattice.points.size()});
    if (i == halvings) break;
    lattice.halve();
  }
  for (const Vec3 point : lattice.points) surface.vertices.push_back(deform(point));
  surface.computeNormals();
  float square = 0.0F;
  for (std::size_t i = surface.levels.size() - 1; i-- > 0;) {
    square += halvingError(surface.vertices, surface.levels[i], surface.levels[i + 1]);
    surface.levels[i].error = std::sqrt(square);
  }
  return surface;
}

}  // namespace grove::raster
