#include "objects/herd/backend/motion/strong_component.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace grove::objects::herd {
namespace {

constexpr std::uint32_t kUnseen = std::numeric_limits<std::uint32_t>::max();

class Tarjan {
 public:
  Tarjan(std::uint32_t nodes, std::span<const Edge> edges)
      : first_(nodes + 1), targets_(edges.size()), order_(nodes, kUnseen), low_(nodes), component_(nodes, kUnseen) {
    for (const auto& [from, to] : edges) ++first_[from + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (const auto& [from, to] : edges) targets_[next[from]++] = to;
    next_.assign(first_.begin(), first_.end() - 1);
  }

  std::vector<bool> largest() {
    for (std::uint32_t node = 0; node < order_.size(); ++node) {
      if (order_[node] == kUnseen) search(node);
    }
    const auto best = static_cast<std::uint32_t>(std::ranges::max_element(sizes_) - sizes_.begin());
    std::vector<bool> belongs(component_.size());
    for (std::size_t i = 0; i < belongs.size(); ++i) belongs[i] = component_[i] == best;
    return belongs;
  }

 private:
  void enter(std::uint32_t node) {
    order_[node] = low_[node] = count_++;
    path_.push_back(node);
    open_.push_back(node);
  }

  void search(std::uint32_t root) {
    enter(root);
    while (!path_.empty()) {
      const std::uint32_t node = path_.back();
      if (next_[node] < first_[node + 1]) {
        const std::uint32_t target = targets_[next_[node]++];
        if (order_[target] == kUnseen) {
          enter(target);
        } else if (component_[target] == kUnseen) {
          low_[node] = std::min(low_[node], order_[target]);
        }
        continue;
      }
      path_.pop_back();
      if (!path_.empty()) low_[path_.back()] = std::min(low_[path_.back()], low_[node]);
      if (low_[node] == order_[node]) close(node);
    }
  }

  void close(std::uint32_t node) {
    const auto number = static_cast<std::uint32_t>(sizes_.size());
    sizes_.push_back(0);
    for (bool isLast = false; !isLast;) {
      const std::uint32_t member = open_.back();
      open_.pop_back();
      component_[member] = number;
      ++sizes_.back();
      isLast = member == node;
    }
  }

  std::vector<std::uint32_t> first_;  ///< edge of each node
  std::vector<std::uint32_t> targets_;
  std::vector<std::uint32_t> order_;  ///< in which nodes are found
  std::vector<std::uint32_t> low_;
  std::vector<std::uint32_t> component_;
  std::vector<std::uint32_t> next_;  ///< edge to look at, of each node
  std::vector<std::uint32_t> path_;
  std::vector<std::uint32_t> open_;  ///< found, component unknown
  std::vector<std::uint32_t> sizes_;
  std::uint32_t count_ = 0;
};

}  // namespace

std::vector<bool> largestComponent(std::uint32_t nodes, std::span<const Edge> edges) {
  if (nodes == 0) return {};
  return Tarjan(nodes, edges).largest();
}

}  // namespace grove::objects::herd
