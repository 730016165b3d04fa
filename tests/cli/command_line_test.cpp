#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "cli/program.h"

namespace grove::cli {
namespace {

using testing::AllOf;
using testing::HasSubstr;

std::ptrdiff_t lines(const std::string& text) { return std::ranges::count(text, '\n'); }

TEST(CommandLine, EveryCommandHasHelp) {
  for (const char* command : {"--help", "serve --help", "load --help", "node --help", "bench --help",
                              "bench fluid --help", "bench amortize --help", "bench encode --help",
                              "bench pipeline --help", "bench view --help", "shape --help", "world --help"}) {
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
                              "serve --nodes nowhere",
                              "node",
                              "node --objects mesh --listen nowhere",
                              "serve --tls-cert cert.pem --tls-key key.pem --hsts -1",
                              "serve --join nowhere",
                              "serve --share 127.0.0.1",
                              "serve --join 127.0.0.1:1 --share 127.0.0.1:2",
                              "world --listen nowhere",
                              "world --tls-cert cert.pem",
                              "node --objects mesh --tls-ca ca.pem",
                              "node --objects mesh --tls-key ''",
                              "serve --link-tls-cert cert.pem --link-tls-key key.pem",
                              "serve --share 127.0.0.1:0 --link-tls-ca ca.pem",
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
                              "load ws://127.0.0.1:1/ --shape 5mbit,80ms,loss=101",
                              "shape",
                              "shape 5mbit,80ms",
                              "shape --to 127.0.0.1:1",
                              "shape fast --to 127.0.0.1:1",
                              "shape 5mbit,80ms,loss=-1 --to 127.0.0.1:1",
                              "shape 5mbit,80ms,loss=x --to 127.0.0.1:1",
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
                              "bench pipeline --size 1281x721",
                              "bench view --size 1280",
                              "bench view --size 1281x721",
                              "bench view --seconds 0",
                              "bench view --seconds long",
                              "bench view --visitors 2",
                              "bench view --stand --visitors 0",
                              "bench view --stand --visitors 129",
                              "bench view round"}) {
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
  const Outcome keep = grove("bench encode --keep no/such/dir");
  EXPECT_EQ(keep.exit, 1);
  EXPECT_THAT(keep.output, HasSubstr("no/such/dir/frames.y4m"));
  EXPECT_EQ(lines(keep.output), 1) << keep.output;

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

TEST(CommandLine, ReportsAPortInUseBeforePreparation) {
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

TEST(CommandLine, ReportsALowOpenFileLimit) {
  const Outcome outcome = shell("ulimit -n 24; " GROVE_BINARY " serve --listen 127.0.0.1:0 2>&1");
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_THAT(outcome.output, HasSubstr("24 open files"));
  EXPECT_EQ(lines(outcome.output), 1) << outcome.output;
}

TEST(CommandLine, NamesTheLineOfAMalformedScene) {
  const auto file = std::filesystem::temp_directory_path() / "grove_malformed_scene.toml";
  std::ofstream(file) << "name = 'x'\n[[object]]\ntype = 'mesh'\nshape = 'stone'\nheigth = 3\n";
  const Outcome outcome = grove("serve --scene " + file.string() + " --listen 127.0.0.1:0");
  std::filesystem::remove(file);
  EXPECT_EQ(outcome.exit, 1);
  EXPECT_THAT(outcome.output, AllOf(HasSubstr(":5: "), HasSubstr("heigth")));
  EXPECT_EQ(lines(outcome.output), 1) << outcome.output;
}

TEST(CommandLine, WithoutGlNamesReasonAndRemedy) {
  const Outcome outcome = shell("__EGL_VENDOR_LIBRARY_DIRS=/nonexistent timeout 60 " GROVE_BINARY
                                " serve --gl egl --listen 127.0.0.1:0 2>&1 >/dev/null");
  EXPECT_EQ(outcome.exit, 1) << outcome.output;
  EXPECT_THAT(outcome.output, HasSubstr("libegl-mesa0"));
}

}  // namespace
}  // namespace grove::cli
