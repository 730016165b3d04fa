#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>

#include "node/object_type.h"
#include "objects/lightfield/backend/light_field_model.h"
#include "objects/lightfield/backend/near_views.h"
#include "objects/lightfield/backend/picture_budget.h"
#include "objects/lightfield/backend/sampler.h"
#include "objects/lightfield/backend/sun_grid.h"
#include "objects/lightfield/backend/view_cache.h"
#include "objects/lightfield/backend/view_cache_options.h"
#include "objects/lightfield/frontend/late_views.h"

namespace grove::objects::lightfield {

/// The rendering node of all light fields. What is far enough is answered with a picture from the shared view cache,
/// which the frontend reprojects; what is near, with a picture of this visitor's own, and with that again as long as it
/// serves. While there is no time for new pictures the last one is shown however wrong it is, or if there is none, one
/// with a sixteenth of the texels.
class LightFieldBackend final : public node::BackendHalf {
 public:
  /// Finds the shadows on its objects on the services' workers and waits for them, so not on one of those.
  LightFieldBackend(const node::BackendServices& services, world::TypeIndex self, const ViewCacheOptions& cache);
  ~LightFieldBackend() override;

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kRendering; }
  /// The GL workers if any object is sampled by GL, else the workers of everything.
  [[nodiscard]] pipeline::Executor& executor() override { return executor_; }
  [[nodiscard]] int concurrency() const override { return executor_.width(); }
  [[nodiscard]] std::size_t mostAtOnce() const override;
  void forget(node::SessionId session) override { near_.forget(session); }
  /// Each step permits pictures less error. Those of other steps are shown on as long as they serve.
  void setQuality(int step) override;
  /// On the executor; safe to call from several of its threads at once.
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override;

  /// What the new pictures of all visitors together may have where so many cores make them.
  [[nodiscard]] static double texelsPerSecond(int cores) noexcept;

 private:
  /// A picture to make.
  struct Shot {
    ObjectCamera camera;
    world::Rect rect;
    [[nodiscard]] std::int64_t texels() const { return std::int64_t{rect.width()} * rect.height(); }
    [[nodiscard]] Shot coarse() const;
  };
  /// One object of the world, as it stands there.
  struct Entry {
    const LightFieldModel* model = nullptr;
    Sampler* sampler = nullptr;
    float yaw = 0.0F;
    world::Mat4 toObject{1.0F};
    SunGrid sun;
  };
  /// An object with the light field that it has for one request.
  struct Subject {
    const Entry& entry;
    const LightField& field;
    int version = 0;
  };
  [[nodiscard]] node::Payload answerOne(const node::Request& request);
  [[nodiscard]] static std::optional<ViewCell> cellOf(const Subject& subject, world::Vec3 eye, float focal,
                                                      float mostError);
  [[nodiscard]] std::shared_ptr<const CachedView> sharedView(const node::Request& request, const Subject& subject,
                                                             const ViewCell& cell, world::Vec3 eye, float mostError);
  /// Beside the shared view of this frame.
  [[nodiscard]] CrossFade sharedFade(const node::Request& request, const Subject& subject, world::Vec3 eye,
                                     float mostError);
  [[nodiscard]] NearView nearView(const node::Request& request, const Subject& subject, const ObjectCamera& camera,
                                  float times, float mostError);
  [[nodiscard]] static Shot shotOf(const Subject& subject, const ViewCell& cell);
  [[nodiscard]] std::shared_ptr<const CachedView> pictureOf(const Subject& subject, const Shot& shot);
  [[nodiscard]] std::shared_ptr<raster::Image> sample(const Subject& subject, const ObjectCamera& camera,
                                                      const Haze& haze, const world::Rect& rect);

  pipeline::Timeline& timeline_;
  raster::ImagePool& images_;
  pipeline::Executor& executor_;
  const float sceneError_;  ///< pixels, at quality 0
  std::atomic<float> mostError_;
  ViewCache cache_;
  LateViews late_;
  NearViews near_;
  PictureBudget budget_;
  std::map<SamplerKind, std::unique_ptr<Sampler>> samplers_;
  std::map<world::ObjectId, Entry> entries_;
  pipeline::HeldMemory sunGrids_;
};

}  // namespace grove::objects::lightfield
