#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "objects/ground/common/ground_maps.h"
#include "objects/ground/frontend/frame.h"
#include "objects/ground/frontend/ground_light.h"
#include "raster/image.h"
#include "world/camera.h"
#include "world/light.h"

namespace grove::objects::ground {

/// A camera's view of the ground within `rect`, cropped to the rows below the horizon. Depth is the ground's, or less
/// where a blade of grass stands in front of it. Only the nearest eight lights count.
class GroundPicture {
 public:
  /// `maps` and `light` outlive the picture.
  GroundPicture(const GroundMaps& maps, const GroundLight& light, const world::Camera& camera, world::Rect rect,
                std::span<const world::PointLight> lights, raster::ImagePool& images);
  ~GroundPicture();
  GroundPicture(const GroundPicture&) = delete;
  GroundPicture& operator=(const GroundPicture&) = delete;

  /// Number of strips of the picture, side by side; 0 if nothing is below the horizon or the eye is not above the
  /// ground.
  [[nodiscard]] std::size_t parts() const noexcept { return parts_; }
  /// Paints one strip. Several threads may paint different strips at once.
  void paint(std::size_t part);

  /// Null if no ground is visible; complete after all parts are painted.
  [[nodiscard]] std::shared_ptr<const raster::Image> image() const noexcept { return image_; }

 private:
  class StripPainter;

  const GroundMaps& maps_;
  const GroundLight& light_;
  Frame frame_;
  std::vector<world::PointLight> lights_;
  std::shared_ptr<raster::Image> image_;
  int first_ = 0;   ///< farthest row that is painted
  int lowest_ = 0;  ///< nearest row whose grass may reach into the picture
  int firstColumn_ = 0;
  std::size_t parts_ = 0;
};

}  // namespace grove::objects::ground
