#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "objects/lightfield/backend/near/half_planes.h"
#include "objects/lightfield/common/haze.h"
#include "objects/lightfield/format/near_model.h"
#include "objects/lightfield/format/view_camera.h"
#include "pipeline/memory_ledger.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// Draws light fields' objects from their faces, for eyes so near that the views are too coarse. Each face is projected
/// once and sorted into tiles, which are drawn in the cache, front to back, so that hidden faces cost little. Sixteen
/// samples per pixel smooth the edges. Any thread, any number at once.
class NearRenderer {
 public:
  explicit NearRenderer(pipeline::MemoryLedger& memory);
  ~NearRenderer();
  NearRenderer(const NearRenderer&) = delete;
  NearRenderer& operator=(const NearRenderer&) = delete;

  /// Draws what `rect` of the camera's picture shows of the model: colour and depth, as a Sampler does. The image is
  /// from `images` and covers only the tiles that faces touch; it is empty if there are none.
  [[nodiscard]] std::shared_ptr<raster::Image> render(const NearModel& model, int lighting, const ObjectCamera& camera,
                                                      const Haze& haze, const world::Rect& rect,
                                                      raster::ImagePool& images);

 private:
  struct Scratch;
  [[nodiscard]] std::unique_ptr<Scratch> takeScratch();
  void giveBack(std::unique_ptr<Scratch> scratch);

  const HalfPlanes halfPlanes_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Scratch>> unused_;
  pipeline::HeldMemory held_;
};

}  // namespace grove::objects::lightfield
