#include "world/rays/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <exception>
#include <mutex>

#include "world/rays/embree_device.h"

namespace grove::world {

struct RayScene::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::atomic<std::int64_t> bytes{0};

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (scene != nullptr) rtcReleaseScene(scene);
    if (device != nullptr) rtcReleaseDevice(device);
  }
};

namespace {

/// Embree's memory monitor: negative `bytes` are freed memory.
bool addBytes(void* sum, ssize_t bytes, bool /*post*/) {
  static_cast<std::atomic<std::int64_t>*>(sum)->fetch_add(bytes, std::memory_order_relaxed);
  return true;
}

}  // namespace

namespace {

/// Embree's progress reports during a build. Its callbacks must not throw, so exceptions are rethrown after the build.
class Build {
 public:
  explicit Build(const std::function<void(float)>& progress) : progress_(progress) {}

  static bool report(void* build, double share) {
    return static_cast<Build*>(build)->report(static_cast<float>(share));
  }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  bool report(float share) noexcept {
    const std::lock_guard lock(mutex_);
    if (thrown_) return false;
    try {
      progress_(share);
      return true;
    } catch (...) {
      thrown_ = std::current_exception();
      return false;
    }
  }

  const std::function<void(float)>& progress_;
  std::mutex mutex_;
  std::exception_ptr thrown_;
};

/// Rejects hits of backs.
void passBacks(const RTCFilterFunctionNArguments* args) {
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] == 0) continue;
    const float towards = RTCHitN_Ng_x(args->hit, args->N, i) * RTCRayN_dir_x(args->ray, args->N, i) +
                          RTCHitN_Ng_y(args->hit, args->N, i) * RTCRayN_dir_y(args->ray, args->N, i) +
                          RTCHitN_Ng_z(args->hit, args->N, i) * RTCRayN_dir_z(args->ray, args->N, i);
    if (towards >= 0.0F) args->valid[i] = 0;
  }
}

}  // namespace

RayScene::RayScene(const Triangles& triangles, const std::function<void(float)>& progress, Backs backs)
    : handles_(std::make_unique<Handles>()) {
  handles_->device = newEmbreeDevice();
  rtcSetDeviceMemoryMonitorFunction(handles_->device, addBytes, &handles_->bytes);
  handles_->scene = rtcNewScene(handles_->device);
  rtcSetSceneFlags(handles_->scene, RTC_SCENE_FLAG_ROBUST);
  if (!triangles.indices.empty()) {
    RTCGeometry geometry = rtcNewGeometry(handles_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcAttachGeometry(handles_->scene, geometry);
    rtcReleaseGeometry(geometry);
    void* positions = requireBuffer(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                            sizeof(Vec3), triangles.positions.size()));
    std::memcpy(positions, triangles.positions.data(), triangles.positions.size() * sizeof(Vec3));
    void* indices = requireBuffer(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                          sizeof(triangles.indices[0]), triangles.indices.size()));
    std::memcpy(indices, triangles.indices.data(), triangles.indices.size() * sizeof(triangles.indices[0]));
    if (backs == Backs::kPassed) rtcSetGeometryIntersectFilterFunction(geometry, passBacks);
    rtcCommitGeometry(geometry);
  }
  Build build(progress);
  if (progress) rtcSetSceneProgressMonitorFunction(handles_->scene, &Build::report, &build);
  rtcCommitScene(handles_->scene);
  rtcSetSceneProgressMonitorFunction(handles_->scene, nullptr, nullptr);
  build.rethrow();
  requireBuilt(handles_->device);
}

RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::size_t RayScene::bytes() const noexcept {
  return static_cast<std::size_t>(std::max<std::int64_t>(0, handles_->bytes.load(std::memory_order_relaxed)));
}

namespace {

RTCRay makeRay(Vec3 origin, Vec3 direction, float near, float far) {
  RTCRay ray{};
  ray.org_x = origin.x;
  ray.org_y = origin.y;
  ray.org_z = origin.z;
  ray.dir_x = direction.x;
  ray.dir_y = direction.y;
  ray.dir_z = direction.z;
  ray.tnear = near;
  ray.tfar = far;
  ray.mask = 0xFFFFFFFFU;
  return ray;
}

}  // namespace

std::optional<RayScene::Hit> RayScene::intersect(Vec3 origin, Vec3 direction, float near, float far) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query{};
  query.ray = makeRay(origin, direction, near, far);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(handles_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return Hit{query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v,
             glm::normalize(Vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z))};
}

bool RayScene::occluded(Vec3 origin, Vec3 direction, float near, float far) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = makeRay(origin, direction, near, far);
  rtcOccluded1(handles_->scene, &context, &ray);
  return ray.tfar < 0.0F;
}

}  // namespace grove::world
