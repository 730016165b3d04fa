#pragma once

#include <map>
#include <memory>

#include "node/backend/backend_services.h"
#include "objects/lightfield/backend/light_field_model.h"
#include "objects/lightfield/backend/near/near_renderer.h"
#include "objects/lightfield/backend/sampler.h"
#include "objects/lightfield/backend/surroundings/rims.h"
#include "objects/lightfield/backend/surroundings/sun_grid.h"
#include "objects/lightfield/common/shot.h"
#include "objects/lightfield/common/view_cell.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// Makes pictures of all light-field objects as they stand in the world: with its shadows and, if requested, with the
/// haze in front of them. Any thread, on executor().
class ObjectPictures {
 public:
  /// Computes the shadows on its objects on the services' workers and waits for them; do not call it on one of them.
  ObjectPictures(const node::BackendServices& services, world::TypeIndex self);
  ~ObjectPictures();
  ObjectPictures(const ObjectPictures&) = delete;
  ObjectPictures& operator=(const ObjectPictures&) = delete;

  /// The GL workers if GL samples any object, else the shared workers.
  [[nodiscard]] pipeline::Executor& executor() const noexcept { return executor_; }

  /// One object at its place in the world.
  struct Entry {
    const LightFieldModel* model = nullptr;
    Sampler* sampler = nullptr;
    world::Bounds bounds;  ///< in the world
    world::Transform transform;
    SunGrid sun;
    Rims rims;
  };
  /// Throws std::out_of_range for an unknown object.
  [[nodiscard]] const Entry& of(world::ObjectId object) const { return entries_.at(object); }
  [[nodiscard]] const world::Sky& sky() const noexcept { return sky_; }
  [[nodiscard]] const std::map<world::ObjectId, Entry>& all() const noexcept { return entries_; }

  /// Makes the shared picture of a cell.
  [[nodiscard]] static Shot shotOf(const LightField& field, const ViewCell& cell);

  [[nodiscard]] std::shared_ptr<raster::Image> make(const Entry& entry, const LightField& field, const Shot& shot,
                                                    const Haze& haze);
  /// The same from the field's near model, which must not be empty. The image covers only what the object may touch.
  [[nodiscard]] std::shared_ptr<raster::Image> makeNear(const Entry& entry, const LightField& field, const Shot& shot,
                                                        const Haze& haze);

 private:
  pipeline::Executor& executor_;
  raster::ImagePool& images_;
  const world::Sky& sky_;
  NearRenderer nearRenderer_;
  std::map<SamplerKind, std::unique_ptr<Sampler>> samplers_;
  std::map<world::ObjectId, Entry> entries_;
  pipeline::HeldMemory sunGrids_;
};

}  // namespace grove::objects::lightfield
