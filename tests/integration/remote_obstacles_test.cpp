#include "node/transport/grpc/calls/remote_obstacles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <numeric>
#include <string>
#include <thread>
#include <utility>

#include "eventually.h"
#include "integration/node_program.h"
#include "integration/picture.h"
#include "integration/remote_world.h"
#include "integration/served_scene.h"
#include "node/backend/prepare/load_scene.h"
#include "objects/fluid/backend/fluid_backend.h"
#include "objects/fluid/common/snapshot.h"
#include "objects/lightfield/backend/simd/thicket.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/small_field.h"

namespace grove::integration {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using tests::eventually;

/// A light field with a trunk of wood.
void writeTree(const std::filesystem::path& file) {
  objects::lightfield::LightField field = objects::lightfield::Thicket().bake(4, 32, 2);
  std::vector<std::uint8_t> cells(std::size_t{3} * 20 * 3, 0);
  for (std::size_t y = 0; y < 20; ++y) {
    cells[(1 * 20 + y) * 3 + 1] = static_cast<std::uint8_t>(objects::lightfield::Voxel::kWood);
  }
  field.voxels = {3, 20, 3, 0.1F, {-0.15F, 0.0F, -0.15F}, cells};
  objects::lightfield::writeLightField(field, file);
}

std::ptrdiff_t timesIn(const std::string& text, const std::string& part) {
  std::ptrdiff_t times = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
  return times;
}

/// A fire between a stone, a model from a glTF file and a light field, in a folder of its own.
class RemoteObstaclesTest : public ::testing::Test {
 protected:
  RemoteObstaclesTest() {
    std::filesystem::copy(GROVE_LANTERN_TREE, model());
    writeTree(lightField());
    text =
        "name = 'a fire'\nspawn = [0, 0, 8]\n[[object]]\ntype = 'fluid'\ngrid = 24\nsize = 4\nrate = 600\n"
        "[[object]]\ntype = 'mesh'\nshape = 'stone'\nposition = [-0.8, 0, 0.3]\n"
        "[[object]]\ntype = 'mesh'\nmodel = '" +
        model().string() +
        "'\nposition = [0.9, 0, -0.6]\n"
        "[[object]]\ntype = 'lightfield'\nscale = 3\nfile = '" +
        lightField().string() + "'\nposition = [0.5, 0, 1.2]\n";
    std::ofstream(file()) << text;
  }
  [[nodiscard]] std::filesystem::path model() const { return folder / "tree.gltf"; }
  [[nodiscard]] std::filesystem::path lightField() const { return folder / "tree.glf"; }
  [[nodiscard]] std::string file() const { return (folder / "scene.toml").string(); }
  [[nodiscard]] world::Scene scene() const { return world::parseScene(text, "test.toml"); }
  [[nodiscard]] node::RemoteObstacles obstaclesOf(const NodeProgram& node) const {
    return {node.address(), scene().hash, {}};
  }
  /// Only those who have read them before know what stops smoke.
  void removeModels() const {
    std::filesystem::remove(model());
    std::filesystem::remove(lightField());
  }

  const objects::lightfield::TemporaryFolder folder;
  std::string text;
  const node::BackendTypes types = objects::builtinTypes().backends;
};

/// The fire of a scene in this process, amid these obstacles.
struct OneFire {
  OneFire(const world::Scene& scene, const node::BackendTypes& types, const world::VoxelObstacles& around)
      : loaded(node::loadScene(scene, types, {.objects = {1}, .visitors = false})),
        obstacles(around),
        fire({.scene = loaded,
              .geometry = geometry,
              .obstacles = obstacles,
              .world = mirror,
              .workers = workers,
              .gl = gl,
              .timeline = timeline,
              .memory = memory,
              .images = images,
              .announce = [](const node::Announcement&) {},
              .progress = {}},
             loaded.layout.objects.front().type) {}

  std::shared_ptr<const objects::fluid::FluidSnapshot> newest() {
    node::Request request;
    request.object = 1;
    request.shared = true;
    node::Payload payload;
    fire.answer({&request, 1}, {&payload, 1});
    return std::dynamic_pointer_cast<const objects::fluid::FluidSnapshot>(
        std::get<std::shared_ptr<const node::SharedData>>(payload));
  }
  /// As it is while nobody has come: after so many ticks, it rests.
  std::shared_ptr<const objects::fluid::FluidSnapshot> atRest() {
    const auto runs = [this] { return timeline.totals()["Simulation Tick"].runs; };
    EXPECT_TRUE(eventually([&] { return runs() >= 60; }));
    return newest();
  }
  void visit() {
    const auto update = std::make_shared<node::WorldUpdate>();
    update->number = 1;
    update->players.resize(1);
    (void)mirror.apply(1, update);
  }
  /// More where the grid is finer.
  std::int64_t bytes() { return memory.totals()[{"simulations", "fluid"}].bytes; }

