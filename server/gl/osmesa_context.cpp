#include <GL/osmesa.h>

#include <array>

#include "base/error.h"
#include "gl/native_context.h"

namespace grove::gl {
namespace {

/// OSMesa wants a colour buffer of its own even if all drawing goes to framebuffer objects: one pixel suffices.
class OsmesaContext final : public NativeContext {
 public:
  explicit OsmesaContext(OSMesaContext context) : context_(context) {}
  ~OsmesaContext() override { OSMesaDestroyContext(context_); }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  void makeCurrent() override {
    if (OSMesaMakeCurrent(context_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
      throw EnvironmentError("cannot make the GL context current", platform(), "");
    }
  }
  void release() noexcept override { OSMesaMakeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0); }

  [[nodiscard]] Function function(const char* name) const override { return OSMesaGetProcAddress(name); }
  [[nodiscard]] std::string platform() const override { return "OSMesa"; }

 private:
  OSMesaContext context_;
  std::array<unsigned char, 4> pixel_{};
};

}  // namespace

std::unique_ptr<NativeContext> makeOsmesaContext(std::string& whyNot) {
  constexpr std::array<int, 11> kAttributes = {OSMESA_FORMAT,
                                               OSMESA_RGBA,
                                               OSMESA_DEPTH_BITS,
                                               0,
                                               OSMESA_PROFILE,
                                               OSMESA_CORE_PROFILE,
                                               OSMESA_CONTEXT_MAJOR_VERSION,
                                               4,
                                               OSMESA_CONTEXT_MINOR_VERSION,
                                               5,
                                               0};
  OSMesaContext context = OSMesaCreateContextAttribs(kAttributes.data(), nullptr);
  if (context == nullptr) {
    whyNot += std::string(whyNot.empty() ? "" : "; ") + "OSMesa: no OpenGL 4.5 core context";
    return nullptr;
  }
  return std::make_unique<OsmesaContext>(context);
}

}  // namespace grove::gl
