#include "raster/joined_surface.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace grove::raster {
namespace {

/// Of the next finer level's triangles: a level that saves less is left out.
constexpr float kMostTriangles = 0.84F;

/// A level of each part.
class Choice {
 public:
  explicit Choice(std::span<const Surface> parts) : parts_(parts), chosen_(parts.size()) {}

  /// Refines the part whose squared error falls most for each triangle. False if all are as fine as they can be.
  bool refine() {
    std::size_t best = 0;
    for (std::size_t i = 1; i < parts_.size(); ++i) {
      if (gainOf(i) > gainOf(best)) best = i;
    }
    if (parts_.empty() || gainOf(best) < 0.0F) return false;
    ++chosen_[best];
    return true;
  }

  [[nodiscard]] float squaredError() const {
    float sum = 0.0F;
    for (std::size_t i = 0; i < parts_.size(); ++i) sum += square(levelOf(i).error);
    return sum;
  }

  [[nodiscard]] float worstError() const {
    float worst = 0.0F;
    for (std::size_t i = 0; i < parts_.size(); ++i) worst = std::max(worst, levelOf(i).error);
    return worst;
  }

  /// Without its error.
  [[nodiscard]] Level level() const {
    Level all;
    std::uint32_t first = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      for (const auto& [a, b, c] : levelOf(i).triangles) all.triangles.push_back({a + first, b + first, c + first});
      all.vertexCount = first + levelOf(i).vertexCount;
      first += static_cast<std::uint32_t>(parts_[i].vertices.size());
    }
    return all;
  }

 private:
  static float square(float value) { return value * value; }

  [[nodiscard]] const Level& levelOf(std::size_t part) const { return parts_[part].levels[chosen_[part]]; }

  /// Negative if there is no finer level.
  [[nodiscard]] float gainOf(std::size_t part) const {
    const Level& now = levelOf(part);
    if (&now == &parts_[part].levels.back()) return -1.0F;
    const Level& finer = parts_[part].levels[chosen_[part] + 1];
    const auto more = static_cast<float>(finer.triangles.size() - now.triangles.size());
    return (square(now.error) - square(finer.error)) / more;
  }

  std::span<const Surface> parts_;
  std::vector<std::size_t> chosen_;  ///< by part
};

/// Coarse to fine.
std::vector<Level> levelsOf(std::span<const Surface> parts) {
  Choice choice(parts);
  const float squaredWorst = choice.squaredError();
  const float worst = choice.worstError();
  std::vector<Level> levels;
  do {
    levels.push_back(choice.level());
    levels.back().error = squaredWorst > 0.0F ? worst * std::sqrt(choice.squaredError() / squaredWorst) : 0.0F;
  } while (choice.refine());
  return levels;
}

/// Leaves out levels that save little. Neither the coarsest nor the finest.
std::vector<Level> thinned(std::vector<Level> levels) {
  std::vector<Level> kept;
  for (std::size_t i = levels.size(); i-- > 0;) {
    const auto count = static_cast<float>(levels[i].triangles.size());
    const bool saves = kept.empty() || count <= kMostTriangles * static_cast<float>(kept.back().triangles.size());
    if (saves || i == 0) kept.push_back(std::move(levels[i]));
  }
  std::ranges::reverse(kept);
  return kept;
}

}  // namespace

Surface joined(std::span<const Surface> parts) {
  Surface all;
  for (const Surface& part : parts) {
    all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
    all.weathered = all.weathered || part.weathered;
    all.marked = all.marked || part.marked;
    all.gloss = std::max(all.gloss, part.gloss);
  }
  all.levels = thinned(levelsOf(parts));
  return all;
}

}  // namespace grove::raster
