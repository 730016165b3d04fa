#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>

#include "objects/lightfield/frontend/reprojection/reprojection.h"

namespace grove::objects::lightfield {

/// Mixes two pictures of one object tile by tile during a cross-fade.
class MixedTiles {
 public:
  /// `share`: of the newer picture, 0 to 1.
  explicit MixedTiles(float share);

  /// Receivers for the tiles that reproject() makes of each picture, one after the other with the same rectangle. Where
  /// both are covered, the depth is the newer picture's.
  void addLeaving(const world::Rect& part, const WarpTile& tile);
  void addComing(const world::Rect& part, const WarpTile& tile);

  /// Calls lay(part, colour, depth) for each tile that either picture covers; it may change the colours.
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
