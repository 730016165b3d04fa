#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "cli/program.h"
#include "measure/trace_faults.h"

namespace grove::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::ptrdiff_t lines(const std::string& text) { return std::ranges::count(text, '\n'); }

TEST(CommandLine, HelpEverywhere) {
  for (const char* command :
       {"--help", "serve --help", "load --help", "bench --help", "bench fluid --help", "bench amortize --help",
        "bench encode --help", "bench pipeline --help", "shape --help"}) {
    const Outcome outcome = grove(command, false);
    EXPECT_EQ(outcome.exit, 0) << command;
    EXPECT_THAT(outcome.output, HasSubstr("--help")) << command;
  }
}

TEST(CommandLine, BadOptionsExitTwoWithOneLine) {
  for (const char* command : {"",
                              "fly",
                              "serve --fly",
                              "serve --frames-in-flight 0",
                              "serve --gl vulkan",
                              "serve --listen nowhere",
                              "serve --listen 127.0.0.1:9 --operator 127.0.0.2:9",
                              "serve --name https://grove.example",
                              "serve --name grove.example:443",
                              "serve --name ''",
                              "serve --origin example.org",
                              "serve --origin https://example.org/page",
                              "serve --origin '*'",
                              "serve --proxy localhost",
                              "serve --proxy 10.0.0.0/33",
                              "serve --tls-cert cert.pem",
                              "serve --tls-key key.pem",
                              "serve --tls-cert '' --tls-key ''",
                              "serve --hsts 60",
                              "serve --tls-cert cert.pem --tls-key key.pem --hsts -1",
                              "load",
                              "load ftp://x/ --sessions 1",
                              "load ws://127.0.0.1:1/ --sessions 0",
                              "load ws://127.0.0.1:1/ --codec vp9",
                              "load ws://127.0.0.1:1/ --look --stand",
                              "load ws://127.0.0.1:1/ --walk --look",
                              "load ws://127.0.0.1:1/ --walk a.walk --stand",
                              "load ws://127.0.0.1:1/ --shape",
                              "load ws://127.0.0.1:1/ --shape 5mbit",
                              "load ws://127.0.0.1:1/ --shape 0mbit,80ms",
                              "load ws://127.0.0.1:1/ --shape 11gbit,80ms",
                              "load ws://127.0.0.1:1/ --shape 5mbit,-80ms",
                              "load ws://127.0.0.1:1/ --shape 5mbit,11s",
                              "load ws://127.0.0.1:1/ --shape 5mbit,80ms,loss=1",
                              "shape",
                              "shape 5mbit,80ms",
                              "shape --to 127.0.0.1:1",
                              "shape fast --to 127.0.0.1:1",
                              "shape 5mbit,80ms --to 127.0.0.1",
                              "shape 5mbit,80ms --to 127.0.0.1:0",
                              "shape 5mbit,80ms --to 127.0.0.1:1 --listen nowhere",
                              "bench fluid --grid 63",
                              "bench fluid --grid 1000000",
                              "bench fluid --steps 0",
                              "bench fluid --threads 0",
                              "bench fluid --steps many",
                              "bench encode --size 1280",
                              "bench encode --size 1281x721",
                              "bench encode --seconds 0",
                              "bench encode --seconds long",
                              "bench encode round",
                              "bench pipeline --frames-in-flight 0",
                              "bench pipeline --frames-in-flight 9",
                              "bench pipeline --frames-in-flight 1,4,1",
                              "bench pipeline --frames-in-flight 1,x",
                              "bench pipeline --frames-in-flight 1.5",
                              "bench pipeline --users 0",
                              "bench pipeline --seconds 0",
                              "bench pipeline --seconds soon",
                              "bench pipeline --size 1280",
                              "bench pipeline --size 1280x720x3",
                              "bench pipeline --size 16x9",
                              "bench pipeline --size 1281x721"}) {
    const Outcome outcome = groveHere(command);
    EXPECT_EQ(outcome.exit, 2) << command;
    EXPECT_EQ(lines(outcome.output), 1) << command << ": " << outcome.output;
  }
}

