#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "objects/lightfield/common/haze.h"
#include "objects/lightfield/format/near_model.h"
#include "objects/lightfield/format/view_camera.h"
#include "pipeline/memory_ledger.h"
#include "raster/image.h"

namespace grove::objects::lightfield {

/// Draws light fields' objects from their triangles, for eyes so near that the views are too coarse. Each triangle is
/// projected once and sorted into tiles, each of which is drawn in the cache. Four samples per pixel smooth the edges.
/// Any thread, any number at once.
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

  std::mutex mutex_;
  std::vector<std::unique_ptr<Scratch>> unused_;
  pipeline::HeldMemory held_;
};

}  // namespace grove::objects::lightfield
