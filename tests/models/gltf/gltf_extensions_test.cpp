#include <gmock/gmock.h>

#include <algorithm>
#include <string>

#include "models/gltf/gltf_import_fixture.h"

namespace grove::models {
namespace {

using testing::HasSubstr;

TEST_F(GltfImport, RefusesUnknownRequiredExtensions) {
  writer.triangle();
  writer.json["extensionsRequired"] = {"KHR_texture_basisu"};
  expectRefused("needs the extension KHR_texture_basisu, which Grove does not know; export it without");
}

TEST_F(GltfImport, NamesUnsupportedCompression) {
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

TEST_F(GltfImport, ReadsTheFallbackOfACompressedMesh) {
  auto& primitive = writer.triangle();
  primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0}, {"attributes", {{"POSITION", 0}}}};
  writer.json["extensionsUsed"] = {"KHR_draco_mesh_compression"};
  EXPECT_EQ(import().triangles.indices.size(), 1U);
  writer.json["accessors"][0].erase("bufferView");
  expectRefused("is compressed by KHR_draco_mesh_compression");
}

TEST_F(GltfImport, NamesSkippedFeaturesInOneLine) {
  writer.triangle();
  writer.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_materials_unlit", "KHR_materials_sheen"};
  writer.json["skins"] = {{{"joints", {0}}}};
  testing::internal::CaptureStderr();
  (void)import();
  const std::string reported = testing::internal::GetCapturedStderr();
  EXPECT_THAT(reported, HasSubstr("ignores KHR_materials_clearcoat, KHR_materials_sheen, skins"));
  EXPECT_EQ(std::ranges::count(reported, '\n'), 1);
}

}  // namespace
}  // namespace grove::models
