#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "world/geometry.h"

namespace grove::models {

/// RGBA8 (bytes R, G, B, A), rows from the top, not premultiplied; sRGB-encoded colour.
struct Texture {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> texels;

  /// The nearest texel, repeated; the first of a row or column for coordinates that are not finite. The texture must
  /// not be empty.
  [[nodiscard]] std::uint32_t at(world::Vec2 uv) const {
    const auto index = [](float along, int size) {
      const float place = (along - std::floor(along)) * static_cast<float>(size);
      return place > 0.0F ? static_cast<std::size_t>(std::min(static_cast<int>(place), size - 1)) : 0;
    };
    return texels[index(uv.y, height) * static_cast<std::size_t>(width) + index(uv.x, width)];
  }
};

/// Optical properties of a surface: diffuse reflection on the lit side, and diffuse transmission to the other side of
/// leaves.
struct Material {
  std::string name;
  /// Shares of light that the lit side reflects and that passes through from behind: diffuse, linear. Vertex colour and
  /// texture multiply both.
  world::Vec3 albedo{0.5F};
  world::Vec3 transmittance{0.0F};
  bool twoSided = true;      ///< else viewers see through its back; it casts shade all the same
  bool solid = false;        ///< blocks smoke (wood, stone); else leaves
  int texture = -1;          ///< index into Model::textures, -1: none
  float alphaCutoff = 0.0F;  ///< texels with less alpha are holes; 0: no holes
  /// Each ray has a random cut-off, 0 to alphaCutoff, so that part of the rays pass. Without a texture, alpha is 1.
  bool blended = false;
};

/// The input of a bake: triangles in metres, Y up, standing on y = 0 around the origin.
struct Model {
  std::string name;
  world::Triangles triangles;
  std::vector<world::Vec3> normals;       ///< unit, per vertex
  std::vector<world::Vec3> colours;       ///< linear, per vertex; empty: white
  std::vector<world::Vec2> uvs;           ///< per vertex; empty: no textures
  std::vector<std::uint16_t> materialOf;  ///< per triangle
  std::vector<Material> materials;
  std::vector<Texture> textures;
};

}  // namespace grove::models
