#pragma once

#include <cstddef>

#include "objects/lightfield/common/shot.h"
#include "objects/lightfield/frontend/near_views.h"
#include "objects/lightfield/frontend/sight.h"
#include "pipeline/timeline.h"

namespace grove::objects::lightfield {

/// Chooses one visitor's own pictures of objects that are too near for shared ones: the last one as long as it is good
/// enough, else a new one. While the budget is spent, uses the last one regardless of its error, or if there is none, a
/// coarse one with a sixteenth of the texels.
class OwnViews {
 public:
  explicit OwnViews(pipeline::Timeline& timeline) : timeline_(timeline) {}

  /// `times`: permitted width of the picture's texels, in pixels.
  [[nodiscard]] node::Plan begin(const Sight& sight, float times);
  /// Requests a picture of the object's faces, one texel per pixel. It costs as much as drawing them for a frame, and
  /// is used while the eye rests.
  [[nodiscard]] node::Plan sharpen(const Sight& sight);
  /// Whether the last picture is one of these and good enough.
  [[nodiscard]] bool isSharp(const Sight& sight);
  /// Continues after the reply to a request of begin(), sharpen() or resume().
  [[nodiscard]] node::Plan resume(const Sight& sight, const node::Reply& reply);

  /// Whether the last picture shows another light field, or its cross-fade is in progress.
  [[nodiscard]] bool isFading(const Sight& sight);
  /// The cross-fade to this picture; none if it is not the last one.
  [[nodiscard]] CrossFade fade(world::ObjectId object, const CachedView& picture, double time);

  [[nodiscard]] std::size_t bytes() const { return near_.bytes(); }

 private:
  [[nodiscard]] float errorOf(const Sight& sight, const NearView& last) const;
  [[nodiscard]] node::Plan showAgain(const Sight& sight, const NearView& last, const char* counter);

  pipeline::Timeline& timeline_;
  NearViews near_;
};

}  // namespace grove::objects::lightfield
