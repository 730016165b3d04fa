#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "models/gltf/gltf_import_fixture.h"
#include "world/noise.h"

namespace grove::models {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

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

TEST_F(GltfImport, RefusesUvsOfWhichAFloatHoldsNoFraction) {
  writer.triangle();
  const int uvs = writer.accessor(std::vector<float>{3.4e38F, 0, 3.4e38F, 0, 3.4e38F, 1}, "VEC2", kFloat);
  writer.json["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = uvs;
  expectRefused("has UVs beyond 1000000");
}

TEST_F(GltfImport, RefusesTransformsToSuchUvs) {
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

TEST_F(GltfImport, ComparesCountsBeforeItReads) {
  const int positions = writer.triangle()["attributes"]["POSITION"];
  Json huge = writer.json["accessors"][static_cast<std::size_t>(positions)];
  huge["count"] = 100'000'000;
  writer.json["accessors"].push_back(huge);
  Json& attributes = writer.json["meshes"][0]["primitives"][0]["attributes"];
  for (const char* const name : {"NORMAL", "COLOR_0", "TEXCOORD_0"}) {
    attributes[name] = positions + 1;
    expectRefused(std::string(name) + " has not as many elements as POSITION");
    attributes.erase(name);
  }
}

TEST_F(GltfImport, RefusesASparseAccessorThatReplacesMoreThanItHas) {
  writer.triangle();
  const int where = writer.view(std::vector<std::uint16_t>{2, 2, 2, 2});
  const int values = writer.view(std::vector<float>(12, 1.0F));
  writer.json["accessors"][0]["sparse"] = {{"count", 4},
                                           {"indices", {{"bufferView", where}, {"componentType", kU16}}},
                                           {"values", {{"bufferView", values}}}};
  expectRefused("a sparse accessor replaces more elements than it has");
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
  const auto reason = [](std::string extension) {
    return "is compressed by " + extension.append(", which Grove cannot read; export it without compression");
  };
  writer.triangle();
  for (const std::string name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
    writer.json["extensionsUsed"] = {name};
    writer.json["extensionsRequired"] = {name};
    expectRefused(reason(name));
  }
  // A meshopt file's fallback buffer, over which the parser stumbles; the file does not say that it needs the
  // extension.
  writer.json.erase("extensionsRequired");
  const auto file = writer.write(folder_ / "model.gltf");
  Json document = writer.json;
  document["buffers"].push_back(
      {{"byteLength", 100}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}});
  GltfWriter::save(file, document.dump());
  EXPECT_THAT(refusal(file), HasSubstr(reason("EXT_meshopt_compression")));
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
  const std::string reported = testing::internal::GetCapturedStderr();
  EXPECT_THAT(reported, HasSubstr("is read without KHR_materials_clearcoat, KHR_materials_sheen, skins"));
  EXPECT_EQ(std::ranges::count(reported, '\n'), 1);
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

}  // namespace
}  // namespace grove::models
