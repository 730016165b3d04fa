#include "objects/lightfield/backend/object_pictures.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "gl/renderer_choice.h"
#include "node/backend/drawing_executor.h"
#include "node/backend/prepare/prepare_each.h"
#include "objects/lightfield/backend/shader/shader_sampler.h"
#include "objects/lightfield/backend/simd/simd_sampler.h"
#include "objects/lightfield/backend/surroundings/shadows.h"
#include "objects/lightfield/common/object_view.h"
#include "objects/lightfield/file/mapped_file.h"
#include "raster/soften.h"

namespace grove::objects::lightfield {
namespace {

const LightFieldModel& modelOf(const world::ModelledObject& object) {
  return static_cast<const LightFieldModel&>(*object.model);
}

SamplerKind kindOf(const world::ModelledObject& object, const gl::Workers& gl) {
  return gl::resolved(modelOf(object).sampler(), gl);
}

std::unique_ptr<Sampler> makeSampler(SamplerKind kind, const node::BackendServices& services) {
  if (kind == SamplerKind::kGl) return std::make_unique<ShaderSampler>(services.gl, services.memory);
  return std::make_unique<SimdSampler>();
}

}  // namespace

ObjectPictures::ObjectPictures(const node::BackendServices& services, world::TypeIndex self)
    : executor_(node::drawingExecutor(
          services, self,
          [&](const world::ModelledObject& object) { return kindOf(object, services.gl) == SamplerKind::kGl; })),
      images_(services.images),
      sky_(services.scene.layout.sky),
      nearRenderer_(services.memory),
      sunGrids_(services.memory, "sun grids", "lightfield", pipeline::Work::kAcrossUser) {
  std::vector<const world::ModelledObject*> objects;
  objects.reserve(services.scene.objects.size());
  for (const world::ModelledObject& object : services.scene.objects) {
    if (object.type == self) objects.push_back(&object);
  }
  for (const world::ModelledObject* const object : objects) {
    const LightFieldModel& model = modelOf(*object);
    const SamplerKind kind = kindOf(*object, services.gl);
    std::unique_ptr<Sampler>& sampler = samplers_[kind];
    if (!sampler) sampler = makeSampler(kind, services);
    Rims rims;
    if (model.isTile()) rims = rimsOf(*object, services.scene.layout.objects);
    entries_.emplace(object->id, Entry{&model, sampler.get(), object->bounds, object->transform, {}, std::move(rims)});
  }
  node::prepareEach(services, "shadows on the light fields", objects.size(), [&](std::size_t i) {
    entries_.at(objects[i]->id).sun = makeSunGrid(*objects[i], sky_.sun, services.geometry.rays());
  });
  std::size_t sunBytes = 0;
  for (const auto& [id, entry] : entries_) sunBytes += pipeline::vectorBytes(entry.sun.sun);
  sunGrids_.set(sunBytes);
}

ObjectPictures::~ObjectPictures() = default;

Shot ObjectPictures::shotOf(const LightField& field, const ViewCell& cell) {
  const float times = magnification(field.geometry, field.size, cell.camera);
  const Shot whole = Shot{cell.camera, {0, 0, cell.size, cell.size}}.coarser(times);
  return {whole.camera, boxOf(field.bounds, whole.camera, whole.rect)};
}

std::shared_ptr<raster::Image> ObjectPictures::make(const Entry& entry, const LightField& field, const Shot& shot,
                                                    const Haze& haze) {
  const SampleRequest request{&field, field.lightingFor(entry.transform.yaw, sky_.sun), levelFor(field, shot.camera),
                              shot.camera, haze};
  std::shared_ptr<raster::Image> image = images_.acquire(shot.rect);
  const std::array<raster::Image*, 1> images{image.get()};
  entry.sampler->render({&request, 1}, images);
  raster::soften(*image, raster::Softening::kQuarter);
  thinRims(entry.rims, shot.camera, *image);
  castShadows(entry.sun, shot.camera, *image);
  if (field.mapped != nullptr) field.mapped->reportIfCut();
  return image;
}

std::shared_ptr<raster::Image> ObjectPictures::makeNear(const Entry& entry, const LightField& field, const Shot& shot,
                                                        const Haze& haze) {
  std::shared_ptr<raster::Image> image = nearRenderer_.render(
      field.near, field.lightingFor(entry.transform.yaw, sky_.sun), shot.camera, haze, shot.rect, images_);
  castShadows(entry.sun, shot.camera, *image);
  if (field.mapped != nullptr) field.mapped->reportIfCut();
  return image;
}

}  // namespace grove::objects::lightfield
