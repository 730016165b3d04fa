#include "objects/builtin_frontends.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "pipeline/worker_pool.h"
#include "world/sky.h"

/// A program of frontend halves alone, linked without any backend: it would not be if one of them needed something of a
/// backend.
namespace grove::objects {
namespace {

TEST(BuiltinFrontends, ExistForEveryType) {
  EXPECT_THAT(builtinFrontends().names(),
              ::testing::UnorderedElementsAre("figure", "fluid", "ground", "herd", "lightfield", "mesh", "sky"));
}

TEST(BuiltinFrontends, WorkWithoutABackend) {
  pipeline::WorkerPool workers(1);
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images;
  const world::Sky sky;
  const node::FrontendTypes types = builtinFrontends();
  for (const std::string_view name : types.names()) {
    EXPECT_TRUE(types.find(name)->makeHalf({workers, timeline, memory, images, sky})) << name;
  }
  workers.drain();
}

/// A machine of frontends alone has no GPU, and no rays to cast.
TEST(BuiltinFrontends, LoadNoLibraryOfBackends) {
  std::ifstream file("/proc/self/maps");
  const std::string maps{std::istreambuf_iterator<char>(file), {}};
  ASSERT_THAT(maps, ::testing::HasSubstr("libc.so"));
  for (const char* library : {"libembree", "libEGL", "libOSMesa", "libGL"}) {
    EXPECT_THAT(maps, ::testing::Not(::testing::HasSubstr(library)));
  }
}

}  // namespace
}  // namespace grove::objects
