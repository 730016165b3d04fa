#include "models/gltf/gltf_materials.h"

#include <stb/stb_image.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <tuple>
#include <utility>

#include "base/log.h"
#include "models/gltf/gltf_accessor.h"
#include "models/gltf/gltf_import.h"

namespace grove::models {
namespace {

using world::Vec3;

// share of a leaf's light that passes through, where a file specifies only "leaf"
constexpr float kThroughLeaf = 0.35F;

/// An encoded image.
struct Encoded {
  std::span<const unsigned char> bytes;
  std::string name;  ///< for messages

  [[nodiscard]] int size() const noexcept { return static_cast<int>(bytes.size()); }
};

/// A texture of the image's size, without texels.
Texture measure(const GltfFile& file, const Encoded& image) {
  if (image.bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    file.fail(image.name + " is too large");
  }
  Texture texture;
  int channels = 0;
  if (stbi_info_from_memory(image.bytes.data(), image.size(), &texture.width, &texture.height, &channels) == 0) {
    file.fail(image.name + " is not a readable image (PNG and JPEG are supported)");
  }
  if (texture.width > kMaxTextureSide || texture.height > kMaxTextureSide) {
    file.fail(image.name + " has " + std::to_string(texture.width) + " x " + std::to_string(texture.height) +
              " texels; the limit is " + std::to_string(kMaxTextureSide) + " per side");
  }
  return texture;
}

void decode(const GltfFile& file, const Encoded& image, Texture& texture) {
  int channels = 0;
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> texels(
      stbi_load_from_memory(image.bytes.data(), image.size(), &texture.width, &texture.height, &channels, 4),
      stbi_image_free);
  if (!texels) file.fail(image.name + " is broken: " + stbi_failure_reason());
  texture.texels.resize(static_cast<std::size_t>(texture.width) * static_cast<std::size_t>(texture.height));
  std::memcpy(texture.texels.data(), texels.get(), texture.texels.size() * sizeof(std::uint32_t));
}

/// Measures each image on first use, and decodes all after their total size is checked.
class TextureShelf {
 public:
  TextureShelf(const GltfFile& file, std::vector<Texture>& textures) : file_(file), textures_(textures) {}

  /// Index into the textures; -1 if there is none or its file is missing.
  int indexOf(int texture) {
    if (texture < 0) return -1;
    const int source = file_.at(file_.document.textures, texture, "texture").source;
    if (source < 0) return -1;
    const tinygltf::Image& image = file_.at(file_.document.images, source, "image");
    const auto [known, isNew] = known_.try_emplace(Key{image.bufferView, image.uri, hasPlace(image) ? -1 : source}, -1);
    if (isNew) known->second = add(image, source);
    return known->second;
  }

  void decodeAll() {
    for (std::size_t i = 0; i < encoded_.size(); ++i) decode(file_, encoded_[i], textures_[i]);
  }

 private:
  /// Buffer view, file and, if it has neither, the image's number: several images may share their bytes.
  using Key = std::tuple<int, std::string, int>;

  static bool hasPlace(const tinygltf::Image& image) { return image.bufferView >= 0 || !image.uri.empty(); }

  int add(const tinygltf::Image& image, int source) {
    const std::string name = "image " + std::to_string(source) + (image.uri.empty() ? "" : " (" + image.uri + ")");
    if (image.bufferView < 0 && image.image.empty()) {
      log::warning(file_.path.string() + ": " + name + " is missing; uses the base colour instead");
      return -1;
    }
    const Encoded encoded{image.bufferView < 0 ? std::span(image.image) : viewBytes(file_, image.bufferView), name};
    const Texture& texture = textures_.emplace_back(measure(file_, encoded));
    texels_ += static_cast<std::uint64_t>(texture.width) * static_cast<std::uint64_t>(texture.height);
    if (texels_ > kMaxTexels) {
      file_.fail("has more than " + std::to_string(kMaxTexels) + " texels in its images together; make them smaller");
    }
    encoded_.push_back(encoded);
    return static_cast<int>(encoded_.size()) - 1;
  }

