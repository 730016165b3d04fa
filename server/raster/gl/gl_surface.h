#pragma once

#include <vector>

#include "gl/handles.h"
#include "raster/drawing.h"
#include "raster/vertex_arrays.h"

namespace grove::raster {

/// A lit surface in the buffers of one GL context.
class GlSurface {
 public:
  GlSurface(const gl::Api& api, const LitSurface& object);

  /// Draws one of the surface's levels with the current program. `light` holds the result of lightVertices() for the
  /// level's vertices from `firstByte` on.
  void draw(const Level& level, const gl::Buffer& light, std::size_t firstByte) const;

  [[nodiscard]] const VertexArrays& arrays() const noexcept { return arrays_; }
  /// Memory use, including the buffers.
  [[nodiscard]] std::size_t bytes() const noexcept { return arrays_.bytes() + bufferBytes_; }

 private:
  struct Range {
    const Level* level;
    GLsizei count;
    std::size_t byteOffset;
  };

  VertexArrays arrays_;
  gl::Buffer vertices_;
  gl::Buffer indices_;
  gl::VertexArray array_;
  std::vector<Range> ranges_;
  std::size_t bufferBytes_;
};

}  // namespace grove::raster
