#pragma once

#include "raster/image.h"
#include "raster/soften_kernels.h"

namespace grove::raster {

/// Softens the colours of an image with one sample per pixel, against stairs and specks. Pixels beside the covered ones
/// become covered a little, with the nearest depth around. All of the image's pixels are defined.
void soften(Image& image, Softening softening);

}  // namespace grove::raster
