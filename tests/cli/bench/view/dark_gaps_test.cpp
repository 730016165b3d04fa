#include "measure/dark_gaps.h"

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
#include "objects/builtin.h"

namespace grove::cli {
namespace {

constexpr PictureSize kSize{640, 360};
constexpr int kWarmUpFrames = 15;
constexpr int kFrames = 30;
constexpr int kFramesPerReference = 5;
constexpr double kBegin = 2.0;  ///< seconds of the walk

node::FramePolicy drawEverything() {
  node::FramePolicy policy = walkPolicy();
  policy.backdrops = false;
  return policy;
}

/// Rough light fields have up to 2.2: texels that are larger than gaps hide the sky in one picture and not in another.
constexpr double kMaxGapsPerFrame = 5.0;

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
  /// Near-black pixels a frame that the second one lacks.
  [[nodiscard]] double gapsOn(const world::Walk& walk) {
    WalkVisitor visitor(world_, {.size = kSize});
    WalkVisitor reference(exactWorld_, {.size = kSize, .policy = drawEverything()});
    std::size_t gaps = 0;
    for (int i = -kWarmUpFrames; i < kFrames; ++i) {
      const Moment moment = world_.momentAt(walk.at(kBegin + std::max(0, i) / kWalkFramesPerSecond));
      const node::FinishedFrame shown = visitor.draw(moment);
      if (i < 0 || i % kFramesPerReference != 0) continue;
      const node::FinishedFrame drawn = reference.draw(moment);
      const auto shownColours = raster::rgbaOf(*shown.picture);
      const auto drawnColours = raster::rgbaOf(*drawn.picture);
      gaps += measure::darkGaps({shownColours, kSize.width}, {drawnColours, kSize.width});
    }
    return static_cast<double>(gaps) * kFramesPerReference / kFrames;
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

/// Fails if moved pictures are black where they are not covered, or hide all behind them there.
TEST(DarkGapsOnWalks, AreAsFewAsLeavesInShadeMake) {
  Groves groves;
  for (const std::string walk : {"clearing", "under_trees", "edge", "crowd"}) {
    EXPECT_LE(groves.gapsOn(world::loadWalk(GROVE_WALKS "/" + walk + ".walk")), kMaxGapsPerFrame) << walk;
  }
}

}  // namespace
}  // namespace grove::cli
