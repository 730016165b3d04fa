#include "objects/herd/frontend/herd_painter.h"

#include <cmath>
#include <functional>
#include <numeric>
#include <span>

#include "node/load_shedding.h"
#include "objects/herd/common/herd_name.h"
#include "objects/herd/frontend/body/deer_shape.h"

namespace grove::objects::herd {
namespace {

std::size_t bytesOf(const std::array<raster::LitSurface, kKinds>& deer) {
  return std::transform_reduce(deer.begin(), deer.end(), std::size_t{0}, std::plus(),
                               [](const raster::LitSurface& each) { return each.bytes(); });
}

/// Pixels by which a deer's level of detail may be off. Its parts hide most of each other's errors, and its coat hides
/// what remains.
constexpr float kAlways = 1.5F;

}  // namespace

HerdPainter::HerdPainter(const node::FrontendTools& tools)
    : workers_(tools.workers),
      deer_{makeDeer(Kind::kDoe), makeDeer(Kind::kBuck), makeDeer(Kind::kFawn)},
      renderer_(tools.images, {tools.memory, kTypeName}),
      held_(tools.memory, "surfaces", kTypeName, pipeline::Work::kAcrossUser, bytesOf(deer_)) {}

float HerdPainter::coarseness() const { return kAlways * std::sqrt(node::errorFactor(workers_.busyShare())); }

std::shared_ptr<const raster::Image> HerdPainter::paint(const raster::Drawing& drawing) {
  std::shared_ptr<raster::Image> image;
  renderer_.render(std::span(&drawing, 1), std::span(&image, 1));
  return image;
}

}  // namespace grove::objects::herd
