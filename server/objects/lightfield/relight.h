#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "objects/lightfield/format/view_camera.h"
#include "objects/lightfield/sun_grid.h"
#include "raster/image.h"
#include "world/light.h"

namespace grove::objects::lightfield {

inline constexpr std::size_t kMostLamps = 4;

/// The point lights that matter most to an object, in its own coordinates and metres.
[[nodiscard]] std::vector<world::PointLight> chooseLamps(std::span<const world::PointLight> lights,
                                                         const world::Bounds& worldBounds, const world::Mat4& toObject);

/// Gives a picture what its light field cannot know: the shadows that others cast on this object. It has the picture's
/// colours alone, not the surface behind them, so it scales what is there. Vectorised; any thread. `camera` is the one
/// that the image was made with.
void castShadows(const SunGrid& sun, const ObjectCamera& camera, raster::Image& image);

/// Adds the light of fires and lanterns in the same way. Keeps `camera`, not the lamps.
class LampLight {
 public:
  LampLight(std::span<const world::PointLight> lamps, const ObjectCamera& camera);

  /// To a part of the picture whose rows are `stride` pixels apart. The smaller the part, the fewer lamps reach it.
  void addTo(const world::Rect& part, std::uint32_t* colour, const float* depth, std::ptrdiff_t stride) const;

  /// To all of it.
  void addTo(raster::Image& image) const;

 private:
  const ObjectCamera& camera_;
  std::array<world::PointLight, kMostLamps> lamps_;
  std::size_t count_;
};

}  // namespace grove::objects::lightfield
