#include "models/gltf/gltf_texture_placement.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace grove::models {
namespace {

using world::Vec2;

float finite(const GltfFile& file, const tinygltf::Value& value) {
  const auto number = value.IsNumber() ? static_cast<float>(value.GetNumberAsDouble()) : NAN;
  if (!std::isfinite(number)) file.fail("has a KHR_texture_transform without finite numbers");
  return number;
}

Vec2 pairOr(const GltfFile& file, const tinygltf::Value& transform, const std::string& key, Vec2 otherwise) {
  if (!transform.Has(key)) return otherwise;
  const tinygltf::Value& pair = transform.Get(key);
  if (!pair.IsArray() || pair.ArrayLen() != 2) file.fail("has a KHR_texture_transform whose " + key + " is not a pair");
  return {finite(file, pair.Get(0)), finite(file, pair.Get(1))};
}

}  // namespace

TexturePlacement placementOf(const GltfFile& file, const tinygltf::TextureInfo& texture) {
  TexturePlacement placement{texture.texCoord, glm::mat3(1.0F)};
  const auto found = texture.extensions.find("KHR_texture_transform");
  if (found == texture.extensions.end() || !found->second.IsObject()) return placement;
  const tinygltf::Value& transform = found->second;
  const Vec2 offset = pairOr(file, transform, "offset", Vec2(0.0F));
  const Vec2 scale = pairOr(file, transform, "scale", Vec2(1.0F));
  const float turn = transform.Has("rotation") ? finite(file, transform.Get("rotation")) : 0.0F;
  if (transform.Has("texCoord")) {
    placement.uvSet = static_cast<int>(std::clamp(finite(file, transform.Get("texCoord")), 0.0F, 1000.0F));
  }
  // Counter-clockwise in an image, whose v points down. The listing in the extension's text rotates the other way,
  // against its words and common practice (github.com/KhronosGroup/glTF/issues/1563).
  const float c = std::cos(turn);
  const float s = std::sin(turn);
  placement.matrix =
      glm::mat3(c * scale.x, -s * scale.x, 0.0F, s * scale.y, c * scale.y, 0.0F, offset.x, offset.y, 1.0F);
  return placement;
}

}  // namespace grove::models
