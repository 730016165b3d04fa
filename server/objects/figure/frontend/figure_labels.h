#pragma once

#include <optional>

#include "node/frontend/frontend_half.h"

namespace grove::objects::figure {

/// Says where visitors' names belong: above their heads, as far as these are seen. Their bodies are pictures.
class FigureLabels final : public node::FrontendHalf {
 public:
  [[nodiscard]] std::unique_ptr<node::Layer> layer(const node::VisibleObject& object, const node::Payload& payload,
                                                   const node::View& view) override;
};

/// The pixels of a figure's head; nothing if it is too far away for a name. May reach beyond the frame.
[[nodiscard]] std::optional<world::Rect> headOf(const world::Object& object, const world::Camera& camera);

/// The name of a figure in a frame of this camera, whose depths are read within headOf(). Fades with the distance, and
/// by the share of the head that something nearer hides.
[[nodiscard]] std::optional<node::Label> labelOf(const world::Object& object, const world::Camera& camera,
                                                 const raster::Image& frame);

}  // namespace grove::objects::figure
