#include "objects/figure/frontend/figure_frontend_type.h"

#include "objects/figure/common/figure_name.h"
#include "objects/figure/frontend/figure_labels.h"

namespace grove::objects::figure {

std::string_view FigureFrontendType::name() const { return kTypeName; }

std::unique_ptr<node::FrontendHalf> FigureFrontendType::makeHalf(const node::FrontendTools& /*tools*/) const {
  return std::make_unique<FigureLabels>();
}

}  // namespace grove::objects::figure