  const GltfFile& file_;
  std::vector<Texture>& textures_;
  std::vector<Encoded> encoded_;  ///< one per texture
  std::map<Key, int> known_;
  std::uint64_t texels_ = 0;
};

/// A number of a material's extension; 0 if it is missing.
float extensionNumber(const tinygltf::Material& material, const char* extension, const char* key) {
  const auto found = material.extensions.find(extension);
  if (found == material.extensions.end() || !found->second.IsObject() || !found->second.Has(key)) return 0.0F;
  const tinygltf::Value& value = found->second.Get(key);
  return value.IsNumber() ? std::clamp(static_cast<float>(value.GetNumberAsDouble()), 0.0F, 1.0F) : 0.0F;
}

float alphaOf(const tinygltf::Material& given) {
  return std::clamp(static_cast<float>(given.pbrMetallicRoughness.baseColorFactor[3]), 0.0F, 1.0F);
}

Material materialOf(const GltfFile& file, const tinygltf::Material& given, TextureShelf& shelf) {
  const auto& factor = given.pbrMetallicRoughness.baseColorFactor;
  if (factor.size() != 4) file.fail("material '" + given.name + "' has a base colour without four numbers");
  const auto channel = [&](std::size_t i) { return std::clamp(static_cast<float>(factor[i]), 0.0F, 1.0F); };
  const Vec3 colour(channel(0), channel(1), channel(2));
  Material material;
  material.name = given.name;
  material.twoSided = given.doubleSided;
  material.texture = shelf.indexOf(given.pbrMetallicRoughness.baseColorTexture.index);
  float through = std::max(extensionNumber(given, "KHR_materials_transmission", "transmissionFactor"),
                           extensionNumber(given, "KHR_materials_diffuse_transmission", "diffuseTransmissionFactor"));
  // The cut-off applies to the product of the texture's alpha and the factor's.
  const float alpha = std::max(alphaOf(given), 1.0e-3F);
  if (given.alphaMode == "BLEND") {
    material.blended = true;
    material.alphaCutoff = 1.0F / alpha;
  } else if (given.alphaMode == "MASK") {
    material.alphaCutoff = std::clamp(static_cast<float>(given.alphaCutoff) / alpha, 0.0F, 1.0F);
  }
  const bool leaf = given.doubleSided && material.texture >= 0 && (material.blended || given.alphaMode == "MASK");
  if (leaf) through = std::max(through, kThroughLeaf);
  material.albedo = colour * (1.0F - through);
  material.transmittance = colour * through;
  material.solid = through == 0.0F;
  return material.texture < 0 ? withoutTexture(std::move(material)) : material;
}

}  // namespace

std::vector<Material> readMaterials(const GltfFile& file, std::vector<Texture>& textures) {
  TextureShelf shelf(file, textures);
  std::vector<Material> materials;
  for (const tinygltf::Material& given : file.document.materials) materials.push_back(materialOf(file, given, shelf));
  shelf.decodeAll();
  materials.push_back({.name = "plain", .albedo = Vec3(1.0F), .twoSided = false, .solid = true});
  if (materials.size() > std::numeric_limits<std::uint16_t>::max()) file.fail("has more than 65535 materials");
  return materials;
}

bool isUnseen(const tinygltf::Material& material) {
  if (material.alphaMode == "MASK") return alphaOf(material) < static_cast<float>(material.alphaCutoff);
  return material.alphaMode == "BLEND" && alphaOf(material) == 0.0F;
}

Material withoutTexture(Material material) {
  material.texture = -1;
  material.blended = material.blended && material.alphaCutoff > 1.0F;
  if (!material.blended) material.alphaCutoff = 0.0F;
  material.solid = material.solid && !material.blended;  // for example glass by KHR_materials_transmission
  return material;
}

}  // namespace grove::models
