#include <gmock/gmock.h>

#include <cstdint>
#include <string>
#include <vector>

#include "models/gltf/gltf_import_fixture.h"

namespace grove::models {
namespace {

using testing::HasSubstr;

TEST_F(GltfImport, RefusesHugeUvs) {
  writer.triangle();
  const int uvs = writer.accessor(std::vector<float>{3.4e38F, 0, 3.4e38F, 0, 3.4e38F, 1}, "VEC2", kFloat);
  writer.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uvs;
  expectRefused("has UVs beyond 1000000");
}

TEST_F(GltfImport, RefusesTransformsToHugeUvs) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(1, 1, {1, 2, 3, 255}))}, {"mimeType", "image/x-tga"}});
  Json& texture = writer.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture["extensions"]["KHR_texture_transform"]["scale"] = {-2.0e6, 1.0};
  expectRefused("has UVs beyond 1000000");
}

TEST_F(GltfImport, RefusesHugeModels) {
  writer.triangle();
  writer.json["accessors"][0]["count"] = 4'000'000'000U;
  expectRefused("an accessor of 4000000000 elements");
}

TEST_F(GltfImport, RefusesAModestMeshRepeatedTooOften) {
  // 300,000 triangles, 200 times.
  std::vector<std::uint8_t> order(900'000);
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint8_t>(i % 3);
  const int indices = writer.accessor(order, "SCALAR", kU8);
  writer.triangle()["indices"] = indices;
  writer.json["nodes"] = Json::array();
  writer.json["scenes"][0]["nodes"] = Json::array();
  for (int i = 0; i < 200; ++i) {
    writer.json["nodes"].push_back({{"mesh", 0}});
    writer.json["scenes"][0]["nodes"].push_back(i);
  }
  expectRefused("more than 50000000 triangles");
}

TEST_F(GltfImport, CountsTheTrianglesOfStripsAndFansWithoutIndices) {
  for (const int mode : {5, 6}) {
    writer.triangle()["mode"] = mode;
    writer.json["accessors"].back()["count"] = 60'000'000;
    expectRefused("more than 50000000 triangles");
    writer.json["meshes"][0]["primitives"].clear();
  }
}

TEST_F(GltfImport, RefusesPrimitivesInTooManyPlaces) {
  // Without positions: they would only cost time.
  for (int i = 0; i < 3000; ++i) {
    writer.json["meshes"][0]["primitives"].push_back({{"attributes", Json::object()}});
    writer.json["nodes"][static_cast<std::size_t>(i)] = {{"mesh", 0}};
    writer.json["scenes"][0]["nodes"][static_cast<std::size_t>(i)] = i;
  }
  expectRefused("more than 5000000 primitives");
}

TEST_F(GltfImport, RefusesImagesThatAreTooLargeTogether) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(kMaxTextureSide, kMaxTextureSide, {}))}, {"mimeType", "image/x-tga"}});
  for (int i = 1; i < 3; ++i) {
    writer.json["images"].push_back(
        {{"bufferView", writer.view(targa(kMaxTextureSide, kMaxTextureSide, {}))}, {"mimeType", "image/x-tga"}});
    writer.json["textures"].push_back({{"source", i}});
    Json material = writer.json["materials"][0];
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = i;
    writer.json["materials"].push_back(material);
  }
  expectRefused("more than 536870912 texels in its images together");
}

TEST_F(GltfImport, RefusesTexturesThatAreTooLarge) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(kMaxTextureSide + 1, 1, {}))}, {"mimeType", "image/x-tga"}});
  expectRefused("16385 x 1 texels");
}

TEST_F(GltfImport, RefusesAModelWithoutExtent) {
  writer.primitive({1, 2, 3, 1, 2, 3, 1, 2, 3});
  expectRefused("no extent");
}

TEST_F(GltfImport, RefusesExtremeExtents) {
  writer.triangle();  // 2 m wide
  for (const double scale : {0.00051, 49'000.0}) {
    writer.json["nodes"][0]["scale"] = {scale, scale, scale};
    EXPECT_EQ(import().triangles.indices.size(), 1U) << scale;
  }
  for (const double scale : {0.00049, 51'000.0}) {
    writer.json["nodes"][0]["scale"] = {scale, scale, scale};
    expectRefused("can be shown; a glTF file's unit is the metre");
  }
}

TEST_F(GltfImport, RefusesDeepNesting) {
  writer.triangle();
  constexpr std::size_t kDeep = 200'000;
  const std::string deep = std::string(kDeep, '[') + std::string(kDeep, ']');
  writer.json["nodes"][0]["extras"] = "DEEP";
  for (const std::string name : {"model.gltf", "model.glb"}) {
    const auto file = folder_ / name;
    if (name == "model.gltf") {
      writer.write(file);
      std::string text = writer.json.dump();
      GltfWriter::save(file, text.replace(text.find("\"DEEP\""), 6, deep));
    } else {
      std::string text = "{\"extras\":" + deep + ",\"asset\":{\"version\":\"2.0\"}}  ";
      text.resize(text.size() / 4 * 4);
      const auto number = [](std::size_t value) {
        std::string four;
        for (int i = 0; i < 4; ++i) four += static_cast<char>(value >> (8 * i) & 0xFFU);
        return four;
      };
      GltfWriter::save(file, "glTF" + number(2) + number(20 + text.size()) + number(text.size()) + "JSON" + text);
    }
    EXPECT_THAT(refusal(file), HasSubstr("nested more than 64 deep")) << name;
  }
  writer.json["nodes"][0]["extras"] = "[[[[ \\\" " + std::string(100, '{');
  EXPECT_EQ(import().triangles.indices.size(), 1U) << "brackets in a string";
}

}  // namespace
}  // namespace grove::models
