#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "models/gltf/gltf_file.h"

namespace grove::models {

/// The bytes of a buffer view. Throws ImportError if it exceeds its buffer.
[[nodiscard]] std::span<const unsigned char> viewBytes(const GltfFile& file, int view);

/// Elements of one to four numbers each, contiguous.
struct Elements {
  std::vector<float> values;
  std::size_t width = 1;  ///< numbers per element

  [[nodiscard]] std::size_t size() const noexcept { return values.size() / width; }
  [[nodiscard]] const float* at(std::size_t element) const noexcept { return &values[element * width]; }
};

/// Reads an accessor of any component type, normalised or not, sparse or not. Throws ImportError if it exceeds its
/// buffer, is not a list of scalars or vectors, or contains numbers that are not finite.
[[nodiscard]] Elements readElements(const GltfFile& file, int accessor);

/// Reads an accessor of unsigned integers. Throws ImportError like readElements().
[[nodiscard]] std::vector<std::uint32_t> readIndices(const GltfFile& file, int accessor);

}  // namespace grove::models
