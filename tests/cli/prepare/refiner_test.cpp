#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "cli/program.h"
#include "objects/lightfield/file/light_field_file.h"

namespace grove::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// The real program with a cache folder of its own and a scene that gets finer within seconds.
class RefinerTest : public testing::Test {
 public:
  ~RefinerTest() override { std::filesystem::remove_all(folder_); }

 protected:
  RefinerTest() {
    std::string name = (std::filesystem::temp_directory_path() / "grove_refiner_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    // Of a thousand triangles: somebody else may have all the cores.
    for (const char* const model : {"near.gltf", "far.gltf"}) {
      std::filesystem::copy_file(GROVE_LANTERN_TREE, folder_ / model);
    }
    std::ofstream(folder_ / "scene.toml")
        << "name = 'lantern trees'\nspawn = [0, 0, 8]\n"
           "[[object]]\ntype = 'lightfield'\nmodel = 'far.gltf'\nposition = [0, 0, -20]\n"
           "subdivision = 1\nsize = 64\nlightings = 1\n"
           "[[object]]\ntype = 'lightfield'\nmodel = 'near.gltf'\nsubdivision = 2\nsize = 64\nlightings = 1\n";
  }

  /// Serves until a line that has `until` in it is there, does `then`, and interrupts it; all that it wrote.
  Outcome serve(const std::string& until, const std::string& then = "true", const std::string& before = "") {
    return shell("cd " + folder_.string() + "; " + before + " rm -f out; export GROVE_CACHE=$PWD/cache\n" + kServe +
                 "until grep -qs '" + until + "' out; do sleep 0.1; kill -0 $server || break; done\n" + then +
                 "\nkill -INT $server; wait $server; status=$?; cat out; exit $status");
  }

  /// Of the finest light fields, which are whole if they open.
  int countFine() const {
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cache" / "light-fields")) {
      const std::string name = entry.path().filename().string();
      if (entry.path().extension() != ".glf" || name.find("rough") != std::string::npos) continue;
      (void)objects::lightfield::openLightField(entry.path());
      ++count;
    }
    return count;
  }

  static constexpr const char* kServe =
      GROVE_BINARY " serve --listen 127.0.0.1:0 --scene scene.toml >out 2>&1 & server=$!\n";
  static constexpr const char* kAllFine = "as fine as the scene wants";
  std::filesystem::path folder_;
};

TEST_F(RefinerTest, ServesCoarseFirstAndRefines) {
  const Outcome outcome = serve(kAllFine);
  EXPECT_EQ(outcome.exit, 0) << outcome.output;
  const std::size_t listening = outcome.output.find("listening on");
  const std::size_t first = outcome.output.find("finer light field 1 of 2, near.gltf");
  const std::size_t second = outcome.output.find("finer light field 2 of 2, far.gltf");
  EXPECT_LT(outcome.output.find("the page is at http://127.0.0.1:"), listening) << outcome.output;
  EXPECT_LT(listening, first) << outcome.output;
  EXPECT_LT(first, second) << "what is nearest to where visitors arrive comes first: " << outcome.output;
  EXPECT_LT(second, outcome.output.find(kAllFine)) << outcome.output;
  EXPECT_EQ(countFine(), 2);
  const Outcome again = serve("listening");
  EXPECT_THAT(again.output, AllOf(HasSubstr("listening"), Not(HasSubstr("sketching")), Not(HasSubstr("finer"))));
}

TEST_F(RefinerTest, ResumesAfterASignal) {
  const Outcome outcome = serve("listening on");
  EXPECT_EQ(outcome.exit, 0) << outcome.output;
  EXPECT_LT(countFine(), 2) << outcome.output;
  const Outcome next = serve(kAllFine);
  EXPECT_EQ(countFine(), 2);
}

TEST_F(RefinerTest, KillLeavesNothingDamaged) {
  (void)serve("listening on", "sleep 0.3; kill -KILL $server");
  // On a fast machine, nothing is left to be made.
  if (countFine() < 2) {
    EXPECT_THAT(serve(kAllFine).output, Not(HasSubstr("is rebuilt")));
  }
  EXPECT_EQ(countFine(), 2);
}

TEST_F(RefinerTest, ReplacesDamagedFiles) {
  (void)serve(kAllFine);
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "cache" / "light-fields")) {
    if (entry.path().extension() == ".glf") std::filesystem::resize_file(entry.path(), entry.file_size() / 2);
  }
  const Outcome outcome = serve(kAllFine);
  EXPECT_EQ(outcome.exit, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("is rebuilt"), HasSubstr("listening")));
  EXPECT_EQ(countFine(), 2);
}

TEST_F(RefinerTest, TwoServersShareResults) {
  const std::string other = GROVE_BINARY
      " serve --listen 127.0.0.1:0 --scene scene.toml >other 2>&1 & second=$!\n"
      "until grep -qs 'as fine as' other; do sleep 0.1; [ -e other ] && kill -0 $second || break; done\n"
      "kill -INT $second; wait $second; cat other";
  const std::string report = "for i in $(seq 300); do grep -qs 'as fine as' other && break; sleep 0.1; done; cat other";
  const Outcome outcome =
      serve(kAllFine, report, "(" + std::string("export GROVE_CACHE=$PWD/cache\n") + other + ") > /dev/null &\n");
  EXPECT_EQ(outcome.exit, 0) << outcome.output;
  std::size_t fine = 0;
  for (std::size_t at = 0; (at = outcome.output.find("finer light field", at)) != std::string::npos; ++at) ++fine;
  EXPECT_GE(fine, 4U) << outcome.output;
  EXPECT_EQ(countFine(), 2);
}

TEST_F(RefinerTest, StaysCoarseWithoutCache) {
  // A file where the folder should be: no permission keeps root out.
  std::ofstream(folder_ / "cache") << "in the way";
  const Outcome outcome = serve("listening on");
  EXPECT_EQ(outcome.exit, 0) << outcome.output;
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("listening on"), HasSubstr("GROVE_CACHE"), HasSubstr("coarse")));
  EXPECT_THAT(outcome.output, Not(HasSubstr("finer light field")));
}

}  // namespace
}  // namespace grove::cli
