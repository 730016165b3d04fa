#pragma once

#include <memory>
#include <optional>

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/view_cell.h"
#include "objects/lightfield/frontend/last_views.h"
#include "objects/lightfield/frontend/sight.h"
#include "pipeline/timeline.h"

namespace grove::objects::lightfield {

/// Chooses for one visitor which of the pictures that all share he is shown: the last one as long as it serves, else
/// that of a cell on his way or of his own. While there is no time for new ones the last is shown however large its
/// error is, or if there is none, one with a sixteenth of the texels.
class SharedViews {
 public:
  explicit SharedViews(pipeline::Timeline& timeline) : timeline_(timeline) {}

  /// The cell of the eye; nothing if it is too near to share a picture.
  [[nodiscard]] static std::optional<ViewCell> cellOf(const Sight& sight);

  [[nodiscard]] node::Plan begin(const Sight& sight, const ViewCell& cell);
  /// After what begin() or this asked for.
  [[nodiscard]] node::Plan resume(const Sight& sight, const node::Reply& reply);

  [[nodiscard]] CrossFade fade(world::ObjectId object, double time) const { return last_.fade(object, time); }

 private:
  struct Last {
    CellId cell;
    std::shared_ptr<const CachedView> picture;  ///< null if there is none
    float error = 0.0F;                         ///< in times of what is permitted; infinite if there is none
  };
  [[nodiscard]] Last lastOf(const Sight& sight, std::int32_t focal) const;
  [[nodiscard]] node::Plan show(const Sight& sight, const char* counter, const CellId& cell,
                                std::shared_ptr<const CachedView> picture);

  pipeline::Timeline& timeline_;
  LastViews last_;
};

}  // namespace grove::objects::lightfield
