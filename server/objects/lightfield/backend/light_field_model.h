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

/// What computes the pictures: `renderer = "auto" | "gl" | "simd"`.
enum class SamplerKind {
  kAuto,  ///< GL on a GPU, SIMD where GL is software
  kGl,
  kSimd,
};

/// A light field that a model showed or shows; a later one is finer. Immutable.
struct FieldVersion {
  LightField field;
  int number = 0;  ///< from 0
};

/// A light field and what its voxels are to the world; one for all objects of the scene that show the same file. The
/// light field may give way to a finer one of the same thing while the world lives; the rest stays. Any thread.
class LightFieldModel final : public world::Model {
 public:
  LightFieldModel(LightField field, SamplerKind sampler);

  [[nodiscard]] world::Bounds bounds() const override { return bounds_; }
  [[nodiscard]] const world::Triangles* solid() const override;
  [[nodiscard]] const world::Triangles* shade() const override;
  [[nodiscard]] std::optional<float> obstacleRadius() const override { return trunkRadius_; }
  [[nodiscard]] std::size_t bytes() const override { return shown()->field.bytes + solid_.bytes() + shade_.bytes(); }

  /// The newest one, for as long as it is held.
  [[nodiscard]] std::shared_ptr<const FieldVersion> shown() const;
  /// From now on this one, of the same model in the same place. Pictures that are being made of the last one still are.
  void show(LightField finer);
  /// Calls `report` each time that it shows another one, until the token that this returns is gone.
  [[nodiscard]] std::shared_ptr<const void> whenShown(std::function<void()> report) const;
  [[nodiscard]] SamplerKind sampler() const noexcept { return sampler_; }

 private:
  mutable std::mutex mutex_;
  std::shared_ptr<const FieldVersion> shown_;  ///< under mutex_
  mutable std::mutex listenersMutex_;
  mutable std::list<std::function<void()>> listeners_;
  const SamplerKind sampler_;
  const world::Bounds bounds_;
  const world::Triangles solid_;
  const world::Triangles shade_;
  const std::optional<float> trunkRadius_;
};

}  // namespace grove::objects::lightfield
