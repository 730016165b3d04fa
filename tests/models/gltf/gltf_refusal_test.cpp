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

TEST_F(GltfImport, RefusesOtherFiles) {
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
  EXPECT_THAT(refusal(folder_), HasSubstr("is not a regular file"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("is not a regular file"));
}

TEST_F(GltfImport, RefusesTruncatedBinaryFiles) {
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
  expectRefused("index 3 is beyond the 3 vertices");
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

TEST_F(GltfImport, ComparesCountsBeforeItReads) {
  const int positions = writer.triangle()["attributes"]["POSITION"];
  Json huge = writer.json["accessors"][static_cast<std::size_t>(positions)];
  huge["count"] = 100'000'000;
  writer.json["accessors"].push_back(huge);
  Json& attributes = writer.json["meshes"][0]["primitives"][0]["attributes"];
  for (const char* const name : {"NORMAL", "COLOR_0", "TEXCOORD_0"}) {
    attributes[name] = positions + 1;
    expectRefused(std::string(name) + " and POSITION have different numbers of elements");
    attributes.erase(name);
  }
}

TEST_F(GltfImport, RefusesAnOversizedSparseAccessor) {
  writer.triangle();
  const int where = writer.view(std::vector<std::uint16_t>{2, 2, 2, 2});
  const int values = writer.view(std::vector<float>(12, 1.0F));
  writer.json["accessors"][0]["sparse"] = {{"count", 4},
                                           {"indices", {{"bufferView", where}, {"componentType", kU16}}},
                                           {"values", {{"bufferView", values}}}};
  expectRefused("a sparse accessor replaces more elements than it has");
}

TEST_F(GltfImport, RefusesBrokenTextures) {
  addTexturedTriangle();
  useTexture({{"bufferView", writer.view(std::vector<std::uint8_t>{1, 2, 3, 4})}, {"mimeType", "image/png"}});
  expectRefused("image 0 is not a readable image");
}

TEST_F(GltfImport, RefusesNodesInACycle) {
  writer.triangle();
  writer.json["nodes"] = Json::parse(R"([{"children": [1]}, {"children": [0], "mesh": 0}])");
  expectRefused("reached twice");
  writer.json.erase("scenes");
  writer.json.erase("scene");
  expectRefused("cycle");
}

TEST_F(GltfImport, RefusesDanglingReferences) {
  writer.triangle()["material"] = 7;
  expectRefused("there is no material 7");
  writer.json["meshes"][0]["primitives"][0].erase("material");
  writer.json["nodes"][0]["mesh"] = 9;
  expectRefused("there is no mesh 9");
  writer.json["nodes"][0] = {{"children", {12}}};
  expectRefused("there is no node 12");
}

}  // namespace
}  // namespace grove::models
