#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "node/backend/prepare/load_scene.h"
#include "node/backend_stand.h"
#include "node/frontend/scene_analyzer.h"
#include "node/frontend/shared/shared_store.h"
#include "objects/lightfield/backend/light_field_backend.h"
#include "objects/lightfield/backend/light_field_backend_type.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/small_field.h"
#include "objects/lightfield/frontend/light_field_frontend.h"
#include "world/scenes/scene_file.h"
#include "world/world.h"

namespace grove::objects::lightfield {

/// What an object is shown with in a frame.
struct Shown {
  node::Payload payload;
  CrossFade fade;
  bool isFinal = true;
};

/// A wood of 25 thickets of ten metres, and visitors who walk about in it: each with a frontend half, all with one
/// shared store and one backend half.
class Wood {
 public:
  Wood(const LightField& field, int visitors) : world_(sceneOf(field)), players_(world_.scene.layout) {
    for (int i = 0; i < visitors; ++i) {
      visitors_.push_back({players_.players().join("visitor", 0.0), std::make_unique<LightFieldFrontend>(tools_, recent_)});
    }
  }

  /// Sets a visitor's controls.
  void steer(std::size_t visitor, node::FrameNumber frame, double now, bool walks) {
    world::Input input;
    input.number = frame;
    input.keys = walks ? world::kForward : 0;
    input.yaw = 0.8F * static_cast<float>(visitor) + (walks ? std::sin(0.5F * static_cast<float>(now)) : 0.0F);
    players_.players().apply(visitors_[visitor].id, input, now);
  }

  /// What a visitor sees in the next frame, of 16:9 and this many lines.
  std::vector<Shown> look(std::size_t visitor, node::FrameNumber frame, double now, bool walks = true, int lines = 180) {
    world::Players& players = players_.players();
    const world::PlayerId id = visitors_[visitor].id;
    steer(visitor, frame, now, walks);
    const auto view = std::make_shared<node::View>();
    view->session = visitor + 1;
    view->frame = frame;
    view->viewer = id;
    view->time = now;
    view->players = players.all(now);
    view->visitors = view->players.size();
    view->camera.pose = players.find(id, now)->pose;
    view->camera.width = lines * 16 / 9;
    view->camera.height = lines;
    std::vector<Shown> shown;
    for (const node::VisibleObject& object : node::visibleObjects(world_.scene.layout, *view)) {
      shown.push_back(show(*visitors_[visitor].half, object, view));
    }
    return shown;
  }

  /// The light field that all show gives way to a finer one.
  void show(const LightField& finer) {
    const std::string file = (folder_ / "thicket.glf").string();
    writeLightField(finer, file);
    static_cast<const LightFieldBackendType&>(*types_.find("lightfield")).show(file, openLightField(file));
  }

  std::int64_t counted(const char* counter) {
    const auto counters = stand_.timeline.counters();
    const auto found = counters.find(counter);
    return found == counters.end() ? 0 : found->second;
  }

 private:
  struct Visitor {
    world::PlayerId id = 0;
    std::unique_ptr<LightFieldFrontend> half;
  };

  node::LoadedScene sceneOf(const LightField& field) {
    const std::string file = (folder_ / "thicket.glf").string();
    writeLightField(field, file);
    types_.add(std::make_unique<LightFieldBackendType>());
    std::string scene = "name = 'a wood'\nspawn = [0, 0, 30]\n";
    for (int i = 0; i < 25; ++i) {
      scene += "[[object]]\ntype = 'lightfield'\nrenderer = 'simd'\nscale = 5\nfile = '" + file + "'\nposition = [" +
               std::to_string(14 * (i % 5 - 2)) + ", 0, " + std::to_string(14 * (i / 5 - 2)) + "]\n";
    }
    return node::loadScene(world::parseScene(scene, "wood.toml"), types_);
  }

  node::BackendServices services() {
    node::BackendServices services = stand_.services(world_);
    services.announce = [this](const node::Announcement& announcement) { store_.announced(announcement); };
    return services;
  }

  node::Payload answer(const node::Request& request) {
    node::Payload payload;
    backend_.answer({&request, 1}, {&payload, 1});
    return payload;
  }

  bool fetch(const node::Request& request) {
    node::Result result;
    result.what = {request.object, request.key};
    result.shared = true;
    result.payload = answer(request);
    const auto* const data = std::get_if<std::shared_ptr<const node::SharedData>>(&result.payload);
    if (data != nullptr) result.version = (*data)->version();
    EXPECT_TRUE(store_.put(result));
    return true;
  }

  Shown show(LightFieldFrontend& half, const node::VisibleObject& object,
             const std::shared_ptr<const node::View>& view) {
    const node::SharedOf shared(store_, object.object.id);
    node::Plan plan = half.plan(object, *view, shared, nullptr);
    while (const auto* const asked = std::get_if<node::Ask>(&plan)) {
      const node::Ask ask = *asked;
      node::Request request;
      request.view = view;
      request.object = object.object.id;
      request.shared = ask.shared;
      request.key = ask.key;
      request.rect = ask.rect;
      request.distance = object.distance;
      request.urgency = ask.urgency;
      node::Payload payload;
      if (ask.shared) {
        store_.get(request, [&](const node::Payload& came) { payload = came; });
      } else {
        payload = answer(request);
      }
      const node::Reply reply{ask, payload};
      plan = half.plan(object, *view, shared, &reply);
    }
    Shown shown{std::get<node::Payload>(plan), {}};
    if (const auto layer = half.layer(object, shown.payload, *view)) shown.isFinal = layer->isFinal();
    if (const auto* const data = std::get_if<std::shared_ptr<const node::SharedData>>(&shown.payload)) {
      shown.fade = half.fade(object.object.id, static_cast<const CachedView&>(**data), view->time);
    }
    return shown;
  }

  TemporaryFolder folder_;
  node::BackendTypes types_;
  tests::BackendWorld world_;
  world::World players_;
  tests::BackendStand stand_;
  node::SharedStore store_{std::size_t{256} << 20U,
                           [this](const node::ToBackend& message) { return fetch(std::get<node::Request>(message)); }};
  LightFieldBackend backend_{services(), 0, {}};
  const std::shared_ptr<RecentCells> recent_ = std::make_shared<RecentCells>();
  node::FrontendTools tools_{stand_.workers, stand_.timeline, stand_.memory, stand_.images, world_.scene.layout.sky};
  std::vector<Visitor> visitors_;
};

}  // namespace grove::objects::lightfield
