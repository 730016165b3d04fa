#include "objects/lightfield/backend/light_field_model.h"

#include <utility>

#include "objects/lightfield/backend/voxel_shapes.h"

namespace grove::objects::lightfield {
namespace {

const world::Triangles* unlessEmpty(const world::Triangles& triangles) {
  return triangles.indices.empty() ? nullptr : &triangles;
}

}  // namespace

LightFieldModel::LightFieldModel(LightField field, SamplerKind sampler, bool isTile)
    : shown_(std::make_shared<const FieldVersion>(FieldVersion{std::move(field), 0})),
      sampler_(sampler),
      isTile_(isTile),
      bounds_(shown_->field.bounds),
      solid_(woodSurface(shown_->field.voxels)),
      shade_(shadeSurface(shown_->field.voxels)),
      trunkRadius_(trunkRadius(shown_->field.voxels)) {}

std::shared_ptr<const FieldVersion> LightFieldModel::shown() const {
  const std::lock_guard lock(mutex_);
  return shown_;
}

void LightFieldModel::show(LightField finer) {
  auto next = std::make_shared<FieldVersion>();
  next->field = std::move(finer);
  const std::shared_ptr<const FieldVersion> last = shown();  // freed without the lock
  next->number = last->number + 1;
  {
    const std::lock_guard lock(mutex_);
    shown_ = std::move(next);
  }
  const std::lock_guard lock(listenersMutex_);
  for (const auto& report : listeners_) report();
}

std::shared_ptr<const void> LightFieldModel::whenShown(std::function<void()> report) const {
  const std::lock_guard lock(listenersMutex_);
  const auto listener = listeners_.insert(listeners_.end(), std::move(report));
  return {this, [this, listener](const void*) {
            const std::lock_guard ending(listenersMutex_);
            listeners_.erase(listener);
          }};
}

const world::Triangles* LightFieldModel::solid() const { return unlessEmpty(solid_); }

const world::Triangles* LightFieldModel::shade() const { return unlessEmpty(shade_); }

}  // namespace grove::objects::lightfield
