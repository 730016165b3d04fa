#include "objects/lightfield/backend/near/near_renderer.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "objects/lightfield/backend/near/near_canvas_kernels.h"
#include "objects/lightfield/backend/near/near_projection_kernels.h"
#include "objects/lightfield/backend/near/near_resolve_kernels.h"

namespace grove::objects::lightfield {
namespace {

using world::Vec2;
using world::Vec3;
using world::Vec4;

/// The projection to the pixels of a picture's part.
NearProjection projectionTo(const world::Rect& rect, const ObjectCamera& camera) {
  const glm::mat3 toPixels = glm::inverse(glm::mat3(camera.perColumn, camera.perRow, camera.corner));
  const Vec3 offset = -(toPixels * camera.eye);
  const auto row = [&](int i) { return Vec4(toPixels[0][i], toPixels[1][i], toPixels[2][i], offset[i]); };
  return {row(0) - static_cast<float>(rect.left) * row(2), row(1) - static_cast<float>(rect.top) * row(2), row(2)};
}

/// Whether a box is partly in the view, which has that many pixels.
bool isSeen(const NearCluster& cluster, const NearProjection& projection, Vec2 size) {
  // The planes through the eye and an edge of the picture; positive inside.
  const std::array<Vec4, 5> planes{projection.depth, projection.x, projection.y,
                                   size.x * projection.depth - projection.x, size.y * projection.depth - projection.y};
  return std::ranges::all_of(planes, [&](const Vec4& plane) {
    float most = plane.w;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      most += std::max(plane[axis] * cluster.low[a], plane[axis] * cluster.high[a]);
    }
    return most > 0.0F;
  });
}

}  // namespace

/// Scratch buffers of one thread.
struct NearRenderer::Scratch {
  NearTiles tiles;
  NearCanvas canvas;

  [[nodiscard]] std::size_t bytes() const noexcept { return tiles.bytes() + canvas.bytes(); }
};

NearRenderer::NearRenderer(pipeline::MemoryLedger& memory)
    : held_(memory, "near buffers", "lightfield", pipeline::Work::kAcrossUser) {}

NearRenderer::~NearRenderer() = default;

std::shared_ptr<raster::Image> NearRenderer::render(const NearModel& model, int lighting, const ObjectCamera& camera,
                                                    const Haze& haze, const world::Rect& rect,
                                                    raster::ImagePool& images) {
  const std::span<const std::uint32_t> colours = model.colours[static_cast<std::size_t>(lighting)];
  const std::span<const std::uint32_t> fronts = colours.first(colours.size() / 2);
  const std::span<const std::uint32_t> backs = colours.subspan(colours.size() / 2);
  const NearProjection projection = projectionTo(rect, camera);
  std::unique_ptr<Scratch> scratch = takeScratch();
  NearTiles& tiles = scratch->tiles;
  tiles.begin(rect.width(), rect.height());
  for (const NearCluster& cluster : model.clusters) {
    if (!isSeen(cluster, projection, {rect.width(), rect.height()})) continue;
    projectCluster(model, cluster, fronts, backs, projection, tiles);
  }
  const world::Rect part = tiles.touched();
  auto image = images.acquire(part.moved(rect.left, rect.top));
  for (int top = part.top; top < part.bottom; top += kNearTile) {
    for (int left = part.left; left < part.right; left += kNearTile) {
      const int column = left / kNearTile;
      const int row = top / kNearTile;
      tiles.sort(column, row);
      drawTile(tiles, column, row, halfPlanes_, scratch->canvas);
      resolveTile(left - part.left, top - part.top, haze, scratch->canvas, *image);
    }
  }
  giveBack(std::move(scratch));
  return image;
}

std::unique_ptr<NearRenderer::Scratch> NearRenderer::takeScratch() {
  const std::lock_guard lock(mutex_);
  if (unused_.empty()) return std::make_unique<Scratch>();
  std::unique_ptr<Scratch> scratch = std::move(unused_.back());
  unused_.pop_back();
  return scratch;
}

void NearRenderer::giveBack(std::unique_ptr<Scratch> scratch) {
  const std::lock_guard lock(mutex_);
  unused_.push_back(std::move(scratch));
  std::size_t sum = 0;
  for (const auto& unused : unused_) sum += unused->bytes();
  held_.set(sum);
}

}  // namespace grove::objects::lightfield
