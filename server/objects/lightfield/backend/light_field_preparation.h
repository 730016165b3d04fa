#pragma once

#include <memory>
#include <vector>

#include "node/backend/prepare/preparation.h"
#include "world/scenes/scene_file.h"

namespace grove::objects::lightfield {

class LightFieldBackendType;

/// The light fields that objects of the scene show by plant or model, which are baked when they are first needed. Both
/// outlive them. Throws world::SceneError.
[[nodiscard]] std::vector<std::unique_ptr<node::Preparation>> lightFieldPreparations(const world::Scene& scene,
                                                                                     const LightFieldBackendType& type);

}  // namespace grove::objects::lightfield
