#include "objects/lightfield/light_field_backend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <latch>
#include <string>
#include <utility>

#include "gl/workers.h"
#include "objects/lightfield/object_view.h"
#include "objects/lightfield/relight.h"
#include "objects/lightfield/shader/shader_sampler.h"
#include "objects/lightfield/shared_view.h"
#include "objects/lightfield/simd/simd_sampler.h"

namespace grove::objects::lightfield {
namespace {

/// A picture takes milliseconds: small batches keep all threads at work on one frame.
constexpr std::size_t kMostAtOnce = 4;

/// From here on it is cheaper to sample one pixel a texel, and to let the frontend enlarge the picture.
constexpr float kLeastMagnification = 1.3F;

/// What covers the rectangle in pixels that are `times` as large.
world::Rect coarser(const world::Rect& rect, float times) {
  const auto down = [&](int at) { return static_cast<int>(std::floor(static_cast<float>(at) / times)); };
  return {down(rect.left) - 1, down(rect.top) - 1, down(rect.right) + 2, down(rect.bottom) + 2};
}

const LightFieldModel& modelOf(const world::Object& object) {
  return static_cast<const LightFieldModel&>(*object.model);
}

SamplerKind resolved(SamplerKind kind, const gl::Workers& gl) {
  if (kind != SamplerKind::kAuto) return kind;
  return gl.softwareRendered() ? SamplerKind::kSimd : SamplerKind::kGl;
}

std::unique_ptr<Sampler> makeSampler(SamplerKind kind, gl::Workers& gl) {
  if (kind == SamplerKind::kGl) return std::make_unique<ShaderSampler>(gl);
  return std::make_unique<SimdSampler>();
}

/// One executor serves all of the type's objects, and GL is bound to threads of its own.
pipeline::Executor& executorOf(const node::BackendServices& services, world::TypeIndex self) {
  const bool anyByGl = std::ranges::any_of(services.world.objects(), [&](const world::Object& object) {
    return object.type == self && resolved(modelOf(object).sampler(), services.gl) == SamplerKind::kGl;
  });
  if (anyByGl) return services.gl;
  return services.workers;
}

}  // namespace

LightFieldBackend::LightFieldBackend(const node::BackendServices& services, world::TypeIndex self,
                                     const ViewCacheOptions& cache)
    : timeline_(services.timeline),
      images_(services.images),
      executor_(executorOf(services, self)),
      mostError_(cache.mostError),
      cache_(cache.mostBytes) {
  for (const world::Object& object : services.world.objects()) {
    if (object.type != self) continue;
    const LightFieldModel& model = modelOf(object);
    const SamplerKind kind = resolved(model.sampler(), services.gl);
    std::unique_ptr<Sampler>& sampler = samplers_[kind];
    if (!sampler) sampler = makeSampler(kind, services.gl);
    entries_.emplace(object.id, Entry{&model.field(),
                                      sampler.get(),
                                      model.field().lightingFor(object.transform.yaw),
                                      glm::inverse(object.transform.matrix()),
                                      {}});
  }
  std::latch left(static_cast<std::ptrdiff_t>(entries_.size()));
  for (const world::Object& object : services.world.objects()) {
    if (object.type != self) continue;
    services.workers.post([&world = services.world, &left, &object, &entry = entries_.at(object.id)] {
      entry.sun = makeSunGrid(object, world.rays());
      left.count_down();
    });
  }
  left.wait();
  if (services.progress) services.progress("shadows on the light fields", 1.0F);
}

LightFieldBackend::~LightFieldBackend() = default;

std::size_t LightFieldBackend::mostAtOnce() const { return kMostAtOnce; }

void LightFieldBackend::answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) {
  for (std::size_t i = 0; i < requests.size(); ++i) payloads[i] = answerOne(requests[i]);
}

node::Payload LightFieldBackend::answerOne(const node::Request& request) {
  const node::VisibleObject& visible = request.visible();
  const auto found = entries_.find(visible.object.id);
  if (found == entries_.end()) return node::Failure{"no such light field: " + visible.object.name};
  const Entry& entry = found->second;
  const world::Camera& camera = request.view().camera;
  SharedView::Parts parts{nullptr, objectCamera(camera, visible.object.transform), hazeBefore(visible, camera),
                          chooseLamps(request.view().lights, visible.object.bounds, entry.toObject)};
  if (cache_.mostBytes() > 0) {
    if (const auto cell = viewCell(entry.field->geometry, parts.camera.eye, camera.focal(), mostError_)) {
      parts.picture = sharedView(request, entry, *cell, parts.camera.eye);
      return std::make_shared<const SharedView>(std::move(parts));
    }
    timeline_.count("views too near to share");
  }
  if (const float times = magnification(*entry.field, parts.camera); times > kLeastMagnification) {
    const ObjectCamera coarse = coarser(parts.camera, times);
    const auto image = sample(entry, coarse, {}, coarser(visible.rect, times));
    parts.picture = std::make_shared<const CachedView>(*image, coarse);
    return std::make_shared<const SharedView>(std::move(parts));
  }
  std::shared_ptr<node::Image> image = sample(entry, parts.camera, parts.haze, visible.rect);
  LampLight(parts.lamps, parts.camera).addTo(*image);
  return image;
}

std::shared_ptr<const CachedView> LightFieldBackend::sharedView(const node::Request& request, const Entry& entry,
                                                                const ViewCell& cell, world::Vec3 eye) {
  const world::ObjectId object = request.visible().object.id;
  const ViewKey key{object, cell.id};
  std::shared_ptr<const CachedView> picture = cache_.find(key);
  if (picture) {
    timeline_.count("view cache hits");
  } else if ((picture = late_.lateView(request.view(), object, cell, eye))) {
    timeline_.count("views shown late");
    return picture;
  } else {
    timeline_.count("view cache misses");
    picture = cache_.keep(key, pictureOf(entry, cell));
  }
  late_.shown(request.view(), object, picture);
  return picture;
}

std::shared_ptr<const CachedView> LightFieldBackend::pictureOf(const Entry& entry, const ViewCell& cell) {
  const float times = magnification(*entry.field, cell.camera);
  const ObjectCamera camera = coarser(cell.camera, times);
  const world::Rect whole = coarser({0, 0, cell.size, cell.size}, times);
  const auto image = sample(entry, camera, {}, boxOf(entry.field->bounds, camera, whole));
  return std::make_shared<const CachedView>(*image, camera);
}

std::shared_ptr<node::Image> LightFieldBackend::sample(const Entry& entry, const ObjectCamera& camera, const Haze& haze,
                                                       const world::Rect& rect) {
  const SampleRequest request{entry.field, entry.lighting, levelFor(*entry.field, camera), camera, haze};
  std::shared_ptr<node::Image> image = images_.acquire(rect);
  const std::array<node::Image*, 1> images{image.get()};
  entry.sampler->render({&request, 1}, images);
  castShadows(entry.sun, camera, *image);
  return image;
}

}  // namespace grove::objects::lightfield
