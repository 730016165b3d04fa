#pragma once

#include <memory>
#include <string>

namespace grove::gl {

/// A GL 4.5 core context of one window-system library, without a window. Made on any thread, then current on one thread
/// at a time; two contexts of different libraries must not be current on one thread at once.
class NativeContext {
 public:
  virtual ~NativeContext() = default;

  /// Throws EnvironmentError.
  virtual void makeCurrent() = 0;
  virtual void release() noexcept = 0;

  using Function = void (*)();
  [[nodiscard]] virtual Function function(const char* name) const = 0;

  /// As in "EGL surfaceless".
  [[nodiscard]] virtual std::string platform() const = 0;
};

/// Which of the machine's EGL displays.
enum class EglPlatform {
  kHardwareDevice,  ///< a GPU without a screen, by EGL_EXT_platform_device
  kSurfaceless,     ///< EGL_MESA_platform_surfaceless: Mesa's choice of driver
  kSoftwareDevice,  ///< Mesa's software device: a second, independent display
};

/// Null, with the reason in `whyNot`, if there is no such context.
[[nodiscard]] std::unique_ptr<NativeContext> makeEglContext(EglPlatform platform, std::string& whyNot);
[[nodiscard]] std::unique_ptr<NativeContext> makeOsmesaContext(std::string& whyNot);

}  // namespace grove::gl
