#pragma once

#include <cstdint>

#include "objects/lightfield/bake/bake.h"

namespace grove::bake {

/// Of all that a bake's views depend on, so that a partial bake is only taken up for what it was begun for.
[[nodiscard]] std::uint64_t bakeKeyOf(const models::Model& model, const BakeOptions& options);

}  // namespace grove::bake
