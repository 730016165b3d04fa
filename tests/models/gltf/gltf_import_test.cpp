#include "models/gltf/gltf_import.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "models/gltf/gltf_writer.h"
#include "world/noise.h"

namespace grove::models {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using world::Vec2;
using world::Vec3;

/// An uncompressed 32-bit image: the simplest that stb_image reads, without a library to write it.
std::vector<std::uint8_t> targa(int width, int height, const std::vector<std::uint8_t>& bgra) {
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
    EXPECT_THAT(refusal(file), AllOf(StartsWith(file.string() + ": "), HasSubstr(reason)));
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

TEST_F(GltfImport, ReadsTheTriangleOfABareFile) {
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

TEST_F(GltfImport, ReadsTheSameFromABinaryFile) {
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

TEST_F(GltfImport, ReadsTexturesAndTakesDoubleSidedHolesForLeaves) {
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

TEST_F(GltfImport, ReadsTexturesFromFilesBeside) {
  addTexturedTriangle();
  const auto image = targa(1, 1, {1, 2, 3, 255});
  GltfWriter::save(folder_ / "my skin.tga", std::string(image.begin(), image.end()));
  useTexture({{"uri", "my%20skin.tga"}});
  EXPECT_EQ(import().textures.size(), 1U);
}

TEST_F(GltfImport, GoesOnWithTheBaseColourWhereATextureFileIsAbsent) {
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

TEST_F(GltfImport, IgnoresTheTextureWhereThereAreNoUvs) {
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

TEST_F(GltfImport, RefusesWhatIsNoGltf) {
  GltfWriter::save(folder_ / "a.gltf", "{\"asset\": ");
  GltfWriter::save(folder_ / "b.glb", "glTF\2");
  GltfWriter::save(folder_ / "c.gltf", "");
  GltfWriter::save(folder_ / "d.gltf", R"({"asset": {"version": "2.0"}, "meshes": 5, "nodes": [[]]})");
  for (const char* const name : {"a.gltf", "b.glb", "c.gltf", "d.gltf"}) {
    const std::string message = refusal(folder_ / name);
    EXPECT_THAT(message, StartsWith((folder_ / name).string() + ": "));
    EXPECT_THAT(message, testing::Not(HasSubstr("\n")));
  }
  EXPECT_THAT(refusal(folder_ / "none.gltf"), HasSubstr("there is no such file"));
  EXPECT_THAT(refusal(folder_), HasSubstr("is no plain file"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("is no plain file"));
}

TEST_F(GltfImport, RefusesABinaryFileCutAnywhere) {
  writer.triangle();
  const auto file = writer.writeBinary(folder_ / "model.glb");
  const auto size = std::filesystem::file_size(file);
  for (std::uintmax_t kept = size - 1; kept > 0; kept = kept * 3 / 4) {
    std::filesystem::resize_file(file, kept);
    EXPECT_THAT(refusal(file), StartsWith(file.string() + ": ")) << kept;
  }
}

TEST_F(GltfImport, SurvivesDamagedFiles) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(2, 1, {10, 20, 30, 255, 40, 50, 60, 0}))}});
  const auto file = writer.writeBinary(folder_ / "model.glb");
  std::ifstream in(file, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(in), {}};
  int refused = 0;
  constexpr std::uint32_t kRounds = 500;
  for (std::uint32_t round = 0; round < kRounds; ++round) {
    std::string damaged = whole;
    for (std::uint32_t i = 0; i < 1 + round % 3; ++i) {
      const std::uint32_t number = world::hash(3 * round + i);
      damaged[number % damaged.size()] = static_cast<char>(number >> 24U);
    }
    GltfWriter::save(file, damaged);
    try {
      const Model model = importGltf(file);
      for (const auto& triangle : model.triangles.indices) {
        ASSERT_LT(*std::ranges::max_element(triangle), model.triangles.positions.size());
      }
    } catch (const ImportError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, static_cast<int>(kRounds) / 4);
}

TEST_F(GltfImport, RefusesAnEmptyModel) { expectRefused("has no triangles"); }

TEST_F(GltfImport, RefusesAnAccessorBeyondItsBuffer) {
  writer.triangle();
  writer.json["accessors"][0]["count"] = 4;
  expectRefused("reaches beyond buffer view 0");
}

TEST_F(GltfImport, RefusesABufferViewBeyondItsBuffer) {
  writer.triangle();
  writer.json["bufferViews"][0]["byteLength"] = 40;
  expectRefused("reaches beyond its buffer");
}

TEST_F(GltfImport, RefusesAnImageBeyondItsBuffer) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(std::vector<std::uint8_t>(8, 0))}, {"mimeType", "image/png"}});
  writer.json["bufferViews"].back()["byteLength"] = 100'000;
  expectRefused("reaches beyond its buffer");
}

TEST_F(GltfImport, RefusesAnIndexWithoutVertex) {
  const int order = writer.accessor(std::vector<std::uint16_t>{0, 1, 3}, "SCALAR", kU16);
  writer.triangle()["indices"] = order;
  expectRefused("index 3 is out of the 3 vertices");
}

TEST_F(GltfImport, RefusesPositionsThatAreNotFinite) {
  writer.primitive({0, 0, 0, 1, 0, 0, 0, std::numeric_limits<float>::quiet_NaN(), 0});
  expectRefused("not finite");
}

