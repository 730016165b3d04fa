#pragma once

#include <memory>
#include <mutex>
#include <set>

#include "node/frontend/frontend_half.h"
#include "objects/lightfield/frontend/eye_rest.h"
#include "objects/lightfield/frontend/own_views.h"
#include "objects/lightfield/frontend/shared_views.h"

namespace grove::objects::lightfield {

/// One visitor's view of all light fields. Distant objects use shared pictures, reprojected by depth to this visitor's
/// eye. Near objects use the visitor's own pictures, reused as long as they are good enough.
class LightFieldFrontend final : public node::FrontendHalf {
 public:
  /// `recent`: of all visitors.
  LightFieldFrontend(const node::FrontendTools& tools, std::shared_ptr<RecentCells> recent);

  [[nodiscard]] node::Plan plan(const node::VisibleObject& object, const node::View& view, const node::SharedOf& shared,
                                const node::Reply* reply) override;
  [[nodiscard]] std::unique_ptr<node::Layer> layer(const node::VisibleObject& object, const node::Payload& payload,
                                                   const node::View& view) override;
  [[nodiscard]] std::optional<float> stillDistance(const node::VisibleObject& object, world::Vec3 eye) const override {
    return object.object.bounds.distance(eye);
  }
  [[nodiscard]] std::size_t bytes() const override { return own_.bytes(); }

  /// The cross-fade of an object's picture in a frame at that time.
  [[nodiscard]] CrossFade fade(world::ObjectId object, const CachedView& picture, double time);

 private:
  [[nodiscard]] node::Plan begin(const Sight& sight);
  [[nodiscard]] node::Plan beginFromViews(const Sight& sight);
  [[nodiscard]] node::Plan resume(const Sight& sight, const node::Reply& reply);
  /// Records whether an object is shown with a picture that should be replaced.
  void remember(world::ObjectId object, bool isProvisional);
  [[nodiscard]] bool isProvisional(world::ObjectId object) const;

  pipeline::Timeline& timeline_;
  const world::Sky& sky_;
  SharedViews shared_;
  OwnViews own_;
  EyeRest rest_;
  mutable std::mutex mutex_;
  std::set<world::ObjectId> provisional_;
};

}  // namespace grove::objects::lightfield
