#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "models/gltf/gltf_import.h"
#include "models/gltf/gltf_writer.h"

namespace grove::models {

/// An uncompressed 32-bit image: the simplest that stb_image reads, without a library to write it.
inline std::vector<std::uint8_t> targa(int width, int height, const std::vector<std::uint8_t>& bgra) {
  constexpr std::size_t kHeader = 18;
  std::vector<std::uint8_t> file(kHeader + bgra.size(), 0);
  file[2] = 2;
  file[12] = static_cast<std::uint8_t>(width & 255);
  file[13] = static_cast<std::uint8_t>(width >> 8);
  file[14] = static_cast<std::uint8_t>(height & 255);
  file[15] = static_cast<std::uint8_t>(height >> 8);
  file[16] = 32;
  file[17] = 0x28;  // rows from the top, eight bits of alpha
  std::ranges::copy(bgra, file.begin() + kHeader);
  return file;
}

class GltfImport : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  Model import() { return importGltf(writer.write(folder_ / "model.gltf")); }

  /// The message with which the file is refused.
  static std::string refusal(const std::filesystem::path& file) {
    try {
      static_cast<void>(importGltf(file));
    } catch (const ImportError& e) {
      return e.what();
    }
    return "was imported";
  }
  void expectRefused(const std::string& reason) {
    const auto file = writer.write(folder_ / "model.gltf");
    EXPECT_THAT(refusal(file), testing::AllOf(testing::StartsWith(file.string() + ": "), testing::HasSubstr(reason)));
  }

  /// A material with a texture of one view of the buffer or a file.
  void useTexture(Json image) {
    writer.json["images"] = {std::move(image)};
    writer.json["textures"] = {{{"source", 0}}};
    writer.json["materials"] = {{{"name", "m"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  }
  void addTexturedTriangle() {
    writer.triangle();
    const int uvs = writer.accessor(std::vector<float>{0, 1, 1, 1, 0.5F, 0}, "VEC2", kFloat);
    auto& primitive = writer.json["meshes"][0]["primitives"].back();
    primitive["attributes"]["TEXCOORD_0"] = uvs;
    primitive["material"] = 0;
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      ("gltf_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  GltfWriter writer;
};

}  // namespace grove::models
