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

struct BufferTraits {
  static GLuint create(const Api& api) {
    GLuint name = 0;
    api.CreateBuffers(1, &name);
    return name;
  }
  static void destroy(const Api& api, GLuint name) { api.DeleteBuffers(1, &name); }
};

struct Texture2dTraits {
  static GLuint create(const Api& api) {
    GLuint name = 0;
    api.CreateTextures(GL_TEXTURE_2D, 1, &name);
    return name;
  }
  static void destroy(const Api& api, GLuint name) { api.DeleteTextures(1, &name); }
};

struct Texture2dArrayTraits {
  static GLuint create(const Api& api) {
    GLuint name = 0;
    api.CreateTextures(GL_TEXTURE_2D_ARRAY, 1, &name);
    return name;
  }
  static void destroy(const Api& api, GLuint name) { api.DeleteTextures(1, &name); }
};

struct FramebufferTraits {
  static GLuint create(const Api& api) {
    GLuint name = 0;
    api.CreateFramebuffers(1, &name);
    return name;
  }
  static void destroy(const Api& api, GLuint name) { api.DeleteFramebuffers(1, &name); }
};

struct VertexArrayTraits {
  static GLuint create(const Api& api) {
    GLuint name = 0;
    api.CreateVertexArrays(1, &name);
    return name;
  }
  static void destroy(const Api& api, GLuint name) { api.DeleteVertexArrays(1, &name); }
};

struct ProgramTraits {
  static GLuint create(const Api& api) { return api.CreateProgram(); }
  static void destroy(const Api& api, GLuint name) { api.DeleteProgram(name); }
};

using Buffer = Handle<BufferTraits>;
using Texture = Handle<Texture2dTraits>;
using TextureArray = Handle<Texture2dArrayTraits>;
using VertexArray = Handle<VertexArrayTraits>;

}  // namespace grove::gl
