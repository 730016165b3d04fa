#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/permitted_error.h"
#include "objects/lightfield/common/view_cell.h"
#include "objects/lightfield/frontend/last_views.h"
#include "objects/lightfield/frontend/recent_cells.h"
#include "objects/lightfield/frontend/sight.h"
#include "pipeline/timeline.h"

namespace grove::objects::lightfield {

/// Chooses one visitor's shared pictures: the last one as long as it is good enough, else one of a cell ahead or of the
/// current cell. While the budget is spent, uses the last one regardless of its error, or if there is none, a coarse
/// one with a sixteenth of the texels. For an object that the visitor has not seen yet, the last one is the best that
/// others had made recently.
class SharedViews {
 public:
  SharedViews(pipeline::Timeline& timeline, std::shared_ptr<RecentCells> recent)
      : timeline_(timeline), recent_(std::move(recent)) {}

  /// The cell of the eye; nothing if it is too near for a shared picture.
  [[nodiscard]] static std::optional<ViewCell> cellOf(const Sight& sight);

  [[nodiscard]] node::Plan begin(const Sight& sight, const ViewCell& cell);
  /// Continues after the reply to a request of begin() or resume().
  [[nodiscard]] node::Plan resume(const Sight& sight, const node::Reply& reply);

  [[nodiscard]] CrossFade fade(world::ObjectId object, double time) const { return last_.fade(object, time); }

 private:
  struct Last {
    CellId cell;
    std::shared_ptr<const CachedView> picture;  ///< null if there is none
    float error = kNever;                       ///< relative to the permitted error; infinite without a picture
  };
  /// The picture of a cell, in a frame with this step of the focal length.
  [[nodiscard]] static Last pictureOf(const Sight& sight, const CellId& cell, std::int32_t focal);
  [[nodiscard]] Last lastOf(const Sight& sight, std::int32_t focal) const;
  [[nodiscard]] Last ofOthers(const Sight& sight, std::int32_t focal) const;
  [[nodiscard]] node::Plan show(const Sight& sight, const char* counter, const CellId& cell,
                                std::shared_ptr<const CachedView> picture);

  pipeline::Timeline& timeline_;
  const std::shared_ptr<RecentCells> recent_;
  LastViews last_;
};

}  // namespace grove::objects::lightfield
