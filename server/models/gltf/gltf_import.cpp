#include "models/gltf/gltf_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "base/log.h"
#include "base/name_list.h"
#include "models/gltf/gltf_accessor.h"
#include "models/gltf/gltf_file.h"
#include "models/gltf/gltf_materials.h"
#include "models/gltf/gltf_nodes.h"
#include "models/gltf/gltf_texture_placement.h"

namespace grove::models {
namespace {

using world::Mat4;
using world::Vec2;
using world::Vec3;
using Triangle = std::array<std::uint32_t, 3>;

/// Triangles of a list, strip or fan of vertices, without a strip's degenerate ones.
std::vector<Triangle> trianglesOf(const std::vector<std::uint32_t>& order, int mode) {
  std::vector<Triangle> triangles;
  const std::size_t step = mode == TINYGLTF_MODE_TRIANGLES ? 3 : 1;
  for (std::size_t i = 0; i + 2 < order.size(); i += step) {
    Triangle triangle{order[i], order[i + 1], order[i + 2]};
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP && i % 2 == 1) std::swap(triangle[1], triangle[2]);
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) triangle[0] = order[0];
    const auto [a, b, c] = triangle;
    if (a != b && b != c && c != a) triangles.push_back(triangle);
  }
  return triangles;
}

/// Unit normals of vertices from the adjacent triangles, weighted by area.
std::vector<Vec3> meanNormals(const std::vector<Vec3>& positions, const std::vector<Triangle>& triangles) {
  std::vector<Vec3> normals(positions.size(), Vec3(0.0F));
  for (const auto& [a, b, c] : triangles) {
    const Vec3 normal = glm::cross(positions[b] - positions[a], positions[c] - positions[a]);
    for (const auto corner : {a, b, c}) normals[corner] += normal;
  }
  return normals;
}

Vec3 unitOrUp(Vec3 v) {
  const float length = glm::length(v);
  return length > 0.0F && std::isfinite(length) ? v / length : Vec3(0, 1, 0);
}

int modeOf(const tinygltf::Primitive& primitive) {
  return primitive.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive.mode;
}

/// For a message about materials.
std::string quoted(const std::set<std::string>& names) {
  std::vector<std::string> list;
  list.reserve(names.size());
  for (const std::string& name : names) list.push_back("'" + name + "'");
  return nameList(list);
}

class Importer {
 public:
  explicit Importer(const std::filesystem::path& path) : file_(loadGltfFile(path)) {
    model_.name = path.stem().string();
    model_.materials = readMaterials(file_, model_.textures);
    untextured_.resize(model_.materials.size());
  }

  Model run() {
    const std::vector<MeshInstance> instances = meshInstances(file_);
    checkSize(instances);
    for (const MeshInstance& instance : instances) {
      for (const tinygltf::Primitive& primitive : file_.at(file_.document.meshes, instance.mesh, "mesh").primitives) {
        if (modeOf(primitive) >= TINYGLTF_MODE_TRIANGLES) add(primitive, instance.matrix);
      }
    }
    logIgnoredAlpha();
    if (model_.triangles.indices.empty()) file_.fail("has no triangles");
    stand();
    return std::move(model_);
  }

 private:
  /// Rejects oversized models before they take memory or time: a small file may repeat a mesh many times.
  void checkSize(const std::vector<MeshInstance>& instances) const {
    std::size_t visits = 0;
    std::size_t corners = 0;
    for (const MeshInstance& instance : instances) {
      const tinygltf::Mesh& mesh = file_.at(file_.document.meshes, instance.mesh, "mesh");
      visits += mesh.primitives.size();
      if (visits > kMaxPrimitives) file_.fail("has more than " + std::to_string(kMaxPrimitives) + " primitives");
      for (const tinygltf::Primitive& primitive : mesh.primitives) {
        if (modeOf(primitive) >= TINYGLTF_MODE_TRIANGLES) corners += cornersOf(primitive);
        if (corners > 3 * kMaxTriangles) file_.fail("has more than " + std::to_string(kMaxTriangles) + " triangles");
      }
    }
  }

