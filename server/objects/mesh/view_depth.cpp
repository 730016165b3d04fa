#include "objects/mesh/view_depth.h"

#include "world/camera.h"

namespace grove::objects::mesh {

void toViewDepth(std::span<float> depth, float nearDepth) noexcept {
  float* values = depth.data();
  const std::size_t count = depth.size();
  for (std::size_t i = 0; i < count; ++i) {
    values[i] = values[i] > 0.0F ? nearDepth / values[i] : world::kInfiniteDepth;
  }
}

}  // namespace grove::objects::mesh
