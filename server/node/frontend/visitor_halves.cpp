#include "node/frontend/visitor_halves.h"

namespace grove::node {

VisitorHalves::VisitorHalves(const FrontendProcess& frontend) {
  for (world::TypeIndex i = 0; i < frontend.layout().types.size(); ++i) {
    const FrontendType& type = frontend.type(i);
    auto held = std::make_unique<pipeline::HeldMemory>(frontend.tools().memory, "frontends", type.name(),
                                                       pipeline::Work::kPerUserFrontend);
    halves_.emplace(i, TypeHalf{type.name(), type.makeHalf(frontend.tools()), std::move(held)});
  }
}

void VisitorHalves::reportMemory() {
  for (auto& [type, half] : halves_) half.held->set(half.half->bytes());
}

}  // namespace grove::node
