#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "node/frontend/visitor_halves.h"
#include "node/messages.h"
#include "pipeline/outlet.h"

namespace grove::node {

/// Last box of Figure 4.2: composites the pictures and layers of a frame's objects by depth, then lets the layers draw,
/// back to front (section 4.2, step 10). Shows every frame that it gets, in the order in which they come.
class Compositor final : public pipeline::Stage<CompleteFrame> {
 public:
  /// `frameDone` is called once for every frame that came, be it sent on or not. `frontend` outlives it.
  Compositor(std::size_t capacity, FrontendProcess& frontend, std::shared_ptr<VisitorHalves> halves,
             std::function<void()> frameDone);
  void connect(std::shared_ptr<pipeline::Inlet<FinishedFrame>> next);

 protected:
  void process(std::span<CompleteFrame> frames, pipeline::Run& run) override;

 private:
  [[nodiscard]] std::shared_ptr<const raster::Image> composite(const CompleteFrame& frame);
  /// Something to lay over a frame.
  struct Placed {
    const VisibleObject& object;
    const raster::Image* picture;  ///< null: none
    std::unique_ptr<Layer> layer;  ///< null: the picture is all of it
    [[nodiscard]] bool opaque() const { return layer ? layer->opaque() : picture->opaque; }
  };
  /// Back to front.
  [[nodiscard]] std::vector<Placed> placedOf(const CompleteFrame& frame);
  /// What the layers are to have before they can be laid.
  void makeParts(const CompleteFrame& frame, std::span<Placed> placed);
  [[nodiscard]] pipeline::TimedParts timesOf(const CompleteFrame& frame);
  void layBand(const world::Rect& band, std::span<Placed* const> placed, pipeline::TimedParts& times,
               raster::Image& frame);

  pipeline::Executor& executor_;
  pipeline::Timeline& timeline_;
  raster::ImagePool& images_;
  const std::shared_ptr<VisitorHalves> halves_;
  const std::function<void()> frameDone_;
  pipeline::Outlet<FinishedFrame> next_;
};

}  // namespace grove::node
