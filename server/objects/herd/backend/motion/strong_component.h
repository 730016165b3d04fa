#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace grove::objects::herd {

/// A directed edge between two nodes.
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Returns for each of `nodes` nodes whether it belongs to the largest strongly connected component of the graph.
/// Tarjan, "Depth-First Search and Linear Graph Algorithms" (1972), without recursion.
[[nodiscard]] std::vector<bool> largestComponent(std::uint32_t nodes, std::span<const Edge> edges);

}  // namespace grove::objects::herd
