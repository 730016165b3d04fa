#include "objects/mesh/backend/shapes/holes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "base/name_list.h"

namespace grove::objects::mesh {
namespace {

using models::Material;
using models::Model;
using world::Vec2;
using world::Vec3;

constexpr float kTexelsAPiece = 2.0F;
constexpr int kMaxParts = 64;    // along a triangle's edge
constexpr int kMinParts = 4;     // with fewer, a leaf loses its shape
constexpr float kFaint = 0.1F;   // alpha above which blended parts are visible
constexpr float kEnough = 0.5F;  // of a piece's samples

bool isPierced(const Model& model, std::size_t triangle) {
  const Material& material = model.materials[model.materialOf[triangle]];
  return material.alphaCutoff > 0.0F && material.texture >= 0 && !model.uvs.empty();
}

const models::Texture& textureOf(const Model& model, std::size_t triangle) {
  return model.textures[static_cast<std::size_t>(model.materials[model.materialOf[triangle]].texture)];
}

/// Parts of the triangle's edges that give a piece kTexelsAPiece.
float wantedParts(const Model& model, std::size_t triangle) {
  const models::Texture& texture = textureOf(model, triangle);
  const Vec2 size(texture.width, texture.height);
  const auto [a, b, c] = model.triangles.indices[triangle];
  const auto texels = [&](std::uint32_t from, std::uint32_t to) {
    return glm::length((model.uvs[to] - model.uvs[from]) * size);
  };
  const float parts = std::max({texels(a, b), texels(b, c), texels(c, a)}) / kTexelsAPiece;
  return std::clamp(std::ceil(parts), static_cast<float>(kMinParts), static_cast<float>(kMaxParts));
}

/// Cuts triangles and adds the pieces to the model.
class Cutter {
 public:
  explicit Cutter(Model& model) : model_(model) {}

  void cut(std::size_t triangle, int parts) {
    corners_ = model_.triangles.indices[triangle];
    material_ = model_.materialOf[triangle];
    parts_ = parts;
    const std::size_t side = static_cast<std::size_t>(parts) + 1;
    made_.assign(side * side, kNone);
    const Material& material = model_.materials[material_];
    const float min = material.blended ? kFaint * material.alphaCutoff : material.alphaCutoff;
    const models::Texture& texture = textureOf(model_, triangle);
    for (int row = 0; row < parts; ++row) {
      for (int column = 0; row + column < parts; ++column) {
        keep({Place{column, row}, {column + 1, row}, {column, row + 1}}, texture, min);
        if (row + column + 1 == parts) continue;
        keep({Place{column + 1, row}, {column + 1, row + 1}, {column, row + 1}}, texture, min);
      }
    }
  }

 private:
  /// A point of the triangle, in parts from its first corner towards the other two.
  struct Place {
    int column = 0;
    int row = 0;
  };
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  /// Interpolates a corner value with shares towards the second and the third corner.
  template <class T>
  [[nodiscard]] T mixed(const std::vector<T>& values, float second, float third) const {
    return values[corners_[0]] * (1.0F - second - third) + values[corners_[1]] * second + values[corners_[2]] * third;
  }

  void keep(const std::array<Place, 3>& piece, const models::Texture& texture, float min) {
    // Samples the centre and the points halfway from it to the corners.
    Vec2 middle(0.0F);
    for (const Place& place : piece) middle += Vec2(place.column, place.row) / 3.0F;
    const auto isSeen = [&](Vec2 place) {
      const Vec2 share = place / static_cast<float>(parts_);
      return static_cast<float>(texture.at(mixed(model_.uvs, share.x, share.y)) >> 24U) / 255.0F >= min;
    };
    int seen = isSeen(middle) ? 1 : 0;
    for (const Place& place : piece) seen += isSeen((middle + Vec2(place.column, place.row)) * 0.5F) ? 1 : 0;
    if (static_cast<float>(seen) < kEnough * 4.0F) return;
    model_.triangles.indices.push_back({vertex(piece[0]), vertex(piece[1]), vertex(piece[2])});
    model_.materialOf.push_back(material_);
  }

  std::uint32_t vertex(const Place& place) {
    const std::size_t side = static_cast<std::size_t>(parts_) + 1;
    std::uint32_t& made = made_[static_cast<std::size_t>(place.row) * side + static_cast<std::size_t>(place.column)];
    if (made != kNone) return made;
    made = static_cast<std::uint32_t>(model_.triangles.positions.size());
    const float second = static_cast<float>(place.column) / static_cast<float>(parts_);
    const float third = static_cast<float>(place.row) / static_cast<float>(parts_);
    model_.triangles.positions.push_back(mixed(model_.triangles.positions, second, third));
    const Vec3 normal = mixed(model_.normals, second, third);
    const float length = glm::length(normal);
    model_.normals.push_back(length > 0.0F ? normal / length : model_.normals[corners_[0]]);
    model_.uvs.push_back(mixed(model_.uvs, second, third));
    if (!model_.colours.empty()) model_.colours.push_back(mixed(model_.colours, second, third));
    return made;
  }

  Model& model_;
  std::array<std::uint32_t, 3> corners_{};
  std::uint16_t material_ = 0;
  int parts_ = 1;
  std::vector<std::uint32_t> made_;  ///< vertices of the triangle by their place
};

void logUnshownHoles(const Model& model, bool cut) {
  std::set<std::string> blended;
  std::set<std::string> uncut;
  for (const std::uint16_t used : std::set(model.materialOf.begin(), model.materialOf.end())) {
    const Material& material = model.materials[used];
    if (material.blended) blended.insert("'" + material.name + "'");
    if (!cut && !material.blended && material.alphaCutoff > 0.0F) uncut.insert("'" + material.name + "'");
  }
  const auto name = [&](const std::set<std::string>& names, const char* reason) {
    if (names.empty()) return;
    log::warning(model.name + ": as a mesh, " + nameList({names.begin(), names.end()}) + reason +
                 "; a light field shows it");
  };
  name(blended, " is solid where it blends");
  name(uncut, " is drawn without its holes because there are too many");
}

}  // namespace

Model withHolesCut(Model model) {
  std::vector<std::size_t> pierced;
  double pieces = 0.0;
  for (std::size_t i = 0; i < model.triangles.indices.size(); ++i) {
    if (!isPierced(model, i)) continue;
    pierced.push_back(i);
    pieces += std::pow(static_cast<double>(wantedParts(model, i)), 2.0);
  }
  const bool cut = pierced.size() * kMinParts * kMinParts <= kMaxPieces;
  logUnshownHoles(model, cut);
  if (!cut || pierced.empty()) return model;

  const float share = static_cast<float>(std::min(1.0, std::sqrt(static_cast<double>(kMaxPieces) / pieces)));
  Cutter cutter(model);
  for (const std::size_t i : pierced) {
    cutter.cut(i, std::max(kMinParts, static_cast<int>(wantedParts(model, i) * share)));
  }
  std::size_t kept = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < model.triangles.indices.size(); ++i) {
    if (next < pierced.size() && pierced[next] == i) {
      ++next;
      continue;
    }
    model.triangles.indices[kept] = model.triangles.indices[i];
    model.materialOf[kept++] = model.materialOf[i];
  }
  model.triangles.indices.resize(kept);
  model.materialOf.resize(kept);
  return model;
}

}  // namespace grove::objects::mesh
