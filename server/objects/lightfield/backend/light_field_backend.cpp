#include "objects/lightfield/backend/light_field_backend.h"

#include <array>
#include <cassert>
#include <set>
#include <utility>

#include "node/load_shedding.h"
#include "objects/lightfield/common/cached_view.h"
#include "objects/lightfield/common/field_info.h"
#include "objects/lightfield/common/keys.h"
#include "objects/lightfield/common/lamps/lamp_light.h"
#include "objects/lightfield/common/layered_haze.h"
#include "objects/lightfield/common/object_view.h"
#include "objects/lightfield/common/permitted_error.h"

namespace grove::objects::lightfield {
namespace {

/// A picture takes milliseconds: small batches keep all threads at work on one frame.
constexpr std::size_t kMaxAtOnce = 4;

/// Shares of the scene's permitted error, by quality.
constexpr std::array<float, node::kMaxQuality + 1> kErrorShares{1.0F, 0.75F, 0.5F};

/// Texels that a core samples per second, including shadows: 25 to 31 ns per texel were measured on a Xeon with
/// AVX-512, for visitors who walk among trees in the default world.
constexpr double kTexelsPerCoreSecond = 34.0e6;

/// Texels that take as long as one of an object's faces, besides those that it covers: 0.1 us.
constexpr std::int64_t kTexelsPerFace = 3;

/// Share of the machine for all visitors' new pictures.
constexpr double kShareOfCores = 1.0 / 4.0;

/// Largest picture of a request.
constexpr std::int64_t kMaxTexels = std::int64_t{1} << 26U;

const node::Failure kNoTime{"no time for a new picture", true};

}  // namespace

LightFieldBackend::LightFieldBackend(const node::BackendServices& services, world::TypeIndex self,
                                     const LightFieldOptions& options)
    : timeline_(services.timeline),
      memory_(services.memory),
      announce_(services.announce),
      options_(options),
      maxError_(options.maxError),
      pictures_(services, self),
      budget_(
          texelsPerSecond(pictures_.executor().width()),
          [&workers = pictures_.executor()] { return node::errorFactor(workers.busyShare()); },
          [&world = services.world] { return world.now(); }) {
  std::set<const LightFieldModel*> models;
  for (const auto& [id, entry] : pictures_.all()) models.insert(entry.model);
  listeners_.reserve(models.size());
  for (const LightFieldModel* const model : models) {
    listeners_.push_back(model->whenShown([this] { announceInfo(); }));
  }
}

LightFieldBackend::~LightFieldBackend() = default;

void LightFieldBackend::setQuality(int step) {
  assert(step >= 0 && step <= node::kMaxQuality);
  maxError_ = kErrorShares[static_cast<std::size_t>(step)] * options_.maxError;
  announceInfo();
}

void LightFieldBackend::announceInfo() {
  const node::Version version = ++infoVersion_;
  for (const auto& [id, entry] : pictures_.all()) announce_({{id, {}}, version});
}

double LightFieldBackend::texelsPerSecond(int cores) noexcept { return kShareOfCores * kTexelsPerCoreSecond * cores; }

std::size_t LightFieldBackend::maxAtOnce() const { return kMaxAtOnce; }

void LightFieldBackend::answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) {
  for (std::size_t i = 0; i < requests.size(); ++i) payloads[i] = answerOne(requests[i]);
}

node::Payload LightFieldBackend::answerOne(const node::Request& request) {
  const ObjectPictures::Entry& entry = pictures_.of(request.object);
  if (request.shared) return request.key.empty() ? info(*entry.model) : sharedPicture(request, entry);
  const bool isForItsFrame = request.key.empty() || request.key == kNearKey;
  return isForItsFrame ? framePicture(request, entry) : ownPicture(request, entry);
}

node::Payload LightFieldBackend::info(const LightFieldModel& model) const {
  // Read before the rest: later changes are announced again.
  const node::Version version = infoVersion_;
  const std::shared_ptr<const FieldVersion> shown = model.shown();
  const FieldInfo::Parts parts{shown->field.geometry, shown->field.size, shown->number, maxError_,
                               !shown->field.near.empty()};
  return std::shared_ptr<const node::SharedData>(std::make_shared<const FieldInfo>(parts, version));
}

bool LightFieldBackend::mayMake(const node::Request& request, std::int64_t texels, bool mustBeMade) {
  if (!mustBeMade) return budget_.take(*request.view, texels, request.urgency);
  budget_.borrow(*request.view, texels);
  return true;
}

node::Payload LightFieldBackend::sharedPicture(const node::Request& request, const ObjectPictures::Entry& entry) {
  const CellId id = cellIdOf(request.key);
  const std::shared_ptr<const FieldVersion> shown = entry.model->shown();
  const LightField& field = shown->field;
  const auto cell = viewCell(field.geometry, id);
  if (!cell || !request.view) return node::Failure{"there is no such picture of a light field"};
  Shot shot = ObjectPictures::shotOf(field, *cell);
  if (id.coarse) shot = shot.coarser(kCoarse);
  if (!mayMake(request, shot.texels(), id.coarse)) return kNoTime;
  const pipeline::TimedRun timed(timeline_, "Shared View", pipeline::Work::kOnDemand, traceTag(request), kTypeName);
  timeline_.count("texels of new views", shot.texels());
  auto view = std::make_shared<CachedView>(*pictures_.make(entry, field, shot, {}), shot.camera);
  view->holdIn(memory_, "shared views", kTypeName, pipeline::Work::kOnDemand);
  return std::shared_ptr<const node::SharedData>(std::move(view));
}

node::Payload LightFieldBackend::ownPicture(const node::Request& request, const ObjectPictures::Entry& entry) {
  const OwnPicture own = ownPictureOf(request.key);
  const Shot shot{own.camera, request.rect};
  if (shot.texels() > kMaxTexels) return node::Failure{"a picture of a light field is too large"};
  const std::shared_ptr<const FieldVersion> shown = entry.model->shown();
  const bool fromFaces = own.faces && !shown->field.near.empty();
  const std::int64_t forFaces = fromFaces ? kTexelsPerFace * std::ssize(shown->field.near.faces) : 0;
  if (!mayMake(request, shot.texels() + forFaces, own.mustBeMade)) return kNoTime;
  timeline_.count("texels of new views", shot.texels());
  const auto image =
      fromFaces ? pictures_.makeNear(entry, shown->field, shot, {}) : pictures_.make(entry, shown->field, shot, {});
  return std::shared_ptr<const raster::Image>(image);
}

node::Payload LightFieldBackend::framePicture(const node::Request& request, const ObjectPictures::Entry& entry) {
  const world::Camera& camera = request.seenBy().camera;
  const Shot shot{objectCamera(camera, entry.transform), request.rect};
  const std::shared_ptr<const FieldVersion> shown = entry.model->shown();
  const Haze haze = hazeBefore(entry.bounds, pictures_.sky(), camera);
  const bool isNear = request.key == kNearKey && !shown->field.near.empty();
  const auto image =
      isNear ? pictures_.makeNear(entry, shown->field, shot, haze) : pictures_.make(entry, shown->field, shot, haze);
  LayeredHaze(entry.bounds, pictures_.sky(), camera).addMistTo(*image);
  const auto lamps = chooseLamps(request.seenBy().lights, entry.bounds, glm::inverse(entry.transform.matrix()));
  LampLight(lamps, shot.camera).addTo(*image);
  return std::shared_ptr<const raster::Image>(image);
}

}  // namespace grove::objects::lightfield
