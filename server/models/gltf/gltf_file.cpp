#include "models/gltf/gltf_file.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>
#include <system_error>

#include "base/log.h"
#include "models/gltf/gltf_import.h"

namespace grove::models {
namespace {

/// How many bytes may still be read.
using Budget = std::uint64_t;

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

/// Leaves decoding to those who know the limits. The pointer into a buffer view has not been checked.
bool keepEncoded(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                 int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

/// Only the first line: the rest repeats it.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Extensions without which the file says that it cannot be read.
void checkExtensions(const GltfFile& file) {
  constexpr std::array<std::string_view, 5> kKnown{"KHR_materials_transmission", "KHR_materials_diffuse_transmission",
                                                   "KHR_mesh_quantization", "KHR_materials_unlit",
                                                   "KHR_materials_specular"};
  for (const std::string& name : file.document.extensionsRequired) {
    if (std::ranges::find(kKnown, name) == kKnown.end())
      file.fail("needs the extension " + name + ", which is unknown");
  }
}

}  // namespace

void GltfFile::fail(const std::string& reason) const { throw ImportError(path, reason); }

GltfFile loadGltfFile(const std::filesystem::path& path) {
  GltfFile file{path, {}};
  std::error_code failed;
  const auto status = std::filesystem::status(path, failed);
  if (!std::filesystem::exists(status)) file.fail("there is no such file");
  if (!std::filesystem::is_regular_file(status)) file.fail("is no plain file; name a .glb or .gltf file");
  Budget budget = kMostBytes - 1;
  std::vector<unsigned char> bytes;
  std::string error;
  std::string warning;
  if (!readWhole(&bytes, &error, path.string(), &budget)) file.fail(error.empty() ? "cannot be read" : error);

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
  if (!loaded) file.fail(error.empty() ? "is not glTF 2.0" : firstLine(error));
  if (!warning.empty()) log::warning(path.string() + ": " + firstLine(warning));
  checkExtensions(file);
  return file;
}

}  // namespace grove::models
