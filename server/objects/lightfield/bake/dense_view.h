#pragma once

#include "objects/lightfield/bake/view_renderer.h"
#include "objects/lightfield/file/view_packer.h"

namespace grove::bake {

/// Converts a picture to a light field's representation: depth in steps between the camera's nearest and farthest. Any
/// thread.
[[nodiscard]] objects::lightfield::DenseView toDense(Picture picture, const objects::lightfield::ViewCamera& camera);

}  // namespace grove::bake
