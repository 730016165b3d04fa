#include "objects/mesh/gl_surface.h"

#include <algorithm>
#include <cassert>

namespace grove::objects::mesh {
namespace {

constexpr GLuint kVertexBinding = 0;
constexpr GLuint kLightBinding = 1;
constexpr GLuint kLightAttribute = 4;

void attribute(const gl::VertexArray& array, GLuint index, GLint floats, std::size_t offset, GLuint binding) {
  const gl::Api& api = array.api();
  api.EnableVertexArrayAttrib(array.name(), index);
  api.VertexArrayAttribFormat(array.name(), index, floats, GL_FLOAT, GL_FALSE, static_cast<GLuint>(offset));
  api.VertexArrayAttribBinding(array.name(), index, binding);
}

template <class T>
void fill(const gl::Buffer& buffer, const std::vector<T>& values) {
  buffer.api().NamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), 0);
}

}  // namespace

GlSurface::GlSurface(const gl::Api& api, const LitSurface& object)
    : vertices_(api), light_(api), indices_(api), array_(api) {
  const Surface& surface = object.surface;
  fill(vertices_, surface.vertices);
  fill(light_, object.light);
  std::vector<Triangle> all;
  for (const Level& level : surface.levels) {
    ranges_.push_back({&level, static_cast<GLsizei>(level.triangles.size() * 3), all.size() * sizeof(Triangle)});
    all.insert(all.end(), level.triangles.begin(), level.triangles.end());
  }
  fill(indices_, all);

  api.VertexArrayVertexBuffer(array_.name(), kVertexBinding, vertices_.name(), 0, sizeof(Vertex));
  api.VertexArrayVertexBuffer(array_.name(), kLightBinding, light_.name(), 0, sizeof(world::Vec4));
  api.VertexArrayElementBuffer(array_.name(), indices_.name());
  static_assert(offsetof(Vertex, bone) == sizeof(world::Vec3), "the shader reads position and bone as one");
  attribute(array_, 0, 4, offsetof(Vertex, position), kVertexBinding);
  attribute(array_, 1, 3, offsetof(Vertex, normal), kVertexBinding);
  attribute(array_, 2, 3, offsetof(Vertex, albedo), kVertexBinding);
  attribute(array_, 3, 4, offsetof(Vertex, grain), kVertexBinding);
  attribute(array_, kLightAttribute, 4, 0, kLightBinding);
}

void GlSurface::draw(const Level& level) const {
  const auto range = std::ranges::find(ranges_, &level, &Range::level);
  assert(range != ranges_.end());
  const gl::Api& api = array_.api();
  api.BindVertexArray(array_.name());
  // GL takes the offset into the bound buffer as a pointer.
  api.DrawElements(GL_TRIANGLES, range->count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(range->byteOffset));
}

}  // namespace grove::objects::mesh
