#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "node/frontend/backdrops/backdrop.h"
#include "node/frontend/backdrops/backdrop_area.h"

/// Backdrops that are drawn by a function.
namespace grove::node::testing {

inline world::Camera cameraOf(int width, int height) {
  world::Camera camera;
  camera.width = width;
  camera.height = height;
  return camera;
}

inline View viewOf(const world::Camera& camera) {
  View view;
  view.frame = 1;
  view.camera = camera;
  return view;
}

struct Pixel {
  std::uint32_t colour = 0;
  float depth = world::kInfiniteDepth;
};

/// What a ray of one metre of view depth meets.
using Painter = std::function<Pixel(const world::Camera& camera, world::Vec3 ray)>;

inline std::shared_ptr<raster::Image> paint(const Painter& painter, const world::Camera& camera,
                                            const world::Rect& area) {
  const auto image = raster::ImagePool().acquire(area);
  for (int y = 0; y < image->height(); ++y) {
    for (int x = 0; x < image->width(); ++x) {
      const auto at = [](int place, int edge) { return static_cast<float>(place + edge) + 0.5F; };
      const Pixel pixel = painter(camera, camera.ray(at(x, area.left), at(y, area.top)));
      image->colourRow(y)[x] = pixel.colour;
      image->depthRow(y)[x] = pixel.depth;
    }
  }
  return image;
}

/// As if the frame of `origin` had drawn `image`.
inline std::shared_ptr<const Backdrop> backdropOf(const std::shared_ptr<const raster::Image>& image,
                                                  Backdrop::Origin origin) {
  raster::ImagePool pool;
  BackdropDepths depths(image->rect, pool);
  depths.measure(*image);
  auto colours = raster::acquireSemiPlanar(pool, image->rect);
  raster::toSemiPlanar(*image, *colours);
  return std::make_shared<const Backdrop>(std::move(colours), std::move(depths), std::move(origin));
}

/// Of an area that holds `area`.
inline std::shared_ptr<const Backdrop> backdropOf(const Painter& painter, const world::Camera& camera,
                                                  const world::Rect& area) {
  return backdropOf(paint(painter, camera, wholeCells(area)), {std::make_shared<const View>(viewOf(camera)), 1});
}

}  // namespace grove::node::testing
