#include "objects/lightfield/bake/bake.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <string>
#include <system_error>
#include <vector>

#include "base/error.h"
#include "models/plants/plants.h"
#include "objects/lightfield/bake/bake_key.h"
#include "objects/lightfield/bake/bake_step.h"
#include "objects/lightfield/bake/dense_view.h"
#include "objects/lightfield/bake/light/light_points.h"
#include "objects/lightfield/bake/light/lightings.h"
#include "objects/lightfield/bake/light/surface_light.h"
#include "objects/lightfield/bake/model_rays.h"
#include "objects/lightfield/bake/near/near_surface.h"
#include "objects/lightfield/bake/partial_bake.h"
#include "objects/lightfield/bake/refine.h"
#include "objects/lightfield/bake/view_plan.h"
#include "objects/lightfield/bake/view_renderer.h"
#include "objects/lightfield/bake/voxelize.h"
#include "objects/lightfield/file/light_field_file.h"
#include "objects/lightfield/file/view_packer.h"
#include "pipeline/executor.h"
#include "pipeline/parallel_for.h"
#include "world/camera.h"

namespace grove::bake {

using objects::lightfield::DenseView;
using objects::lightfield::HeldOutView;
using objects::lightfield::kMinSize;
using objects::lightfield::kNoDepth;
using objects::lightfield::LightField;
using objects::lightfield::ObjectCamera;
using objects::lightfield::PackedView;
using objects::lightfield::ViewCamera;
using objects::lightfield::ViewGeometry;
using objects::lightfield::ViewSphere;
using world::Vec3;

namespace {

constexpr int kVoxelsAlongEdge = 64;
constexpr int kVoxelsAlongGroup = 24;
// In texels of a view.
constexpr float kPatch = 2.0F;  // patch of one light point
constexpr LongestEdge kLongest{4.0F, 8.0F};
constexpr float kAwayFromSurface = 0.15F;
constexpr float kThinnest = 4.0F;
// Light of a rough bake.
constexpr float kRoughPatch = 4.0F;
constexpr int kRoughDirections = 16;
constexpr int kRoughSunRays = 2;
constexpr std::size_t kRoughHeldOut = 2;

/// The box that clips rays: flat models get a thickness, because no ray would be inside a plane.
world::Bounds boundsOfView(const world::Triangles& triangles, float texel) {
  world::Bounds bounds = triangles.bounds();
  const Vec3 missing = glm::max(Vec3(kThinnest * texel) - bounds.size(), Vec3(0.0F));
  bounds.low -= 0.5F * missing;
  bounds.high += 0.5F * missing;
  return bounds;
}

int levelsOf(int size) { return std::bit_width(static_cast<unsigned>(size / kMinSize)); }

/// Deletes the partial output of a process that was killed while it wrote the finished file, up to the whole file's
/// size.
void removeLeftovers(const std::filesystem::path& file) {
  const std::string prefix = file.filename().string() + ".partial-";
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
    if (entry.path().filename().string().starts_with(prefix)) std::filesystem::remove(entry.path(), ignored);
  }
}

/// One run of bakeLightField(): the lit and visible model, and the result.
class Job {
 public:
  Job(const models::Model& model, const BakeOptions& options, std::filesystem::path file, const ProgressCall& progress,
      const std::stop_token& stop)
      : options_(options),
        threads_(options.threads > 0 ? options.threads : pipeline::coreCount()),
        file_(std::move(file)),
        progress_(progress),
        stop_(stop),
        sphere_(options.subdivision),
        geometry_(planViews(model.triangles)),
        texel_(2.0F * geometry_.extent / static_cast<float>(options.size)),
        original_(model),
        model_(refined(model, {kLongest.solid * texel_, kLongest.leaves * texel_})),
        textures_(model.textures.begin(), model.textures.end()),
        rays_(model_, textures_),
        lightings_(options.sky, options.lightings),
        shape_{sphere_.views(), options.size, levelsOf(options.size), options.lightings, bakeKeyOf(model, options)},
        partial_(file_.string() + ".partial", shape_) {
    // The lock on the partial bake excludes other writers of this file.
    removeLeftovers(file_);
    if (options.tile) rays_.surround(models::neighbouringTiles());
  }

