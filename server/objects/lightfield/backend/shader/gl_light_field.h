#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "gl/handles.h"
#include "objects/lightfield/format/light_field.h"

namespace grove::objects::lightfield {

/// One light field as textures of one GL context: the directory, depth and colour as arrays of blocks, and the views'
/// cameras in a buffer. A lighting's colour is uploaded on first use. shaders/lightfield/field.glsl reads them.
class GlLightField {
 public:
  /// Throws EnvironmentError if the field exceeds the driver's texture limits.
  GlLightField(const gl::Api& api, const LightField& field);

  /// Uploads missing data and binds everything for the shaders.
  void bind(const LightField& field, int lighting);

  /// Graphics memory in use, and the additional memory of a lighting that is not loaded yet.
  [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }
  [[nodiscard]] std::size_t missingBytes(int lighting) const noexcept;
  /// Memory of the directory, the cameras and depth.
  [[nodiscard]] static std::size_t minBytes(const LightField& field) noexcept;

  /// Returns false if `field` is another light field, possibly at the same address.
  [[nodiscard]] bool isOf(const LightField& field) const noexcept;
  /// Returns true if the light field has been freed.
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