  const node::LoadedScene loaded;
  const world::VoxelObstacles& obstacles;
  const world::WorldGeometry geometry{loaded.objects};
  node::WorldMirror mirror;
  pipeline::Timeline timeline;
  pipeline::MemoryLedger memory;
  raster::ImagePool images{memory};
  const gl::ShaderLibrary shaders;
  gl::Workers gl{gl::ContextKind::kAuto, shaders, 1};
  pipeline::WorkerPool workers{1};
  objects::fluid::FluidBackend fire;
};

TEST_F(RemoteObstaclesTest, MatchLocalObstacles) {
  const node::LoadedScene loaded = node::loadScene(scene(), types);
  const world::WorldGeometry geometry(loaded.objects);
  const world::VoxelObstacles& local = geometry.obstacles();
  const NodeProgram stones(file(), "mesh,lightfield");
  const node::RemoteObstacles remote = obstaclesOf(stones);
  const world::Vec3 sun = loaded.layout.sky.sun;
  for (const int cells : {16, 24, 36, 48}) {
    const world::Cube cube{{-2.0F, 0.0F, -2.0F}, 4.0F, cells};
    const auto solid = remote.solidCells(cube);
    const auto lit = remote.sunlitCells(cube, sun);
    EXPECT_EQ(solid, local.solidCells(cube));
    EXPECT_EQ(lit, local.sunlitCells(cube, sun));
    EXPECT_GT(std::ranges::count(solid, 1), cells) << "of nothing";
    EXPECT_GT(std::ranges::count(lit, 0), cells);
  }
}

TEST_F(RemoteObstaclesTest, GiveTheSameSmoke) {
  const node::LoadedScene loaded = node::loadScene(scene(), types);
  const world::WorldGeometry geometry(loaded.objects);
  OneFire amidModels(scene(), types, geometry.obstacles());
  const NodeProgram stones(file(), "mesh,lightfield");
  const node::RemoteObstacles remote = obstaclesOf(stones);
  OneFire withRemote(scene(), types, remote);
  const world::WorldGeometry nothing({});
  OneFire alone(scene(), types, nothing.obstacles());
  const auto expected = amidModels.atRest();
  const auto seen = withRemote.atRest();
  ASSERT_EQ(seen->tick, expected->tick);
  EXPECT_GT(seen->count(), 100U);
  EXPECT_EQ(seen->x, expected->x);
  EXPECT_EQ(seen->sunLight, expected->sunLight);
  EXPECT_NE(seen->x, alone.atRest()->x) << "they matter";
}

/// Would catch a node that opens a model or a light field which is not its own: they are gone.
TEST_F(RemoteObstaclesTest, SufficeForAFluidNode) {
  const NodeProgram stones(file(), "mesh,lightfield");
  removeModels();
  EXPECT_EQ(NodeProgram(file(), "fluid").port(), 0) << "without the option it cannot start";
  const NodeProgram fire(file(), "fluid", 0, {"--obstacles", stones.address()});
  ASSERT_NE(fire.port(), 0);
  const node::FrontendTypes frontends = objects::builtinTypes().frontends;
  stream::Host host(remoteWorld(text, frontends, {stones.address(), fire.address()}), frontends,
                    ServedScene::patient({}), {});
  stream::HeadlessSession visitor(host, "Ada", 320, 180);
  EXPECT_GT(settledPicture(visitor, visitor.control(0, 0.0F, 0.0F)).mean(), 0.5);
  EXPECT_TRUE(eventually([&] { return host.timeline().costs()[{"Compositor", "fluid"}].cpuNanoseconds > 0; }));
  EXPECT_TRUE(eventually([&] { return host.timeline().costs()[{"Compositor", "mesh"}].cpuNanoseconds > 0; }));
}

/// Would catch a fire that stops, or a log that is flooded, because the other node is away.
TEST_F(RemoteObstaclesTest, GridStaysUntilObstaclesArrive) {
  auto stones = std::make_unique<NodeProgram>(file(), "mesh,lightfield");
  const int port = stones->port();
  const node::RemoteObstacles remote = obstaclesOf(*stones);
  OneFire fire(scene(), types, remote);
  fire.visit();
  const auto ticksOn = [&] {
    const auto tick = fire.newest()->tick;
    return eventually([&] { return fire.newest()->tick > tick + 30; });
  };
  ASSERT_TRUE(ticksOn());
  const std::int64_t before = fire.bytes();
  stones.reset();
  ::testing::internal::CaptureStderr();
  const auto begin = std::chrono::steady_clock::now();
  fire.fire.setQuality(2);
  EXPECT_TRUE(ticksOn());
  EXPECT_TRUE(ticksOn());
  const std::string log = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, HasSubstr("its smoke keeps its grid: 127.0.0.1:" + std::to_string(port) +
                             ": no node provides obstacles: Connection refused"));
  const auto questions = 1 + (std::chrono::steady_clock::now() - begin) / 10s;
  EXPECT_LE(timesIn(log, "its smoke keeps its grid"), questions) << log;
  EXPECT_LT(fire.bytes(), before * 3 / 2);
  stones = std::make_unique<NodeProgram>(file(), "mesh,lightfield", port);
  ASSERT_EQ(stones->port(), port);
  EXPECT_TRUE(eventually([&] { return fire.bytes() > 2 * before; })) << "it asks again by itself";
  EXPECT_EQ(fire.timeline.totals()["Simulation Tick"].failures, 0U);
}

}  // namespace
}  // namespace grove::integration
