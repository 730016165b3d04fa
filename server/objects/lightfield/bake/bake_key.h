#pragma once

#include <cstdint>

#include "objects/lightfield/bake/bake.h"

namespace grove::bake {

/// Hash of all inputs of a bake's views, so that a partial bake is only continued with the same inputs.
[[nodiscard]] std::uint64_t bakeKeyOf(const models::Model& model, const BakeOptions& options);

}  // namespace grove::bake
