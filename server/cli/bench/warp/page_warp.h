#pragma once

#include <cstdint>
#include <vector>

#include "cli/bench/picture_size.h"
#include "measure/pictures/picture_quality.h"
#include "stream/late_walk/nearness_grid.h"
#include "world/camera.h"

namespace grove::cli {

/// What a page has of a picture.
struct PagePicture {
  measure::Picture colours;  ///< with its border
  const stream::NearnessGrid& grid;
  world::Camera camera;  ///< of the whole picture
};

/// Places of the corners of a window's cells of 16 x 16 pixels in a picture, row by row: pixels of the picture.
struct WarpMesh {
  int across = 0;
  int down = 0;
  std::vector<world::Vec2> places;
};

/// The camera of the window in a picture: its middle without the border, as web/picture/look_geometry.js has it.
[[nodiscard]] world::Camera windowOf(world::Camera picture, int borderPercent);

/// The mesh by which a page moves a picture to the eye of `window`; does what web/picture/warp_mesh.js does, without
/// parts that move by themselves.
[[nodiscard]] WarpMesh warpMesh(const stream::NearnessGrid& grid, const world::Camera& picture,
                                const world::Camera& window);

/// Returns the picture as the page's WebGL shows it on a display of this size, RGBA; the window has the picture's
/// pixels. Pixels beyond the picture repeat its edge, darker than it.
[[nodiscard]] std::vector<std::uint32_t> warpedByPage(const PagePicture& picture, const world::Camera& window,
                                                      const PictureSize& display);

}  // namespace grove::cli
