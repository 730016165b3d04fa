#pragma once

#include <vector>

#include "gl/handles.h"
#include "objects/mesh/drawing.h"

namespace grove::objects::mesh {

/// A lit surface in the buffers of one GL context.
class GlSurface {
 public:
  GlSurface(const gl::Api& api, const LitSurface& object);

  /// Draws one of the surface's levels with the program in use.
  void draw(const Level& level) const;

 private:
  struct Range {
    const Level* level;
    GLsizei count;
    std::size_t byteOffset;
  };

  gl::Buffer vertices_;
  gl::Buffer light_;
  gl::Buffer indices_;
  gl::VertexArray array_;
  std::vector<Range> ranges_;
};

}  // namespace grove::objects::mesh
