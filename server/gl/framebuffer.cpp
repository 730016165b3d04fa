#include "gl/framebuffer.h"

#include <string>

#include "base/error.h"

namespace grove::gl {

Framebuffer::Framebuffer(const Api& api, int width, int height)
    : framebuffer_(api), colour_(api), depth_(api), width_(width), height_(height) {
  api.TextureStorage2D(colour_.name(), 1, GL_RGBA8, width, height);
  api.TextureStorage2D(depth_.name(), 1, GL_DEPTH_COMPONENT32F, width, height);
  api.NamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, colour_.name(), 0);
  api.NamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, depth_.name(), 0);
  if (api.CheckNamedFramebufferStatus(framebuffer_.name(), GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    throw EnvironmentError("cannot make a framebuffer of " + std::to_string(width) + "x" + std::to_string(height), "GL",
                           "more graphics memory may be needed");
  }
}

void Framebuffer::bind() const { framebuffer_.api().BindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name()); }

}  // namespace grove::gl
