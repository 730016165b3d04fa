#include "objects/figure/backend/figure_type.h"

#include "objects/figure/backend/figure_backend.h"
#include "objects/figure/backend/figure_model.h"
#include "objects/figure/frontend/figure_frontend.h"

namespace grove::objects::figure {

std::shared_ptr<const world::Model> FigureType::model(const world::Parameters& /*parameters*/) const {
  return std::make_shared<FigureModel>();
}

std::unique_ptr<node::BackendHalf> FigureType::makeBackend(const node::BackendServices& services,
                                                           world::TypeIndex /*self*/) const {
  return std::make_unique<FigureBackend>(services);
}

std::unique_ptr<node::FrontendHalf> FigureType::makeFrontend() const { return std::make_unique<FigureFrontend>(); }

}  // namespace grove::objects::figure
