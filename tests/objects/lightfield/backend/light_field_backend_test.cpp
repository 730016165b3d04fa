#include "objects/lightfield/backend/light_field_backend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/frontend/scene_analyzer.h"
#include "node/registry.h"
#include "objects/lightfield/backend/light_field_type.h"
#include "objects/lightfield/backend/simd/thicket.h"
#include "objects/lightfield/common/shared_view.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/small_field.h"
#include "pipeline/worker_pool.h"
#include "world/scene_file.h"

namespace grove::objects::lightfield {
namespace {

/// A wood of 25 thickets of ten metres, and visitors who walk about in it.
class Wood {
 public:
  Wood(const LightField& field, int visitors) : world_(layoutOf(field)) {
    for (int i = 0; i < visitors; ++i) players_.push_back(world_.players().join("visitor", 0.0));
  }

  /// What a visitor is answered in the next frame.
  std::vector<node::Payload> look(std::size_t visitor, node::FrameNumber frame, double now, bool walks = true) {
    world::Input input;
    input.number = frame;
    input.keys = walks ? world::kForward : 0;
    input.yaw = 0.8F * static_cast<float>(visitor) + (walks ? std::sin(0.5F * static_cast<float>(now)) : 0.0F);
    world_.players().apply(players_[visitor], input, now);
    const auto view = std::make_shared<node::View>();
    view->session = static_cast<node::SessionId>(visitor + 1);
    view->frame = frame;
    view->viewer = players_[visitor];
    view->time = now;
    view->players = world_.players().all(now);
    view->camera.pose = world_.players().find(players_[visitor], now)->pose;
    view->camera.width = 320;
    view->camera.height = 180;
    const auto list = std::make_shared<node::FrameList>();
    list->view = view;
    list->objects = node::visibleObjects(world_, *view);
    std::vector<node::Payload> payloads(list->objects.size());
    for (std::uint32_t i = 0; i < payloads.size(); ++i) {
      const node::Request request{list, i};
      backend_.answer({&request, 1}, {&payloads[i], 1});
    }
    return payloads;
  }

  /// The light field that all show gives way to a finer one.
  void show(const LightField& finer) {
    const std::string file = (folder_ / "thicket.glf").string();
    writeLightField(finer, file);
    registry_.type(*registry_.find("lightfield")).show(file);
  }

  std::int64_t counted(const char* counter) {
    const auto counters = timeline_.counters();
    const auto found = counters.find(counter);
    return found == counters.end() ? 0 : found->second;
  }

 private:
  world::World::Layout layoutOf(const LightField& field) {
    const std::string file = (folder_ / "thicket.glf").string();
    writeLightField(field, file);
    registry_.add(std::make_unique<LightFieldType>(ViewCacheOptions{}));
    std::string scene = "name = 'a wood'\nspawn = [0, 0, 30]\n";
    for (int i = 0; i < 25; ++i) {
      scene += "[[object]]\ntype = 'lightfield'\nrenderer = 'simd'\nscale = 5\nfile = '" + file + "'\nposition = [" +
               std::to_string(14 * (i % 5 - 2)) + ", 0, " + std::to_string(14 * (i / 5 - 2)) + "]\n";
    }
    return node::makeLayout(world::parseScene(scene, "wood.toml"), registry_);
  }

