#pragma once

#include <memory>
#include <vector>

#include "node/backend/prepare/preparation.h"
#include "world/scenes/scene_file.h"

namespace grove::objects::lightfield {

class LightFieldBackendType;

/// Returns the bakes of light fields that the scene's objects name by plant or model; they run when first needed. Both
/// arguments outlive the result. Throws world::SceneError.
[[nodiscard]] std::vector<std::unique_ptr<node::Preparation>> lightFieldPreparations(const world::Scene& scene,
                                                                                     const LightFieldBackendType& type);

}  // namespace grove::objects::lightfield
