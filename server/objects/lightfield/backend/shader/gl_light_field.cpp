#include "objects/lightfield/backend/shader/gl_light_field.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <string>

#include "base/error.h"

namespace grove::objects::lightfield {
namespace {

// Same as in shaders/lightfield/field.glsl.
constexpr std::size_t kDirectoryWidth = 2048;
constexpr std::size_t kBlocksAcross = 120;
constexpr std::size_t kBlocksInLayer = kBlocksAcross * kBlocksAcross;
constexpr GLuint kCameraBinding = 0;
constexpr GLuint kDirectoryUnit = 0;
constexpr GLuint kDepthUnit = 1;
constexpr GLuint kColourUnit = 2;

struct Camera {
  world::Vec4 eyeNear;
  world::Vec4 rightFocal;
  world::Vec4 downStep;
  world::Vec4 forward;
};

struct Format {
  GLenum internal;
  GLenum components;
  GLenum type;
};
constexpr Format kEntries{GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT};
constexpr Format kDepths{GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT};
constexpr Format kColours{GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE};

struct Extent3 {
  std::size_t width;
  std::size_t height;
  std::size_t layers;
  [[nodiscard]] std::size_t texels() const { return width * height * layers; }
};

std::size_t divided(std::size_t whole, std::size_t part) { return (whole + part - 1) / part; }

/// A single layer has only as many rows as needed.
Extent3 extentOfBlocks(const LightField& field) {
  const std::size_t blocks = std::max<std::size_t>(field.depth.size() / kBlockTexels, 1);
  const std::size_t rows = std::min(divided(blocks, kBlocksAcross), kBlocksAcross);
  return {kBlocksAcross * kBlockStride, rows * kBlockStride, divided(blocks, kBlocksInLayer)};
}

std::size_t directoryEntries(const LightField& field) {
  std::size_t entries = 0;
  for (const auto& level : field.blocks) entries += level.size();
  return entries;
}

Extent3 extentOfDirectory(const LightField& field) {
  const std::size_t rows = divided(directoryEntries(field), kDirectoryWidth);
  return {kDirectoryWidth, std::min(rows, kDirectoryWidth), divided(rows, kDirectoryWidth)};
}

void allocate(const gl::TextureArray& texture, const Format& format, const Extent3& extent) {
  const gl::Api& api = texture.api();
  GLint maxAcross = 0;
  GLint maxLayers = 0;
  api.GetIntegerv(GL_MAX_TEXTURE_SIZE, &maxAcross);
  api.GetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &maxLayers);
  const bool fits = std::max(extent.width, extent.height) <= static_cast<std::size_t>(maxAcross) &&
                    extent.layers <= static_cast<std::size_t>(maxLayers);
  while (api.GetError() != GL_NO_ERROR) {
  }
  if (fits) {
    api.TextureStorage3D(texture.name(), 1, format.internal, static_cast<GLsizei>(extent.width),
                         static_cast<GLsizei>(extent.height), static_cast<GLsizei>(extent.layers));
  }
  if (!fits || api.GetError() != GL_NO_ERROR) {
    throw EnvironmentError("a light field needs a texture of " + std::to_string(extent.width) + " x " +
                               std::to_string(extent.height) + " x " + std::to_string(extent.layers) +
                               " texels, which exceeds the limits of this driver",
                           "GL", "bake it smaller, or set renderer = \"simd\" for it in the scene file");
  }
  // Integer textures cannot be filtered; reading one with a filter returns nothing.
  api.TextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  api.TextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

/// Uploads layer by layer; `fill(layer, texels)` fills a layer.
template <class T, class Fill>
void upload(const gl::TextureArray& texture, const Format& format, const Extent3& extent, Fill fill) {
  allocate(texture, format, extent);
  std::vector<T> texels(extent.width * extent.height);
  for (std::size_t layer = 0; layer < extent.layers; ++layer) {
    fill(layer, texels);
    texture.api().TextureSubImage3D(texture.name(), 0, 0, 0, static_cast<GLint>(layer),
                                    static_cast<GLsizei>(extent.width), static_cast<GLsizei>(extent.height), 1,
                                    format.components, format.type, texels.data());
  }
}

template <class T>
void uploadBlocks(const gl::TextureArray& texture, const Format& format, const LightField& field,
                  std::span<const T> blocks) {
  const Extent3 extent = extentOfBlocks(field);
  upload<T>(texture, format, extent, [&](std::size_t layer, std::vector<T>& texels) {
    const std::size_t first = layer * kBlocksInLayer;
    const std::size_t end = std::min(first + kBlocksInLayer, blocks.size() / kBlockTexels);
    for (std::size_t block = first; block < end; ++block) {
      const std::size_t place = block - first;
      const auto from = blocks.subspan(block * kBlockTexels, kBlockTexels);
      T* to =
          texels.data() + place / kBlocksAcross * kBlockStride * extent.width + place % kBlocksAcross * kBlockStride;
      for (std::size_t row = 0; row < kBlockStride; ++row)
        std::ranges::copy(from.subspan(row * kBlockStride, kBlockStride), to + row * extent.width);
    }
  });
}

void uploadDirectory(const gl::TextureArray& texture, const LightField& field) {
  std::size_t level = 0;
  std::size_t next = 0;  // entry of the level
  const auto fill = [&](std::size_t, std::vector<std::uint32_t>& texels) {
    for (std::size_t filled = 0; filled < texels.size() && level < field.blocks.size();) {
      const auto rest = field.blocks[level].subspan(next);
      const std::size_t count = std::min(rest.size(), texels.size() - filled);
      std::ranges::copy(rest.first(count), texels.begin() + static_cast<std::ptrdiff_t>(filled));
      filled += count;
      next += count;
      if (count == rest.size()) ++level, next = 0;
    }
  };
  upload<std::uint32_t>(texture, kEntries, extentOfDirectory(field), fill);
}

void uploadCameras(const gl::Buffer& buffer, const LightField& field) {
  std::vector<Camera> cameras;
  for (int view = 0; view < field.sphere.views(); ++view) {
    const ViewCamera c = viewCamera(field.geometry, field.sphere.direction(view));
    const float step = (c.farDepth - c.nearDepth) / static_cast<float>(kNoDepth - 1);
    cameras.push_back({{c.eye, c.nearDepth}, {c.right, c.focal}, {c.down, step}, {c.forward, 0.0F}});
  }
  buffer.api().NamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(cameras.size() * sizeof(Camera)),
                                  cameras.data(), 0);
}

}  // namespace

