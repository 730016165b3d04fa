#pragma once

#include <memory>
#include <vector>

#include "node/frontend/compositing/composite.h"
#include "objects/herd/frontend/herd_layer.h"
#include "objects/herd/poses.h"
#include "pipeline/worker_pool.h"

namespace grove::objects::herd {

/// A grey, level plain with a herd on it, as one visitor sees it.
class Meadow {
 public:
  static constexpr int kWidth = 640;
  static constexpr int kHeight = 360;
  static constexpr std::uint32_t kGround = 0xFF808080U;

  Meadow() {
    sky_.sun = glm::normalize(world::Vec3(-1.0F, 0.5F, 0.0F));
    view_.camera.width = kWidth;
    view_.camera.height = kHeight;
    view_.camera.pose = {{0.0F, 1.7F, 6.0F}, 0.0F, -0.12F};
  }

  [[nodiscard]] static Animal animal(const AnimalPose& pose, Kind kind = Kind::kDoe, float sunShare = 1.0F) {
    return {kind, 1.0F, sunShare, pose, pose};
  }

  void add(const Animal& animal) { animals_.push_back(animal); }

  struct What {
    float wall = 0.0F;  ///< view depth of a grey wall before everything; 0 for none
    bool shadows = true;
  };

  /// Makes the frame.
  void show() { show(What{}); }
  void show(const What& what) {
    const auto herd = std::make_shared<const HerdSnapshot>(1, 0.0, animals_);
    HerdLayer layer(painter_, herd, sky_, view_);
    reach_ = layer.reach({});
    parts_ = layer.parts();
    mover_ = layer.mover();
    const world::Rect all{0, 0, kWidth, kHeight};
    const auto ground = groundOf(all, what.wall);
    frame_ = images_.acquire(all);
    const auto edges = images_.acquire(all);
    for (std::size_t i = 0; i < layer.parts(); ++i) layer.makePart(i);
    node::FrameBuilder rows(*frame_, *edges);
    rows.lay(*ground);
    layer.lay(rows);
    rows.finish();
    if (what.shadows) layer.draw(*frame_);
  }

  [[nodiscard]] std::uint32_t colourAt(int x, int y) const { return frame_->colourRow(y)[x]; }
  [[nodiscard]] float depthAt(int x, int y) const { return frame_->depthRow(y)[x]; }
  /// Red of the pixel at a point, 0..255.
  [[nodiscard]] int brightnessAt(world::Vec3 point) const {
    const world::Vec3 at = view_.camera.project(point);
    return static_cast<int>(colourAt(static_cast<int>(at.x), static_cast<int>(at.y)) & 0xFFU);
  }
  /// Whether a pixel shows an animal, which is nearer than the ground and the sky.
  [[nodiscard]] bool isBody(int x, int y) const { return depthAt(x, y) < 0.999F * groundDepth(x, y); }
  template <class Visit>
  void forEachBodyPixel(const Visit& visit) const {
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        if (isBody(x, y)) visit(x, y);
      }
    }
  }
  [[nodiscard]] int bodyPixels() const {
    int count = 0;
    forEachBodyPixel([&](int, int) { ++count; });
    return count;
  }
  /// Pixels that differ from the empty plain.
  [[nodiscard]] int changedPixels() const {
    int count = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) count += colourAt(x, y) == kGround ? 0 : 1;
    }
    return count;
  }

  world::Sky sky_;
  node::View view_;
  world::Rect reach_;
  std::size_t parts_ = 0;
  std::optional<node::Mover> mover_;

 private:
  [[nodiscard]] float groundDepth(int x, int y) const {
    const world::Vec3 ray = view_.camera.ray(static_cast<float>(x) + 0.5F, static_cast<float>(y) + 0.5F);
    return ray.y < -1.0e-3F ? view_.camera.pose.position.y / -ray.y : world::kInfiniteDepth;
  }

  [[nodiscard]] std::shared_ptr<raster::Image> groundOf(const world::Rect& all, float wall) {
    const auto ground = images_.acquire(all);
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        ground->colourRow(y)[x] = kGround;
        ground->depthRow(y)[x] = wall > 0.0F ? wall : groundDepth(x, y);
      }
    }
    return ground;
  }

  pipeline::WorkerPool workers_{1};
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger memory_;
  raster::ImagePool images_;
  HerdPainter painter_{{workers_, timeline_, memory_, images_, sky_}};
  std::vector<Animal> animals_;
  std::shared_ptr<raster::Image> frame_;
};

}  // namespace grove::objects::herd
