#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "gl/context.h"
#include "gl/program.h"
#include "gl/shader_library.h"

namespace grove::gl {
namespace {

using testing::HasSubstr;

/// A directory of shaders that goes with the test.
class ShaderDirectory {
 public:
  ShaderDirectory() : path_(std::filesystem::path(testing::TempDir()) / "grove_shader_test") {
    std::filesystem::create_directories(path_ / "common");
  }
  ~ShaderDirectory() { std::filesystem::remove_all(path_); }
  ShaderDirectory(const ShaderDirectory&) = delete;
  ShaderDirectory& operator=(const ShaderDirectory&) = delete;

  void write(const std::string& name, const std::string& text) const { std::ofstream(path_ / name) << text; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

template <class Task>
std::string errorOf(const Task& task) {
  try {
    task();
  } catch (const EnvironmentError& error) {
    return error.what();
  }
  return "no error";
}

TEST(ShaderLibrary, ExpandsIncludesOnce) {
  const ShaderDirectory directory;
  directory.write("a.frag", "#version 450 core\n#include \"common/b.glsl\"\n#include \"common/b.glsl\"\nend\n");
  directory.write("common/b.glsl", "inner\n");
  const ShaderSource source = ShaderLibrary(directory.path()).load("a.frag");
  EXPECT_EQ(source.text, "#version 450 core\ninner\nend\n");
  EXPECT_THAT(source.places, testing::ElementsAre("a.frag:1", "common/b.glsl:1", "a.frag:4"));
}

TEST(ShaderLibrary, HoldsTheShadersOfTheBuild) {
  EXPECT_THAT(ShaderLibrary().load("mesh/mesh.vert").text, HasSubstr("gl_Position"));
}

TEST(ShaderLibrary, MissingDirectory) {
  EXPECT_THAT(errorOf([] { const ShaderLibrary library("/no/such/place"); }), HasSubstr("/no/such/place"));
}

TEST(ShaderLibrary, MissingFileNamesItsIncluder) {
  const ShaderDirectory directory;
  directory.write("a.frag", "#version 450 core\n#include \"common/gone.glsl\"\n");
  const ShaderLibrary library(directory.path());
  EXPECT_THAT(errorOf([&] { (void)library.load("a.frag"); }),
              testing::AllOf(HasSubstr("a.frag:2"), HasSubstr("gone.glsl")));
}

TEST(Program, ErrorNamesFileAndLine) {
  const ShaderDirectory directory;
  directory.write("a.vert", "#version 450 core\nvoid main() { gl_Position = vec4(0.0); }\n");
  directory.write("a.frag", "#version 450 core\n#include \"common/b.glsl\"\nvoid main() { colour = vec4(f()); }\n");
  directory.write("common/b.glsl", "out vec4 colour;\n\nfloat f() { return nonsense; }\n");
  const ShaderLibrary library(directory.path());
  const Context context(ContextKind::kAuto);
  const auto link = [&] { const Program program(context.api(), library.load("a.vert"), library.load("a.frag")); };
  EXPECT_THAT(errorOf(link), testing::AllOf(HasSubstr("common/b.glsl:3"), HasSubstr("nonsense")));
  directory.write("common/b.glsl", "out vec4 colour;\n");
  EXPECT_THAT(errorOf(link), HasSubstr("a.frag:3"));
}

}  // namespace
}  // namespace grove::gl
