#include "raster/outline/surface_edges.h"

#include <algorithm>
#include <utility>

namespace grove::raster {
namespace {

/// Edges without a triangle to the right, in one list per start vertex. Lists are short, so searching them is several
/// times faster than one map of all edges.
class OpenEdges {
 public:
  explicit OpenEdges(std::span<const Triangle> triangles) {
    std::uint32_t last = 0;
    for (const auto& [a, b, c] : triangles) last = std::max({last, a, b, c});
    newest_.assign(std::size_t{last} + 1, kNone);
  }

  /// Edges are added in their order. Of several with the same ends, only the first counts.
  void add(const std::vector<SurfaceEdge>& edges) {
    const auto index = static_cast<std::uint32_t>(edges.size() - 1);
    const SurfaceEdge& edge = edges.back();
    older_.push_back(kNone);
    if (*find(edges, edge.from, edge.to) != kNone) return;
    older_.back() = newest_[edge.from];
    newest_[edge.from] = index;
  }

  /// Removes and returns the open edge between two vertices; returns kNone if there is none.
  [[nodiscard]] std::uint32_t take(const std::vector<SurfaceEdge>& edges, std::uint32_t from, std::uint32_t to) {
    std::uint32_t* const place = find(edges, from, to);
    return *place == kNone ? kNone : std::exchange(*place, older_[*place]);
  }

  static constexpr std::uint32_t kNone = SurfaceEdge::kNone;

 private:
  /// Where the edge's index, or kNone, is stored.
  [[nodiscard]] std::uint32_t* find(const std::vector<SurfaceEdge>& edges, std::uint32_t from, std::uint32_t to) {
    std::uint32_t* place = &newest_[from];
    while (*place != kNone && edges[*place].to != to) place = &older_[*place];
    return place;
  }

  std::vector<std::uint32_t> newest_;  // by vertex
  std::vector<std::uint32_t> older_;   // by edge: the next of its list
};

}  // namespace

std::vector<SurfaceEdge> edgesOf(std::span<const Triangle> triangles) {
  std::vector<SurfaceEdge> edges;
  OpenEdges open(triangles);
  for (std::uint32_t triangle = 0; triangle < triangles.size(); ++triangle) {
    const auto& [a, b, c] = triangles[triangle];
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
      const std::uint32_t opposite = open.take(edges, to, from);
      if (opposite != SurfaceEdge::kNone) {
        edges[opposite].right = triangle;
        continue;
      }
      edges.push_back({from, to, triangle});
      open.add(edges);
    }
  }
  return edges;
}

}  // namespace grove::raster
