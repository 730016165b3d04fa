#include "objects/lightfield/bake/light/light_points.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

namespace grove::bake {

using world::Bounds;
using world::Vec3;

namespace {

/// Sets of vertices that triangles connect, also across seams of normals or UVs that duplicate vertices.
class Pieces {
 public:
  explicit Pieces(const world::Triangles& triangles) : parent_(triangles.positions.size()) {
    std::iota(parent_.begin(), parent_.end(), 0U);
    std::vector<std::uint32_t> order(parent_);
    const std::vector<Vec3>& p = triangles.positions;
    const auto less = [&](std::uint32_t a, std::uint32_t b) {
      if (p[a].x != p[b].x) return p[a].x < p[b].x;
      if (p[a].y != p[b].y) return p[a].y < p[b].y;
      return p[a].z != p[b].z ? p[a].z < p[b].z : a < b;
    };
    std::sort(order.begin(), order.end(), less);
    for (std::size_t i = 1; i < order.size(); ++i) {
      if (p[order[i]] == p[order[i - 1]]) join(order[i], order[i - 1]);
    }
    for (const auto& [a, b, c] : triangles.indices) {
      join(a, b);
      join(b, c);
    }
  }

  [[nodiscard]] std::uint32_t of(std::uint32_t vertex) {
    while (parent_[vertex] != vertex) vertex = parent_[vertex] = parent_[parent_[vertex]];
    return vertex;
  }

 private:
  void join(std::uint32_t a, std::uint32_t b) {
    a = of(a);
    b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

  std::vector<std::uint32_t> parent_;
};

/// Returns equal numbers for normals that may share light: one number for all normals near the piece's own, so that a
/// bent leaf is not divided arbitrarily, and else one for each of 24 directions: a face of a cube and a quarter of it.
std::uint32_t facing(Vec3 normal, Vec3 ofPiece) {
  constexpr float kNear = 0.8F;
  constexpr std::uint32_t kOwn = 31;
  if (glm::dot(normal, ofPiece) > kNear * glm::length(ofPiece)) return kOwn;
  const Vec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto sign = [&](int a) { return std::uint32_t{normal[a % 3] < 0.0F}; };
  return static_cast<std::uint32_t>(axis) * 8U + sign(axis) * 4U + sign(axis + 1) * 2U + sign(axis + 2);
}

/// Interleaves the bits of three coordinates of 21 bits.
std::uint64_t morton(Vec3 unit) {
  std::uint64_t code = 0;
  for (int a = 0; a < 3; ++a) {
    auto x = static_cast<std::uint64_t>(std::clamp(unit[a], 0.0F, 1.0F) * 2097151.0F);
    x = (x | x << 32U) & 0x001F00000000FFFFULL;
    x = (x | x << 16U) & 0x001F0000FF0000FFULL;
    x = (x | x << 8U) & 0x100F00F00F00F00FULL;
    x = (x | x << 4U) & 0x10C30C30C30C30C3ULL;
    x = (x | x << 2U) & 0x1249249249249249ULL;
    code |= x << static_cast<unsigned>(a);
  }
  return code;
}

/// Vertices with equal keys share a point.
struct Key {
  std::uint64_t order = 0;  ///< of the piece, along a space-filling curve
  std::uint64_t patch = 0;  ///< cell and facing within the piece
  std::uint32_t piece = 0;
  std::uint32_t vertex = 0;

