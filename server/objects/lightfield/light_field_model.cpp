#include "objects/lightfield/light_field_model.h"

#include <utility>

#include "objects/lightfield/voxel_shapes.h"

namespace grove::objects::lightfield {
namespace {

const world::Triangles* unlessEmpty(const world::Triangles& triangles) {
  return triangles.indices.empty() ? nullptr : &triangles;
}

}  // namespace

LightFieldModel::LightFieldModel(LightField field, SamplerKind sampler)
    : field_(std::move(field)),
      sampler_(sampler),
      solid_(woodSurface(field_.voxels)),
      shade_(shadeSurface(field_.voxels)),
      trunkRadius_(trunkRadius(field_.voxels)) {}

const world::Triangles* LightFieldModel::solid() const { return unlessEmpty(solid_); }

const world::Triangles* LightFieldModel::shade() const { return unlessEmpty(shade_); }

}  // namespace grove::objects::lightfield
