#pragma once

#include <cstddef>

#include "objects/lightfield/common/shot.h"
#include "objects/lightfield/frontend/near_views.h"
#include "objects/lightfield/frontend/sight.h"
#include "pipeline/timeline.h"

namespace grove::objects::lightfield {

/// Chooses for one visitor which of his own pictures he is shown of what is too near to share one: the last as long as
/// it serves, else a new one. While there is no time for new ones the last is shown however large its error is, or if
/// there is none, one with a sixteenth of the texels.
class OwnViews {
 public:
  explicit OwnViews(pipeline::Timeline& timeline) : timeline_(timeline) {}

  /// `times`: how wide a texel of the picture may be, in pixels.
  [[nodiscard]] node::Plan begin(const Sight& sight, float times);
  /// After what begin() or this asked for.
  [[nodiscard]] node::Plan resume(const Sight& sight, const node::Reply& reply);

  /// Whether the last one shows another light field, or was the first of this one a moment ago.
  [[nodiscard]] bool isFading(const Sight& sight);
  /// What gives way to this picture; nothing if it is not the last one.
  [[nodiscard]] CrossFade fade(world::ObjectId object, const CachedView& picture, double time);

  [[nodiscard]] std::size_t bytes() const { return near_.bytes(); }

 private:
  [[nodiscard]] float errorOf(const Sight& sight, const NearView& last) const;
  [[nodiscard]] node::Plan showAgain(const Sight& sight, const NearView& last, const char* counter);

  pipeline::Timeline& timeline_;
  NearViews near_;
};

}  // namespace grove::objects::lightfield
