#include "objects/lightfield/bake/dense_view.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "world/camera.h"

namespace grove::bake {

using objects::lightfield::DenseView;
using objects::lightfield::kNoDepth;
using objects::lightfield::ViewCamera;

DenseView toDense(Picture picture, const ViewCamera& camera) {
  DenseView view;
  view.size = picture.size;
  view.colour = std::move(picture.colour);
  view.depth.reserve(picture.depth.size());
  const float scale = static_cast<float>(kNoDepth - 1) / (camera.farDepth - camera.nearDepth);
  for (const float depth : picture.depth) {
    const float step = std::clamp((depth - camera.nearDepth) * scale, 0.0F, static_cast<float>(kNoDepth - 1));
    view.depth.push_back(depth >= world::kInfiniteDepth ? kNoDepth : static_cast<std::uint16_t>(std::lround(step)));
  }
  return view;
}

}  // namespace grove::bake
