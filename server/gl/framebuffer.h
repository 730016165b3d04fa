#pragma once

#include <cstddef>

#include "gl/handles.h"

namespace grove::gl {

/// A target to draw to: RGBA8 colour (not sRGB: shaders encode for the display themselves) and 32-bit float depth.
class Framebuffer {
 public:
  Framebuffer(const Api& api, int width, int height);

  /// Makes it the one that is drawn to and read from.
  void bind() const;

  [[nodiscard]] GLuint name() const noexcept { return framebuffer_.name(); }
  [[nodiscard]] int width() const noexcept { return width_; }
  [[nodiscard]] int height() const noexcept { return height_; }
  /// Memory that it takes.
  [[nodiscard]] std::size_t bytes() const noexcept {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 8;
  }

 private:
  FramebufferName framebuffer_;
  Texture colour_;
  Texture depth_;
  int width_;
  int height_;
};

}  // namespace grove::gl
