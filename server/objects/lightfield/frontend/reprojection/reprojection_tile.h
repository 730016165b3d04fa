#pragma once

#include <cstdint>

#include "objects/lightfield/common/cached_view.h"

/// Data of the loops of reproject().
///
/// A texel of the picture at s (both coordinates) with nearness w = 1 / depth is the point c + (C s) / w of the
/// picture's camera with eye c and matrix C of columns perColumn, perRow, corner; a visitor's ray is e + t r. With
/// k = inverse(C) r and m = inverse(C) (e - c), they meet where s = a + b w, for
///     a = (k0, k1) / k2,   b = (m0, m1) - a m2,   and then   t = (1 / w - m2) / k2.
/// a is the position of an infinitely distant point, and b the direction of a pixel's ray through the picture.
namespace grove::objects::lightfield {

/// Rays away from the picture camera's direction hit nothing.
inline constexpr float kMinForward = 1.0e-3F;

/// Maps a visitor's pixels to texels of a view.
struct ViewWarp {
  world::Vec3 k, kPerColumn, kPerRow;
  world::Vec3 m;

  ViewWarp(const CachedView& view, const ObjectCamera& camera);

  /// The b of a given a.
  [[nodiscard]] world::Vec2 way(world::Vec2 a) const { return world::Vec2(m) - a * m.z; }
};

inline constexpr int kTileWidth = 16;
inline constexpr int kTileHeight = 8;
inline constexpr int kTilePixels = kTileWidth * kTileHeight;

/// The pixels of a tile, row by row.
struct alignas(64) WarpTile {
  float a0[kTilePixels];
  float a1[kTilePixels];
  float perForward[kTilePixels];  ///< 1 / k2
  float place[kTilePixels];       ///< the w of a + b w for the colour
  float near[kTilePixels];        ///< 1 / depth in the picture
  std::uint32_t colour[kTilePixels];
  float depth[kTilePixels];
};

}  // namespace grove::objects::lightfield
