#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>

#include "objects/lightfield/format/light_field.h"
#include "world/object.h"

namespace grove::objects::lightfield {

/// The renderer of the pictures: `renderer = "auto" | "gl" | "simd"`.
enum class SamplerKind {
  kAuto,  ///< GL on a GPU, SIMD where GL is software
  kGl,
  kSimd,
};

/// A light field that a model shows or showed; later versions are finer. Immutable.
struct FieldVersion {
  LightField field;
  int number = 0;  ///< from 0
};

/// A light field and the shapes of its voxels, shared by all objects of the scene with the same file. A finer light
/// field of the same thing may replace it in a running world; the shapes stay. Any thread.
class LightFieldModel final : public world::Model {
 public:
  /// `isTile`: see models::isTile().
  LightFieldModel(LightField field, SamplerKind sampler, bool isTile);

  [[nodiscard]] world::Bounds bounds() const override { return bounds_; }
  [[nodiscard]] const world::Triangles* solid() const override;
  [[nodiscard]] const world::Triangles* shade() const override;
  [[nodiscard]] std::optional<float> obstacleRadius() const override { return trunkRadius_; }
  [[nodiscard]] std::size_t bytes() const override { return shown()->field.bytes + solid_.bytes() + shade_.bytes(); }

  /// The newest version; it stays valid as long as the pointer is held.
  [[nodiscard]] std::shared_ptr<const FieldVersion> shown() const;
  /// Shows this light field from now on; it has the same model at the same place. Pictures in progress keep the old
  /// one.
  void show(LightField finer);
  /// Calls `report` after each change of the light field until the returned token is destroyed.
  [[nodiscard]] std::shared_ptr<const void> whenShown(std::function<void()> report) const;
  [[nodiscard]] SamplerKind sampler() const noexcept { return sampler_; }
  [[nodiscard]] bool isTile() const noexcept { return isTile_; }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const FieldVersion> shown_;  ///< guarded by mutex_
  mutable std::mutex listenersMutex_;
  mutable std::list<std::function<void()>> listeners_;
  const SamplerKind sampler_;
  const bool isTile_;
  const world::Bounds bounds_;
  const world::Triangles solid_;
  const world::Triangles shade_;
  const std::optional<float> trunkRadius_;
};

}  // namespace grove::objects::lightfield
