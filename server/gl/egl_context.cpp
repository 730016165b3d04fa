#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstring>
#include <vector>

#include "base/error.h"
#include "gl/native_context.h"

namespace grove::gl {
namespace {

const char* name(EglPlatform platform) {
  switch (platform) {
    case EglPlatform::kHardwareDevice:
      return "EGL device";
    case EglPlatform::kSurfaceless:
      return "EGL surfaceless";
    case EglPlatform::kSoftwareDevice:
      break;
  }
  return "EGL software device";
}

/// The display itself is never terminated: EGL shares it with every other context of the process.
class EglContext final : public NativeContext {
 public:
  EglContext(EGLDisplay display, EGLContext context, EglPlatform platform)
      : display_(display), context_(context), platform_(platform) {}
  ~EglContext() override { eglDestroyContext(display_, context_); }
  EglContext(const EglContext&) = delete;
  EglContext& operator=(const EglContext&) = delete;

  void makeCurrent() override {
    // The API binding is per thread.
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE ||
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      throw EnvironmentError("cannot make the GL context current", platform(), "");
    }
  }
  void release() noexcept override { eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT); }

  [[nodiscard]] Function function(const char* function) const override { return eglGetProcAddress(function); }
  [[nodiscard]] std::string platform() const override { return name(platform_); }

 private:
  EGLDisplay display_;
  EGLContext context_;
  EglPlatform platform_;
};

template <class Function>
Function extension(const char* function) {
  return reinterpret_cast<Function>(eglGetProcAddress(function));
}

EGLDisplay deviceDisplay(bool software) {
  const auto queryDevices = extension<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto queryString = extension<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (queryDevices == nullptr || queryString == nullptr) return EGL_NO_DISPLAY;
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE) return EGL_NO_DISPLAY;
  for (EGLint i = 0; i < count; ++i) {
    EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
    const char* extensions = queryString(device, EGL_EXTENSIONS);
    const bool isSoftware = extensions != nullptr && std::strstr(extensions, "EGL_MESA_device_software") != nullptr;
    if (isSoftware == software) return eglGetPlatformDisplay(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
  }
  return EGL_NO_DISPLAY;
}

EGLDisplay findDisplay(EglPlatform platform) {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (client == nullptr) return EGL_NO_DISPLAY;
  if (platform == EglPlatform::kSurfaceless) {
    if (std::strstr(client, "EGL_MESA_platform_surfaceless") == nullptr) return EGL_NO_DISPLAY;
    return eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  }
  if (std::strstr(client, "EGL_EXT_platform_device") == nullptr) return EGL_NO_DISPLAY;
  return deviceDisplay(platform == EglPlatform::kSoftwareDevice);
}

}  // namespace

std::unique_ptr<NativeContext> makeEglContext(EglPlatform platform, std::string& whyNot) {
  const auto refuse = [&](const char* reason) {
    whyNot += std::string(whyNot.empty() ? "" : "; ") + name(platform) + ": " + reason;
    return nullptr;
  };
  EGLDisplay display = findDisplay(platform);
  if (display == EGL_NO_DISPLAY) return refuse("no such display");
  if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) return refuse("cannot be initialised");
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) return refuse("no desktop OpenGL");
  constexpr std::array<EGLint, 7> kAttributes = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes.data());
  if (context == EGL_NO_CONTEXT) return refuse("no OpenGL 4.5 core context");
  return std::make_unique<EglContext>(display, context, platform);
}

}  // namespace grove::gl
