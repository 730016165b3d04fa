#include "gl/context.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/error.h"

namespace grove::gl {
namespace {

std::string text(const Api& api, GLenum what) {
  const GLubyte* bytes = api.GetString(what);
  return bytes == nullptr ? "?" : reinterpret_cast<const char*>(bytes);
}

bool isSoftware(std::string_view renderer) {
  constexpr std::array<std::string_view, 4> kNames = {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"};
  return std::ranges::any_of(kNames, [&](auto known) { return renderer.find(known) != std::string_view::npos; });
}

}  // namespace

Context::Context(ContextKind kind, int ordinal) {
  std::string whyNot;
  if (kind != ContextKind::kOsmesa) {
    if (adopt(makeEglContext(EglPlatform::kHardwareDevice, whyNot)) && !software_) return;
    const auto software = ordinal % 2 == 0 ? std::array{EglPlatform::kSurfaceless, EglPlatform::kSoftwareDevice}
                                           : std::array{EglPlatform::kSoftwareDevice, EglPlatform::kSurfaceless};
    for (const EglPlatform platform : software) {
      if (adopt(makeEglContext(platform, whyNot))) return;
    }
  }
  if (kind != ContextKind::kEgl && adopt(makeOsmesaContext(whyNot))) return;
  throw EnvironmentError("no usable OpenGL 4.5: " + whyNot, "GL",
                         "install libegl-mesa0 and libegl1, or libosmesa6, or your GPU's EGL driver");
}

Context::~Context() {
  if (native_) native_->release();
}

std::string Context::driver() const { return text(*api_, GL_VENDOR) + ", " + text(*api_, GL_VERSION); }

bool Context::adopt(std::unique_ptr<NativeContext> native) {
  if (!native) return false;
  if (native_) native_->release();
  native->makeCurrent();
  native_ = std::move(native);
  api_ = std::make_unique<const Api>([&](const char* name) { return native_->function(name); });
  const std::string renderer = text(*api_, GL_RENDERER);
  software_ = isSoftware(renderer);
  GLint major = 0;
  GLint minor = 0;
  api_->GetIntegerv(GL_MAJOR_VERSION, &major);
  api_->GetIntegerv(GL_MINOR_VERSION, &minor);
  description_ = native_->platform() + ", " + renderer + ", GL " + std::to_string(major) + "." + std::to_string(minor);
  return true;
}

}  // namespace grove::gl