  /// Upper bound of the numbers of vertices and of triangle corners.
  [[nodiscard]] std::size_t cornersOf(const tinygltf::Primitive& primitive) const {
    const auto positions = primitive.attributes.find("POSITION");
    if (positions == primitive.attributes.end()) return 0;
    const std::size_t vertices = file_.at(file_.document.accessors, positions->second, "accessor").count;
    const std::size_t order =
        primitive.indices < 0 ? vertices : file_.at(file_.document.accessors, primitive.indices, "accessor").count;
    for (const std::size_t count : {vertices, order}) {
      if (count > 3 * kMaxTriangles) file_.fail("has an accessor of " + std::to_string(count) + " elements");
    }
    return std::max(vertices, modeOf(primitive) == TINYGLTF_MODE_TRIANGLES ? order : 3 * order);
  }

  /// An attribute with one element per position and an allowed width.
  std::optional<Elements> attribute(const tinygltf::Primitive& primitive, const std::string& name, std::size_t count,
                                    std::size_t min, std::size_t max) const {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return {};
    // Checked before reading: it may have millions of elements for three positions.
    if (count > 0 && file_.at(file_.document.accessors, found->second, "accessor").count != count) {
      file_.fail(name + " and POSITION have different numbers of elements");
    }
    Elements elements = readElements(file_, found->second);
    if (elements.width < min || elements.width > max) file_.fail(name + " has vectors of the wrong length");
    return elements;
  }

  void add(const tinygltf::Primitive& primitive, const Mat4& matrix) {
    const tinygltf::Material* const given =
        primitive.material < 0 ? nullptr : &file_.at(file_.document.materials, primitive.material, "material");
    if (given != nullptr && isUnseen(*given)) {
      unseen_.insert(given->name);
      return;
    }
    const auto positions = attribute(primitive, "POSITION", 0, 3, 3);
    if (!positions || positions->size() == 0) return;
    const std::size_t count = positions->size();
    const std::vector<Triangle> triangles = trianglesOf(orderOf(primitive, count), modeOf(primitive));
    if (triangles.empty()) return;
    std::vector<Vec3> placed(count);
    for (std::size_t i = 0; i < count; ++i) {
      const float* const p = positions->at(i);
      placed[i] = Vec3(matrix * world::Vec4(p[0], p[1], p[2], 1.0F));
      if (!std::isfinite(placed[i].x + placed[i].y + placed[i].z)) file_.fail("has positions that are not finite");
    }
    addNormals(primitive, matrix, placed, triangles);
    addColours(primitive, given, count);
    const std::uint16_t material = materialFor(primitive, addUvs(primitive, given, count));
    const auto first = static_cast<std::uint32_t>(model_.triangles.positions.size());
    model_.triangles.positions.insert(model_.triangles.positions.end(), placed.begin(), placed.end());
    // A mirrored mesh turns its triangles inside out.
    const bool mirrored = glm::determinant(glm::mat3(matrix)) < 0.0F;
    for (auto [a, b, c] : triangles) {
      if (mirrored) std::swap(b, c);
      model_.triangles.indices.push_back({first + a, first + b, first + c});
    }
    model_.materialOf.insert(model_.materialOf.end(), triangles.size(), material);
  }

  /// The vertices of the triangles, in order.
  std::vector<std::uint32_t> orderOf(const tinygltf::Primitive& primitive, std::size_t count) const {
    if (primitive.indices >= 0) {
      std::vector<std::uint32_t> order = readIndices(file_, primitive.indices);
      const auto highest = std::ranges::max_element(order);
      if (highest != order.end() && *highest >= count) {
        file_.fail("index " + std::to_string(*highest) + " is beyond the " + std::to_string(count) + " vertices");
      }
      return order;
    }
    std::vector<std::uint32_t> order(count);
    for (std::size_t i = 0; i < count; ++i) order[i] = static_cast<std::uint32_t>(i);
    return order;
  }

  void addNormals(const tinygltf::Primitive& primitive, const Mat4& matrix, const std::vector<Vec3>& placed,
                  const std::vector<Triangle>& triangles) {
    const std::size_t count = placed.size();
    if (const auto normals = attribute(primitive, "NORMAL", count, 3, 3)) {
      const glm::mat3 turn = glm::transpose(glm::inverse(glm::mat3(matrix)));
      for (std::size_t i = 0; i < count; ++i) {
        const float* const n = normals->at(i);
        model_.normals.push_back(unitOrUp(turn * Vec3(n[0], n[1], n[2])));
      }
    } else {
      const float side = glm::determinant(glm::mat3(matrix)) < 0.0F ? -1.0F : 1.0F;
      for (const Vec3 normal : meanNormals(placed, triangles)) model_.normals.push_back(unitOrUp(side * normal));
    }
  }

