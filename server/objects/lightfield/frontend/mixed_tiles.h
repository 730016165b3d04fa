#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>

#include "objects/lightfield/frontend/reprojection/reprojection.h"

namespace grove::objects::lightfield {

/// Two pictures of one object, tile by tile, while one gives way to the other.
class MixedTiles {
 public:
  /// `share`: of the picture that comes, 0 to 1.
  explicit MixedTiles(float share);

  /// What reproject() hands the tiles of each picture to, in turn, with the same rectangle. Where both show something,
  /// the depth is that of the picture that comes.
  void addLeaving(const world::Rect& part, const WarpTile& tile);
  void addComing(const world::Rect& part, const WarpTile& tile);

  /// Calls lay(part, colour, depth) with each tile that either shows something in; it may change the colours.
  void forEach(const std::function<void(const world::Rect&, std::uint32_t*, const float*)>& lay);

 private:
  struct Mixed {
    world::Rect part;
    std::uint32_t colour[kTilePixels];
    float depth[kTilePixels];
  };
  void add(const world::Rect& part, const WarpTile& tile, std::uint32_t share, std::uint32_t rounding);

  const std::uint32_t share_;                   ///< of 256
  std::map<std::pair<int, int>, Mixed> tiles_;  ///< by top and left
};

}  // namespace grove::objects::lightfield
