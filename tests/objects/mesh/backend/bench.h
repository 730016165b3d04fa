#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "node/backend/backend_half.h"
#include "node/backend_stand.h"
#include "objects/mesh/backend/mesh_model.h"

namespace grove::objects::mesh {

inline constexpr std::array kRenderers = {raster::RendererKind::kGl, raster::RendererKind::kSimd,
                                          raster::RendererKind::kEmbree};

/// 320 x 180 pixels.
[[nodiscard]] world::Camera smallCamera();

/// Largest difference of a channel.
[[nodiscard]] int difference(std::uint32_t a, std::uint32_t b);

[[nodiscard]] world::ModelledObject makeObject(world::ObjectId id, raster::Surface surface,
                                               raster::RendererKind renderer, world::Vec3 position);

[[nodiscard]] std::shared_ptr<node::FrameList> look(const world::Camera& camera,
                                                    const std::vector<world::Object>& objects);

/// An object of a frame that is asked for.
struct Asked {
  std::shared_ptr<node::FrameList> list;
  std::uint32_t slot = 0;
};
[[nodiscard]] std::vector<node::Request> requestsFor(const std::vector<Asked>& asked);

/// Asks the half on its own executor, one batch for all requests.
[[nodiscard]] std::vector<node::Payload> ask(node::BackendHalf& half, const std::vector<node::Request>& requests);
[[nodiscard]] std::vector<node::Payload> ask(node::BackendHalf& half, const std::vector<Asked>& asked);

/// A copy that has what the spans leave out, as nothing.
[[nodiscard]] std::shared_ptr<const raster::Image> withoutSpans(const raster::Image& image);

/// The same of an answer.
[[nodiscard]] std::shared_ptr<const raster::Image> imageOf(const node::Payload& payload);

}  // namespace grove::objects::mesh
