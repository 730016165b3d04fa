#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "gl/handles.h"
#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {

/// One light field as textures of one GL context: the directory, depth and colour as arrays of blocks, the views'
/// cameras in a buffer. Colour is uploaded when its lighting is first used. shaders/lightfield/field.glsl reads it.
class GlLightField {
 public:
  /// Throws EnvironmentError if the field is larger than the driver's textures may be.
  GlLightField(const gl::Api& api, const LightField& field);

  /// Uploads what is missing and binds what the shaders read.
  void bind(const LightField& field, int lighting);

  /// Graphics memory in use, and what a lighting that is not there would add.
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::size_t missingBytes(int lighting) const noexcept;
  /// Of the directory, the cameras and depth.
  [[nodiscard]] static std::size_t minBytes(const LightField& field) noexcept;

  /// False if `field` is another one, perhaps at the same address.
  [[nodiscard]] bool isOf(const LightField& field) const noexcept;
  /// True if the field itself is no more.
  [[nodiscard]] bool isAbandoned() const noexcept { return storage_.expired(); }

 private:
  std::weak_ptr<const void> storage_;
  std::size_t colourBytes_;
  std::size_t bytes_ = 0;
  gl::Buffer cameras_;
  gl::TextureArray directory_;
  gl::TextureArray depth_;
  std::vector<std::optional<gl::TextureArray>> colour_;  // by lighting
};

}  // namespace grove::objects::lightfield
