#include <cmath>

#include "node/messages/packing/packing.h"
#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/packed_camera.h"
#include "objects/lightfield/common/view_cell.h"

namespace grove::objects::lightfield {
namespace {

constexpr int kMaxEdge = kMaxCellSize + 2 * CachedView::kBorder;
constexpr int kMaxOffset = 1 << 20;

}  // namespace

node::PackedBytes CachedView::pack() const {
  node::PackWriter writer;
  putCamera(writer, camera_);
  writer.put(left_).put(top_).put(width_).put(height_).put(softness_);
  writer.putPlanes(std::span<const std::uint32_t>(colour_.get(), texels()));
  writer.putPlanes(std::span<const float>(nearness_.get(), texels()));
  return writer.take();
}

std::shared_ptr<CachedView> CachedView::unpack(std::span<const std::byte> bytes) {
  node::PackReader reader(bytes, "a light field's view");
  const auto view = std::shared_ptr<CachedView>(new CachedView);
  view->camera_ = takeCamera(reader);
  view->left_ = reader.takeWithin(-kMaxOffset, kMaxOffset);
  view->top_ = reader.takeWithin(-kMaxOffset, kMaxOffset);
  view->width_ = reader.takeWithin(0, kMaxEdge);
  view->height_ = reader.takeWithin(0, kMaxEdge);
  view->softness_ = reader.takeFinite(0.0F, 1.0e6F);
  if (view->empty() != (view->height_ == 0)) reader.fail("has columns without rows or rows without columns");
  reader.expect(view->texels() * (sizeof(std::uint32_t) + sizeof(float)));
  if (!view->empty()) view->allocate();
  reader.takePlanes(std::span<std::uint32_t>(view->colour_.get(), view->texels()));
  const std::span<float> nearness(view->nearness_.get(), view->texels());
  reader.takePlanes(nearness);
  reader.finish();
  for (const float each : nearness) {
    if (!std::isfinite(each)) reader.fail("has depths that are not finite");
  }
  if (!view->empty()) view->measure();
  return view;
}

}  // namespace grove::objects::lightfield
