#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {

/// Largest length in a file: keeps products of lengths well within the range of a float.
inline constexpr float kLongest = 1.0e6F;

/// Reads field.near from the bytes of its section, which start at a multiple of 4. Returns the memory of its clusters:
/// a copy, because readers navigate by them, so later writes to the mapped file must not corrupt them. Validates
/// everything, see openLightField(). Throws LightFieldError that begins with `name`.
[[nodiscard]] std::shared_ptr<const std::vector<NearCluster>> readNear(std::span<const std::byte> section,
                                                                       std::size_t lightings, const std::string& name,
                                                                       LightField& field);

}  // namespace grove::objects::lightfield
