#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>

#include "base/lru_table.h"
#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/cross_fade.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// One value per side of a rectangle.
struct Sides {
  float left = 0.0F;
  float top = 0.0F;
  float right = 0.0F;
  float bottom = 0.0F;
};

/// Empty texels between an object and its picture's edge that prove that the object ends there.
inline constexpr int kClearTexels = CachedView::kSquare;
/// edgeNearness() where the object ends within the picture.
inline constexpr float kObjectEnds = -1.0F;

/// Max of 1 / depth along each edge of a picture of the pixels `sampled` of its camera.
[[nodiscard]] Sides edgeNearness(const CachedView& picture, const world::Rect& sampled);

/// A visitor's own picture of an object that is too near for a shared one; made for one frame and reused in the next.
struct NearView {
  std::shared_ptr<const CachedView> picture = nullptr;
  world::Rect sampled = {};                          ///< pixels of the picture's camera; unknown outside
  float roughness = 0.0F;                            ///< of the picture
  Sides edges = {};                                  ///< see edgeNearness()
  bool coarse = false;                               ///< made with few texels because the budget was spent
  bool sharp = false;                                ///< made from the object's faces, a texel per pixel
  int version = 0;                                   ///< of its light field
  std::shared_ptr<const CachedView> from = nullptr;  ///< last picture of a former light field
  double since = 0.0;                                ///< when the first picture of this light field was shown
};

/// Variation of 1 / depth between adjacent texels, per metre: the root mean square over the picture. An eye that moves
/// d metres sideways uncovers strips beside edges that are about d * roughness wide, in units of pixels at one metre's
/// distance.
[[nodiscard]] float roughness(const CachedView& picture);

/// Width of the strips relative to `errorPixels` pixels of the frame's camera. Infinite if the picture lacks a part of
/// the pixels `rect` of that camera. Assumes that the unknown part beyond an edge is not nearer than the edge. Turning
/// the head uncovers nothing.
[[nodiscard]] float reprojectionError(const NearView& view, const ObjectCamera& camera, const world::Rect& rect,
                                      float errorPixels);

/// The view without the picture that it replaced, if that has faded out.
[[nodiscard]] NearView unlessFaded(NearView view, double now);

/// A visitor's last pictures of near objects. Keeps the kMax most recently used. Any thread.
class NearViews {
 public:
  static constexpr std::size_t kMax = 64;

  /// The result has no picture if there is none.
  [[nodiscard]] NearView last(world::ObjectId object);
  void shown(world::ObjectId object, NearView view);
  /// Memory use.
  [[nodiscard]] std::size_t bytes() const;

 private:
  mutable std::mutex mutex_;
  LruTable<world::ObjectId, NearView> views_;
  std::size_t bytes_ = 0;
};

}  // namespace grove::objects::lightfield
