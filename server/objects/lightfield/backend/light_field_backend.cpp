#include "objects/lightfield/backend/light_field_backend.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "gl/workers.h"
#include "node/prepare_each.h"
#include "objects/lightfield/backend/shader/shader_sampler.h"
#include "objects/lightfield/backend/shadows.h"
#include "objects/lightfield/backend/simd/simd_sampler.h"
#include "objects/lightfield/common/lamps.h"
#include "objects/lightfield/common/object_view.h"
#include "objects/lightfield/common/shared_view.h"
#include "objects/lightfield/file/mapped_file.h"
#include "objects/lightfield/frontend/lamp_light.h"

namespace grove::objects::lightfield {
namespace {

/// A picture takes milliseconds: small batches keep all threads at work on one frame.
constexpr std::size_t kMostAtOnce = 4;

/// From here on it is cheaper to sample one pixel a texel, and to let the frontend enlarge the picture.
constexpr float kLeastMagnification = 1.3F;

/// Of the permitted error: what a near picture may be wrong by on average, where that of a far one is the largest.
constexpr float kNearShare = 0.5F;

/// Of the scene's permitted error, by quality.
constexpr std::array<float, node::kMostQuality + 1> kErrorShares{1.0F, 0.75F, 0.5F};

/// What a picture of a former light field counts as at least; so little that it is replaced when there is time.
constexpr float kOutdatedWrongness = 1.5F;

/// A picture of a former light field that is more wrong than this is no longer mixed into the one that replaces it.
constexpr float kMaxFadingWrongness = 4.0F;

/// Pixels beyond the frame that a near picture has, for a head that turns.
constexpr int kMarginAcross = 64;
constexpr int kMarginDown = 32;

/// What a core samples in a second, shadows and all: 25 to 31 ns a texel were measured on a Xeon with AVX-512, for
/// visitors who walk among trees in the default world.
constexpr double kTexelsPerCoreSecond = 34.0e6;

/// What all visitors' new pictures may take of the machine.
constexpr double kShareOfCores = 1.0 / 4.0;

constexpr float kNever = std::numeric_limits<float>::infinity();

/// Metres a second.
constexpr float kStanding = 0.05F;

/// What covers the rectangle in pixels that are `times` as large.
world::Rect coarser(const world::Rect& rect, float times) {
  const auto down = [&](int at) { return static_cast<int>(std::floor(static_cast<float>(at) / times)); };
  return {down(rect.left) - 1, down(rect.top) - 1, down(rect.right) + 2, down(rect.bottom) + 2};
}

/// Metres. Hardly two visitors are in one cell that is smaller, and one who walks leaves it after two frames; what he
/// sees of the object with a picture of his own is less than all of it.
constexpr float kLeastSharedReach = 0.13F;

/// Where a picture for a visitor who walks is made from, in reaches of his own cell; the first that serves him is
/// taken.
constexpr std::array<float, 3> kStepsAhead{1.8F, 1.2F, 0.6F};

/// Which way the viewer goes, in an object's coordinates; zero if he stands.
world::Vec3 headingOf(const node::View& view, const world::Mat4& toObject) {
  const auto self = std::ranges::find(view.players, view.viewer, &world::Player::id);
  if (self == view.players.end()) return world::Vec3(0.0F);
  const world::Vec3 velocity = glm::mat3(toObject) * self->velocity;
  const float speed = glm::length(velocity);
  return speed > kStanding ? velocity / speed : world::Vec3(0.0F);
}

const LightFieldModel& modelOf(const world::Object& object) {
  return static_cast<const LightFieldModel&>(*object.model);
}

SamplerKind resolved(SamplerKind kind, const gl::Workers& gl) {
  if (kind != SamplerKind::kAuto) return kind;
  return gl.softwareRendered() ? SamplerKind::kSimd : SamplerKind::kGl;
}

std::unique_ptr<Sampler> makeSampler(SamplerKind kind, const node::BackendServices& services) {
  if (kind == SamplerKind::kGl) return std::make_unique<ShaderSampler>(services.gl, services.memory);
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
      sceneError_(cache.mostError),
      mostError_(cache.mostError),
      cache_(cache.mostBytes, services.memory),
      near_(services.memory),
      budget_(texelsPerSecond(executor_.width())),
      sunGrids_(services.memory, "sun grids", "lightfield", pipeline::Work::kAcrossUser) {
  for (const world::Object& object : services.world.objects()) {
    if (object.type != self) continue;
    const LightFieldModel& model = modelOf(object);
    const SamplerKind kind = resolved(model.sampler(), services.gl);
    std::unique_ptr<Sampler>& sampler = samplers_[kind];
    if (!sampler) sampler = makeSampler(kind, services);
    entries_.emplace(object.id,
                     Entry{&model, sampler.get(), object.transform.yaw, glm::inverse(object.transform.matrix()), {}});
  }
  std::vector<const world::Object*> shaded;
  for (const world::Object& object : services.world.objects()) {
    if (object.type == self) shaded.push_back(&object);
  }
  node::prepareEach(services, "shadows on the light fields", shaded.size(), [&](std::size_t i) {
    entries_.at(shaded[i]->id).sun = makeSunGrid(*shaded[i], services.world.geometry().rays());
  });
  std::size_t sunBytes = 0;
  for (const auto& [id, entry] : entries_) sunBytes += pipeline::vectorBytes(entry.sun.sun);
  sunGrids_.set(sunBytes);
}

LightFieldBackend::~LightFieldBackend() = default;

void LightFieldBackend::setQuality(int step) {
  assert(step >= 0 && step <= node::kMostQuality);
  mostError_ = kErrorShares[static_cast<std::size_t>(step)] * sceneError_;
}

double LightFieldBackend::texelsPerSecond(int cores) noexcept { return kShareOfCores * kTexelsPerCoreSecond * cores; }

std::size_t LightFieldBackend::mostAtOnce() const { return kMostAtOnce; }

void LightFieldBackend::answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) {
  for (std::size_t i = 0; i < requests.size(); ++i) payloads[i] = answerOne(requests[i]);
}

node::Payload LightFieldBackend::answerOne(const node::Request& request) {
  const node::VisibleObject& visible = request.visible();
  const auto found = entries_.find(visible.object.id);
  if (found == entries_.end()) return node::Failure{"no such light field: " + visible.object.name};
  const Entry& entry = found->second;
  const std::shared_ptr<const FieldVersion> shown = entry.model->shown();
  const Subject subject{entry, shown->field, shown->number};
  const world::Camera& camera = request.view().camera;
  SharedView::Parts parts{nullptr,
                          {},
                          objectCamera(camera, visible.object.transform),
                          hazeBefore(visible, camera),
                          chooseLamps(request.view().lights, visible.object.bounds, entry.toObject)};
  const float mostError = mostError_;
  if (cache_.mostBytes() > 0) {
    const auto cell = cellOf(subject, parts.camera.eye, camera.focal(), mostError);
    if (cell && cell->reach >= kLeastSharedReach) {
      parts.picture = sharedView(request, subject, *cell, parts.camera.eye, mostError);
      parts.fade = sharedFade(request, subject, parts.camera.eye, mostError);
      return std::make_shared<const SharedView>(std::move(parts));
    }
    timeline_.count("views too near to share");
  }
  const float times = magnification(subject.field, parts.camera);
  if (times > kLeastMagnification || near_.isFading(request.view(), visible.object.id, subject.version)) {
    const NearView near = nearView(request, subject, parts.camera, times, mostError);
    parts.picture = near.picture;
    if (near.from) parts.fade = {near.from, CrossFade::shareAfter(request.view().time - near.since)};
    return std::make_shared<const SharedView>(std::move(parts));
  }
  std::shared_ptr<raster::Image> image = sample(subject, parts.camera, parts.haze, visible.rect);
  LampLight(parts.lamps, parts.camera).addTo(*image);
  return image;
}

std::optional<ViewCell> LightFieldBackend::cellOf(const Subject& subject, world::Vec3 eye, float focal,
                                                  float mostError) {
  auto cell = viewCell(subject.field.geometry, eye, focal, mostError);
  if (cell) cell->id.version = subject.version;
  return cell;
}

std::shared_ptr<const CachedView> LightFieldBackend::sharedView(const node::Request& request, const Subject& subject,
                                                                const ViewCell& cell, world::Vec3 eye,
                                                                float mostError) {
  const node::View& view = request.view();
  const world::ObjectId object = request.visible().object.id;
  const float focal = view.camera.focal();
  const ViewGeometry& geometry = subject.field.geometry;
  const auto show = [&](const char* counter, const CellId& shown, std::shared_ptr<const CachedView> picture) {
    timeline_.count(counter);
    late_.shown(view, object, shown);
    return picture;
  };
  const auto make = [&](const char* counter, const ViewCell& made, const Shot& shot) {
    const pipeline::TimedRun timed(timeline_, "Shared View", pipeline::Work::kAcrossUser, {view.session, view.frame},
                                   "lightfield");
    return show(counter, made.id, cache_.keep({object, made.id}, pictureOf(subject, shot)));
  };
  const auto wrong = [&](world::Vec3 own) { return wrongness(geometry, own, eye, focal, mostError); };
  // Going on with the last picture as long as it serves takes fewer of them than changing it at the border of its cell.
  const std::optional<CellId> lastCell = late_.last(view, object);
  const auto last = lastCell && lastCell->focal == cell.id.focal ? cache_.find({object, *lastCell}) : nullptr;
  float lastWrong = last ? wrong(last->camera().eye) : kNever;
  if (last && lastCell->coarse) lastWrong = std::max(lastWrong, PictureBudget::kCoarseWrongness);
  if (last && lastCell->version != subject.version) lastWrong = std::max(lastWrong, kOutdatedWrongness);
  if (lastWrong <= 1.0F) return show("view cache hits", *lastCell, last);
  const world::Vec3 step = cell.reach * headingOf(view, subject.entry.toObject);
  ViewCell best = cell;
  for (const float steps : kStepsAhead) {
    const auto ahead = cellOf(subject, eye + steps * step, focal, mostError);
    if (!ahead || wrong(ahead->camera.eye) > 1.0F) continue;
    if (auto picture = cache_.find({object, ahead->id})) return show("view cache hits", ahead->id, picture);
    if (best.id == cell.id) best = *ahead;
  }
  if (auto picture = cache_.find({object, cell.id})) return show("view cache hits", cell.id, picture);
  const Shot shot = shotOf(subject, best);
  if (budget_.take(view, shot.texels(), lastWrong)) return make("view cache misses", best, shot);
  if (lastWrong < kNever) return show("views shown late", *lastCell, last);
  best.id.coarse = true;
  if (auto picture = cache_.find({object, best.id})) return show("views shown late", best.id, picture);
  const Shot rough = shot.coarse();
  budget_.owe(view, rough.texels());
  return make("coarse views", best, rough);
}

CrossFade LightFieldBackend::sharedFade(const node::Request& request, const Subject& subject, world::Vec3 eye,
                                        float mostError) {
  const node::View& view = request.view();
  const world::ObjectId object = request.visible().object.id;
  const auto fading = late_.fading(view, object);
  if (!fading) return {};
  auto from = cache_.find({object, fading->from});
  if (!from) return {};
  const float wrong = wrongness(subject.field.geometry, from->camera().eye, eye, view.camera.focal(), mostError);
  if (wrong > kMaxFadingWrongness) return {};
  return {std::move(from), fading->share};
}

NearView LightFieldBackend::nearView(const node::Request& request, const Subject& subject, const ObjectCamera& camera,
                                     float times, float mostError) {
  const node::View& view = request.view();
  const world::ObjectId object = request.visible().object.id;
  const world::Rect& rect = request.visible().rect;
  const world::Rect around{rect.left - kMarginAcross, rect.top - kMarginDown, rect.right + kMarginAcross,
                           rect.bottom + kMarginDown};
  Shot shot{coarser(camera, times), coarser(around, times)};
  if (cache_.mostBytes() == 0) return {.picture = pictureOf(subject, shot)};
  const NearView last = near_.last(view.session, object);
  float wrong = last.picture ? wrongness(last, camera, rect, kNearShare * mostError) : kNever;
  if (last.coarse) wrong = std::max(wrong, PictureBudget::kCoarseWrongness);
  const bool isOutdated = last.picture && last.version != subject.version;
  if (isOutdated) wrong = std::max(wrong, kOutdatedWrongness);
  const bool make = wrong > 1.0F && budget_.take(view, shot.texels(), wrong);
  if (!make && wrong < kNever) {
    timeline_.count(wrong > 1.0F ? "near views shown late" : "near views shown again");
    NearView again = unlessFaded(last, view.time);
    if (again.from != last.from) near_.shown(view.session, object, again);
    return again;
  }
  if (!make) {
    timeline_.count("coarse views");
    shot = shot.coarse();
    budget_.owe(view, shot.texels());
  }
  NearView next = isOutdated ? NearView{.from = last.picture, .since = view.time} : unlessFaded(last, view.time);
  next.picture = pictureOf(subject, shot);
  next.sampled = shot.rect;
  next.roughness = roughness(*next.picture);
  next.coarse = !make;
  next.version = subject.version;
  near_.shown(view.session, object, next);
  return next;
}

LightFieldBackend::Shot LightFieldBackend::Shot::coarse() const {
  return {coarser(camera, PictureBudget::kCoarse), coarser(rect, PictureBudget::kCoarse)};
}

LightFieldBackend::Shot LightFieldBackend::shotOf(const Subject& subject, const ViewCell& cell) {
  const float times = magnification(subject.field, cell.camera);
  const ObjectCamera camera = coarser(cell.camera, times);
  const world::Rect whole = coarser({0, 0, cell.size, cell.size}, times);
  return {camera, boxOf(subject.field.bounds, camera, whole)};
}

std::shared_ptr<const CachedView> LightFieldBackend::pictureOf(const Subject& subject, const Shot& shot) {
  timeline_.count("texels of new views", shot.texels());
  return std::make_shared<const CachedView>(*sample(subject, shot.camera, {}, shot.rect), shot.camera);
}

std::shared_ptr<raster::Image> LightFieldBackend::sample(const Subject& subject, const ObjectCamera& camera,
                                                         const Haze& haze, const world::Rect& rect) {
  const auto& [entry, field, version] = subject;
  const SampleRequest request{&field, field.lightingFor(entry.yaw), levelFor(field, camera), camera, haze};
  std::shared_ptr<raster::Image> image = images_.acquire(rect);
  const std::array<raster::Image*, 1> images{image.get()};
  entry.sampler->render({&request, 1}, images);
  castShadows(entry.sun, camera, *image);
  if (field.mapped != nullptr) field.mapped->tellIfCut();
  return image;
}

}  // namespace grove::objects::lightfield
