#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "cli/program.h"

namespace grove::bake {
namespace {

using cli::grove;
using cli::groveHere;
using cli::Outcome;
using testing::HasSubstr;
using testing::StartsWith;

std::ptrdiff_t lines(const std::string& text) { return std::ranges::count(text, '\n'); }

/// A folder with a glTF file of one triangle, whose buffer is in the file.
class BakeCommand : public testing::Test {
 public:
  ~BakeCommand() override { std::filesystem::remove_all(folder_); }

 protected:
  BakeCommand() {
    std::string name = (std::filesystem::temp_directory_path() / "grove_command_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    // Positions (0,0,0), (1,0,0), (0,1,0) as 36 bytes of floats.
    std::ofstream(path("model.gltf"))
        << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
        << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],)"
        << R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],)"
        << R"("bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,)"
        << R"("uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
  }
  [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }

  std::filesystem::path folder_;
};

TEST_F(BakeCommand, BadOptionsExitTwoWithOneLine) {
  const std::string out = " -o " + path("out.glf");
  for (const std::string& options :
       {std::string("--plant oak"), "--plant oak --subdivision 0" + out, "--plant oak --subdivision 129" + out,
        "--plant oak --size 100" + out, "--plant oak --size 16" + out, "--plant oak --size 2048" + out,
        "--plant oak --lightings 0" + out, "--plant oak --lightings 17" + out, "--plant oak --samples 0" + out,
        "--plant oak --threads 0" + out, "--plant oak --detail huge" + out, "--plant baobab" + out,
        "a.glb --plant oak" + out, "-o " + path("out.glf")}) {
    const Outcome outcome = groveHere("bake " + options);
    EXPECT_EQ(outcome.exit, 2) << options;
    EXPECT_EQ(lines(outcome.output), 1) << options << ": " << outcome.output;
  }
  EXPECT_THAT(groveHere("bake --plant baobab" + out).output, testing::AllOf(HasSubstr("baobab"), HasSubstr("oak")));
}

TEST_F(BakeCommand, ReplacesOnlyRegularFiles) {
  std::filesystem::create_directory(folder_ / "folder");
  std::ofstream(path("kept.glf")) << "kept";
  std::filesystem::create_symlink(path("kept.glf"), path("link"));
  ASSERT_EQ(mkfifo(path("fifo").c_str(), 0600), 0);
  for (const std::string& output : {path("folder"), path("link"), path("fifo"), std::string("/dev/null")}) {
    const Outcome outcome = grove("bake " + path("model.gltf") + " --subdivision 1 --size 32 -o " + output);
    EXPECT_EQ(outcome.exit, 2) << output;
    EXPECT_THAT(outcome.output, HasSubstr(output));
    EXPECT_EQ(lines(outcome.output), 1) << outcome.output;
  }
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_TRUE(std::filesystem::is_fifo(path("fifo")));
  EXPECT_EQ(std::filesystem::file_size(path("kept.glf")), 4U);
}

TEST_F(BakeCommand, FailuresExitOneWithOneLine) {
  const Outcome absent = grove("bake " + path("absent.glb") + " -o " + path("out.glf"));
  EXPECT_EQ(absent.exit, 1);
  EXPECT_THAT(absent.output, HasSubstr("absent.glb"));
  EXPECT_EQ(lines(absent.output), 1) << absent.output;
  const Outcome endless = grove("bake /dev/zero -o " + path("out.glf"));
  EXPECT_EQ(endless.exit, 1);
  EXPECT_THAT(endless.output, testing::AllOf(HasSubstr("/dev/zero: is not a regular file"), HasSubstr(".glb")));
  EXPECT_EQ(lines(endless.output), 1) << endless.output;
  std::ofstream(path("broken.glb")) << "glTF and then nothing";
  EXPECT_EQ(grove("bake " + path("broken.glb") + " -o " + path("out.glf")).exit, 1);
  const Outcome folder = grove("bake " + path("model.gltf") + " --subdivision 1 --size 32 -o " + path("no/out.glf"));
  EXPECT_EQ(folder.exit, 1);
  EXPECT_THAT(folder.output, HasSubstr("no/out.glf"));
  EXPECT_EQ(lines(folder.output), 1) << folder.output;
}

TEST_F(BakeCommand, PrintsItsDocument) {
  const Outcome outcome = grove(
      "bake " + path("model.gltf") + " --subdivision 2 --size 32 --lightings 1 --json -o " + path("out.glf"), false);
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_THAT(outcome.output, StartsWith("{"));
  for (const char* key :
       {"\"views\": 13", "\"size\": 32", "\"lightings\": 1", "\"triangles\": 1", "\"bytes\"", "\"seconds\""}) {
    EXPECT_THAT(outcome.output, HasSubstr(key));
  }
  EXPECT_TRUE(std::filesystem::exists(path("out.glf")));
}

TEST_F(BakeCommand, KilledBakeResumes) {
  const std::string file = path("killed.glf");
  const std::string journal = file + ".partial/journal";
  const std::string options = " --subdivision 6 --size 256 --lightings 2 --samples 3 --threads 1 --json -o ";
  for (const int signal : {SIGKILL, SIGINT}) {
    const pid_t child = fork();
    if (child == 0) {
      std::string command = "exec " GROVE_BINARY " bake ";
      command.append(path("model.gltf")).append(options).append(file).append(" >/dev/null 2>&1");
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      _exit(127);
    }
    // Some more views than there are already.
    std::error_code error;
    const auto before = std::filesystem::file_size(journal, error);
    const std::uintmax_t start = error ? 0 : before;
    for (int i = 0; i < 6000; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      const auto now = std::filesystem::file_size(journal, error);
      if (!error && now > start + 20'000) break;
    }
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    if (signal == SIGINT) {
      ASSERT_TRUE(WIFEXITED(status));
      EXPECT_EQ(WEXITSTATUS(status), 1);
    }
    EXPECT_FALSE(std::filesystem::exists(file));
  }
  const Outcome finished = grove("bake " + path("model.gltf") + options + file, false);
  EXPECT_EQ(finished.exit, 0);
  EXPECT_THAT(finished.output, testing::Not(HasSubstr("\"views_taken_up\": 0")));
  const Outcome whole = grove("bake " + path("model.gltf") + options + path("whole.glf"), false);
  EXPECT_EQ(whole.exit, 0);
  EXPECT_EQ(std::system(("cmp -s " + file + " " + path("whole.glf")).c_str()), 0);
}

}  // namespace
}  // namespace grove::bake