TEST(CommandLine, FailuresExitOneWithOneLine) {
  const Outcome scene = grove("serve --scene no/such/file.toml --listen 127.0.0.1:0");
  EXPECT_EQ(scene.exit, 1);
  EXPECT_THAT(scene.output, HasSubstr("no/such/file.toml"));
  EXPECT_EQ(lines(scene.output), 1) << scene.output;

  const Outcome certificate = grove("serve --tls-cert no/cert.pem --tls-key no/key.pem --listen 127.0.0.1:0");
  EXPECT_EQ(certificate.exit, 1);
  EXPECT_THAT(certificate.output, AllOf(HasSubstr("--tls-cert"), HasSubstr("no/cert.pem"), HasSubstr("No such file")));
  EXPECT_EQ(lines(certificate.output), 1) << certificate.output << "told before the world is prepared";

  const Outcome shaders = grove("serve --shader-dir no/such/dir --listen 127.0.0.1:0");
  EXPECT_EQ(shaders.exit, 1);
  EXPECT_THAT(shaders.output, HasSubstr("no/such/dir"));
  EXPECT_EQ(lines(shaders.output), 1) << shaders.output;

  // Told before anything else is done.
  const Outcome trace = grove("bench pipeline --trace no/such/dir/trace.json --scene no/such/file.toml");
  EXPECT_EQ(trace.exit, 1);
  EXPECT_THAT(trace.output, HasSubstr("no/such/dir/trace.json"));
  EXPECT_EQ(lines(trace.output), 1) << trace.output;

  const Outcome nobody = grove("load ws://127.0.0.1:1/ --sessions 1 --seconds 1");
  EXPECT_EQ(nobody.exit, 1);
  EXPECT_EQ(lines(nobody.output), 1) << nobody.output;

  const Outcome walk = grove("load ws://127.0.0.1:1/ --walk no/such.walk");
  EXPECT_EQ(walk.exit, 1);
  EXPECT_THAT(walk.output, HasSubstr("no/such.walk"));
  EXPECT_EQ(lines(walk.output), 1) << walk.output;

  const Outcome shaped = grove("load ws://127.0.0.1:1/ --shape 5mbit,20ms --seconds 1");
  EXPECT_EQ(shaped.exit, 1);
  EXPECT_EQ(lines(shaped.output), 1) << shaped.output;

  const Outcome unknown = grove("shape 5mbit,80ms --listen 127.0.0.1:0 --to no.such.host.invalid:80");
  EXPECT_EQ(unknown.exit, 1);
  EXPECT_THAT(unknown.output, HasSubstr("--to"));
  EXPECT_EQ(lines(unknown.output), 1) << unknown.output;
}

TEST(CommandLine, APortInUseIsToldBeforeTheWorldIsPrepared) {
  const int taken = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(taken, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(listen(taken, 1), 0);
  socklen_t size = sizeof address;
  getsockname(taken, reinterpret_cast<sockaddr*>(&address), &size);
  const std::string port = std::to_string(ntohs(address.sin_port));
  const Outcome outcome = grove("serve --listen 127.0.0.1:" + port);
  close(taken);
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_THAT(outcome.output, HasSubstr(port));
  EXPECT_EQ(lines(outcome.output), 1) << outcome.output;
}

TEST(CommandLine, ALowLimitOfOpenFilesIsToldInOneLine) {
  const Outcome outcome = shell("ulimit -n 24; " GROVE_BINARY " serve --listen 127.0.0.1:0 2>&1");
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_THAT(outcome.output, HasSubstr("24 open files"));
  EXPECT_EQ(lines(outcome.output), 1) << outcome.output;
}

TEST(CommandLine, AMalformedSceneNamesItsLine) {
  const auto file = std::filesystem::temp_directory_path() / "grove_malformed_scene.toml";
  std::ofstream(file) << "name = 'x'\n[[object]]\ntype = 'mesh'\nshape = 'stone'\nheigth = 3\n";
  const Outcome outcome = grove("serve --scene " + file.string() + " --listen 127.0.0.1:0");
  std::filesystem::remove(file);
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr(":5: "), HasSubstr("heigth")));
  EXPECT_EQ(lines(outcome.output), 1) << outcome.output;
}

TEST(CommandLine, WithoutGlTheReasonAndTheRemedyAreNamed) {
  const std::string nowhere = "__EGL_VENDOR_LIBRARY_DIRS=/nonexistent ";
  const std::string command =
      nowhere + "timeout 60 " GROVE_BINARY " serve --gl egl --listen 127.0.0.1:0 2>&1 >/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  std::string output;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) output.append(buffer.data(), n);
  EXPECT_EQ(WEXITSTATUS(pclose(pipe)), 1) << output;
  EXPECT_THAT(output, HasSubstr("libegl-mesa0"));
}