  [[nodiscard]] std::optional<BakeReport> run();

 private:
  [[nodiscard]] std::vector<Picture> renderHeldOut(const ViewRenderer& renderer,
                                                   const std::vector<ObjectCamera>& cameras,
                                                   ModelRays::Among among) const;
  void checkRoom(const std::vector<Picture>& samples) const;
  void renderViews(const ViewRenderer& renderer, const BakeStep& step);
  [[nodiscard]] LightSettings lightSettings() const;
  void writeFile(std::vector<HeldOutView> heldOut, const NearSurface& near);

  const BakeOptions options_;
  const int threads_;
  const std::filesystem::path file_;
  const ProgressCall& progress_;
  const std::stop_token stop_;
  const ViewSphere sphere_;
  const ViewGeometry geometry_;
  const float texel_;  ///< metres per texel edge in the middle of a view
  const models::Model& original_;
  const models::Model model_;
  const std::vector<TextureSampler> textures_;
  ModelRays rays_;
  const Lightings lightings_;
  const PartialBake::Shape shape_;
  PartialBake partial_;
};

std::vector<Picture> Job::renderHeldOut(const ViewRenderer& renderer, const std::vector<ObjectCamera>& cameras,
                                        ModelRays::Among among) const {
  std::vector<Picture> pictures(cameras.size());
  pipeline::parallelFor(threads_, cameras.size(), [&](std::size_t i) {
    if (!stop_.stop_requested()) pictures[i] = renderer.render(cameras[i], options_.size, among);
  });
  return pictures;
}

/// Estimates the space of the other views from the held-out ones.
void Job::checkRoom(const std::vector<Picture>& samples) const {
  std::uint64_t blocks = 0;
  for (const Picture& picture : samples) {
    DenseView view;
    view.size = picture.size;
    for (const float depth : picture.depth) view.depth.push_back(depth >= world::kInfiniteDepth ? kNoDepth : 0);
    blocks += packView(view, shape_.levels).blockCount();
  }
  const auto views = static_cast<std::uint64_t>(shape_.views);
  const std::uint64_t all = views * PartialBake::bytesOfView(shape_, blocks / samples.size());
  // The partial bake keeps all views until they are copied into the file.
  const std::uint64_t needed = 2 * all - std::min(all, partial_.bytes());
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(file_.string() + ".partial", error);
  if (!error && space.available < needed) {
    throw EnvironmentError("the disk is too full: about " + std::to_string(needed) + " bytes are needed and " +
                               std::to_string(space.available) + " are free",
                           file_.string(), "make room or choose a smaller size or subdivision");
  }
}

void Job::renderViews(const ViewRenderer& renderer, const BakeStep& step) {
  const int takenUp = partial_.views();
  std::mutex mutex;
  std::condition_variable_any appended;
  bool broken = false;
  const auto make = [&](int index) {
    const ViewCamera camera = viewCamera(geometry_, sphere_.direction(index));
    const PackedView view =
        packView(toDense(renderer.render(objectCamera(camera, options_.size), options_.size), camera), shape_.levels);
    // Views are appended in order, so that the file is the same for any number of threads.
    std::unique_lock lock(mutex);
    appended.wait(lock, stop_, [&] { return broken || partial_.views() == index; });
    if (broken || partial_.views() != index) return;
    partial_.append(view);
    step.show(static_cast<float>(partial_.views() - takenUp) / static_cast<float>(shape_.views - takenUp));
    appended.notify_all();
  };
  pipeline::parallelFor(threads_, static_cast<std::size_t>(shape_.views - takenUp), [&](std::size_t i) {
    if (stop_.stop_requested()) return;
    try {
      make(takenUp + static_cast<int>(i));
    } catch (...) {
      // Wakes the threads that wait for the failed view.
      const std::lock_guard lock(mutex);
      broken = true;
      appended.notify_all();
      throw;
    }
  });
}

void Job::writeFile(std::vector<HeldOutView> heldOut, const NearSurface& near) {
  LightField field;
  field.sphere = sphere_;
  field.geometry = geometry_;
  field.bounds = boundsOfView(original_.triangles, texel_);
  field.size = options_.size;
  field.levels = shape_.levels;
  field.sunAzimuth = lightings_.firstAzimuth();
  field.source = original_.name;
  const Voxels voxels = voxelize(original_, options_.group ? kVoxelsAlongGroup : kVoxelsAlongEdge);
  field.voxels = voxels.grid;
  field.voxels.cells = voxels.cells;
  field.heldOut = std::move(heldOut);
  field.near = near.model();
  partial_.fill(field);
  writeLightField(field, file_);
}

LightSettings Job::lightSettings() const {
  LightSettings settings{.threads = threads_, .away = kAwayFromSurface * texel_, .grounded = options_.tile};
  if (options_.rough) {
    settings.directions = kRoughDirections;
    settings.sunRays = kRoughSunRays;
  }
  return settings;
}

std::optional<BakeReport> Job::run() {
  const BakeStep all("preparing", progress_);
  BakeReport report;
  report.triangles = original_.triangles.indices.size();
  report.views = shape_.views;
  report.viewsTakenUp = partial_.views();
  const LightPoints points = options_.rough
                                 ? chooseLightPoints(model_, textures_, kRoughPatch * texel_, PointsOf::kCell)
                                 : chooseLightPoints(model_, textures_, kPatch * texel_, PointsOf::kPiece);
  report.lightPoints = points.points.size();

  const BakeStep lighting("light", progress_);
  const SurfaceLight light = lightSurfaces(
      model_, points, rays_, lightings_, lightSettings(), [&](float share) { lighting.show(share); }, stop_);
  report.lightSeconds = lighting.seconds();
  if (stop_.stop_requested()) return std::nullopt;

  const BakeStep views("views", progress_);
  const ViewRenderer renderer(model_, textures_, rays_, points, light, options_.samples);
  std::vector<ObjectCamera> cameras = planHeldOut(geometry_, options_.subdivision, options_.size);
  // Held-out views are also needed to estimate space; a rough bake needs no more of them.
  if (options_.rough) cameras.resize(kRoughHeldOut);
  const ViewRenderer truth(model_, textures_, rays_, points, light, options_.truthSamples);
  const std::vector<Picture> heldOut = renderHeldOut(truth, cameras, ModelRays::Among::kModel);
  const std::vector<ObjectCamera> seamCameras =
      options_.tile && !options_.rough ? planSeams(geometry_, options_.size) : std::vector<ObjectCamera>();
  const std::vector<Picture> seams = renderHeldOut(truth, seamCameras, ModelRays::Among::kSurroundings);
  if (stop_.stop_requested()) return std::nullopt;
  checkRoom(heldOut);
  renderViews(renderer, views);
  report.viewSeconds = views.seconds();
  if (stop_.stop_requested()) return std::nullopt;

  const BakeStep writing("file", progress_);
  std::vector<HeldOutView> kept;
  const auto keep = [&](const std::vector<ObjectCamera>& from, const std::vector<Picture>& pictures, bool seam) {
    for (std::size_t i = 0; i < from.size(); ++i) {
      kept.push_back({from[i], options_.size, pictures[i].colour.front(), pictures[i].depth, seam});
    }
  };
  keep(cameras, heldOut, false);
  keep(seamCameras, seams, true);
  // A tile has several hundred thousand blades: its triangles cost more than its views, even from near. So do a
  // group's, and nobody comes near it.
  writeFile(std::move(kept), options_.tile || options_.group ? NearSurface() : makeNearSurface(model_, points, light));
  partial_.remove();
  report.bytes = std::filesystem::file_size(file_);
  report.seconds = all.seconds();
  return report;
}

}  // namespace

std::optional<BakeReport> bakeLightField(const models::Model& model, const BakeOptions& options,
                                         const std::filesystem::path& file, const ProgressCall& progress,
                                         const std::stop_token& stop) {
  if (model.triangles.indices.empty()) throw EnvironmentError("has no triangles", model.name, "bake another model");
  return Job(model, options, file, progress, stop).run();
}

}  // namespace grove::bake
