#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/lightfield/common/lamps/lamps.h"
#include "objects/lightfield/format/view_camera.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// Adds the light of fires and lanterns to a picture by scaling its colours. Keeps `camera`, not the lamps.
class LampLight {
 public:
  LampLight(std::span<const world::PointLight> lamps, const ObjectCamera& camera);

  /// Lights a part of the picture whose rows are `stride` pixels apart. Smaller parts have fewer lamps in reach.
  void addTo(const world::Rect& part, std::uint32_t* colour, const float* depth, std::ptrdiff_t stride) const;

  /// Lights the whole picture.
  void addTo(raster::Image& image) const;

 private:
  const ObjectCamera& camera_;
  std::array<world::PointLight, kMaxLamps> lamps_;
  std::size_t count_;
};

}  // namespace grove::objects::lightfield
