#pragma once

#include <memory>
#include <string>

#include "gl/api.h"
#include "gl/native_context.h"

namespace grove::gl {

/// As in `--gl auto|egl|osmesa`.
enum class ContextKind { kAuto, kEgl, kOsmesa };

/// A GL 4.5 core context without a window.
///
/// Thread rule: it is current on the thread that made it, and all GL calls, the destruction of GL handles and of the
/// context itself happen there. At most one context per thread.
class Context {
 public:
  /// kEgl takes a GPU if there is one, else Mesa's software GL; kAuto falls back to OSMesa. `ordinal` spreads contexts
  /// over independent software displays, because llvmpipe rasterises for one context of a display at a time; on a GPU
  /// it has no effect. Throws EnvironmentError that lists what was tried and what to install.
  explicit Context(ContextKind kind, int ordinal = 0);
  ~Context();
  Context(Context&&) noexcept = default;
  Context& operator=(Context&&) = delete;

  [[nodiscard]] const Api& api() const noexcept { return *api_; }

  /// As in "EGL surfaceless, llvmpipe (LLVM 15.0.6, 256 bits), GL 4.5".
  [[nodiscard]] const std::string& description() const noexcept { return description_; }

  /// Vendor and version as the driver reports them, as in "Mesa, 4.5 (Core Profile) Mesa 22.3.6".
  [[nodiscard]] std::string driver() const;

  /// True if triangles are drawn by this machine's CPU.
  [[nodiscard]] bool softwareRendered() const noexcept { return software_; }

 private:
  bool adopt(std::unique_ptr<NativeContext> native);

  std::unique_ptr<NativeContext> native_;
  std::unique_ptr<const Api> api_;
  std::string description_;
  bool software_ = false;
};

}  // namespace grove::gl