GlLightField::GlLightField(const gl::Api& api, const LightField& field)
    : storage_(field.storage),
      colourBytes_(extentOfBlocks(field).texels() * sizeof(std::uint32_t)),
      bytes_(minBytes(field)),
      cameras_(api),
      directory_(api),
      depth_(api),
      colour_(static_cast<std::size_t>(field.lightings())) {
  uploadCameras(cameras_, field);
  uploadDirectory(directory_, field);
  uploadBlocks(depth_, kDepths, field, field.depth);
}

void GlLightField::bind(const LightField& field, int lighting) {
  const auto k = static_cast<std::size_t>(lighting);
  const gl::Api& api = cameras_.api();
  if (!colour_[k]) {
    gl::TextureArray colour(api);
    uploadBlocks(colour, kColours, field, field.colour[k]);
    colour_[k] = std::move(colour);
    bytes_ += colourBytes_;
  }
  api.BindBufferBase(GL_SHADER_STORAGE_BUFFER, kCameraBinding, cameras_.name());
  api.BindTextureUnit(kDirectoryUnit, directory_.name());
  api.BindTextureUnit(kDepthUnit, depth_.name());
  api.BindTextureUnit(kColourUnit, colour_[k]->name());
}

std::size_t GlLightField::missingBytes(int lighting) const noexcept {
  return colour_[static_cast<std::size_t>(lighting)] ? 0 : colourBytes_;
}

std::size_t GlLightField::minBytes(const LightField& field) noexcept {
  return static_cast<std::size_t>(field.sphere.views()) * sizeof(Camera) +
         extentOfDirectory(field).texels() * sizeof(std::uint32_t) +
         extentOfBlocks(field).texels() * sizeof(std::uint16_t);
}

bool GlLightField::isOf(const LightField& field) const noexcept { return storage_.lock() == field.storage; }

}  // namespace grove::objects::lightfield
