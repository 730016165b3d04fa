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

  /// Fills `image.rect` of the camera's picture with colour and depth, as a Sampler does.
  void render(const NearModel& model, int lighting, const ObjectCamera& camera, const Haze& haze, raster::Image& image);

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
