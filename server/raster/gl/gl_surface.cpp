#include "raster/gl/gl_surface.h"

#include <algorithm>
#include <cassert>

namespace grove::raster {
namespace {

constexpr GLuint kVertexBinding = 0;
constexpr GLuint kLightBinding = 1;
constexpr GLuint kPositionAttribute = 0;
constexpr GLuint kLightAttribute = 1;
constexpr GLuint kLichenAttribute = 2;

void attribute(const gl::VertexArray& array, GLuint index, GLint count, GLenum type, std::size_t offset,
               GLuint binding) {
  const gl::Api& api = array.api();
  api.EnableVertexArrayAttrib(array.name(), index);
  api.VertexArrayAttribFormat(array.name(), index, count, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE,
                              static_cast<GLuint>(offset));
  api.VertexArrayAttribBinding(array.name(), index, binding);
}

template <class T>
void fill(const gl::Buffer& buffer, const std::vector<T>& values) {
  buffer.api().NamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(values.size() * sizeof(T)), values.data(), 0);
}

}  // namespace

GlSurface::GlSurface(const gl::Api& api, const LitSurface& object)
    : arrays_(object), vertices_(api), indices_(api), array_(api) {
  const Surface& surface = object.surface;
  fill(vertices_, surface.vertices);
  std::vector<Triangle> all;
  for (const Level& level : surface.levels) {
    ranges_.push_back({&level, static_cast<GLsizei>(level.triangles.size() * 3), all.size() * sizeof(Triangle)});
    all.insert(all.end(), level.triangles.begin(), level.triangles.end());
  }
  fill(indices_, all);
  bufferBytes_ = surface.vertices.size() * sizeof(Vertex) + all.size() * sizeof(Triangle);

  api.VertexArrayVertexBuffer(array_.name(), kVertexBinding, vertices_.name(), 0, sizeof(Vertex));
  api.VertexArrayElementBuffer(array_.name(), indices_.name());
  static_assert(offsetof(Vertex, bone) == sizeof(world::Vec3), "the shader reads position and bone as one");
  attribute(array_, kPositionAttribute, 4, GL_FLOAT, offsetof(Vertex, position), kVertexBinding);
  attribute(array_, kLightAttribute, 4, GL_UNSIGNED_BYTE, 0, kLightBinding);
  attribute(array_, kLichenAttribute, 1, GL_FLOAT, offsetof(Vertex, lichen), kVertexBinding);
}

void GlSurface::draw(const Level& level, const gl::Buffer& light, std::size_t firstByte) const {
  const auto range = std::ranges::find(ranges_, &level, &Range::level);
  assert(range != ranges_.end());
  const gl::Api& api = array_.api();
  api.VertexArrayVertexBuffer(array_.name(), kLightBinding, light.name(), static_cast<GLintptr>(firstByte),
                              sizeof(std::uint32_t));
  api.BindVertexArray(array_.name());
  // GL takes the offset into the bound buffer as a pointer.
  api.DrawElements(GL_TRIANGLES, range->count, GL_UNSIGNED_INT, reinterpret_cast<const void*>(range->byteOffset));
}

}  // namespace grove::raster