  [[nodiscard]] bool shares(const Key& other) const { return piece == other.piece && patch == other.patch; }
  [[nodiscard]] bool operator<(const Key& other) const {
    if (order != other.order) return order < other.order;
    if (piece != other.piece) return piece < other.piece;
    return patch != other.patch ? patch < other.patch : vertex < other.vertex;
  }
};

/// By vertex: the number of its connected piece.
std::vector<std::uint32_t> piecesOf(const models::Model& model) {
  Pieces pieces(model.triangles);
  std::vector<std::uint32_t> result(model.triangles.positions.size());
  for (std::uint32_t v = 0; v < result.size(); ++v) result[v] = pieces.of(v);
  return result;
}

/// By vertex: 1 for solid parts, 0 for leaves.
std::vector<std::uint32_t> kindsOf(const models::Model& model) {
  std::vector<std::uint32_t> result(model.triangles.positions.size(), 0);
  for (std::size_t i = 0; i < model.triangles.indices.size(); ++i) {
    if (!model.materials[model.materialOf[i]].solid) continue;
    for (const std::uint32_t vertex : model.triangles.indices[i]) result[vertex] = 1;
  }
  return result;
}

std::vector<Key> makeKeys(const models::Model& model, float cell, PointsOf of) {
  const std::vector<Vec3>& positions = model.triangles.positions;
  const bool byPiece = of == PointsOf::kPiece;
  const std::vector<std::uint32_t> pieces = byPiece ? piecesOf(model) : kindsOf(model);
  std::vector<Bounds> extents(positions.size());
  std::vector<Vec3> normals(positions.size(), Vec3(0.0F));
  Bounds all;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    extents[pieces[v]].add(positions[v]);
    // The group of all leaves has no direction of its own.
    if (byPiece) normals[pieces[v]] += model.normals[v];
    all.add(positions[v]);
  }
  const float scale = 1.0F / std::max({all.size().x, all.size().y, all.size().z, 1.0e-20F});
  std::vector<Key> keys(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const std::uint32_t piece = pieces[v];
    const Bounds& extent = extents[piece];
    Key& key = keys[v];
    key.piece = piece;
    key.vertex = v;
    key.patch = facing(model.normals[v], normals[piece]) >> (byPiece ? 0U : 2U);
    Vec3 middle(0.0F);
    for (int a = 0; a < 3; ++a) {
      // A whole number of cells of about the wanted size, so that a small piece is not divided arbitrarily.
      const float cells = std::clamp(std::round(extent.size()[a] / cell), 1.0F, 65535.0F);
      const float share = (positions[v][a] - extent.low[a]) / std::max(extent.size()[a], 1.0e-20F);
      const float index = std::min(std::floor(share * cells), cells - 1.0F);
      key.patch = key.patch << 16U | static_cast<std::uint64_t>(index);
      middle[a] = extent.low[a] + (index + 0.5F) / cells * extent.size()[a];
    }
    key.order = morton((middle - all.low) * scale);
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// Makes the points of all vertices, without a position; `means` are the mean positions of their vertices.
LightPoints groupVertices(const models::Model& model, const std::vector<Key>& keys, std::vector<Vec3>& means) {
  const std::vector<Vec3>& positions = model.triangles.positions;
  LightPoints result;
  result.ofVertex.resize(positions.size());
  for (std::size_t first = 0; first < keys.size();) {
    std::size_t end = first;
    Vec3 position(0.0F);
    Vec3 normal(0.0F);
    for (; end < keys.size() && keys[end].shares(keys[first]); ++end) {
      position += positions[keys[end].vertex];
      normal += model.normals[keys[end].vertex];
      result.ofVertex[keys[end].vertex] = static_cast<std::uint32_t>(result.points.size());
    }
    LightPoint point;
    const float length = glm::length(normal);
    point.normal = length > 1.0e-6F ? normal / length : model.normals[keys[first].vertex];
    means.push_back(position / static_cast<float>(end - first));
    result.points.push_back(point);
    first = end;
  }
  return result;
}

/// Puts each point on the surface: at the vertex or triangle centre nearest to the mean.
void putOnSurface(const world::Triangles& triangles, const std::vector<Vec3>& means, LightPoints& points) {
  const std::vector<Vec3>& positions = triangles.positions;
  std::vector<float> nearest(points.points.size(), std::numeric_limits<float>::infinity());
  const auto offer = [&](std::uint32_t vertex, Vec3 position) {
    const std::uint32_t point = points.ofVertex[vertex];
    const Vec3 away = position - means[point];
    const float squared = glm::dot(away, away);
    if (squared >= nearest[point]) return;
    nearest[point] = squared;
    points.points[point].position = position;
  };
  for (std::uint32_t v = 0; v < positions.size(); ++v) offer(v, positions[v]);
  for (const auto& [a, b, c] : triangles.indices) {
    const Vec3 middle = (positions[a] + positions[b] + positions[c]) / 3.0F;
    for (const std::uint32_t vertex : {a, b, c}) offer(vertex, middle);
  }
}

/// Gives each point the mean of the materials at its corners of triangles.
void takeMaterials(const models::Model& model, const std::vector<TextureSampler>& textures, LightPoints& points) {
  std::vector<float> corners(points.points.size(), 0.0F);
  for (std::size_t i = 0; i < model.triangles.indices.size(); ++i) {
    const models::Material& material = model.materials[model.materialOf[i]];
    for (const std::uint32_t vertex : model.triangles.indices[i]) {
      const std::uint32_t at = points.ofVertex[vertex];
      LightPoint& point = points.points[at];
      Vec3 tint = model.colours.empty() ? Vec3(1.0F) : model.colours[vertex];
      if (material.texture >= 0) tint *= textures[static_cast<std::size_t>(material.texture)].mean();
      point.albedo += material.albedo * tint;
      point.transmittance += material.transmittance * tint;
      point.bothSides = point.bothSides || !material.solid;
      corners[at] += 1.0F;
    }
  }
  for (std::size_t i = 0; i < points.points.size(); ++i) {
    const float share = 1.0F / std::max(corners[i], 1.0F);
    points.points[i].albedo *= share;
    points.points[i].transmittance *= share;
  }
}

}  // namespace

LightPoints chooseLightPoints(const models::Model& model, const std::vector<TextureSampler>& textures, float cell,
                              PointsOf of) {
  std::vector<Vec3> means;
  LightPoints points = groupVertices(model, makeKeys(model, cell, of), means);
  putOnSurface(model.triangles, means, points);
  takeMaterials(model, textures, points);
  return points;
}

}  // namespace grove::bake
