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

/// A value for each side of a rectangle.
struct Sides {
  float left = 0.0F;
  float top = 0.0F;
  float right = 0.0F;
  float bottom = 0.0F;
};

/// Empty texels between an object and an edge of its picture that show that the object ends there.
inline constexpr int kClearTexels = CachedView::kSquare;
/// edgeNearness() where the object ends within the picture.
inline constexpr float kObjectEnds = -1.0F;

/// Largest 1 / depth along each edge of a picture that was made for the pixels `sampled` of its camera.
[[nodiscard]] Sides edgeNearness(const CachedView& picture, const world::Rect& sampled);

/// A visitor's own picture of an object that is too near to share, made for one frame and good for some more.
struct NearView {
  std::shared_ptr<const CachedView> picture = nullptr;
  world::Rect sampled = {};                          ///< pixels of the picture's camera; beyond, nothing is known
  float roughness = 0.0F;                            ///< of the picture
  Sides edges = {};                                  ///< see edgeNearness()
  bool coarse = false;                               ///< of few texels, for want of time
  int version = 0;                                   ///< of the light field that it shows
  std::shared_ptr<const CachedView> from = nullptr;  ///< the last one of a former light field
  double since = 0.0;                                ///< when the first of this light field was shown
};

/// How much neighbouring texels differ in 1 / depth, per metre: the root of the mean square over the picture. An eye
/// that goes d metres aside, or pixels of one metre's distance, uncovers strips beside edges that are about
/// d * roughness wide.
[[nodiscard]] float roughness(const CachedView& picture);

/// How wide the strips are, in times of `errorPixels` pixels of the frame's camera, at which the picture shows the
/// object. Infinite if the picture lacks something in the pixels `rect` of that camera. Assumes that what lies beyond
/// an edge is not nearer than what the edge shows. A head that only turns uncovers nothing.
[[nodiscard]] float reprojectionError(const NearView& view, const ObjectCamera& camera, const world::Rect& rect,
                                      float errorPixels);

/// The picture without the one that it replaced, if that has faded away.
[[nodiscard]] NearView unlessFaded(NearView view, double now);

/// A visitor's last pictures of what is near to him. Keeps the kMax used last. Any thread.
class NearViews {
 public:
  static constexpr std::size_t kMax = 64;

  /// Without a picture if there is none.
  [[nodiscard]] NearView last(world::ObjectId object);
  void shown(world::ObjectId object, NearView view);
  /// Memory that they take.
  [[nodiscard]] std::size_t bytes() const;

 private:
  mutable std::mutex mutex_;
  LruTable<world::ObjectId, NearView> views_;
  std::size_t bytes_ = 0;
};

}  // namespace grove::objects::lightfield
