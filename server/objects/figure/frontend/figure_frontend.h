#pragma once

#include <map>
#include <string>
#include <utility>

#include "node/object_type.h"
#include "objects/figure/frontend/label_font.h"

namespace grove::objects::figure {

/// Writes visitors' names above their heads, hidden by whatever stands before them.
class FigureFrontend final : public node::FrontendHalf {
 public:
  void draw(const node::VisibleObject& object, const node::Payload& payload, const node::View& view,
            raster::Image& frame) override;

 private:
  [[nodiscard]] const LabelMask& maskOf(const std::string& name, int pixels);

  LabelFont font_;
  std::map<std::pair<std::string, int>, LabelMask> masks_;
};

}  // namespace grove::objects::figure
