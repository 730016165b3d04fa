#include "world/rays/ray_scene.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <exception>
#include <glm/gtc/matrix_inverse.hpp>
#include <map>
#include <mutex>
#include <vector>

#include "world/rays/embree_device.h"

namespace grove::world {

struct RayScene::Handles {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::atomic<std::int64_t> bytes{0};
  std::vector<glm::mat3> normalsToWorld;  ///< of each place

  Handles();
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

/// Adds triangles to a scene.
RTCGeometry attach(RTCDevice device, RTCScene scene, const Triangles& triangles) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  void* positions = requireBuffer(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                          sizeof(Vec3), triangles.positions.size()));
  std::memcpy(positions, triangles.positions.data(), triangles.positions.size() * sizeof(Vec3));
  void* indices = requireBuffer(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                        sizeof(triangles.indices[0]), triangles.indices.size()));
  std::memcpy(indices, triangles.indices.data(), triangles.indices.size() * sizeof(triangles.indices[0]));
  return geometry;
}

/// Adds a scene to another one, at a place.
void attachAt(RTCDevice device, RTCScene scene, RTCScene part, const Mat4& toWorld) {
  RTCGeometry instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcAttachGeometry(scene, instance);
  rtcReleaseGeometry(instance);
  rtcSetGeometryInstancedScene(instance, part);
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, &toWorld[0][0]);
  rtcCommitGeometry(instance);
}

/// Creates a scene that is not built yet.
RTCScene newScene(RTCDevice device) {
  RTCScene scene = rtcNewScene(device);
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  return scene;
}

void commit(RTCDevice device, RTCScene scene, const std::function<void(float)>& progress) {
  Build build(progress);
  if (progress) rtcSetSceneProgressMonitorFunction(scene, &Build::report, &build);
  rtcCommitScene(scene);
  rtcSetSceneProgressMonitorFunction(scene, nullptr, nullptr);
  build.rethrow();
  requireBuilt(device);
}

}  // namespace

RayScene::Handles::Handles() : device(newEmbreeDevice()) {
  rtcSetDeviceMemoryMonitorFunction(device, addBytes, &bytes);
  scene = newScene(device);
}

RayScene::RayScene(const Triangles& triangles, const std::function<void(float)>& progress, Backs backs)
    : handles_(std::make_unique<Handles>()) {
  if (!triangles.indices.empty()) {
    RTCGeometry geometry = attach(handles_->device, handles_->scene, triangles);
    if (backs == Backs::kPassed) rtcSetGeometryIntersectFilterFunction(geometry, passBacks);
    rtcCommitGeometry(geometry);
  }
  commit(handles_->device, handles_->scene, progress);
}

RayScene::RayScene(std::span<const PlacedTriangles> placed, const std::function<void(float)>& progress)
    : handles_(std::make_unique<Handles>()) {
  struct Release {
    using pointer = RTCScene;
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  RTCDevice device = handles_->device;
  // Scenes that are placed keep their parts.
  std::map<const Triangles*, std::unique_ptr<RTCScene, Release>> parts;
  for (const PlacedTriangles& each : placed) parts[each.triangles.get()];
  std::size_t built = 0;
  for (auto& [triangles, part] : parts) {
    part.reset(newScene(device));
    if (!triangles->indices.empty()) rtcCommitGeometry(attach(device, part.get(), *triangles));
    commit(device, part.get(), {});
    if (progress) progress(static_cast<float>(++built) / static_cast<float>(parts.size()));
  }
  for (const PlacedTriangles& each : placed) {
    attachAt(device, handles_->scene, parts.at(each.triangles.get()).get(), each.toWorld);
    handles_->normalsToWorld.push_back(glm::inverseTranspose(glm::mat3(each.toWorld)));
  }
  commit(device, handles_->scene, {});
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
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(handles_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  Vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  const unsigned place = query.hit.instID[0];
  if (place != RTC_INVALID_GEOMETRY_ID) normal = handles_->normalsToWorld[place] * normal;
  return Hit{query.ray.tfar, query.hit.primID, query.hit.u, query.hit.v, glm::normalize(normal)};
}

bool RayScene::occluded(Vec3 origin, Vec3 direction, float near, float far) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = makeRay(origin, direction, near, far);
  rtcOccluded1(handles_->scene, &context, &ray);
  return ray.tfar < 0.0F;
}

}  // namespace grove::world
