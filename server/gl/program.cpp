#include "gl/program.h"

#include <regex>
#include <string>

#include "base/error.h"

namespace grove::gl {
namespace {

class Shader {
 public:
  Shader(const Api& api, GLenum stage) : api_(api), name_(api.CreateShader(stage)) {}
  ~Shader() { api_.DeleteShader(name_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  [[nodiscard]] GLuint name() const { return name_; }

 private:
  const Api& api_;
  GLuint name_;
};

struct Complaint {
  std::string where;
  std::string what;
};

/// Drivers write "0:LINE(COLUMN): ..." (Mesa) or "0(LINE) : ..." (NVIDIA).
Complaint readLog(const std::string& log, const ShaderSource& source) {
  static const std::regex kPlace(R"(\d+[:(](\d+)\)?(?:\(\d+\))?\s*:\s*([^\n]*))");
  std::smatch match;
  if (std::regex_search(log, match, kPlace)) {
    const std::size_t line = std::stoul(match[1]);
    if (line >= 1 && line <= source.places.size()) return {source.places[line - 1], match[2].str()};
  }
  return {source.places.empty() ? "shader" : source.places.front(), log};
}

void compile(const Api& api, const Shader& shader, const ShaderSource& source) {
  const char* text = source.text.c_str();
  api.ShaderSource(shader.name(), 1, &text, nullptr);
  api.CompileShader(shader.name());
  GLint done = GL_FALSE;
  api.GetShaderiv(shader.name(), GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return;
  GLint length = 1;
  api.GetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  api.GetShaderInfoLog(shader.name(), length, nullptr, log.data());
  const Complaint complaint = readLog(log, source);
  throw EnvironmentError("shader does not compile: " + complaint.what, complaint.where, "");
}

}  // namespace

Program::Program(const Api& api, const ShaderSource& vertex, const ShaderSource& fragment) : program_(api) {
  const Shader first(api, GL_VERTEX_SHADER);
  const Shader second(api, GL_FRAGMENT_SHADER);
  compile(api, first, vertex);
  compile(api, second, fragment);
  api.AttachShader(program_.name(), first.name());
  api.AttachShader(program_.name(), second.name());
  api.LinkProgram(program_.name());
  GLint done = GL_FALSE;
  api.GetProgramiv(program_.name(), GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return;
  GLint length = 1;
  api.GetProgramiv(program_.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(length), '\0');
  api.GetProgramInfoLog(program_.name(), length, nullptr, log.data());
  throw EnvironmentError("shaders do not link: " + log, vertex.places.front() + " and " + fragment.places.front(), "");
}

}  // namespace grove::gl
