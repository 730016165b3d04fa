#include "objects/lightfield/bake/refine.h"

#include <algorithm>
#include <cstddef>
#include <unordered_map>

namespace grove::bake {
namespace {

using world::Vec3;
using Triangle = std::array<std::uint32_t, 3>;

class Refiner {
 public:
  Refiner(models::Model& model, const LongestEdge& longest) : model_(model), longest_(longest) {}

  void run() {
    std::vector<Triangle> todo;
    std::vector<Triangle>& indices = model_.triangles.indices;
    const std::size_t count = indices.size();
    for (std::size_t i = 0; i < count; ++i) {
      // The pieces of triangle i: the first replaces it, the others are appended.
      bool first = true;
      const float longest = model_.materials[model_.materialOf[i]].solid ? longest_.solid : longest_.leaves;
      todo.assign(1, indices[i]);
      while (!todo.empty()) {
        const Triangle triangle = todo.back();
        todo.pop_back();
        const std::size_t edge = longEdge(triangle, longest * longest);
        if (edge < 3) {
          const std::uint32_t middle = between(triangle[edge], triangle[(edge + 1) % 3]);
          todo.push_back({triangle[edge], middle, triangle[(edge + 2) % 3]});
          todo.push_back({middle, triangle[(edge + 1) % 3], triangle[(edge + 2) % 3]});
        } else if (first) {
          indices[i] = triangle;
          first = false;
        } else {
          indices.push_back(triangle);
          model_.materialOf.push_back(model_.materialOf[i]);
        }
      }
    }
  }

 private:
  /// The longest edge, from corner e to corner e + 1; 3 if no squared length exceeds `max`. Both triangles at an edge
  /// decide alike.
  [[nodiscard]] std::size_t longEdge(const Triangle& triangle, float max) const {
    std::size_t longest = 3;
    for (std::size_t e = 0; e < 3; ++e) {
      const Vec3 along = model_.triangles.positions[triangle[e]] - model_.triangles.positions[triangle[(e + 1) % 3]];
      const float squared = glm::dot(along, along);
      if (squared > max) {
        max = squared;
        longest = e;
      }
    }
    return longest;
  }

  std::uint32_t between(std::uint32_t a, std::uint32_t b) {
    const std::uint64_t key = std::uint64_t{std::min(a, b)} << 32U | std::max(a, b);
    const auto next = static_cast<std::uint32_t>(model_.triangles.positions.size());
    const auto [it, isNew] = middles_.try_emplace(key, next);
    if (isNew) {
      const auto mean = [&](auto& values) { values.push_back((values[a] + values[b]) * 0.5F); };
      mean(model_.triangles.positions);
      mean(model_.normals);
      model_.normals.back() = glm::normalize(model_.normals.back() + 1.0e-6F * model_.normals[a]);
      if (!model_.colours.empty()) mean(model_.colours);
      if (!model_.uvs.empty()) mean(model_.uvs);
    }
    return it->second;
  }

  models::Model& model_;
  LongestEdge longest_;
  std::unordered_map<std::uint64_t, std::uint32_t> middles_;
};

/// Only triangles with two sides: the winding of one-sided triangles defines their side, whatever their shading normals
/// are.
void windAroundNormals(models::Model& model) {
  const std::vector<Vec3>& p = model.triangles.positions;
  for (std::size_t i = 0; i < model.triangles.indices.size(); ++i) {
    if (!model.materials[model.materialOf[i]].twoSided) continue;
    Triangle& triangle = model.triangles.indices[i];
    const auto [a, b, c] = triangle;
    const Vec3 normal = model.normals[a] + model.normals[b] + model.normals[c];
    if (glm::dot(glm::cross(p[b] - p[a], p[c] - p[a]), normal) < 0.0F) std::swap(triangle[1], triangle[2]);
  }
}

}  // namespace

models::Model refined(models::Model model, const LongestEdge& longest) {
  Refiner(model, longest).run();
  windAroundNormals(model);
  return model;
}

}  // namespace grove::bake
