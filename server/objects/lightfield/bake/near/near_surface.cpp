#include "objects/lightfield/bake/near/near_surface.h"

#include <algorithm>
#include <array>
#include <span>
#include <unordered_map>

#include "objects/lightfield/bake/near/near_faces.h"
#include "world/light.h"

namespace grove::bake {

using objects::lightfield::kClusterAlignment;
using objects::lightfield::kMaxClusterFaces;
using objects::lightfield::kMaxClusterVertices;
using objects::lightfield::NearCluster;
using objects::lightfield::NearFace;
using objects::lightfield::NearModel;
using world::Vec3;

namespace {

/// Larger models cost more than their views, even from near.
constexpr std::size_t kMaxTriangles = 1'000'000;

class Builder {
 public:
  Builder(const models::Model& model, const LightPoints& points, const SurfaceLight& light)
      : model_(model), points_(points), light_(light), lightings_(light.stride() / 3) {}

  [[nodiscard]] NearSurface build() {
    fronts_.resize(lightings_);
    backs_.resize(lightings_);
    for (const ModelFace& face : sortedFaces()) add(face);
    finish();
    for (std::size_t k = 0; k < lightings_; ++k) {
      std::vector<std::uint32_t>& colours = result_.colours.emplace_back(std::move(fronts_[k]));
      colours.insert(colours.end(), backs_[k].begin(), backs_[k].end());
    }
    return std::move(result_);
  }

 private:
  /// Leaves after wood; both in the order of the light points, which follows a space-filling curve.
  [[nodiscard]] std::vector<ModelFace> sortedFaces() const {
    std::vector<ModelFace> faces = facesOf(model_);
    std::ranges::stable_sort(faces, {}, [&](const ModelFace& face) {
      return std::pair(!isSmooth(face), points_.ofVertex[face.corners[0]]);
    });
    return faces;
  }

  [[nodiscard]] bool isSmooth(const ModelFace& face) const { return model_.materials[face.material].solid; }

  void add(const ModelFace& face) {
    const bool smooth = isSmooth(face);
    const auto added = std::ranges::count_if(face.corners, [&](std::uint32_t v) { return !indices_.contains(v); });
    const bool isFull =
        cluster_.vertices + static_cast<std::size_t>(added) > kMaxClusterVertices || cluster_.faces == kMaxClusterFaces;
    if (isFull || (cluster_.faces > 0 && smooth != (cluster_.smooth != 0))) finish();
    cluster_.smooth = smooth ? 1 : 0;
    NearFace local{};
    for (std::size_t i = 0; i < 4; ++i) local[i] = indexOf(face.corners[i], face.material);
    result_.faces.push_back(local);
    ++cluster_.faces;
    if (!smooth) addColours(face.material, std::span(face.corners).first(face.isTriangle() ? 3 : 4));
  }

  /// The vertex's index in the current cluster, to which it is added if necessary.
  std::uint8_t indexOf(std::uint32_t vertex, std::uint16_t material) {
    const auto [it, isNew] = indices_.try_emplace(vertex, static_cast<std::uint8_t>(cluster_.vertices));
    if (!isNew) return it->second;
    const Vec3 position = model_.triangles.positions[vertex];
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      result_.positions[a].push_back(position[axis]);
      cluster_.low[a] = cluster_.vertices == 0 ? position[axis] : std::min(cluster_.low[a], position[axis]);
      cluster_.high[a] = cluster_.vertices == 0 ? position[axis] : std::max(cluster_.high[a], position[axis]);
    }
    ++cluster_.vertices;
    if (cluster_.smooth != 0) addColours(material, std::array{vertex});
    return it->second;
  }

  /// Adds the mean colour at some vertices, for each lighting and side.
  void addColours(std::uint16_t materialIndex, std::span<const std::uint32_t> vertices) {
    const models::Material& material = model_.materials[materialIndex];
    const std::size_t stride = light_.stride();
    for (std::size_t k = 0; k < lightings_; ++k) {
      Vec3 front(0.0F);
      Vec3 back(0.0F);
      for (const std::uint32_t vertex : vertices) {
        const std::span<const float> arriving = light_.at(points_.ofVertex[vertex]);
        const auto side = [&](std::size_t from) {
          return Vec3(arriving[from], arriving[from + 1], arriving[from + 2]);
        };
        const Vec3 before = side(3 * k);
        const Vec3 behind = side(stride + 3 * k);
        const Vec3 tint = model_.colours.empty() ? Vec3(1.0F) : model_.colours[vertex];
        front += tint * (material.albedo * before + material.transmittance * behind);
        back += tint * (material.albedo * behind + material.transmittance * before);
      }
      fronts_[k].push_back(world::toDisplayRgba(front / static_cast<float>(vertices.size())));
      backs_[k].push_back(world::toDisplayRgba(back / static_cast<float>(vertices.size())));
    }
  }

  /// Ends the current cluster, if there is one, and begins the next.
  void finish() {
    if (cluster_.faces > 0) result_.clusters.push_back(cluster_);
    for (std::vector<float>& axis : result_.positions) {
      axis.resize((axis.size() + kClusterAlignment - 1) / kClusterAlignment * kClusterAlignment, 0.0F);
    }
    indices_.clear();
    cluster_ = {.firstVertex = static_cast<std::uint32_t>(result_.positions[0].size()),
                .firstFace = static_cast<std::uint32_t>(result_.faces.size()),
                .firstColour = static_cast<std::uint32_t>(fronts_[0].size())};
  }

  const models::Model& model_;
  const LightPoints& points_;
  const SurfaceLight& light_;
  const std::size_t lightings_;
  NearSurface result_;
  NearCluster cluster_;
  std::unordered_map<std::uint32_t, std::uint8_t> indices_;  ///< of the current cluster's vertices
  std::vector<std::vector<std::uint32_t>> fronts_;           ///< by lighting
  std::vector<std::vector<std::uint32_t>> backs_;
};

}  // namespace

NearModel NearSurface::model() const {
  NearModel model;
  model.clusters = clusters;
  for (std::size_t axis = 0; axis < 3; ++axis) model.positions[axis] = positions[axis];
  model.faces = faces;
  model.colours.assign(colours.begin(), colours.end());
  return model;
}

NearSurface makeNearSurface(const models::Model& model, const LightPoints& points, const SurfaceLight& light) {
  if (!model.textures.empty() || model.triangles.indices.size() > kMaxTriangles) return {};
  return Builder(model, points, light).build();
}

}  // namespace grove::bake
