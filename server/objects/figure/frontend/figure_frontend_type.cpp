#include "objects/figure/frontend/figure_frontend_type.h"

#include "objects/figure/common/figure_name.h"
#include "objects/figure/frontend/figure_labels.h"

namespace grove::objects::figure {
namespace {

class FigureFrontendType final : public node::FrontendType {
 public:
  [[nodiscard]] std::string_view name() const override { return kTypeName; }

  [[nodiscard]] std::unique_ptr<node::FrontendHalf> makeHalf(const node::FrontendTools& /*tools*/) const override {
    return std::make_unique<FigureLabels>();
  }
};

}  // namespace

std::unique_ptr<node::FrontendType> frontendType() { return std::make_unique<FigureFrontendType>(); }

}  // namespace grove::objects::figure
