#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

#include "integration/node_program.h"
#include "integration/picture.h"
#include "integration/remote_world.h"
#include "integration/served_scene.h"
#include "objects/lightfield/backend/simd/thicket.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/small_field.h"

namespace grove::integration {
namespace {

/// Pictures of a distant light field that a server asks a node for, to share them; the node has these further options.
std::int64_t picturesToShare(const std::vector<std::string>& options) {
  const objects::lightfield::TemporaryFolder folder;
  const std::string field = (folder / "thicket.glf").string();
  objects::lightfield::writeLightField(objects::lightfield::Thicket().bake(8, 64, 3), field);
  const std::string scene =
      "name = 'a thicket'\nspawn = [0, 0, 60]\n[[object]]\ntype = 'lightfield'\nscale = 5\nfile = '" + field + "'\n";
  const std::string file = (folder / "scene.toml").string();
  std::ofstream(file) << scene;
  const NodeProgram node(file, "lightfield", 0, options);
  const node::FrontendTypes types = objects::builtinTypes().frontends;
  stream::Host host(remoteWorld(scene, types, {node.address()}), types, ServedScene::patient({}), {});
  stream::HeadlessSession visitor(host, "Ada", 320, 180);
  EXPECT_GT(settledPicture(visitor, visitor.control(0, 0.0F, 0.0F), 60).mean(), 0.5);
  return host.timeline().counters()["view cache misses"];
}

/// Would catch a node whose option reaches no light field, or no server.
TEST(RemoteViewError, ComesFromTheNode) {
  EXPECT_GT(picturesToShare({}), 0);
  EXPECT_EQ(picturesToShare({"--view-error", "0"}), 0);
}

}  // namespace
}  // namespace grove::integration
