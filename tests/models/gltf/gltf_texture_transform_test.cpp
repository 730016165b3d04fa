#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "models/gltf/gltf_import_fixture.h"

namespace grove::models {
namespace {

using world::Vec2;

TEST_F(GltfImport, TransformsTheUvs) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(1, 1, {1, 2, 3, 255}))}, {"mimeType", "image/x-tga"}});
  auto& texture = writer.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  const auto uvsBy = [&](const char* transform) {
    texture["extensions"]["KHR_texture_transform"] = Json::parse(transform);
    return import().uvs;
  };
  // As they are given: (0, 1), (1, 1), (0.5, 0).
  EXPECT_THAT(uvsBy("{}"), testing::ElementsAre(Vec2(0, 1), Vec2(1, 1), Vec2(0.5F, 0)));
  EXPECT_THAT(uvsBy(R"({"offset": [0.25, 2], "scale": [2, 3]})"),
              testing::ElementsAre(Vec2(0.25F, 5), Vec2(2.25F, 5), Vec2(1.25F, 2)));
  // A quarter turn, counter-clockwise as one sees the image: what is below goes to the right.
  const auto turned = uvsBy(R"({"rotation": 1.5707963267948966, "scale": [2, 3], "offset": [1, 0]})");
  EXPECT_NEAR(turned[0].x, 4.0F, 1.0e-5F);
  EXPECT_NEAR(turned[0].y, 0.0F, 1.0e-5F);
  EXPECT_NEAR(turned[1].x, 4.0F, 1.0e-5F);
  EXPECT_NEAR(turned[1].y, -2.0F, 1.0e-5F);
}

TEST_F(GltfImport, UsesUvsNamedByATextureTransform) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(1, 1, {1, 2, 3, 255}))}, {"mimeType", "image/x-tga"}});
  const int others = writer.accessor(std::vector<float>{0, 0, 0.25F, 0, 0, 0.75F}, "VEC2", kFloat);
  writer.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = others;
  writer.json["extensionsRequired"] = {"KHR_texture_transform"};
  auto& texture = writer.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}, {"scale", {4, 4}}};
  EXPECT_THAT(import().uvs, testing::ElementsAre(Vec2(0, 0), Vec2(1, 0), Vec2(0, 3)));
}

TEST_F(GltfImport, RefusesAMalformedTextureTransform) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(1, 1, {1, 2, 3, 255}))}, {"mimeType", "image/x-tga"}});
  auto& texture = writer.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  for (const char* const transform : {R"({"offset": [1]})", R"({"scale": "large"})", R"({"rotation": 1e300})",
                                      R"({"scale": [1e39, 1]})", R"({"offset": [null, 1]})"}) {
    texture["extensions"]["KHR_texture_transform"] = Json::parse(transform);
    expectRefused("KHR_texture_transform");
  }
  texture["extensions"]["KHR_texture_transform"] = {{"scale", {3.0e38, 3.0e38}}, {"offset", {3.0e38, 3.0e38}}};
  expectRefused("UVs beyond 1000000");
}

TEST_F(GltfImport, BlendingBecomesStochasticCoverage) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(1, 1, {1, 2, 3, 60}))}, {"mimeType", "image/x-tga"}});
  writer.json["materials"][0]["alphaMode"] = "BLEND";
  writer.json["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.5};
  const Model model = import();
  const Material& glass = model.materials[model.materialOf[0]];
  EXPECT_TRUE(glass.blended);
  EXPECT_FLOAT_EQ(glass.alphaCutoff, 2.0F) << "half of the rays pass where the texture is opaque";
}

}  // namespace
}  // namespace grove::models
