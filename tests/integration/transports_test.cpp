#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

#include "integration/picture.h"
#include "integration/served_scene.h"
#include "objects/lightfield/backend/simd/thicket.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/small_field.h"
#include "sanitized.h"
#include "stream/session/headless_session.h"

namespace grove::integration {
namespace {

/// So far apart that none is shown by a backdrop of another: whether one is extended depends on how long frames take.
constexpr std::array kYaws = {0.0F, 1.5708F, -1.5708F};

/// What a visitor sees in each direction.
std::vector<Picture> picturesOver(node::TransportKind kind, const std::string& scene) {
  ServedScene served(scene, {}, node::transportFactory(kind));
  stream::HeadlessSession visitor(served.host, "Ada", 320, 180);
  // To the left of who comes first.
  const stream::HeadlessSession neighbour(served.host, "Bob", 160, 90);
  const auto look = [&](float yaw) { return settledPicture(visitor, visitor.control(0, yaw, 0.0F)); };
  // Who stands still sees late what has come meanwhile; who comes back sees all of it.
  for (const float yaw : kYaws) (void)look(yaw);
  std::vector<Picture> pictures;
  pictures.reserve(kYaws.size());
  for (const float yaw : kYaws) pictures.push_back(look(yaw));
  if (kind != node::TransportKind::kReference) {
    const node::LinkTraffic traffic = served.host.traffic();
    EXPECT_GT(traffic.pictures + traffic.sharedData, 0u) << "nothing travelled";
  }
  return pictures;
}

/// The largest difference of two pictures' light, and how bright the first one is.
struct Comparison {
  double difference = 0.0;
  double mean = 0.0;
};

Comparison compareTransports(const std::string& scene) {
  const std::vector<Picture> byReference = picturesOver(node::TransportKind::kReference, scene);
  const std::vector<Picture> byBytes = picturesOver(node::TransportKind::kBytes, scene);
  const std::vector<Picture> byGrpc = picturesOver(node::TransportKind::kGrpc, scene);
  Comparison comparison;
  for (std::size_t i = 0; i < kYaws.size(); ++i) {
    comparison.difference = std::max(
        {comparison.difference, difference(byReference[i], byBytes[i]), difference(byReference[i], byGrpc[i])});
    comparison.mean = std::max(comparison.mean, byReference[i].mean());
  }
  return comparison;
}

void expectTheSamePictures(const std::string& scene) {
  const Comparison comparison = compareTransports("name = 'a stage'\nspawn = [0, 0, 6]\n" + scene);
  EXPECT_EQ(comparison.difference, 0.0);
  EXPECT_GT(comparison.mean, 1.0) << "of nothing";
}

TEST(Transports, ShowTheSameSky) { expectTheSamePictures("[[object]]\ntype = 'sky'\n"); }

TEST(Transports, ShowTheSameGround) { expectTheSamePictures("[[object]]\ntype = 'ground'\n"); }

TEST(Transports, ShowTheSameMeshes) {
  expectTheSamePictures("[[object]]\ntype = 'sky'\n[[object]]\ntype = 'mesh'\nshape = 'rocks'\nposition = [0, 0, 1]\n");
}

TEST(Transports, ShowTheSameFigures) {
  expectTheSamePictures("[[object]]\ntype = 'sky'\n[visitor]\ntype = 'figure'\n");
}

TEST(Transports, ShowTheSameLightFieldsFarAndNear) {
  const objects::lightfield::TemporaryFolder folder;
  objects::lightfield::writeLightField(objects::lightfield::Thicket().bake(8, 64, 3), folder / "thicket.glf");
  const auto thicket = [&](const char* place) {
    return "[[object]]\ntype = 'lightfield'\nscale = 5\nposition = " + std::string(place) + "\nfile = '" +
           (folder / "thicket.glf").string() + "'\n";
  };
  expectTheSamePictures("[[object]]\ntype = 'sky'\n" + thicket("[0, 0, -20]") + thicket("[-1, 0, 0]"));
}

TEST(Transports, ShowTheSameSmoke) {
  const std::string smoke =
      "name = 'smoke'\nspawn = [0, 0, 6]\n[[object]]\ntype = 'fluid'\nsize = 8\nradius = 0.3\nrate = 2300\n";
  const Comparison comparison = compareTransports(smoke + (kSanitized ? "grid = 16\n" : ""));
  EXPECT_GT(comparison.mean, 0.5);
  EXPECT_LT(comparison.difference, 0.25 * comparison.mean + 1.0);
}

}  // namespace
}  // namespace grove::integration
