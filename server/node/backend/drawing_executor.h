#pragma once

#include <algorithm>

#include "gl/workers.h"
#include "node/backend/backend_services.h"

namespace grove::node {

/// Where a type's objects are drawn: the GL workers if any of them is drawn by GL, else the workers of everything. One
/// executor serves all of the type's objects, and GL is bound to threads of its own.
template <class IsByGl>
[[nodiscard]] pipeline::Executor& drawingExecutor(const BackendServices& services, world::TypeIndex self,
                                                  const IsByGl& isByGl) {
  const bool anyByGl = std::ranges::any_of(services.scene.objects, [&](const world::ModelledObject& object) {
    return object.type == self && isByGl(object);
  });
  if (anyByGl) return services.gl;
  return services.workers;
}

}  // namespace grove::node
