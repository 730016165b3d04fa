#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <stop_token>
#include <string>
#include <string_view>

#include "cli/bench/walk/walk_visitor.h"
#include "cli/bench/walk/walk_world.h"
#include "cli/prepare/prepare_world.h"
#include "gl/shader_library.h"
#include "measure/pictures/block_jumps.h"
#include "measure/pictures/dark_gaps.h"
#include "measure/pictures/foreign_pixels.h"
#include "objects/builtin.h"
#include "sanitized.h"

namespace grove::cli {
namespace {

constexpr PictureSize kSize{640, 360};
constexpr int kWarmUpFrames = 15;
constexpr int kFrames = kSanitized ? 6 : 30;
constexpr double kBegin = 2.0;  ///< seconds of the walk

node::FramePolicy drawEverything() {
  node::FramePolicy policy = walkPolicy();
  policy.backdrops = false;
  return policy;
}

/// What a walk shows that a drawn one does not, in the mean of its frames.
struct Faults {
  double darkGaps = 0.0;
  double foreignPixels = 0.0;
  double blockJumps = 0.0;
};

/// Rough light fields have up to 1.4, 50 and 5; fine ones have no dark gaps. Where rays that meet nothing
/// show nothing there are 220 to 300 foreign pixels on three walks; where pictures are not moved, 16 to 165 of about
/// 700 blocks jump.
constexpr Faults kMost{.darkGaps = 2.0, .foreignPixels = 150.0, .blockJumps = 12.0};

/// Without the fluid, which moves between two frames.
world::Scene grove() {
  world::Scene scene = openScene(std::nullopt);
  std::erase_if(scene.objects, [](const auto& object) { return object.type == "fluid"; });
  return scene;
}

/// Light fields are drawn for each frame alone.
world::Scene exactGrove() {
  world::Scene scene = grove();
  world::setTypeOption(scene, "lightfield", "view_error", 0.0);
  return scene;
}

void ignoreProgress(std::string_view, float) {}

/// The built-in world as visitors see it, and beside it one that moves no pictures.
class Groves {
 public:
  [[nodiscard]] Faults faultsOn(const world::Walk& walk) {
    WalkVisitor visitor(world_, {.size = kSize});
    WalkVisitor reference(exactWorld_, {.size = kSize, .policy = drawEverything()});
    Faults sum;
    measure::BlockJumps jumps;
    for (int i = -kWarmUpFrames; i < kFrames; ++i) {
      const Moment moment = world_.momentAt(walk.at(kBegin + std::max(0, i) / kWalkFramesPerSecond));
      const node::FinishedFrame shownFrame = visitor.draw(moment);
      if (i < 0) continue;
      const node::FinishedFrame drawnFrame = reference.draw(moment);
      const auto shownColours = raster::rgbaOf(*shownFrame.picture);
      const auto drawnColours = raster::rgbaOf(*drawnFrame.picture);
      const measure::Picture shown{shownColours, kSize.width};
      const measure::Picture drawn{drawnColours, kSize.width};
      sum.darkGaps += static_cast<double>(measure::darkGaps(shown, drawn));
      sum.foreignPixels += static_cast<double>(measure::foreignPixels(shown, drawn));
      jumps.add(shown, drawn);
    }
    return {sum.darkGaps / kFrames, sum.foreignPixels / kFrames,
            static_cast<double>(jumps.jumps()) / static_cast<double>(jumps.pairs())};
  }

 private:
  /// Of what is in the cache folder, or something rough.
  static world::Scene prepared(world::Scene scene, const node::ObjectTypes& types) {
    static_cast<void>(prepareFirstLook(scene, types.backends, ignoreProgress, std::stop_token()));
    return scene;
  }

  const node::ObjectTypes types_ = objects::builtinTypes();
  const gl::ShaderLibrary shaders_;
  gl::Workers gl_{gl::ContextKind::kAuto, shaders_};
  const world::Scene scene_ = prepared(grove(), types_);
  const world::Scene exactScene_ = exactGrove();
  const node::LoadedScene loaded_ = node::loadScene(scene_, types_.backends);
  const node::LoadedScene loadedExact_ = node::loadScene(exactScene_, types_.backends);
  WalkWorld world_{loaded_, types_, gl_, ignoreProgress};
  WalkWorld exactWorld_{loadedExact_, types_, gl_, ignoreProgress};
};

/// Fails if moved pictures show nothing, black or what lies behind where they are not covered, or are not moved right.
TEST(WalkFaults, AreFew) {
  Groves groves;
  for (const std::string walk : {"clearing", "under_trees", "edge", "crowd"}) {
    const Faults faults = groves.faultsOn(world::loadWalk(GROVE_WALKS "/" + walk + ".walk"));
    EXPECT_LE(faults.darkGaps, kMost.darkGaps) << walk;
    EXPECT_LE(faults.foreignPixels, kMost.foreignPixels) << walk;
    EXPECT_LE(faults.blockJumps, kMost.blockJumps) << walk;
  }
}

}  // namespace
}  // namespace grove::cli
