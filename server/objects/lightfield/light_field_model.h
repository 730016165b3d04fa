#pragma once

#include <memory>
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

/// A light field and what its voxels are to the world; one for all objects of the scene that show the same file.
class LightFieldModel final : public world::Model {
 public:
  LightFieldModel(LightField field, SamplerKind sampler);

  [[nodiscard]] world::Bounds bounds() const override { return field_.bounds; }
  [[nodiscard]] const world::Triangles* solid() const override;
  [[nodiscard]] const world::Triangles* shade() const override;
  [[nodiscard]] std::optional<float> obstacleRadius() const override { return trunkRadius_; }
  [[nodiscard]] std::size_t bytes() const override { return field_.bytes + solid_.bytes() + shade_.bytes(); }

  [[nodiscard]] const LightField& field() const noexcept { return field_; }
  [[nodiscard]] SamplerKind sampler() const noexcept { return sampler_; }

 private:
  const LightField field_;
  const SamplerKind sampler_;
  const world::Triangles solid_;
  const world::Triangles shade_;
  const std::optional<float> trunkRadius_;
};

}  // namespace grove::objects::lightfield
