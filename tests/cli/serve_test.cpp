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

using testing::AllOf;
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

TEST(Serve, ReplacesADamagedCachedLightField) {
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
  EXPECT_THAT(again.output, HasSubstr("is rebuilt"));
  EXPECT_THAT(again.output, HasSubstr("listening"));
  EXPECT_THAT(serveUntilItListens(folder).output, Not(HasSubstr("is rebuilt")));
  std::filesystem::remove_all(folder);
}

TEST(Serve, NamesTheLineOfABadModel) {
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
TEST(Serve, ReportsASmallAddressSpace) {
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

/// What the shells of these tests share: a server of a stone, with what `options` say, whose output is in `out`.
std::string serveAStone(const std::filesystem::path& folder, const std::string& options) {
  std::ofstream(folder / "scene.toml") << "name = 'a stone'\n[[object]]\ntype = 'mesh'\nshape = 'stone'\n";
  return "cd " + folder.string() +
         "\nfor name in first second; do openssl req -x509 -newkey ec -pkeyopt ec_paramgen_curve:prime256v1 -nodes "
         "-subj /CN=$name -days 30 -keyout $name.key -out $name.pem 2>/dev/null; done; cp first.pem cert.pem; "
         "cp first.key key.pem\n"
         "until_says() { for try in {1..300}; do grep -qs -- \"$1\" out && return; sleep 0.1; done; echo never; }\n"
         "GROVE_CACHE=$PWD/cache " GROVE_BINARY " serve --scene scene.toml --listen 127.0.0.1:0 " +
         options +
         " >out 2>&1 & server=$!; trap 'kill -KILL $server 2>/dev/null' EXIT; until_says listening\n"
         "port=$(sed -n 's/^listening on .*:\\([0-9]*\\)$/\\1/p' out)\n";
}

TEST(Serve, ReloadsTheCertificate) {
  const std::filesystem::path folder = temporaryFolder();
  const Outcome outcome = shell(serveAStone(folder, "--tls-cert cert.pem --tls-key key.pem") +
                                "shown() { openssl s_client -connect 127.0.0.1:$port </dev/null 2>/dev/null | sed -n "
                                "'s/^subject=CN = //p'; }\n"
                                "shown; kill -HUP $server; until_says 'new connections'; cp second.pem cert.pem\n"
                                "kill -HUP $server; until_says 'not the key'; shown; cp second.key key.pem\n"
                                "for try in {1..100}; do [ $(shown) = second ] && break; sleep 0.1; done; shown\n"
                                "kill -INT $server; wait $server; status=$?; cat out; exit $status");
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_THAT(outcome.output, testing::StartsWith("first\nfirst\nsecond\n")) << "a key of another is not taken";
  EXPECT_THAT(outcome.output, HasSubstr("listening on https://127.0.0.1:"));
  EXPECT_THAT(outcome.output, HasSubstr("page at http://127.0.0.1:"));
  std::filesystem::remove_all(folder);
}

TEST(Serve, SurvivesAHangup) {
  const std::filesystem::path folder = temporaryFolder();
  const Outcome outcome = shell(serveAStone(folder, "") +
                                "kill -HUP $server; until_says SIGHUP\n"
                                "kill -TERM $server; wait $server; echo ended with $?");
  EXPECT_EQ(outcome.output, "ended with 0\n");
  std::filesystem::remove_all(folder);
}

/// `script` gives it one, and closes it.
TEST(Serve, EndsWhenItsTerminalIsGone) {
  const std::filesystem::path folder = temporaryFolder();
  const Outcome outcome =
      shell(serveAStone(folder, "") +
            "kill -INT $server; wait $server; rm out\n"
            "mkfifo hold; script -qec 'GROVE_CACHE=$PWD/cache exec " GROVE_BINARY
            " serve --scene scene.toml --listen 127.0.0.1:0 >out 2>&1' /dev/null <hold >/dev/null & terminal=$!\n"
            "exec 9>hold; until_says listening; kill -KILL $terminal; until_says stopping; cat out");
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("stopping"), Not(HasSubstr("never"))));
  std::filesystem::remove_all(folder);
}

/// A fire on the finest grid takes many seconds to grow before anybody is let in.
TEST(Serve, StopsOnASignalDuringPreparation) {
  const std::filesystem::path folder = temporaryFolder();
  std::ofstream(folder / "slow.toml") << "name = 'slow'\n[[object]]\ntype = 'fluid'\ngrid = 128\n";
  const std::string at = folder.string();
  const Outcome outcome = shell("cd " + at +
                                "; " GROVE_BINARY
                                " serve --listen 127.0.0.1:0 --scene slow.toml >out 2>&1 & server=$!\n"
                                "until grep -qs preparing out; do sleep 0.1; kill -0 $server || break; done\n"
                                "kill -INT $server; wait $server; status=$?; cat " +
                                at + "/out; exit $status");
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr("preparing"), HasSubstr("stopped"), Not(HasSubstr("listening"))));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace grove::cli
