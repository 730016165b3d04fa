#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "node/messages.h"
#include "objects/figure/backend/figure_model.h"

/// Frames in which visitors are seen.
namespace grove::objects::figure {

/// Who stands there.
[[nodiscard]] inline world::Object visitor(world::PlayerId id, world::Vec3 position) {
  world::Object object;
  object.id = world::kFirstPlayerObject + id;
  object.name = "Åsa";
  object.transform.position = position;
  object.bounds = object.transform.apply(FigureModel().bounds());
  return object;
}

/// A frame of 320 x 180 pixels that shows them.
[[nodiscard]] inline std::shared_ptr<node::FrameList> look(const std::vector<world::Object>& visitors,
                                                           std::vector<world::Player> players) {
  auto view = std::make_shared<node::View>();
  view->camera.width = 320;
  view->camera.height = 180;
  view->players = std::move(players);
  auto list = std::make_shared<node::FrameList>();
  list->view = view;
  for (const world::Object& object : visitors) {
    list->objects.push_back({object, view->camera.screenRect(object.bounds),
                             glm::distance(object.bounds.centre(), view->camera.pose.position)});
  }
  return list;
}

}  // namespace grove::objects::figure
