#include "objects/herd/frontend/herd_painter.h"

#include <functional>
#include <numeric>
#include <span>

#include "objects/herd/common/herd_name.h"
#include "objects/herd/frontend/deer_shape.h"

namespace grove::objects::herd {
namespace {

std::size_t bytesOf(const std::array<raster::LitSurface, kKinds>& deer) {
  return std::transform_reduce(deer.begin(), deer.end(), std::size_t{0}, std::plus(),
                               [](const raster::LitSurface& each) { return each.bytes(); });
}

}  // namespace

HerdPainter::HerdPainter(const node::FrontendTools& tools)
    : deer_{makeDeer(Kind::kDoe), makeDeer(Kind::kBuck), makeDeer(Kind::kFawn)},
      renderer_(tools.images, {tools.memory, kTypeName}),
      held_(tools.memory, "surfaces", kTypeName, pipeline::Work::kAcrossUser, bytesOf(deer_)) {}

std::shared_ptr<const raster::Image> HerdPainter::paint(const raster::Drawing& drawing) {
  std::shared_ptr<raster::Image> image;
  renderer_.render(std::span(&drawing, 1), std::span(&image, 1));
  return image;
}

}  // namespace grove::objects::herd
