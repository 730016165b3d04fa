#include "objects/lightfield/backend/light_field_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "objects/lightfield/backend/light_field_backend_type.h"
#include "objects/lightfield/file/small_field.h"

namespace grove::objects::lightfield {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

world::Scene sceneOf(const std::string& settings) {
  return world::parseScene("[[object]]\ntype = 'lightfield'\nname = 'it'\n" + settings, "test.toml");
}

std::string errorOf(const std::string& settings) {
  const world::Scene scene = sceneOf(settings);
  try {
    (void)LightFieldBackendType().model(scene.objects.at(0).parameters);
  } catch (const world::SceneError& e) {
    return e.what();
  }
  return "no error";
}

TEST(LightFieldSource, RefusesIrregularFilesWithLineAndKey) {
  const TemporaryFolder folder;
  const std::string fifo = (folder / "fifo").string();
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const std::string& file : {std::string("/dev/zero"), std::string("/tmp"), fifo}) {
    EXPECT_THAT(errorOf("\nmodel = '" + file + "'\n"),
                AllOf(StartsWith("test.toml:5: object 'it': 'model': " + file), HasSubstr("is not a regular file"),
                      HasSubstr("name a glTF file")));
    EXPECT_THAT(errorOf("file = '" + file + "'\n"), AllOf(StartsWith("test.toml:4: object 'it': 'file': " + file),
                                                          HasSubstr("is not a regular file"), HasSubstr("grove bake")));
  }
}

TEST(LightFieldSource, NamesAMissingFileWithLineAndKey) {
  EXPECT_THAT(errorOf("model = '/nowhere.glb'\n"),
              AllOf(StartsWith("test.toml:4: object 'it': 'model': /nowhere.glb"), HasSubstr("No such file")));
  EXPECT_THAT(errorOf("file = '/nowhere.glf'\n"), StartsWith("test.toml:4: object 'it': 'file': /nowhere.glf"));
}

TEST(LightFieldSource, ChangedModelGetsAnotherFile) {
  const TemporaryFolder folder;
  const std::string model = (folder / "model.glb").string();
  const auto name = [&](const std::string& bytes) {
    std::ofstream(model, std::ios::binary) << bytes;
    models::FileNames names;
    return readSource(sceneOf("model = '" + model + "'\n").objects.at(0).parameters, names).file.filename().string();
  };
  const std::string large(3'000'000, 'x');
  EXPECT_THAT(name("one"), StartsWith("model-3-"));
  EXPECT_NE(name("one"), name("two"));
  EXPECT_EQ(name(large), name(large));
  EXPECT_NE(name(large), name(large.substr(1) + "y"));
}

}  // namespace
}  // namespace grove::objects::lightfield
