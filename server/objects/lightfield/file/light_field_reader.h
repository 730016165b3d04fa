#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {

/// Reads the light field from the bytes of a file, which `storage` keeps alive; they start at a multiple of 8.
/// Validates everything, see openLightField(). Throws LightFieldError that begins with `name`.
[[nodiscard]] LightField readLightField(std::span<const std::byte> bytes, const std::string& name,
                                        std::shared_ptr<const void> storage);

}  // namespace grove::objects::lightfield
