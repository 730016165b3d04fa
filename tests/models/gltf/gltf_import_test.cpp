#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "models/gltf/gltf_import_fixture.h"

namespace grove::models {
namespace {

using testing::HasSubstr;
using world::Vec2;
using world::Vec3;

TEST_F(GltfImport, ReadsAMinimalFile) {
  writer.triangle();
  const Model model = import();
  EXPECT_EQ(model.name, "model");
  ASSERT_EQ(model.triangles.indices.size(), 1U);
  EXPECT_THAT(model.triangles.positions, testing::ElementsAre(Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)));
  EXPECT_THAT(model.normals, testing::Each(Vec3(0, 0, 1)));
  EXPECT_THAT(model.colours, testing::Each(Vec3(1)));
  ASSERT_EQ(model.materials.size(), 1U);
  EXPECT_EQ(model.materials[0].albedo, Vec3(1));
  EXPECT_TRUE(model.materials[0].solid);
}

TEST_F(GltfImport, ReadsABinaryFile) {
  writer.triangle();
  const Model text = import();
  const Model binary = importGltf(writer.writeBinary(folder_ / "model.glb"));
  EXPECT_EQ(text.triangles.positions, binary.triangles.positions);
  EXPECT_EQ(text.triangles.indices, binary.triangles.indices);
}

TEST_F(GltfImport, PlacesNodesByMatrixAndByTranslationRotationScale) {
  writer.triangle();
  // Parent: 2 up. Child by TRS: doubled, a quarter turn about y. Child by matrix: mirrored in x, 10 to the right.
  writer.json["nodes"] = Json::parse(R"([
    {"translation": [0, 2, 0], "children": [1, 2]},
    {"mesh": 0, "scale": [2, 2, 2], "rotation": [0, 0.70710678, 0, 0.70710678]},
    {"mesh": 0, "matrix": [-1,0,0,0, 0,1,0,0, 0,0,1,0, 10,0,0,1]}])");
  const Model model = import();
  ASSERT_EQ(model.triangles.indices.size(), 2U);
  const world::Bounds bounds = model.triangles.bounds();
  EXPECT_NEAR(bounds.low.y, 0.0F, 1.0e-5F);
  EXPECT_NEAR(bounds.high.y, 2.0F, 1.0e-5F);
  EXPECT_NEAR(bounds.size().x, 11.0F, 1.0e-5F);
  EXPECT_NEAR(bounds.size().z, 4.0F, 1.0e-5F);
  EXPECT_NEAR(bounds.centre().x, 0.0F, 1.0e-5F);
  EXPECT_NEAR(bounds.centre().z, 0.0F, 1.0e-5F);
  // Every triangle's winding agrees with its normals, the mirrored one's too.
  for (const auto& [a, b, c] : model.triangles.indices) {
    const auto& p = model.triangles.positions;
    EXPECT_GT(glm::dot(glm::cross(p[b] - p[a], p[c] - p[a]), model.normals[a]), 0.0F);
  }
  EXPECT_NEAR(std::abs(model.normals[3].x) + std::abs(model.normals[0].x), 1.0F, 1.0e-5F);
}

