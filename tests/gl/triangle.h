#pragma once

#include <cstdint>
#include <vector>

#include "gl/context.h"

namespace grove::gl {

/// A 64x48 picture of two triangles that pass through each other.
struct TrianglePicture {
  std::vector<std::uint8_t> colour;
  std::vector<float> depth;
};

[[nodiscard]] TrianglePicture drawTriangles(const Api& api);

}  // namespace grove::gl
