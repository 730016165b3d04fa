#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "objects/lightfield/format/near_model.h"
#include "world/geometry.h"

namespace grove::objects::lightfield {

/// A model of clusters that the test adds.
class Clusters {
 public:
  /// Leaves have a colour per face and side, smooth surfaces one per vertex.
  void add(const std::vector<world::Vec3>& vertices, const std::vector<NearFace>& faces, bool smooth,
           const std::vector<std::uint32_t>& fronts, const std::vector<std::uint32_t>& backs) {
    NearCluster cluster{.firstVertex = static_cast<std::uint32_t>(positions_[0].size()),
                        .vertices = static_cast<std::uint32_t>(vertices.size()),
                        .firstFace = static_cast<std::uint32_t>(faces_.size()),
                        .faces = static_cast<std::uint32_t>(faces.size()),
                        .firstColour = static_cast<std::uint32_t>(fronts_.size()),
                        .smooth = smooth ? 1U : 0U};
    world::Bounds bounds;
    for (const world::Vec3 vertex : vertices) bounds.add(vertex);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      cluster.low[a] = bounds.low[axis];
      cluster.high[a] = bounds.high[axis];
      for (const world::Vec3 vertex : vertices) positions_[a].push_back(vertex[axis]);
      while (positions_[a].size() % kClusterAlignment != 0) positions_[a].push_back(0.0F);
    }
    faces_.insert(faces_.end(), faces.begin(), faces.end());
    fronts_.insert(fronts_.end(), fronts.begin(), fronts.end());
    backs_.insert(backs_.end(), backs.begin(), backs.end());
    clusters_.push_back(cluster);
  }

  /// A parallelogram between three points of the picture, seen from its front.
  void addLeaf(world::Vec3 topLeft, world::Vec3 topRight, world::Vec3 bottomLeft, std::uint32_t front,
               std::uint32_t back = 0xFFFFFFFFU) {
    add({topLeft, topRight, bottomLeft, topRight + bottomLeft - topLeft}, {{0, 2, 3, 1}}, false, {front}, {back});
  }

  void setFirstVertex(world::Vec3 position) {
    for (int axis = 0; axis < 3; ++axis) positions_[static_cast<std::size_t>(axis)][0] = position[axis];
  }

  [[nodiscard]] NearModel model() {
    colours_ = fronts_;
    colours_.insert(colours_.end(), backs_.begin(), backs_.end());
    NearModel model{clusters_, {}, faces_, {colours_}};
    for (std::size_t axis = 0; axis < 3; ++axis) model.positions[axis] = positions_[axis];
    return model;
  }

 private:
  std::vector<NearCluster> clusters_;
  std::array<std::vector<float>, 3> positions_;
  std::vector<NearFace> faces_;
  std::vector<std::uint32_t> fronts_, backs_, colours_;
};

}  // namespace grove::objects::lightfield
