#pragma once

#include <utility>

#include "gl/api.h"

namespace grove::gl {

/// Owns one GL object. Made and destroyed on the thread of its context, before the context.
template <class Traits>
class Handle {
 public:
  explicit Handle(const Api& api) : api_(&api), name_(Traits::create(api)) {}
  ~Handle() {
    if (name_ != 0) Traits::destroy(*api_, name_);
  }
  Handle(Handle&& other) noexcept : api_(other.api_), name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    Handle taken(std::move(other));
    std::swap(api_, taken.api_);
    std::swap(name_, taken.name_);
    return *this;
  }

  [[nodiscard]] const Api& api() const noexcept { return *api_; }
  /// 0 after a move.
  [[nodiscard]] GLuint name() const noexcept { return name_; }

 private:
  const Api* api_;
  GLuint name_;
};

/// Objects that GL makes and deletes in arrays, here of one; some kinds have a target.
template <auto Create, auto Delete, GLenum... Target>
struct ArrayTraits {
  static GLuint create(const Api& api) {
    GLuint name = 0;
    (api.*Create)(Target..., 1, &name);
    return name;
  }
  static void destroy(const Api& api, GLuint name) { (api.*Delete)(1, &name); }
};

struct ProgramTraits {
  static GLuint create(const Api& api) { return api.CreateProgram(); }
  static void destroy(const Api& api, GLuint name) { api.DeleteProgram(name); }
};

using Buffer = Handle<ArrayTraits<&Api::CreateBuffers, &Api::DeleteBuffers>>;
using Texture = Handle<ArrayTraits<&Api::CreateTextures, &Api::DeleteTextures, GL_TEXTURE_2D>>;
using TextureArray = Handle<ArrayTraits<&Api::CreateTextures, &Api::DeleteTextures, GL_TEXTURE_2D_ARRAY>>;
using FramebufferName = Handle<ArrayTraits<&Api::CreateFramebuffers, &Api::DeleteFramebuffers>>;
using VertexArray = Handle<ArrayTraits<&Api::CreateVertexArrays, &Api::DeleteVertexArrays>>;

}  // namespace grove::gl
