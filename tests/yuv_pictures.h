#pragma once

#include <memory>

#include "raster/yuv_image.h"

/// Pictures before and after they take the form in which encoders take them.
namespace grove::tests {

inline std::shared_ptr<const raster::YuvImage> yuvOf(const raster::Image& image) {
  raster::ImagePool pool;
  auto yuv = raster::acquireYuv(pool, image.rect);
  raster::toYuv(image, image.rect, *yuv);
  return yuv;
}

/// Its depths are undefined.
inline std::shared_ptr<const raster::Image> rgbaOf(const raster::YuvImage& yuv) {
  auto image = raster::ImagePool().acquire(yuv.rect);
  raster::toRgba(yuv, yuv.rect, *image);
  return image;
}

}  // namespace grove::tests
