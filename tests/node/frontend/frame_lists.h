#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "node/messages.h"

/// Lists of objects as the Scene Analyzer sends them, and payloads that can be told apart.
namespace grove::node::testing {

struct ListOptions {
  double deadline = std::numeric_limits<double>::infinity();
  int width = 320;
};

/// A frame with so many objects, whose ids are 1 and up.
inline std::shared_ptr<const FrameList> listOf(FrameNumber number, std::size_t objects,
                                               const ListOptions& options = {}) {
  auto view = std::make_shared<View>();
  view->session = 1;
  view->frame = number;
  view->deadline = options.deadline;
  view->camera.width = options.width;
  view->camera.height = 180;
  auto list = std::make_shared<FrameList>();
  list->view = std::move(view);
  list->objects.resize(objects);
  for (std::size_t i = 0; i < objects; ++i) {
    list->objects[i].object.id = static_cast<world::ObjectId>(i + 1);
    list->objects[i].rect = {0, 0, 8, 8};
  }
  return list;
}

inline Payload failure(std::string reason) { return Failure{std::move(reason)}; }

/// A picture with nothing but its colour.
inline Payload picture(std::uint32_t colour, const world::Rect& rect = {0, 0, 1, 1}) {
  const auto image = raster::ImagePool().acquire(rect);
  std::ranges::fill(image->colour, colour);
  return std::shared_ptr<const raster::Image>(image);
}

/// Of a picture; 0 of anything else.
inline std::uint32_t colourOf(const Payload& payload) {
  const auto* const image = std::get_if<std::shared_ptr<const raster::Image>>(&payload);
  return image != nullptr && *image != nullptr ? (*image)->colour[0] : 0;
}

/// Of a failure; empty for anything else.
inline std::string reasonOf(const Payload& payload) {
  const auto* const failed = std::get_if<Failure>(&payload);
  return failed != nullptr ? failed->reason : "";
}

}  // namespace grove::node::testing
