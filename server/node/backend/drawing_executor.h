#pragma once

#include <algorithm>

#include "gl/workers.h"
#include "node/backend/backend_services.h"

namespace grove::node {

/// Selects where a type's objects are drawn: on the GL workers if GL draws any of them, else on the general workers.
/// One executor serves all objects of a type, because GL is bound to threads of its own.
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