TEST(CommandLine, BenchFluidPrintsOneDocumentOfTheContract) {
  const Outcome outcome = grove("bench fluid --grid 16 --steps 3 --threads 1 --json", false);
  EXPECT_EQ(outcome.exit, 0);
  EXPECT_THAT(outcome.output, StartsWith("{"));
  for (const char* key : {"\"grid\"", "\"threads\"", "\"steps\"", "\"obstacle_cells\"", "\"cpu_ms_per_step\"",
                          "\"wall_ms_per_step\"", "\"residual\"", "\"max_divergence\"", "\"phases\""}) {
    EXPECT_THAT(outcome.output, HasSubstr(key));
  }
}

/// A scene that is soon prepared, in a file that goes when this goes.
class SmallScene {
 public:
  SmallScene() {
    std::ofstream(path_) << "name = 'stones'\nspawn = [0, 0, 9]\n"
                            "[[object]]\ntype = 'mesh'\nshape = 'stone'\nposition = [-3, 0, 0]\n"
                            "[[object]]\ntype = 'fluid'\ngrid = 16\nsize = 8\n";
  }
  ~SmallScene() { std::filesystem::remove(path_); }
  SmallScene(const SmallScene&) = delete;
  SmallScene& operator=(const SmallScene&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  const std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("grove_small_scene_" + std::to_string(getpid()) + ".toml");
};

/// The output of a script that has a server of the small scene at $port.
Outcome whileServed(const std::string& script) {
  const SmallScene scene;
  return shell("served=$(mktemp); " GROVE_BINARY " serve --listen 127.0.0.1:0 --scene " + scene.path() +
               " >$served 2>/dev/null & server=$!\n"
               "until grep -q listening $served; do sleep 0.1; kill -0 $server || break; done\n"
               "port=$(sed -n 's/^listening.*://p' $served); rm $served\n" +
               script + "\nstatus=$?; kill -INT $server; wait $server; exit $status");
}

TEST(CommandLine, LoadPrintsOneDocumentOfTheContract) {
  const Outcome outcome = whileServed(GROVE_BINARY
                                      " load ws://127.0.0.1:$port/ --sessions 2 --seconds 1 --width 320 --height 180"
                                      " --codec jpeg --look --shape 20mbit,20ms,jitter=2ms --json 2>/dev/null");
  ASSERT_EQ(outcome.exit, 0);
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(report.at("sessions"), 2);
  EXPECT_EQ(report.at("errors"), 0);
  EXPECT_EQ(report.at("codec"), "jpeg");
  EXPECT_EQ(report.at("shape"), "20mbit,20ms,jitter=2ms");
  EXPECT_GT(report.at("latency_ms").at("p50"), 20.0);
  EXPECT_GE(report.at("latency_ms").at("p95"), report.at("latency_ms").at("p50"));
  EXPECT_GE(report.at("latency_ms").at("p99"), report.at("latency_ms").at("p95"));
  EXPECT_GE(report.at("lines").at("min"), 90);
  EXPECT_LE(report.at("lines").at("p50"), 180);
  EXPECT_GT(report.at("longest_gap_ms"), 0.0);
  for (const char* key : {"fps", "mbit_per_s", "dropped", "seconds", "frames"}) {
    EXPECT_TRUE(report.contains(key)) << key;
  }
}

TEST(CommandLine, LoadFollowsAWalkAndPrintsATable) {
  const Outcome outcome =
      whileServed(GROVE_BINARY " load ws://127.0.0.1:$port/ --seconds 1 --width 320 --height 180 --walk " GROVE_WALKS
                               "/clearing.walk 2>&1");
  EXPECT_EQ(outcome.exit, 0) << outcome.output;
  for (const char* row : {"p95", "longest gap", "codec", "lines"}) EXPECT_THAT(outcome.output, HasSubstr(row));
}

TEST(CommandLine, ShapeSaysWhereItListensAndEndsAtASignal) {
  for (const char* signal : {"INT", "TERM"}) {
    const Outcome outcome =
        whileServed("shaped=$(mktemp); " GROVE_BINARY
                    " shape 20mbit,20ms --listen 127.0.0.1:0 --to 127.0.0.1:$port >$shaped & shaper=$!\n"
                    "until grep -q listening $shaped; do sleep 0.1; kill -0 $shaper || break; done\n"
                    "cat $shaped; at=$(sed -n 's/^listening on //p' $shaped); rm $shaped\n" GROVE_BINARY
                    " load ws://$at/ --seconds 0.5 --width 320 --height 180 --json 2>/dev/null\n"
                    "kill -" +
                    std::string(signal) + " $shaper; wait $shaper");
    EXPECT_EQ(outcome.exit, 0) << signal;
    EXPECT_THAT(outcome.output, StartsWith("listening on 127.0.0.1:"));
    EXPECT_THAT(outcome.output, HasSubstr("\"errors\":0"));
  }
}

TEST(CommandLine, BenchPipelinePrintsARowForEachNumberOfFramesInFlight) {
  const SmallScene scene;
  const auto traceFile = std::filesystem::temp_directory_path() / ("grove_trace_" + std::to_string(getpid()) + ".json");
  const Outcome outcome =
      grove("bench pipeline --frames-in-flight 3,1 --users 2 --seconds 0.5 --size 320x180 --scene " + scene.path() +
                " --json --trace " + traceFile.string(),
            false);
  ASSERT_EQ(outcome.exit, 0);
  const auto report = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(report.at("scene"), "stones");
  EXPECT_EQ(report.at("users"), 2);
  EXPECT_EQ(report.at("size"), "320x180");
  EXPECT_GE(report.at("cores"), 1);
  EXPECT_GE(report.at("frames_per_second_limit"), 120);
  EXPECT_EQ(report.at("interrupted"), false);
  ASSERT_EQ(report.at("rows").size(), 2u);
  EXPECT_EQ(report.at("rows").at(0).at("frames_in_flight"), 3);
  EXPECT_EQ(report.at("rows").at(1).at("frames_in_flight"), 1);
  for (const auto& row : report.at("rows")) {
    EXPECT_GE(row.at("seconds"), 0.5);
    EXPECT_GT(row.at("frames"), 0);
    EXPECT_GT(row.at("frames_per_second"), 0.0);
    EXPECT_GT(row.at("overlap"), 0.0);
    EXPECT_GT(row.at("latency_ms").at("p50"), 0.0);
    EXPECT_GE(row.at("latency_ms").at("p99"), row.at("latency_ms").at("p50"));
    const auto& stages = row.at("stages");
    EXPECT_TRUE(stages.contains(row.at("bottleneck").get<std::string>()));
    for (const char* stage : {"Scene Analyzer", "Request Sender", "Request Receiver", "Renderer", "Compressor",
                              "Result Sender", "Result Receiver", "Decompressor", "Compositor", "Encoder"}) {
      ASSERT_TRUE(stages.contains(stage)) << stage;
      for (const char* key : {"runs", "wall_ms_per_run", "cpu_ms_per_run", "utilisation"}) {
        EXPECT_TRUE(stages.at(stage).contains(key)) << stage << " " << key;
      }
      EXPECT_LE(stages.at(stage).at("utilisation"), 1.0);
    }
    EXPECT_TRUE(stages.at("Compositor").at("types").contains("fluid"));
  }
  std::ifstream file(traceFile);
  const auto trace = nlohmann::json::parse(file);
  std::filesystem::remove(traceFile);
  EXPECT_EQ(measure::traceFault(trace), "");
  EXPECT_EQ(trace.at("traceEvents").at(0).at("args").at("name"), "3 frames in flight");
}

TEST(CommandLine, AnInterruptedBenchPrintsWhatItHas) {
  const SmallScene scene;
  const std::string command = "timeout --preserve-status -s INT 5 " GROVE_BINARY
                              " bench pipeline --seconds 60 --size 160x90 --json --scene " +
                              scene.path() + " 2>/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r");
  std::array<char, 4096> buffer{};
  std::string output;
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe)) output.append(buffer.data(), n);
  EXPECT_EQ(WEXITSTATUS(pclose(pipe)), 0);
  const auto report = nlohmann::json::parse(output);
  EXPECT_EQ(report.at("interrupted"), true);
  EXPECT_LE(report.at("rows").size(), 1u);
}

}  // namespace
}  // namespace grove::cli
