#pragma once

#include <vector>

#include "models/model.h"

/// Small models with known answers.
namespace grove::bake {

/// Index of a new material.
inline std::uint16_t addMaterial(models::Model& model, const models::Material& material) {
  model.materials.push_back(material);
  return static_cast<std::uint16_t>(model.materials.size() - 1);
}

/// A parallelogram from `corner` along two edges; its normal is their cross product. UVs from 0 to 1.
inline void addQuad(models::Model& model, world::Vec3 corner, world::Vec3 u, world::Vec3 v, std::uint16_t material) {
  const auto first = static_cast<std::uint32_t>(model.triangles.positions.size());
  for (const auto [s, t] : {std::array{0.0F, 0.0F}, {1.0F, 0.0F}, {1.0F, 1.0F}, {0.0F, 1.0F}}) {
    model.triangles.positions.push_back(corner + s * u + t * v);
    model.normals.push_back(glm::normalize(glm::cross(u, v)));
    model.uvs.emplace_back(s, t);
  }
  model.triangles.indices.push_back({first, first + 1, first + 2});
  model.triangles.indices.push_back({first, first + 2, first + 3});
  model.materialOf.insert(model.materialOf.end(), 2, material);
}

/// A closed box with normals outwards.
inline void addBox(models::Model& model, world::Vec3 low, world::Vec3 high, std::uint16_t material) {
  const world::Vec3 size = high - low;
  const world::Vec3 x(size.x, 0, 0);
  const world::Vec3 y(0, size.y, 0);
  const world::Vec3 z(0, 0, size.z);
  addQuad(model, low, y, x, material);
  addQuad(model, low, z, y, material);
  addQuad(model, low, x, z, material);
  addQuad(model, low + z, x, y, material);
  addQuad(model, low + x, y, z, material);
  addQuad(model, low + y, z, x, material);
}

inline models::Material whiteStone() { return {.name = "white", .albedo = world::Vec3(1.0F), .solid = true}; }

/// A post with a roof of leaves that leans to one side: something that looks different from all sides.
inline models::Model crookedTree() {
  models::Model model;
  model.name = "crooked tree";
  const std::uint16_t wood =
      addMaterial(model, {.name = "wood", .albedo = world::Vec3(0.3F, 0.2F, 0.1F), .solid = true});
  const std::uint16_t leaf = addMaterial(
      model,
      {.name = "leaf", .albedo = world::Vec3(0.1F, 0.3F, 0.05F), .transmittance = world::Vec3(0.1F, 0.3F, 0.02F)});
  addBox(model, {-0.1F, 0.0F, -0.1F}, {0.1F, 1.5F, 0.1F}, wood);
  for (int i = 0; i < 12; ++i) {
    const auto f = static_cast<float>(i);
    addQuad(model, {-0.6F + 0.1F * f, 1.2F + 0.05F * f, -0.4F + 0.03F * f}, {0.5F, 0.1F, 0.1F}, {0.1F, 0.3F, 0.5F},
            leaf);
  }
  return model;
}

}  // namespace grove::bake
