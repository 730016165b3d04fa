#include "models/gltf/gltf_file.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include "base/log.h"
#include "base/name_list.h"
#include "models/gltf/gltf_import.h"
#include "models/gltf/json_nesting.h"

namespace grove::models {
namespace {

/// Number of bytes that may still be read.
using Budget = std::uint64_t;

constexpr int kMaxNested = 64;

bool fileExists(const std::string& name, void*) {
  std::error_code failed;
  return std::filesystem::is_regular_file(name, failed);  // a device or pipe might never end
}

std::string sameName(const std::string& name, void*) { return name; }

bool readWhole(std::vector<unsigned char>* bytes, std::string* error, const std::string& name, void* user) {
  auto& budget = *static_cast<Budget*>(user);
  std::ifstream in(name, std::ios::binary | std::ios::ate);
  const std::streamoff size = in ? std::streamoff{in.tellg()} : -1;
  if (size < 0 || static_cast<std::uint64_t>(size) > budget) {
    *error += size < 0 ? "cannot read " + name : "more than 4 GiB with " + name;
    return false;
  }
  budget -= static_cast<std::uint64_t>(size);
  bytes->resize(static_cast<std::size_t>(size));
  in.seekg(0);
  return static_cast<bool>(in.read(static_cast<char*>(static_cast<void*>(bytes->data())), size));
}

/// Leaves decoding to readMaterials(), which checks the limits. The pointer into a buffer view is not validated.
bool keepEncoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

/// The rest of the text repeats the first line.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

bool has(const std::vector<std::string>& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

/// Whether the file cannot be read without an extension, even if it does not require it: a compressed mesh has no other
/// positions.
bool needs(const tinygltf::Model& document, const std::string& extension) {
  if (has(document.extensionsRequired, extension)) return true;
  for (const tinygltf::Mesh& mesh : document.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const auto position = primitive.attributes.find("POSITION");
      if (position == primitive.attributes.end() || !primitive.extensions.contains(extension)) continue;
      const auto accessor = static_cast<std::size_t>(position->second);
      if (accessor < document.accessors.size() && document.accessors[accessor].bufferView < 0) return true;
    }
  }
  return false;
}

/// The parser does not find compressed data, and fails with an unrelated message.
void refuseCompression(const GltfFile& file, bool parsed) {
  for (const char* const name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "KHR_meshopt_compression"}) {
    if (needs(file.document, name) || (!parsed && has(file.document.extensionsUsed, name))) {
      file.fail(std::string("is compressed by ") + name + ", which Grove cannot read; export it without compression");
    }
  }
}

bool isKnown(std::string_view extension) {
  constexpr std::array<std::string_view, 6> kKnown{"KHR_materials_transmission", "KHR_materials_diffuse_transmission",
                                                   "KHR_mesh_quantization",      "KHR_materials_unlit",
                                                   "KHR_materials_specular",     "KHR_texture_transform"};
  return std::ranges::find(kKnown, extension) != kKnown.end();
}

/// Rejects required extensions that are not supported.
void checkExtensions(const GltfFile& file) {
  for (const std::string& name : file.document.extensionsRequired) {
    if (!isKnown(name))
      file.fail("needs the extension " + nameList({name}) + ", which Grove does not know; export it without");
  }
}

void logIgnoredFeatures(const GltfFile& file) {
  std::vector<std::string> names;
  std::ranges::copy_if(file.document.extensionsUsed, std::back_inserter(names),
                       [](const std::string& name) { return !isKnown(name); });
  if (!file.document.animations.empty()) names.emplace_back("animations");
  if (!file.document.skins.empty()) names.emplace_back("skins");
  if (!names.empty()) log::warning(file.path.string() + ": ignores " + nameList(names));
}

/// The JSON of a file, unchecked.
std::string_view jsonOf(std::span<const unsigned char> bytes) {
  const std::string_view text(static_cast<const char*>(static_cast<const void*>(bytes.data())), bytes.size());
  constexpr std::size_t kHeaders = 20;  // of a binary file and of its first chunk
  return text.starts_with("glTF") ? text.substr(std::min(kHeaders, text.size())) : text;
}

}  // namespace

void GltfFile::fail(const std::string& reason) const { throw ImportError(path, reason); }

void GltfFile::failFor(const char* what, int index) const {
  fail(std::string("there is no ") + what + " " + std::to_string(index));
}

GltfFile loadGltfFile(const std::filesystem::path& path) {
  GltfFile file{path, {}};
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (!std::filesystem::exists(status)) file.fail("there is no such file");
  if (!std::filesystem::is_regular_file(status)) file.fail("is not a regular file; name a .glb or .gltf file");
  Budget budget = kMaxBytes - 1;
  std::vector<unsigned char> bytes;
  std::string error;
  std::string warning;
  if (!readWhole(&bytes, &error, path.string(), &budget)) file.fail(error.empty() ? "cannot be read" : error);

  if (nestsDeeper(jsonOf(bytes), kMaxNested)) file.fail("is nested more than " + std::to_string(kMaxNested) + " deep");

  tinygltf::TinyGLTF loader;
  loader.SetImageLoader(keepEncoded, nullptr);
  loader.SetFsCallbacks({fileExists, sameName, readWhole, nullptr, &budget});
  const auto size = static_cast<unsigned int>(bytes.size());
  const std::string folder = path.parent_path().string();
  const bool binary = bytes.size() >= 4 && std::equal(bytes.begin(), bytes.begin() + 4, "glTF");
  bool loaded = false;
  try {
    const auto* const text = static_cast<const char*>(static_cast<const void*>(bytes.data()));
    loaded = binary ? loader.LoadBinaryFromMemory(&file.document, &error, &warning, bytes.data(), size, folder)
                    : loader.LoadASCIIFromString(&file.document, &error, &warning, text, size, folder);
  } catch (const std::exception& e) {
    error = e.what();
  }
  refuseCompression(file, loaded);
  if (!loaded) file.fail(error.empty() ? "is not glTF 2.0" : firstLine(error));
  if (!warning.empty()) log::warning(path.string() + ": " + firstLine(warning));
  checkExtensions(file);
  logIgnoredFeatures(file);
  return file;
}

}  // namespace grove::models
