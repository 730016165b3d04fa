#pragma once

#include <optional>

#include "node/frontend/frontend_half.h"

namespace grove::objects::figure {

/// Places visitors' names above the visible parts of their heads, and reports how their figures move. The bodies
/// themselves are pictures.
class FigureLabels final : public node::FrontendHalf {
 public:
  [[nodiscard]] std::unique_ptr<node::Layer> layer(const node::VisibleObject& object, const node::Payload& payload,
                                                   const node::View& view) override;
};

/// Returns the pixels of a figure's head, or nothing if it is too far away for a name. May exceed the frame.
[[nodiscard]] std::optional<world::Rect> headOf(const world::Object& object, const world::Camera& camera);

/// Returns the name label of a figure in a frame of this camera; reads the frame's depths within headOf(). The label
/// fades with the distance and with the share of the head that nearer things hide.
[[nodiscard]] std::optional<node::Label> labelOf(const world::Object& object, const world::Camera& camera,
                                                 const raster::Image& frame);

}  // namespace grove::objects::figure
