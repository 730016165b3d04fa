#include "objects/mesh/backend/shapes/model_surface.h"

#include <cmath>
#include <map>
#include <tuple>

namespace grove::objects::mesh {
namespace {

using world::Vec3;

float linear(std::uint32_t byte) { return std::pow(static_cast<float>(byte) / 255.0F, 2.2F); }

Vec3 colourOf(std::uint32_t texel) {
  return {linear(texel & 0xFFU), linear(texel >> 8U & 0xFFU), linear(texel >> 16U & 0xFFU)};
}

Vec3 albedoOf(const models::Model& model, const models::Material& material, std::uint32_t vertex) {
  // A leaf also shows transmitted light: a mesh's light covers one side only.
  Vec3 albedo = material.albedo + 0.5F * material.transmittance;
  if (!model.colours.empty()) albedo *= model.colours[vertex];
  if (material.texture >= 0 && !model.uvs.empty()) {
    albedo *= colourOf(model.textures[static_cast<std::size_t>(material.texture)].at(model.uvs[vertex]));
  }
  return albedo;
}

}  // namespace

raster::Surface surfaceOf(const models::Model& model) {
  raster::Surface surface;
  raster::Level& level = surface.levels.emplace_back();
  std::map<std::tuple<std::uint32_t, std::uint16_t, bool>, std::uint32_t> known;
  const auto corner = [&](std::uint32_t vertex, std::uint16_t material, bool back) {
    const auto [it, isNew] =
        known.try_emplace({vertex, material, back}, static_cast<std::uint32_t>(surface.vertices.size()));
    if (isNew) {
      raster::Vertex& made = surface.vertices.emplace_back();
      made.position = model.triangles.positions[vertex];
      made.normal = back ? -model.normals[vertex] : model.normals[vertex];
      made.albedo = albedoOf(model, model.materials[material], vertex);
    }
    return it->second;
  };
  for (std::size_t i = 0; i < model.triangles.indices.size(); ++i) {
    const auto& [a, b, c] = model.triangles.indices[i];
    const std::uint16_t material = model.materialOf[i];
    level.triangles.push_back({corner(a, material, false), corner(b, material, false), corner(c, material, false)});
    if (!model.materials[material].twoSided) continue;
    level.triangles.push_back({corner(c, material, true), corner(b, material, true), corner(a, material, true)});
  }
  level.vertexCount = surface.vertices.size();
  return surface;
}

world::Triangles solidOf(const models::Model& model) {
  world::Triangles solid;
  for (std::size_t i = 0; i < model.triangles.indices.size(); ++i) {
    if (model.materials[model.materialOf[i]].solid) solid.indices.push_back(model.triangles.indices[i]);
  }
  if (!solid.indices.empty()) solid.positions = model.triangles.positions;
  return solid;
}

}  // namespace grove::objects::mesh
