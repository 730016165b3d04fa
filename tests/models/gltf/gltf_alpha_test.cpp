#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "models/gltf/gltf_import_fixture.h"

namespace grove::models {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class GltfAlpha : public GltfImport {
 protected:
  /// A triangle of the material 'm', with a texture or without, beside a plain one.
  void useAlpha(const std::string& mode, double factor, bool textured) {
    addTexturedTriangle();
    useTexture({{"bufferView", writer.view(targa(1, 1, {1, 2, 3, 255}))}, {"mimeType", "image/x-tga"}});
    Json& material = writer.json["materials"][0];
    material["alphaMode"] = mode;
    if (mode == "MASK") material["alphaCutoff"] = 0.5;
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, factor};
    if (!textured) material["pbrMetallicRoughness"].erase("baseColorTexture");
    writer.triangle();
  }
  /// Colours of the first triangle's corners, with alphas.
  void useColours(const std::vector<float>& alphas) {
    std::vector<float> colours;
    for (const float alpha : alphas) colours.insert(colours.end(), {1.0F, 1.0F, 1.0F, alpha});
    const int accessor = writer.accessor(colours, "VEC4", kFloat);
    writer.json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = accessor;
  }
  /// What the import says.
  std::string reported() {
    testing::internal::CaptureStderr();
    model = import();
    return testing::internal::GetCapturedStderr();
  }

  Model model;
};

TEST_F(GltfAlpha, ReportsFullyCutOffPrimitives) {
  for (const bool textured : {true, false}) {
    writer = GltfWriter();
    useAlpha("MASK", 0.4, textured);
    EXPECT_THAT(reported(), AllOf(HasSubstr("ignores 'm'"), HasSubstr("cut-off"))) << textured;
    EXPECT_EQ(model.triangles.indices.size(), 1U) << textured;
    EXPECT_EQ(model.materials[model.materialOf.at(0)].name, "plain") << textured;
  }
}

TEST_F(GltfAlpha, ReportsFullyTransparentPrimitives) {
  useAlpha("BLEND", 0.0, false);
  EXPECT_THAT(reported(), HasSubstr("ignores 'm'"));
  EXPECT_EQ(model.triangles.indices.size(), 1U);
}

TEST_F(GltfAlpha, OpaqueAboveTheCutOff) {
  useAlpha("MASK", 0.5, false);
  EXPECT_EQ(reported(), "");
  EXPECT_EQ(model.triangles.indices.size(), 2U);
  EXPECT_EQ(model.materials[0].alphaCutoff, 0.0F);
}

TEST_F(GltfAlpha, RefusesAnInvisibleModel) {
  useAlpha("MASK", 0.1, false);
  writer.json["meshes"][0]["primitives"].erase(1);
  expectRefused("has no triangles");
}

TEST_F(GltfAlpha, BlendsWithoutTexture) {
  useAlpha("BLEND", 0.25, false);
  EXPECT_EQ(reported(), "");
  EXPECT_TRUE(model.materials[0].blended);
  EXPECT_FLOAT_EQ(model.materials[0].alphaCutoff, 4.0F) << "alpha 1, of which a quarter is to be met";
  EXPECT_FALSE(model.materials[0].solid);
}

TEST_F(GltfAlpha, AlphaOneIsOpaque) {
  useAlpha("BLEND", 1.0, false);
  EXPECT_EQ(reported(), "");
  EXPECT_FALSE(model.materials[0].blended);
  EXPECT_EQ(model.materials[0].alphaCutoff, 0.0F);
}

TEST_F(GltfAlpha, WithoutUvsUsesTheAlphaFactor) {
  for (const double factor : {0.5, 1.0}) {
    writer = GltfWriter();
    useAlpha("BLEND", factor, true);
    writer.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
    (void)reported();
    const Material& material = model.materials[model.materialOf.at(0)];
    EXPECT_EQ(material.texture, -1) << factor;
    EXPECT_EQ(material.blended, factor < 1.0) << factor;
    EXPECT_FLOAT_EQ(material.alphaCutoff, factor < 1.0 ? 2.0F : 0.0F) << factor;
  }
}

TEST_F(GltfAlpha, ReportsVisibleVertexAlpha) {
  useAlpha("MASK", 1.0, true);
  useColours({1.0F, 0.4F, 1.0F});
  const std::string line = reported();
  EXPECT_THAT(line, HasSubstr("ignores the alpha of the vertex colours of 'm'"));
  EXPECT_EQ(std::ranges::count(line, '\n'), 1);
}

TEST_F(GltfAlpha, IgnoresInvisibleVertexAlpha) {
  useAlpha("BLEND", 1.0, true);
  useColours({1.0F, 1.0F, 1.0F});
  EXPECT_EQ(reported(), "");
  writer = GltfWriter();
  useAlpha("OPAQUE", 1.0, true);
  useColours({0.0F, 0.0F, 0.0F});
  EXPECT_EQ(reported(), "");
}

}  // namespace
}  // namespace grove::models
