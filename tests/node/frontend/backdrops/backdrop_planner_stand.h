#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "node/frontend/backdrops/backdrop_planner.h"
#include "node/frontend/backdrops/drawn_backdrop.h"
#include "node/frontend/planner_stand.h"
#include "node/frontend/scene_analyzer.h"

/// A Backdrop Planner whose frames are drawn by the test.
namespace grove::node::testing {

inline constexpr world::ObjectId kHill = 1;
inline constexpr world::ObjectId kFire = 2;
inline constexpr world::ObjectId kTree = 3;  ///< beside the frame

/// Everything near the origin reflects a radiance of 0.1.
inline const world::PointLight kFarLamp{{0.0F, 0.0F, 1000.0F}, world::Vec3(0.1e6F)};

inline std::vector<world::ObjectId> idsOf(const FrameList& list) {
  std::vector<world::ObjectId> ids;
  for (const VisibleObject& object : list.objects) ids.push_back(object.object.id);
  return ids;
}

/// A hill that stands still, a fire that does not, and a tree to the left.
class BackdropPlannerStand : public PlannerStand {
 protected:
  BackdropPlannerStand() {
    const auto add = [&](world::ObjectId id, world::Vec3 centre) {
      layout.objects.push_back(objectOf(id, {centre - 0.5F, centre + 0.5F}));
    };
    add(kHill, {0.0F, 1.7F, -20.0F});
    add(kFire, {1.0F, 1.7F, -8.0F});
    add(kTree, {-11.6F, 1.7F, -10.0F});
    stillness = [this](const VisibleObject& object) -> std::optional<float> {
      if (object.object.id == kFire) return std::nullopt;
      return distance;
    };
    camera.width = 640;
    camera.height = 360;
  }

  /// The next frame, a thirtieth of a second later.
  std::shared_ptr<const FrameList> plan() {
    View view;
    view.session = 1;
    view.frame = ++frame;
    view.camera = camera;
    view.time = time += 1.0 / 30.0;
    view.lights = lights;
    auto seen = std::make_shared<FrameList>();
    seen->objects = visibleObjects(layout, view);
    seen->view = std::make_shared<const View>(std::move(view));
    return planned.plan(std::move(seen));
  }
  /// In the Compositor's place: everything is a wall.
  void draw(const FrameList& list) {
    const auto painter = [this](const world::Camera&, world::Vec3) { return Pixel{0xFFFFFFFFU, wall}; };
    const std::shared_ptr<const View>& eye = list.backdropEye();
    backdrops->put(backdropOf(paint(painter, eye->camera, list.area), {eye, list.view->frame, isFinal}));
  }
  /// Draws backdrops for some frames, so that the way of the eye is known.
  void drawSome() {
    for (int i = 0; i < 3; ++i) {
      if (const auto list = plan(); list->drawsBackdrop()) draw(*list);
    }
  }

  float distance = 10.0F;
  float wall = 20.0F;  ///< metres
  bool isFinal = true;
  world::Camera camera;
  std::vector<world::PointLight> lights;
  FrameNumber frame = 0;
  double time = 100.0;
  float factor = 1.0F;
  BackdropPlanner planned{layout, halves, backdrops, [this] { return factor; }};
};

}  // namespace grove::node::testing
