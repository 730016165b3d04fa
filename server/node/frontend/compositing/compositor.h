#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "node/frontend/backdrops/backdrop_store.h"
#include "node/frontend/backdrops/backdrop_warp.h"
#include "node/frontend/visitor_halves.h"
#include "node/messages.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Last box of Figure 4.2: composites the pictures and layers of a frame's objects by depth, then lets the layers draw,
/// back to front (section 4.2, step 10), and collects the labels of visible objects. Still objects come first: they are
/// drawn into a backdrop, or the last backdrop is warped. Shows all frames, in order.
class Compositor final : public pipeline::Stage<CompleteFrame> {
 public:
  /// Calls `frameDone` once for every frame, whether it is sent on or not. `frontend` outlives it.
  Compositor(std::size_t capacity, FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves,
             std::shared_ptr<BackdropStore> backdrops, std::function<void()> frameDone);
  void connect(std::shared_ptr<pipeline::Inlet<FinishedFrame>> next);

 protected:
  void process(std::span<CompleteFrame> frames, pipeline::Run& run) override;

 private:
  [[nodiscard]] FinishedFrame composite(const CompleteFrame& frame);
  /// An object's picture and layer.
  struct Placed {
    const VisibleObject& object;
    const raster::Image* picture;  ///< null: none
    std::unique_ptr<Layer> layer;  ///< null: the picture shows all of it
    [[nodiscard]] bool opaque() const { return layer ? layer->opaque() : picture->opaque; }
    [[nodiscard]] bool isFinal() const { return !layer || layer->isFinal(); }
  };
  /// Back to front.
  using Scene = std::vector<Placed>;
  /// The objects that are still, or those that are not, within an area.
  [[nodiscard]] Scene sceneOf(const CompleteFrame& frame, bool still, const world::Rect& area);
  void drawBackdrop(const CompleteFrame& frame);
  /// Returns the frame's backdrop as its camera sees it; nothing if it has none. Throws if it could not be drawn.
  [[nodiscard]] static std::optional<BackdropWarp> warpOf(const FrameList& list, const Backdrop* backdrop);
  /// Returns the rectangles in which a scene covers its backdrop.
  [[nodiscard]] static std::vector<world::Rect> drawnParts(const Scene& scene);
  /// Callbacks for each band: a rectangle of some rows, as wide as the composited area.
  struct BandSteps {
    /// Returns the image that the band is composited in.
    std::function<std::shared_ptr<raster::Image>(const world::Rect& band)> image;
    std::function<void(FrameBuilder& rows, const world::Rect& band)> begin = nullptr;
    std::function<void(const raster::Image& image, const world::Rect& band)> end = nullptr;
  };
  void compose(Scene& scene, pipeline::TraceTag tag, const world::Rect& area, const BandSteps& steps);
  /// Makes the parts that layers need before lay().
  void makeParts(Scene& scene, pipeline::TraceTag tag);
  [[nodiscard]] pipeline::TimedParts timesOf(pipeline::TraceTag tag);

  pipeline::Executor& executor_;
  pipeline::Timeline& timeline_;
  raster::ImagePool& images_;
  const std::shared_ptr<VisitorHalves> halves_;
  const std::shared_ptr<BackdropStore> backdrops_;
  const std::function<void()> frameDone_;
  pipeline::Outlet<FinishedFrame> next_;
};

}  // namespace grove::node
