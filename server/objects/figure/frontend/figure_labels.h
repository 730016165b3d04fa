#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include "node/frontend/frontend_half.h"
#include "objects/figure/frontend/label_font.h"

namespace grove::objects::figure {

/// Writes visitors' names above their heads, hidden by whatever stands before them. Their bodies are pictures.
class FigureLabels final : public node::FrontendHalf {
 public:
  [[nodiscard]] std::unique_ptr<node::Layer> layer(const node::VisibleObject& object, const node::Payload& payload,
                                                   const node::View& view) override;

  /// Where the name is written, in pixels of the camera; nothing if it is too far away. May reach beyond the frame. One
  /// thread at a time.
  [[nodiscard]] std::optional<world::Rect> panelOf(const world::Object& object, const world::Camera& camera);
  /// One thread at a time.
  void draw(const world::Object& object, const world::Camera& camera, raster::Image& frame);

 private:
  [[nodiscard]] const LabelMask& maskOf(const std::string& name, int pixels);

  LabelFont font_;
  std::map<std::pair<std::string, int>, LabelMask> masks_;
};

}  // namespace grove::objects::figure
