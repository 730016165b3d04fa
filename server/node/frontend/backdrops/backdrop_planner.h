#pragma once

#include <functional>
#include <memory>
#include <set>
#include <vector>

#include "node/frontend/backdrops/backdrop_store.h"
#include "node/frontend/backdrops/eye_motion.h"
#include "node/frontend/visitor_halves.h"
#include "node/messages.h"

namespace grove::node {

/// Decides for each frame of a visitor whether the still objects are drawn, as a backdrop for the next frames, or shown
/// by the last backdrop. When the head turns beyond the border, only the missing part is drawn, from the eye of the
/// backdrop. Objects that move or are near the eye are drawn in every frame. One thread at a time.
class BackdropPlanner {
 public:
  /// Returns the current factor for permitted errors, see errorFactor().
  using ErrorFactor = std::function<float()>;

  /// `layout` outlives it.
  BackdropPlanner(const world::Layout& layout, std::shared_ptr<VisitorHalves> halves,
                  std::shared_ptr<BackdropStore> backdrops, ErrorFactor errorFactor);

  /// Returns the list that a frame draws, from the list of the objects that it sees.
  [[nodiscard]] std::shared_ptr<const FrameList> plan(std::shared_ptr<const FrameList> seen);

  /// A frame is never composited: if it was to draw a backdrop, the next frame draws one.
  void drop(FrameNumber frame);

 private:
  [[nodiscard]] std::shared_ptr<const FrameList> listToWarp(const FrameList& seen) const;
  [[nodiscard]] std::shared_ptr<const FrameList> listToDraw(const FrameList& seen) const;
  /// Null if the last backdrop is not drawn yet, or if it would not serve for long.
  [[nodiscard]] std::shared_ptr<const FrameList> listToExtend(const FrameList& seen) const;
  /// Whether the last backdrop can show the part that a view sees of it.
  [[nodiscard]] bool serves(const View& view) const;
  /// Whether its area contains everything that a camera sees.
  [[nodiscard]] bool reaches(const world::Camera& camera) const;
  /// Vector, in metres, from a frame's eye to the eye of its backdrop. On a busy machine the backdrop is drawn ahead of
  /// a moving visitor, so that it serves before and after the visitor passes there.
  [[nodiscard]] world::Vec3 lead() const;
  [[nodiscard]] std::shared_ptr<const View> withBackdropPose(const std::shared_ptr<const View>& view) const;
  /// Of warps; grows slower than the error factor, because doubled errors show more than they save.
  [[nodiscard]] float permittedError() const;
  /// Seconds for which a backdrop serves whatever its error; more while it is other visitors' turn to draw theirs.
  [[nodiscard]] float minSeconds() const;
  /// Area of a backdrop with the camera `eye` that the frame of `camera` draws.
  [[nodiscard]] world::Rect areaFor(const world::Camera& eye, const world::Camera& camera) const;
  /// Objects in a backdrop's area, with their boxes in it, which may extend beyond it.
  [[nodiscard]] std::vector<VisibleObject> objectsAround(const View& eye, const world::Rect& area) const;
  /// Still objects in each of the parts that a list draws to extend the last backdrop.
  [[nodiscard]] std::vector<VisibleObject> objectsBeyond(const FrameList& list) const;
  /// Makes the list's backdrop the newest.
  void adopt(std::shared_ptr<const FrameList> list);
  [[nodiscard]] bool isStill(const VisibleObject& object, world::Vec3 eye) const;

  const world::Layout& layout_;
  const std::shared_ptr<VisitorHalves> halves_;
  const std::shared_ptr<BackdropStore> backdrops_;
  const ErrorFactor currentFactor_;
  float errorFactor_ = 1.0F;  ///< for this frame
  EyeMotion motion_;
  std::shared_ptr<const FrameList> last_;  ///< the newest list that draws a backdrop; null: none is of use
  std::set<world::ObjectId> held_;         ///< objects that the backdrop of `last_` shows
  int pause_ = 0;                          ///< frames until a backdrop is tried again
};

}  // namespace grove::node
