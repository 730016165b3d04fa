#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "eventually.h"
#include "integration/node_program.h"
#include "integration/picture.h"
#include "integration/remote_world.h"
#include "integration/stones.h"
#include "objects/builtin_frontends.h"
#include "stream/session/headless_session.h"
#include "stream/session/host.h"

/// This program is linked with what a frontend process needs and nothing else.
namespace grove::integration {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::Not;

/// What this program is linked with, directly or not: targets of the build, and libraries.
std::vector<std::string> linked() {
  std::istringstream list(GROVE_LINKED);
  return {std::istream_iterator<std::string>(list), std::istream_iterator<std::string>()};
}

/// Would catch a frontend that needs a backend again, be it for one header.
TEST(FrontendOnly, LinksNoBackend) {
  EXPECT_THAT(linked(), AllOf(Contains("stream_session"), Contains("node_transport_grpc"),
                              Contains("lightfield_frontend"), Contains("mesh_frontend"), Contains("PkgConfig::GRPC")));
  for (const char* const part :
       {"backend", "node_local", "embree", "world_geometry", "models", "bake", "EGL", "OSMESA"}) {
    EXPECT_THAT(linked(), Each(Not(HasSubstr(part))));
  }
  for (const char* const name : {"gl", "raster", "node", "node_world", "objects", "lightfield_file"}) {
    EXPECT_THAT(linked(), Not(Contains(name)));
  }
}

TEST(FrontendOnly, ShowsAWorldOfRemoteNodes) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("grove_frontend_only_" + std::to_string(getpid()) + ".toml");
  std::ofstream(file) << kStones;
  const NodeProgram still(file.string(), "sky,ground,mesh");
  const NodeProgram figures(file.string(), "figure");
  std::filesystem::remove(file);
  const node::FrontendTypes types = objects::builtinFrontends();
  stream::HostOptions options;
  options.deadlineSeconds = stream::HostOptions::kNoHurry;
  stream::Host host(remoteWorld(kStones, types, {still.address(), figures.address()}), types, options, {});
  stream::HeadlessSession ada(host, "Ada", 320, 180);
  const Picture alone = settledPicture(ada, ada.control(0, 0.0F, 0.0F), 60);
  EXPECT_GT(alone.mean(), 1.0) << "of nothing";
  EXPECT_GT(host.traffic().sharedData, 0U) << "the sky and the ground";
  EXPECT_GT(host.traffic().pictures, 0U) << "the stones, whose bounds the node's welcome told";
  const auto picturesOfFigures = [&] { return host.nodeLinks().at(1).traffic.pictures; };
  EXPECT_EQ(picturesOfFigures(), 0U);
  stream::HeadlessSession bob(host, "Bob", 160, 90);
  (void)bob.control(world::kForward, 0.0F, 0.0F);
  EXPECT_TRUE(tests::eventually([&] { return picturesOfFigures() > 0; })) << "the welcome told how large he is";
}

}  // namespace
}  // namespace grove::integration
