#include "objects/figure/backend/figure_backend_type.h"

#include "objects/figure/backend/figure_backend.h"
#include "objects/figure/backend/figure_model.h"
#include "objects/figure/common/figure_name.h"

namespace grove::objects::figure {

std::string_view FigureBackendType::name() const { return kTypeName; }

std::shared_ptr<const world::Model> FigureBackendType::model(const world::Parameters& /*parameters*/) const {
  return std::make_shared<FigureModel>();
}

std::unique_ptr<node::BackendHalf> FigureBackendType::makeHalf(const node::BackendServices& services,
                                                               world::TypeIndex /*self*/) const {
  return std::make_unique<FigureBackend>(services);
}

}  // namespace grove::objects::figure
