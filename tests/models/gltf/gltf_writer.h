#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace grove::models {

using Json = nlohmann::ordered_json;

inline constexpr int kU8 = 5121;
inline constexpr int kI16 = 5122;
inline constexpr int kU16 = 5123;
inline constexpr int kU32 = 5125;
inline constexpr int kFloat = 5126;

/// Puts together glTF files, right ones and wrong ones: the JSON is open to all.
class GltfWriter {
 public:
  GltfWriter() {
    json["asset"]["version"] = "2.0";
    json["scene"] = 0;
    json["scenes"] = {{{"nodes", {0}}}};
    json["nodes"] = {{{"mesh", 0}}};
    json["meshes"] = {{{"primitives", Json::array()}}};
  }

  Json json;
  std::string bytes;  ///< the one buffer

  template <class T>
  int view(const std::vector<T>& values) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    const std::size_t offset = bytes.size();
    bytes.resize(offset + values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(&bytes[offset], values.data(), values.size() * sizeof(T));
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }

  template <class T>
  int accessor(const std::vector<T>& values, const char* type, int componentType, bool normalized = false) {
    const std::string name = type;
    const std::size_t width = name == "SCALAR" ? 1 : static_cast<std::size_t>(name.back() - '0');
    json["accessors"].push_back({{"bufferView", view(values)},
                                 {"componentType", componentType},
                                 {"count", values.size() / width},
                                 {"type", type},
                                 {"normalized", normalized}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }

  /// A primitive of the first mesh; returns it to be changed.
  Json& primitive(const std::vector<float>& positions) {
    json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", accessor(positions, "VEC3", kFloat)}}}});
    return json["meshes"][0]["primitives"].back();
  }

  /// One triangle in the plane z = 0, seen from +z; 2 wide and 1 tall.
  Json& triangle() { return primitive({-1, 0, 0, 1, 0, 0, 0, 1, 0}); }

  /// Writes JSON with the buffer in a file of its own beside.
  std::filesystem::path write(const std::filesystem::path& file) {
    std::filesystem::path buffer = file;
    buffer.replace_extension(".bin");
    save(buffer, bytes);
    if (!bytes.empty()) json["buffers"] = {{{"byteLength", bytes.size()}, {"uri", buffer.filename().string()}}};
    save(file, json.dump());
    return file;
  }

  /// Writes one binary file.
  std::filesystem::path writeBinary(const std::filesystem::path& file) {
    bytes.resize((bytes.size() + 3) / 4 * 4);
    json["buffers"] = {{{"byteLength", bytes.size()}}};
    std::string text = json.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const auto number = [](std::size_t value) {
      const auto small = static_cast<std::uint32_t>(value);
      std::string four(4, '\0');
      std::memcpy(four.data(), &small, 4);
      return four;
    };
    save(file, "glTF" + number(2) + number(12 + 8 + text.size() + 8 + bytes.size()) + number(text.size()) + "JSON" +
                   text + number(bytes.size()) + std::string("BIN\0", 4) + bytes);
    return file;
  }

  static void save(const std::filesystem::path& file, const std::string& content) {
    std::ofstream(file, std::ios::binary) << content;
  }
};

}  // namespace grove::models
