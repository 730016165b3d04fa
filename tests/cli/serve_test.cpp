#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "cli/program.h"
#include "sanitized.h"

namespace grove::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

std::filesystem::path temporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "grove_serve_XXXXXX").string();
  return mkdtemp(name.data());
}

/// Serves until it listens, then ends it; what it wrote, and its exit status.
Outcome serveUntilItListens(const std::filesystem::path& folder, const std::string& before = "") {
  const std::string at = folder.string();
  return shell(before + "cd " + at + "; rm -f out; GROVE_CACHE=" + at +
               "/cache " GROVE_BINARY
               " serve --listen 127.0.0.1:0 --scene scene.toml >out 2>&1 & server=$!\n"
               "until grep -qs listening out; do sleep 0.1; kill -0 $server || break; done\n"
               "kill -INT $server; wait $server; status=$?; cat " +
               at + "/out; exit $status");
}

TEST(Serve, MakesACachedLightFieldAnewThatIsDamaged) {
  const std::filesystem::path folder = temporaryFolder();
  std::ofstream(folder / "scene.toml") << "name = 'a fern'\n[[object]]\ntype = 'lightfield'\nplant = 'fern'\n"
                                          "subdivision = 2\nsize = 32\nlightings = 1\n";
  ASSERT_EQ(serveUntilItListens(folder).exit, 0);
  const std::filesystem::directory_iterator fields(folder / "cache" / "light-fields");
  const auto field =
      std::find_if(begin(fields), end(fields), [](const auto& f) { return f.path().extension() == ".glf"; });
  ASSERT_NE(field, end(fields));
  std::fstream file(field->path(), std::ios::in | std::ios::out | std::ios::binary);
  const auto middle = static_cast<std::streamoff>(field->file_size() / 2);
  const int byte = (file.seekg(middle), file.get());
  file.seekp(middle).put(static_cast<char>(byte ^ 1));
  file.close();
  const Outcome again = serveUntilItListens(folder);
  EXPECT_EQ(again.exit, 0);
  EXPECT_THAT(again.output, HasSubstr("made anew"));
  EXPECT_THAT(again.output, HasSubstr("listening"));
  EXPECT_THAT(serveUntilItListens(folder).output, Not(HasSubstr("made anew")));
  std::filesystem::remove_all(folder);
}

TEST(Serve, NamesTheLineOfAModelThatCannotBeImported) {
  const std::filesystem::path folder = temporaryFolder();
  std::ofstream(folder / "broken.glb") << "glTF and then nothing";
  const std::string message = "scene.toml:4: object 'it': 'model': ";
  for (const char* const type : {"lightfield", "mesh"}) {
    for (const char* const model : {"broken.glb", "/dev/zero"}) {
      std::ofstream(folder / "scene.toml")
          << "name = 'a model'\n[[object]]\ntype = '" << type << "'\nmodel = '" << model << "'\nname = 'it'\n";
      const Outcome outcome = serveUntilItListens(folder);
      EXPECT_EQ(outcome.exit, 1) << type << " " << model;
      EXPECT_THAT(outcome.output, testing::AllOf(HasSubstr(message), HasSubstr(model))) << type;
      EXPECT_THAT(outcome.output, Not(HasSubstr("listening")));
    }
  }
  std::filesystem::remove_all(folder);
}

/// From where nothing fits to where all does: a line that says what to do, or a server, but never a crash.
TEST(Serve, SaysThatItsAddressSpaceIsTooSmall) {
  if constexpr (kSanitized) GTEST_SKIP() << "a sanitizer's shadow alone is larger than any limit";
  const std::filesystem::path folder = temporaryFolder();
  std::ofstream(folder / "scene.toml") << "name = 'a fern, a stone, a fire'\n[[object]]\ntype = 'lightfield'\n"
                                          "plant = 'fern'\nsubdivision = 2\nsize = 32\nlightings = 1\n"
                                          "[[object]]\ntype = 'mesh'\nshape = 'logs'\n"
                                          "[[object]]\ntype = 'fluid'\ngrid = 32\n";
  ASSERT_EQ(serveUntilItListens(folder).exit, 0);
  bool fit = false;
  for (const char* const megabytes : {"400", "500", "600", "700", "800", "3000"}) {
    const Outcome outcome = serveUntilItListens(folder, std::string("ulimit -v ") + megabytes + "000; ");
    fit = outcome.output.find("listening") != std::string::npos;
    EXPECT_EQ(outcome.exit, fit ? 0 : 1) << megabytes << " MB: " << outcome.output;
    if (fit) continue;
    EXPECT_THAT(outcome.output, testing::AllOf(HasSubstr("memory"), HasSubstr("ulimit -v"))) << megabytes;
  }
  EXPECT_TRUE(fit);
  std::filesystem::remove_all(folder);
}

/// A fire on the finest grid takes many seconds to grow before anybody is let in.
TEST(Serve, EndsSoonAfterASignalWhileItPrepares) {
  const std::filesystem::path folder = temporaryFolder();
  std::ofstream(folder / "slow.toml") << "name = 'slow'\n[[object]]\ntype = 'fluid'\ngrid = 128\n";
  const std::string at = folder.string();
  const Outcome outcome = shell("cd " + at +
                                "; " GROVE_BINARY
                                " serve --listen 127.0.0.1:0 --scene slow.toml >out 2>&1 & server=$!\n"
                                "until grep -qs preparing out; do sleep 0.1; kill -0 $server || break; done\n"
                                "begin=${EPOCHREALTIME/./}; kill -INT $server; wait $server; status=$?\n"
                                "cat " +
                                at + "/out; echo took $(( (${EPOCHREALTIME/./} - begin) / 1000 )); exit $status");
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_THAT(outcome.output, HasSubstr("preparing"));
  EXPECT_THAT(outcome.output, Not(HasSubstr("listening"))) << "it was ready too soon to show anything";
  const std::size_t took = outcome.output.rfind("took ");
  ASSERT_NE(took, std::string::npos);
  EXPECT_LT(std::stoi(outcome.output.substr(took + 5)), 3000) << "milliseconds";
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace grove::cli