  TemporaryFolder folder_;
  node::Registry registry_;
  world::World world_;
  std::vector<world::PlayerId> players_;
  gl::ShaderLibrary shaders_;
  gl::Workers gl_{gl::ContextKind::kAuto, shaders_};
  pipeline::WorkerPool workers_{1};
  pipeline::Timeline timeline_;
  pipeline::MemoryLedger ledger_;
  raster::ImagePool images_;
  LightFieldBackend backend_{
      {world_, workers_, gl_, timeline_, ledger_, images_, {}}, *registry_.find("lightfield"), {}};
};

class LightFieldBackendTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { field_ = new LightField(Thicket().bake(4, 64, 2)); }
  static void TearDownTestSuite() { delete field_; }
  static LightField* field_;
};

LightField* LightFieldBackendTest::field_ = nullptr;

struct Fades {
  int going = 0;
  float least = 1.0F;  ///< share of the finer ones
  float most = 0.0F;
};

Fades fadesOf(const std::vector<node::Payload>& payloads) {
  Fades fades;
  for (const node::Payload& payload : payloads) {
    const auto* shared = std::get_if<std::shared_ptr<const node::SimulationData>>(&payload);
    if (shared == nullptr) continue;
    const CrossFade& fade = static_cast<const SharedView&>(**shared).parts().fade;
    if (!fade.from) continue;
    ++fades.going;
    fades.least = std::min(fades.least, fade.share);
    fades.most = std::max(fades.most, fade.share);
  }
  return fades;
}

bool showsAll(const std::vector<node::Payload>& payloads) {
  for (const node::Payload& payload : payloads) {
    if (std::holds_alternative<node::Failure>(payload)) return false;
    const auto* shared = std::get_if<std::shared_ptr<const node::SimulationData>>(&payload);
    if (shared != nullptr && static_cast<const SharedView&>(**shared).parts().picture == nullptr) return false;
  }
  return true;
}

TEST_F(LightFieldBackendTest, ALoneVisitorIsNeverHeldBack) {
  Wood wood(*field_, 1);
  for (node::FrameNumber frame = 1; frame <= 120; ++frame) (void)wood.look(0, frame, frame / 30.0);
  EXPECT_EQ(wood.counted("coarse views"), 0);
  EXPECT_LE(wood.counted("views shown late"), wood.counted("view cache hits") / 10);
  EXPECT_GT(wood.counted("view cache misses"), 20);
}

TEST_F(LightFieldBackendTest, AFinerLightFieldComesWithoutAJump) {
  Wood wood(*field_, 1);
  node::FrameNumber frame = 1;
  double now = 0.0;
  const auto look = [&] { return wood.look(0, frame++, now += 1.0 / 30.0, false); };
  while (frame < 90) (void)look();
  EXPECT_EQ(fadesOf(look()).going, 0);
  wood.show(Thicket().bake(4, 128, 2));
  // Everything that shows goes over to it, as the budget has it, and begins with the picture that was there.
  std::map<int, int> seen;
  int objects = 0;
  float last = 0.0F;
  bool isFirst = true;
  for (int i = 0; i < 120; ++i) {
    const auto payloads = look();
    ASSERT_TRUE(showsAll(payloads));
    objects = static_cast<int>(payloads.size());
    const Fades fades = fadesOf(payloads);
    if (fades.going == 0) continue;
    if (std::exchange(isFirst, false)) {
      EXPECT_LT(fades.least, 0.01F);
    }
    EXPECT_LT(fades.most - last, 0.1F) << "no more than a frame's share at once";
    last = std::max(last, fades.most);
    ++seen[fades.going];
  }
  ASSERT_GT(objects, 5);
  EXPECT_FALSE(isFirst);
  EXPECT_GT(last, 0.9F);
  EXPECT_GT(seen.rbegin()->first, objects / 2) << "most objects faded";
  EXPECT_EQ(fadesOf(look()).going, 0) << "and it comes to an end";
}

/// For the thread sanitizer, too: requests in progress hold on to what they began with.
TEST_F(LightFieldBackendTest, LightFieldsChangeWhileFramesAreMade) {
  Wood wood(*field_, 2);
  const LightField finer = Thicket().bake(2, 64, 2);
  std::atomic<bool> done{false};
  std::jthread shower([&] {
    for (int i = 0; i < 5; ++i) {
      wood.show(i % 2 == 0 ? finer : *field_);
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    done = true;
  });
  for (node::FrameNumber frame = 1; !done; ++frame) {
    for (const std::size_t visitor : {0U, 1U}) {
      const auto payloads = wood.look(visitor, frame, frame / 30.0);
      ASSERT_TRUE(showsAll(payloads));
      ASSERT_FALSE(payloads.empty());
    }
  }
}

TEST_F(LightFieldBackendTest, ACrowdOnALateMachineSeesEverythingWithinTheBudget) {
  // Pictures of this light field are small; so many share the budget that those who look get few.
  constexpr int kVisitors = 800;
  constexpr std::size_t kLooking = 8;
  constexpr double kSeconds = 10.0;
  Wood wood(*field_, kVisitors);
  const double share = LightFieldBackend::texelsPerSecond(1) * kLooking / kVisitors;
  node::FrameNumber frame = 0;
  for (; frame < 4 * kSeconds; ++frame) {
    for (std::size_t visitor = 0; visitor < kLooking; ++visitor) {
      ASSERT_TRUE(showsAll(wood.look(visitor, frame + 1, 0.25 * frame)));
    }
  }
  EXPECT_LE(static_cast<double>(wood.counted("texels of new views")), share * (kSeconds + 1.0) + kLooking * 64 * 64);
  EXPECT_GT(wood.counted("coarse views"), 10);
  EXPECT_GT(wood.counted("views shown late") + wood.counted("near views shown late"), 100);

  // Who stands still has proper pictures of everything in the end.
  const auto late = [&] {
    return wood.counted("coarse views") + wood.counted("views shown late") + wood.counted("near views shown late");
  };
  for (; frame < 4 * 6 * kSeconds; ++frame) (void)wood.look(0, frame + 1, 0.25 * frame, false);
  const std::int64_t before = late();
  (void)wood.look(0, frame + 1, 0.25 * frame, false);
  EXPECT_EQ(late(), before);
}

}  // namespace
}  // namespace grove::objects::lightfield
