#include "objects/lightfield/frontend/reprojection/reprojection_tile.h"

namespace grove::objects::lightfield {

ViewWarp::ViewWarp(const CachedView& view, const ObjectCamera& camera) {
  const ObjectCamera& own = view.camera();
  const world::Vec3 corner =
      own.corner + static_cast<float>(view.left()) * own.perColumn + static_cast<float>(view.top()) * own.perRow;
  const glm::dmat3 inverse = glm::inverse(glm::dmat3(own.perColumn, own.perRow, corner));
  k = inverse * glm::dvec3(camera.corner);
  kPerColumn = inverse * glm::dvec3(camera.perColumn);
  kPerRow = inverse * glm::dvec3(camera.perRow);
  m = inverse * (glm::dvec3(camera.eye) - glm::dvec3(own.eye));
}

}  // namespace grove::objects::lightfield
