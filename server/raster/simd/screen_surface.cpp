#include "raster/simd/screen_surface.h"

#include "raster/shading/vertex_light.h"

namespace grove::raster {

void ScreenSurface::make(const Drawing& drawing, const VertexArrays& arrays) {
  const Surface& surface = drawing.object->surface;
  const Level& level = surface.levelFor(drawing.distance, drawing.camera->focal());
  const float nearDepth = drawing.camera->nearDepth;
  vertices_.light.resize(level.vertexCount);
  lightVertices(arrays, drawing, vertices_.light);
  project(arrays, drawing, vertices_);
  if (vertices_.nearest < nearDepth) {
    cut(level.triangles, vertices_, arrays.lichen, nearDepth, cut_);
    triangles_ = cut_.triangles;
    corners_ = cut_.corners;
    edges_ = {};
  } else {
    triangles_ = level.triangles;
    corners_ = vertices_.corners;
    edges_ = arrays.edges[static_cast<std::size_t>(&level - surface.levels.data())];
  }
}

}  // namespace grove::raster