TEST_F(GltfImport, RefusesTransformsThatAreNotFinite) {
  writer.triangle();
  writer.json["nodes"][0]["scale"] = {1.0e300, 1, 1};
  expectRefused("not finite");
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

TEST_F(GltfImport, RefusesTexturesThatAreTooLarge) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(kMostTexels + 1, 1, {}))}, {"mimeType", "image/x-tga"}});
  expectRefused("16385 x 1 texels");
}

TEST_F(GltfImport, RefusesTexturesThatAreBroken) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(std::vector<std::uint8_t>{1, 2, 3, 4})}, {"mimeType", "image/png"}});
  expectRefused("image 0 is no image");
}

TEST_F(GltfImport, RefusesNodesInACycle) {
  writer.triangle();
  writer.json["nodes"] = Json::parse(R"([{"children": [1]}, {"children": [0], "mesh": 0}])");
  expectRefused("reached twice");
  writer.json.erase("scenes");
  writer.json.erase("scene");
  expectRefused("cycle");
}

TEST_F(GltfImport, RefusesAModelWithoutExtent) {
  writer.primitive({1, 2, 3, 1, 2, 3, 1, 2, 3});
  expectRefused("no extent");
}

TEST_F(GltfImport, RefusesWhatIsTooSmallOrTooLargeForALightField) {
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

TEST_F(GltfImport, RefusesReferencesToWhatIsNotThere) {
  writer.triangle()["material"] = 7;
  expectRefused("there is no material 7");
  writer.json["meshes"][0]["primitives"][0].erase("material");
  writer.json["nodes"][0]["mesh"] = 9;
  expectRefused("there is no mesh 9");
  writer.json["nodes"][0] = {{"children", {12}}};
  expectRefused("there is no node 12");
}

TEST_F(GltfImport, RefusesUnknownExtensionsThatAreRequired) {
  writer.triangle();
  writer.json["extensionsRequired"] = {"KHR_texture_basisu"};
  expectRefused("needs the extension KHR_texture_basisu, which Grove does not know; export it without");
}

TEST_F(GltfImport, NamesTheCompressionThatItCannotRead) {
  const std::string reason = ", which Grove cannot read; export it without compression";
  writer.triangle();
  for (const std::string name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
    writer.json["extensionsUsed"] = {name};
    writer.json["extensionsRequired"] = {name};
    expectRefused("is compressed by " + name + reason);
  }
  // A meshopt file's fallback buffer, over which the parser stumbles; the file does not say that it needs the
  // extension.
  writer.json.erase("extensionsRequired");
  const auto file = writer.write(folder_ / "model.gltf");
  Json document = writer.json;
  document["buffers"].push_back(
      {{"byteLength", 100}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  GltfWriter::save(file, document.dump());
  EXPECT_THAT(refusal(file), HasSubstr("is compressed by EXT_meshopt_compression" + reason));
}

TEST_F(GltfImport, ReadsACompressedMeshByItsFallback) {
  auto& primitive = writer.triangle();
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  writer.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  EXPECT_EQ(import().triangles.indices.size(), 1U);
  writer.json["accessors"][0].erase("bufferView");
  expectRefused("is compressed by KHR_draco_mesh_compression");
}

TEST_F(GltfImport, NamesWhatItLeavesOutInOneLine) {
  writer.triangle();
  writer.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_unlit", "KHR_materials_sheen"};
  writer.json["skins"] = {{{"joints", {0}}}};
  testing::internal::CaptureStderr();
  (void)import();
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_THAT(told, HasSubstr("is read without KHR_materials_clearcoat, KHR_materials_sheen, skins"));
  EXPECT_EQ(std::ranges::count(told, '\n'), 1);
}

TEST_F(GltfImport, RefusesWhatIsNestedSoDeepThatTheParserWouldOverflowTheStack) {
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

TEST_F(GltfImport, TakesTheUvsThatATextureTransformNames) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(1, 1, {1, 2, 3, 255}))}, {"mimeType", "image/x-tga"}});
  const int others = writer.accessor(std::vector<float>{0, 0, 0.25F, 0, 0, 0.75F}, "VEC2", kFloat);
  writer.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_1"] = others;
  writer.json["extensionsRequired"] = {"KHR_texture_transform"};
  auto& texture = writer.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  texture["extensions"]["KHR_texture_transform"] = {{"texCoord", 1}, {"scale", {4, 4}}};
  EXPECT_THAT(import().uvs, testing::ElementsAre(Vec2(0, 0), Vec2(1, 0), Vec2(0, 3)));
}

TEST_F(GltfImport, RefusesATextureTransformWithoutSense) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(targa(1, 1, {1, 2, 3, 255}))}, {"mimeType", "image/x-tga"}});
  auto& texture = writer.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
  for (const char* const transform : {R"({"offset": [1]})", R"({"scale": "large"})", R"({"rotation": 1e300})",
                                      R"({"scale": [1e39, 1]})", R"({"offset": [null, 1]})"}) {
    texture["extensions"]["KHR_texture_transform"] = Json::parse(transform);
    expectRefused("KHR_texture_transform");
  }
  texture["extensions"]["KHR_texture_transform"] = {{"scale", {3.0e38, 3.0e38}}, {"offset", {3.0e38, 3.0e38}}};
  expectRefused("UVs that are not finite");
}

TEST_F(GltfImport, WhatBlendsIsThereByChance) {
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