  void addColours(const tinygltf::Primitive& primitive, const tinygltf::Material* material, std::size_t count) {
    const auto colours = attribute(primitive, "COLOR_0", count, 3, 4);
    const bool alphaCounts = colours && colours->width == 4 && material != nullptr && material->alphaMode != "OPAQUE";
    bool losesAlpha = false;
    for (std::size_t i = 0; i < count; ++i) {
      const float* const c = colours ? colours->at(i) : nullptr;
      losesAlpha = losesAlpha || (alphaCounts && c[3] < 1.0F);
      model_.colours.push_back(c == nullptr ? Vec3(1.0F) : glm::clamp(Vec3(c[0], c[1], c[2]), 0.0F, 1.0F));
    }
    if (losesAlpha) withoutColourAlpha_.insert(material->name);
  }

  /// Returns whether the primitive has UVs.
  bool addUvs(const tinygltf::Primitive& primitive, const tinygltf::Material* material, std::size_t count) {
    const TexturePlacement placement =
        material == nullptr ? TexturePlacement() : placementOf(file_, material->pbrMetallicRoughness.baseColorTexture);
    const auto uvs = attribute(primitive, "TEXCOORD_" + std::to_string(placement.uvSet), count, 2, 2);
    for (std::size_t i = 0; i < count; ++i) {
      const Vec2 uv = uvs ? placement.apply({uvs->at(i)[0], uvs->at(i)[1]}) : Vec2(0.0F);
      const float max = std::max(std::abs(uv.x), std::abs(uv.y));
      if (!std::isfinite(uv.x + uv.y) || max > kMaxUv) {
        file_.fail("has UVs beyond " + std::to_string(static_cast<int>(kMaxUv)));
      }
      model_.uvs.push_back(uv);
    }
    return uvs.has_value();
  }

  /// The primitive's material, without its texture if the primitive has no UVs.
  std::uint16_t materialFor(const tinygltf::Primitive& primitive, bool hasUvs) {
    const std::size_t given =
        primitive.material < 0 ? untextured_.size() - 1 : static_cast<std::size_t>(primitive.material);
    if (hasUvs || model_.materials[given].texture < 0) return static_cast<std::uint16_t>(given);
    if (!untextured_[given]) {
      if (model_.materials.size() > std::numeric_limits<std::uint16_t>::max()) file_.fail("has too many materials");
      untextured_[given] = static_cast<std::uint16_t>(model_.materials.size());
      model_.materials.push_back(withoutTexture(model_.materials[given]));
    }
    return *untextured_[given];
  }

  void logIgnoredAlpha() const {
    const std::string file = file_.path.string() + ": ";
    if (!unseen_.empty()) {
      log::warning(file + "ignores " + quoted(unseen_) + ": alpha is zero or below the cut-off");
    }
    if (!withoutColourAlpha_.empty()) {
      log::warning(file + "ignores the alpha of the vertex colours of " + quoted(withoutColourAlpha_));
    }
  }

  /// Moves the model onto y = 0 around the origin.
  void stand() {
    const world::Bounds bounds = model_.triangles.bounds();
    const Vec3 size = bounds.size();
    const float extent = std::max({size.x, size.y, size.z});
    if (!std::isfinite(extent)) file_.fail("is too large for floats");
    if (extent <= 0.0F) file_.fail("has no extent: all its points are in one place");
    if (extent < kMinMetres || extent > kMaxMetres) {
      std::ostringstream reason;
      reason << "is " << extent << " m large, and " << kMinMetres << " to " << kMaxMetres
             << " m can be shown; a glTF file's unit is the metre: scale it when it is exported";
      file_.fail(reason.str());
    }
    const Vec3 shift(bounds.centre().x, bounds.low.y, bounds.centre().z);
    for (Vec3& position : model_.triangles.positions) position -= shift;
  }

  const GltfFile file_;
  Model model_;
  std::vector<std::optional<std::uint16_t>> untextured_;  ///< untextured copies of the file's materials, made on demand
  std::set<std::string> unseen_;                          ///< materials that alpha makes invisible
  std::set<std::string> withoutColourAlpha_;
};

}  // namespace

Model importGltf(const std::filesystem::path& file) { return Importer(file).run(); }

}  // namespace grove::models
