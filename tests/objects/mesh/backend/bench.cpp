#include "objects/mesh/backend/bench.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <future>
#include <utility>

namespace grove::objects::mesh {

world::Camera smallCamera() {
  world::Camera camera;
  camera.width = 320;
  camera.height = 180;
  return camera;
}

int difference(std::uint32_t a, std::uint32_t b) {
  int max = 0;
  for (const unsigned shift : {0U, 8U, 16U, 24U}) {
    max = std::max(max, std::abs(static_cast<int>((a >> shift) & 0xFFU) - static_cast<int>((b >> shift) & 0xFFU)));
  }
  return max;
}

world::ModelledObject makeObject(world::ObjectId id, raster::Surface surface, raster::RendererKind renderer,
                                 world::Vec3 position) {
  world::ModelledObject object;
  object.id = id;
  object.name = "object " + std::to_string(id);
  object.transform.position = position;
  object.model = std::make_shared<MeshModel>(std::move(surface), renderer);
  object.bounds = object.transform.apply(object.model->bounds());
  return object;
}

std::shared_ptr<node::FrameList> look(const world::Camera& camera, const std::vector<world::Object>& objects) {
  auto view = std::make_shared<node::View>();
  view->camera = camera;
  auto list = std::make_shared<node::FrameList>();
  list->view = view;
  for (const world::Object& object : objects) {
    list->objects.push_back(
        {object, camera.screenRect(object.bounds), glm::distance(object.bounds.centre(), camera.pose.position)});
  }
  return list;
}

std::vector<node::Request> requestsFor(const std::vector<Asked>& asked) {
  std::vector<node::Request> requests;
  requests.reserve(asked.size());
  for (const auto& [list, slot] : asked) requests.push_back(tests::pictureRequest(*list, slot));
  return requests;
}

std::vector<node::Payload> ask(node::BackendHalf& half, const std::vector<Asked>& asked) {
  return ask(half, requestsFor(asked));
}

std::vector<node::Payload> ask(node::BackendHalf& half, const std::vector<node::Request>& requests) {
  std::vector<node::Payload> payloads(requests.size());
  std::promise<void> done;
  half.executor().post([&] {
    try {
      half.answer(requests, payloads);
      done.set_value();
    } catch (...) {
      done.set_exception(std::current_exception());
    }
  });
  done.get_future().get();
  return payloads;
}

std::shared_ptr<const raster::Image> imageOf(const node::Payload& payload) {
  const auto* image = std::get_if<std::shared_ptr<const raster::Image>>(&payload);
  EXPECT_NE(image, nullptr);
  return image == nullptr || *image == nullptr ? nullptr : withoutSpans(**image);
}

std::shared_ptr<const raster::Image> withoutSpans(const raster::Image& image) {
  raster::ImagePool pool;
  const std::shared_ptr<raster::Image> whole = pool.acquire(image.rect);
  std::ranges::fill(whole->colour, 0U);
  std::ranges::fill(whole->depth, world::kInfiniteDepth);
  for (int row = 0; row < image.height(); ++row) {
    const raster::Span span = image.span(row);
    EXPECT_GE(span.begin, 0);
    EXPECT_LE(span.end, image.width());
    for (int x = span.begin; x < span.end; ++x) {
      whole->colourRow(row)[x] = image.colourRow(row)[x];
      whole->depthRow(row)[x] = image.depthRow(row)[x];
    }
  }
  return whole;
}

}  // namespace grove::objects::mesh
