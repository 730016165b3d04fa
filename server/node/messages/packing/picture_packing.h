#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "node/messages/shared_data.h"
#include "raster/image.h"

/// Pictures as bytes, exact: the rectangle, the rows' spans, and colour and depth of those tiles of 16 x 16 pixels that
/// show anything. Other pixels come back without colour and infinitely far. Any thread.
namespace grove::node {

/// Pixels of the largest picture that can be packed.
inline constexpr std::size_t kMaxPicturePixels = std::size_t{1} << 23U;

/// Throws PackingError for a larger one.
[[nodiscard]] PackedBytes packPicture(const raster::Image& picture);

/// The inverse. Throws PackingError, also for a picture with pixels outside of `asked`, the requested rectangle, so
/// that a peer cannot make this process allocate more than requested.
[[nodiscard]] std::shared_ptr<const raster::Image> unpackPicture(std::span<const std::byte> bytes,
                                                                 const world::Rect& asked, raster::ImagePool& images);

}  // namespace grove::node
