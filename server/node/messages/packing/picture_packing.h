#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "node/messages/shared_data.h"
#include "raster/image.h"

/// Pictures as bytes, exact: the rectangle, the rows' spans, and colour and depth of those tiles of 16 x 16 pixels
/// where anything shows. What shows nowhere comes back without colour and infinitely far. Any thread.
namespace grove::node {

/// Pixels of the largest picture that travels.
inline constexpr std::size_t kMaxPicturePixels = std::size_t{1} << 23U;

/// Throws PackingError for one that is larger.
[[nodiscard]] PackedBytes packPicture(const raster::Image& picture);

/// The inverse. Throws PackingError, also for a picture with pixels outside of `asked`, the rectangle that was asked
/// for: nobody can be made to hold more than he wanted.
[[nodiscard]] std::shared_ptr<const raster::Image> unpackPicture(std::span<const std::byte> bytes,
                                                                 const world::Rect& asked, raster::ImagePool& images);

}  // namespace grove::node