TEST_F(GltfImport, ReadsListsStripsAndFansWithIndicesOfAllWidths) {
  const std::vector<float> square{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  writer.primitive(square)["indices"] = writer.accessor(std::vector<std::uint8_t>{0, 1, 2, 2, 1, 3}, "SCALAR", kU8);
  auto& strip = writer.primitive(square);
  strip["mode"] = 5;
  const int stripOrder = writer.accessor(std::vector<std::uint16_t>{0, 1, 2, 3}, "SCALAR", kU16);
  writer.json["meshes"][0]["primitives"][1]["indices"] = stripOrder;
  auto& fan = writer.primitive(square);
  fan["mode"] = 6;
  const int fanOrder = writer.accessor(std::vector<std::uint32_t>{0, 1, 3, 2}, "SCALAR", kU32);
  writer.json["meshes"][0]["primitives"][2]["indices"] = fanOrder;
  writer.primitive({0, 0, 0, 5, 0, 0})["mode"] = 1;  // a line is left out
  const Model model = import();
  ASSERT_EQ(model.triangles.indices.size(), 6U);
  for (const auto& [a, b, c] : model.triangles.indices) {
    const auto& p = model.triangles.positions;
    EXPECT_FLOAT_EQ(glm::cross(p[b] - p[a], p[c] - p[a]).z, 1.0F);
  }
  EXPECT_NEAR(model.triangles.bounds().size().x, 1.0F, 1.0e-6F);
}

TEST_F(GltfImport, ReadsNormalizedAttributesAndColours) {
  writer.triangle();
  const int colours =
      writer.accessor(std::vector<std::uint8_t>{255, 0, 0, 255, 0, 51, 0, 255, 0, 0, 255, 255}, "VEC4", kU8, true);
  const int uvs = writer.accessor(std::vector<std::uint16_t>{0, 65535, 32768, 0, 65535, 65535}, "VEC2", kU16, true);
  auto& attributes = writer.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["COLOR_0"] = colours;
  attributes["TEXCOORD_0"] = uvs;
  const Model model = import();
  EXPECT_EQ(model.colours[0], Vec3(1, 0, 0));
  EXPECT_NEAR(model.colours[1].g, 0.2F, 1.0e-6F);
  EXPECT_EQ(model.uvs[0], Vec2(0, 1));
  EXPECT_NEAR(model.uvs[1].x, 0.5F, 1.0e-4F);
}

TEST_F(GltfImport, ReplacesTheElementsOfSparseAccessors) {
  writer.triangle();
  const int where = writer.view(std::vector<std::uint16_t>{2});
  const int values = writer.view(std::vector<float>{0, 3, 0});
  writer.json["accessors"][0]["sparse"] = {{"count", 1},
                                           {"indices", {{"bufferView", where}, {"componentType", kU16}}},
                                           {"values", {{"bufferView", values}}}};
  EXPECT_FLOAT_EQ(import().triangles.bounds().high.y, 3.0F);
}

TEST_F(GltfImport, DoubleSidedCutOutsAreLeaves) {
  addTexturedTriangle();
  const int image = writer.view(targa(2, 1, {10, 20, 30, 255, 40, 50, 60, 0}));
  useTexture({{"bufferView", image}, {"mimeType", "image/x-tga"}});
  writer.json["materials"][0]["alphaMode"] = "MASK";
  writer.json["materials"][0]["alphaCutoff"] = 0.25;
  writer.json["materials"][0]["doubleSided"] = true;
  const Model model = import();
  ASSERT_EQ(model.textures.size(), 1U);
  EXPECT_EQ(model.textures[0].width, 2);
  EXPECT_EQ(model.textures[0].height, 1);
  EXPECT_THAT(model.textures[0].texels, testing::ElementsAre(0xFF0A141EU, 0x0028323CU));
  const Material& leaf = model.materials[model.materialOf[0]];
  EXPECT_EQ(leaf.texture, 0);
  EXPECT_FLOAT_EQ(leaf.alphaCutoff, 0.25F);
  EXPECT_TRUE(leaf.twoSided);
  EXPECT_FALSE(leaf.solid);
  EXPECT_GT(leaf.transmittance.g, 0.1F);
  EXPECT_LE(leaf.transmittance.g + leaf.albedo.g, 1.0F);
}

TEST_F(GltfImport, ReadsTextureFiles) {
  addTexturedTriangle();
  const auto image = targa(1, 1, {1, 2, 3, 255});
  GltfWriter::save(folder_ / "my skin.tga", std::string(image.begin(), image.end()));
  useTexture({{"uri", "my%20skin.tga"}});
  EXPECT_EQ(import().textures.size(), 1U);
}

TEST_F(GltfImport, DecodesRepeatedImagesOnce) {
  addTexturedTriangle();
  const auto image = targa(1, 1, {1, 2, 3, 255});
  GltfWriter::save(folder_ / "skin.tga", std::string(image.begin(), image.end()));
  const int view = writer.view(image);
  useTexture({{"uri", "skin.tga"}});
  writer.json["images"].push_back({{"uri", "skin.tga"}});
  for (int i = 0; i < 2; ++i) writer.json["images"].push_back({{"bufferView", view}, {"mimeType", "image/x-tga"}});
  for (int i = 1; i < 4; ++i) {
    writer.json["textures"].push_back({{"source", i}});
    Json material = writer.json["materials"][0];
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = i;
    writer.json["materials"].push_back(material);
  }
  const Model model = import();
  EXPECT_EQ(model.textures.size(), 2U);
  EXPECT_EQ(model.materials[0].texture, model.materials[1].texture);
  EXPECT_EQ(model.materials[2].texture, model.materials[3].texture);
}

TEST_F(GltfImport, MissingTextureFallsBackToBaseColour) {
  addTexturedTriangle();
  useTexture({{"uri", "nowhere.png"}});
  writer.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.2, 0.3, 1.0};
  testing::internal::CaptureStderr();
  const Model model = import();
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("nowhere.png"));
  const Material& material = model.materials[model.materialOf[0]];
  EXPECT_EQ(material.texture, -1);
  EXPECT_FLOAT_EQ(material.albedo.b, 0.3F);
}

TEST_F(GltfImport, IgnoresTexturesWithoutUvs) {
  writer.triangle()["material"] = 0;
  useTexture({{"bufferView", writer.view(targa(1, 1, {1, 2, 3, 255}))}, {"mimeType", "image/x-tga"}});
  const Model model = import();
  EXPECT_EQ(model.materials[model.materialOf[0]].texture, -1);
}

TEST_F(GltfImport, ReadsTransmission) {
  writer.triangle()["material"] = 0;
  writer.json["materials"] =
      Json::parse(R"([{"extensions": {"KHR_materials_transmission": {"transmissionFactor": 0.75}}}])");
  const Model model = import();
  EXPECT_FLOAT_EQ(model.materials[0].albedo.r, 0.25F);
  EXPECT_FLOAT_EQ(model.materials[0].transmittance.r, 0.75F);
  EXPECT_FALSE(model.materials[0].solid);
}

TEST_F(GltfImport, ImportsTheLanternTree) {
  const Model model = importGltf(std::filesystem::path(__FILE__).parent_path() / "lantern_tree.gltf");
  const world::Bounds bounds = model.triangles.bounds();
  EXPECT_NEAR(bounds.low.y, 0.0F, 1.0e-5F);
  EXPECT_NEAR(bounds.high.y, 3.5F, 0.4F);
  EXPECT_EQ(model.textures.size(), 1U);
  std::vector<int> uses(model.materials.size(), 0);
  for (const auto material : model.materialOf) ++uses[material];
  EXPECT_EQ(std::ranges::count_if(uses, [](int n) { return n > 0; }), 4);
  for (const Vec3 normal : model.normals) ASSERT_NEAR(glm::length(normal), 1.0F, 1.0e-4F);
}

}  // namespace
}  // namespace grove::models
