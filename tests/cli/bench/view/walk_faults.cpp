#include "cli/bench/view/walk_faults.h"

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

namespace grove::cli {
namespace {

constexpr PictureSize kSize{640, 360};
constexpr int kWarmUpFrames = 15;
constexpr double kBegin = 2.0;  ///< seconds of the walk

node::FramePolicy drawEverything() {
  node::FramePolicy policy = walkPolicy();
  policy.backdrops = false;
  return policy;
}

/// Without what moves by itself: it is elsewhere in the other world.
world::Scene grove() {
  world::Scene scene = openScene(std::nullopt);
  std::erase_if(scene.objects, [](const auto& object) { return object.type == "fluid" || object.type == "herd"; });
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
  explicit Groves(LightFields fields) : scene_(prepared(grove(), types_, fields)) {}

  [[nodiscard]] Faults faultsOn(const world::Walk& walk, const Frames& frames) {
    WalkVisitor visitor(world_, {.size = kSize});
    WalkVisitor reference(exactWorld_, {.size = kSize, .policy = drawEverything()});
    Faults sum;
    measure::BlockJumps jumps;
    // In time of its own: on a slow machine the eye would rest at the begin, and trees become sharp.
    Moment moment = world_.momentAt(walk.at(kBegin));
    for (int i = -kWarmUpFrames; i < frames.count; ++i) {
      moment.pose = world_.momentAt(walk.at(kBegin + std::max(0, i) * frames.step / kWalkFramesPerSecond)).pose;
      moment.time += (i < 0 ? 1 : frames.step) / kWalkFramesPerSecond;
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
    return {sum.darkGaps / frames.count, sum.foreignPixels / frames.count,
            static_cast<double>(jumps.jumps()) / static_cast<double>(jumps.pairs())};
  }

 private:
  static world::Scene prepared(world::Scene scene, const node::ObjectTypes& types, LightFields fields) {
    if (fields == LightFields::kFine) {
      Progress progress;
      static_cast<void>(prepareWorld(scene, types.backends, progress, std::stop_token()));
    } else {
      static_cast<void>(prepareFirstLook(scene, types.backends, ignoreProgress, std::stop_token()));
    }
    return scene;
  }

  const node::ObjectTypes types_ = objects::builtinTypes();
  const gl::ShaderLibrary shaders_;
  gl::Workers gl_{gl::ContextKind::kAuto, shaders_};
  const world::Scene scene_;
  const world::Scene exactScene_ = exactGrove();
  const node::LoadedScene loaded_ = node::loadScene(scene_, types_.backends);
  const node::LoadedScene loadedExact_ = node::loadScene(exactScene_, types_.backends);
  WalkWorld world_{loaded_, types_, gl_, ignoreProgress};
  WalkWorld exactWorld_{loadedExact_, types_, gl_, ignoreProgress};
};

}  // namespace

void expectFewFaults(LightFields fields, const Frames& frames, const Faults& most) {
  Groves groves(fields);
  for (const std::string walk : {"clearing", "under_trees", "edge", "crowd"}) {
    const Faults faults = groves.faultsOn(world::loadWalk(GROVE_WALKS "/" + walk + ".walk"), frames);
    EXPECT_LE(faults.darkGaps, most.darkGaps) << walk;
    EXPECT_LE(faults.foreignPixels, most.foreignPixels) << walk;
    EXPECT_LE(faults.blockJumps, most.blockJumps) << walk;
  }
}

}  // namespace grove::cli
