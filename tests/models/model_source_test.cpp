#include "models/model_source.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "models/gltf/gltf_writer.h"

namespace grove::models {
namespace {

class ModelSourceName : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// The name of a file made from one of the folder's.
  [[nodiscard]] std::string name(const std::string& file) const {
    FileNames names;
    return name(file, names);
  }
  [[nodiscard]] std::string name(const std::string& file, FileNames& names) const {
    const world::Scene scene = world::parseScene(
        "[[object]]\ntype = 'lightfield'\nname = 'it'\nmodel = '" + (folder_ / file).string() + "'\n", "test.toml");
    const world::Parameters& parameters = scene.objects.at(0).parameters;
    return names.of(readModelSource(parameters), parameters);
  }
  void save(const std::string& file, const std::string& content) const { GltfWriter::save(folder_ / file, content); }

  const std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      ("source_" + std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
  GltfWriter writer;
};

TEST_F(ModelSourceName, ChangesWithItsBuffers) {
  writer.triangle();
  writer.write(folder_ / "model.gltf");
  const std::string before = name("model.gltf");
  EXPECT_EQ(name("model.gltf"), before);
  writer.bytes[0] = static_cast<char>(writer.bytes[0] ^ 1);
  save("model.bin", writer.bytes);
  EXPECT_NE(name("model.gltf"), before);
}

TEST_F(ModelSourceName, ChangesWithItsImages) {
  writer.triangle();
  writer.json["images"] = {{{"uri", "my%20bark.png"}}, {{"uri", "leaf.png"}}};
  writer.write(folder_ / "model.gltf");
  writer.writeBinary(folder_ / "model.glb");
  for (const std::string file : {"model.gltf", "model.glb"}) {
    std::vector<std::string> names{name(file)};
    for (const char* const image : {"my bark.png", "leaf.png"}) {
      for (const char* const content : {"one", "two"}) {
        save(image, content);
        names.push_back(name(file));
        EXPECT_NE(names.end()[-1], names.end()[-2]) << file << ": " << image << " " << content;
      }
      std::filesystem::remove(folder_ / image);
      EXPECT_EQ(name(file), names.front()) << "an absent image is left out";
    }
  }
}

TEST_F(ModelSourceName, IgnoresOtherFiles) {
  writer.triangle();
  writer.json["images"] = {{{"uri", "data:image/png;base64,AAAA"}}};
  writer.json["extras"]["images"] = {{{"uri", "other.png"}}};
  writer.json["samplers"] = {{{"uri", "other.png"}}};
  writer.write(folder_ / "model.gltf");
  const std::string before = name("model.gltf");
  save("other.png", "one");
  EXPECT_EQ(name("model.gltf"), before);
}

TEST_F(ModelSourceName, IsComputedOncePerModel) {
  FileNames names;
  save("one.glb", "one");
  save("two.glb", "two");
  const std::string before = name("one.glb", names);
  EXPECT_NE(name("two.glb", names), before);
  std::filesystem::remove(folder_ / "one.glb");
  EXPECT_EQ(name("one.glb", names), before) << "it is not read again";
}

TEST_F(ModelSourceName, WorksForOtherFiles) {
  save("model.glb", std::string("glTF\2\0\0\0\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFFJSON{\"buffers\":", 31));
  save("model.gltf",
       R"({"buffers": {"uri": 5}, "images": [[], 3, {"uri": {}}, {"uri": "%"}, {"uri": "."}, {"uri": ""}]})");
  save("empty.gltf", "");
  save("deep.gltf", "{\"images\":" + std::string(1'000'000, '['));
  EXPECT_TRUE(name("model.glb").starts_with("model-31-"));
  EXPECT_TRUE(name("model.gltf").starts_with("model-"));
  EXPECT_TRUE(name("empty.gltf").starts_with("empty-0-"));
  EXPECT_TRUE(name("deep.gltf").starts_with("deep-1000010-"));
}

}  // namespace
}  // namespace grove::models
