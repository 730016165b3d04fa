#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/lightfield/common/lamps/lamps.h"
#include "objects/lightfield/format/view_camera.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// Adds the light of fires and lanterns to a picture, scaling what is there. Keeps `camera`, not the lamps.
class LampLight {
 public:
  LampLight(std::span<const world::PointLight> lamps, const ObjectCamera& camera);

  /// To a part of the picture whose rows are `stride` pixels apart. The smaller the part, the fewer lamps reach it.
  void addTo(const world::Rect& part, std::uint32_t* colour, const float* depth, std::ptrdiff_t stride) const;

  /// To all of it.
  void addTo(raster::Image& image) const;

 private:
  const ObjectCamera& camera_;
  std::array<world::PointLight, kMaxLamps> lamps_;
  std::size_t count_;
};

}  // namespace grove::objects::lightfield
