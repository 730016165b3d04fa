#pragma once

#include "gl/handles.h"
#include "gl/shader_library.h"

namespace grove::gl {

/// A linked vertex and fragment shader.
class Program {
 public:
  /// Throws EnvironmentError that names the shader's file and line.
  Program(const Api& api, const ShaderSource& vertex, const ShaderSource& fragment);

  void use() const { program_.api().UseProgram(program_.name()); }

  /// -1 if the shaders do not use it, which GL then ignores.
  [[nodiscard]] GLint uniform(const char* name) const {
    return program_.api().GetUniformLocation(program_.name(), name);
  }
  [[nodiscard]] GLuint name() const noexcept { return program_.name(); }

 private:
  Handle<ProgramTraits> program_;
};

}  // namespace grove::gl
