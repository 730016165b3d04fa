#include "objects/lightfield/bake/model_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "world/noise.h"
#include "world/rays/embree_device.h"

namespace grove::bake {

using world::Vec2;
using world::Vec3;

struct ModelRays::Embree {
  /// Data for the filter functions; Embree passes a pointer to the first member.
  struct Context {
    RTCIntersectContext embree;
    Backs backs;
  };

  RTCDevice device = nullptr;
  RTCScene model = nullptr;
  RTCScene surroundings = nullptr;  ///< null: the model alone

  const models::Model* source = nullptr;
  const std::vector<TextureSampler>* textures = nullptr;
  std::vector<std::uint32_t> solid;     ///< triangles that every ray hits
  std::vector<std::uint32_t> oneSided;  ///< triangles that view rays pass from behind
  std::vector<std::uint32_t> pierced;   ///< triangles with holes

  Embree() = default;
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() {
    if (surroundings != nullptr) rtcReleaseScene(surroundings);
    if (model != nullptr) rtcReleaseScene(model);
    if (device != nullptr) rtcReleaseDevice(device);
  }

  [[nodiscard]] bool isHole(std::uint32_t triangle, float u, float v) const {
    const auto [a, b, c] = source->triangles.indices[triangle];
    const models::Material& material = source->materials[source->materialOf[triangle]];
    const float cutoff = material.alphaCutoff * (material.blended ? chance(triangle, u, v) : 1.0F);
    if (!readsTexture(*source, material)) return 1.0F < cutoff;
    const Vec2 uv = source->uvs[a] * (1.0F - u - v) + source->uvs[b] * u + source->uvs[c] * v;
    return (*textures)[static_cast<std::size_t>(material.texture)].alpha(uv) < cutoff;
  }

  [[nodiscard]] static bool readsTexture(const models::Model& model, const models::Material& material) {
    return material.texture >= 0 && !model.uvs.empty();
  }

  /// A pseudo-random number 0..1, the same for the same place, so that a bake is repeatable.
  [[nodiscard]] static float chance(std::uint32_t triangle, float u, float v) {
    const std::uint32_t place = world::hash(std::bit_cast<std::uint32_t>(u)) ^ std::bit_cast<std::uint32_t>(v);
    return static_cast<float>(world::hash(world::hash(place) ^ triangle) >> 8U) * (1.0F / 16777216.0F);
  }

  /// Rejects hits of one geometry.
  template <class Undone>
  static void filter(const RTCFilterFunctionNArguments* args, const std::vector<std::uint32_t>& triangles,
                     const Undone& undone) {
    for (unsigned i = 0; i < args->N; ++i) {
      if (args->valid[i] != 0 && undone(i, triangles[RTCHitN_primID(args->hit, args->N, i)])) args->valid[i] = 0;
    }
  }

  [[nodiscard]] static bool passesBack(const RTCFilterFunctionNArguments* args, unsigned i) {
    if (reinterpret_cast<const Context*>(args->context)->backs == Backs::kMet) return false;
    const float towards = RTCHitN_Ng_x(args->hit, args->N, i) * RTCRayN_dir_x(args->ray, args->N, i) +
                          RTCHitN_Ng_y(args->hit, args->N, i) * RTCRayN_dir_y(args->ray, args->N, i) +
                          RTCHitN_Ng_z(args->hit, args->N, i) * RTCRayN_dir_z(args->ray, args->N, i);
    return towards > 0.0F;
  }

  static void filterPierced(const RTCFilterFunctionNArguments* args) {
    const Embree& self = *static_cast<const Embree*>(args->geometryUserPtr);
    filter(args, self.pierced, [&](unsigned i, std::uint32_t triangle) {
      const bool twoSided = self.source->materials[self.source->materialOf[triangle]].twoSided;
      return (!twoSided && passesBack(args, i)) ||
             self.isHole(triangle, RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i));
    });
  }

  static void filterOneSided(const RTCFilterFunctionNArguments* args) {
    const Embree& self = *static_cast<const Embree*>(args->geometryUserPtr);
    filter(args, self.oneSided, [&](unsigned i, std::uint32_t) { return passesBack(args, i); });
  }

  void attach(const std::vector<std::uint32_t>& triangles, unsigned id) {
    if (triangles.empty()) return;
    const std::vector<Vec3>& positions = source->triangles.positions;
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcAttachGeometryByID(model, geometry, id);
    rtcReleaseGeometry(geometry);
    void* vertices = world::requireBuffer(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                  RTC_FORMAT_FLOAT3, sizeof(Vec3), positions.size()));
    std::memcpy(vertices, positions.data(), positions.size() * sizeof(Vec3));
    auto* corners = static_cast<std::array<std::uint32_t, 3>*>(world::requireBuffer(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, sizeof(std::array<std::uint32_t, 3>), triangles.size())));
    for (const std::uint32_t triangle : triangles) *corners++ = source->triangles.indices[triangle];
    rtcSetGeometryUserData(geometry, this);
    if (id == kOneSided) rtcSetGeometryIntersectFilterFunction(geometry, filterOneSided);
    if (id == kPierced) {
      rtcSetGeometryIntersectFilterFunction(geometry, filterPierced);
      rtcSetGeometryOccludedFilterFunction(geometry, filterPierced);
    }
    rtcCommitGeometry(geometry);
  }

  static constexpr unsigned kSolid = 0;
  static constexpr unsigned kPierced = 1;
  static constexpr unsigned kOneSided = 2;

  [[nodiscard]] const std::vector<std::uint32_t>& triangles(unsigned id) const {
    return id == kPierced ? pierced : id == kOneSided ? oneSided : solid;
  }

  [[nodiscard]] RTCScene scene(Among among) const {
    return among == Among::kSurroundings && surroundings != nullptr ? surroundings : model;
  }
};

namespace {

/// Ends the inactive rays before tracing. Without native packets of sixteen, which only AVX-512 has, Embree traces them
/// as a stream and ignores the mask.
void endInactive(const ModelRays::Mask& mask, RTCRay16& rays) {
  for (std::size_t i = 0; i < kPacket; ++i) {
    if (mask.lane[i] != 0) continue;
    rays.tnear[i] = 1.0F;
    rays.tfar[i] = -1.0F;
  }
}

}  // namespace

ModelRays::ModelRays(const models::Model& model, const std::vector<TextureSampler>& textures)
    : embree_(std::make_unique<Embree>()) {
  // Always the same tree, so that the same one of several equally near hits wins.
  embree_->device = world::newEmbreeDevice();
  embree_->source = &model;
  embree_->textures = &textures;
  for (std::uint32_t i = 0; i < model.triangles.indices.size(); ++i) {
    const models::Material& material = model.materials[model.materialOf[i]];
    const bool pierced = material.alphaCutoff > 0.0F && (material.blended || Embree::readsTexture(model, material));
    (pierced ? embree_->pierced : material.twoSided ? embree_->solid : embree_->oneSided).push_back(i);
  }
  embree_->model = rtcNewScene(embree_->device);
  embree_->attach(embree_->solid, Embree::kSolid);
  embree_->attach(embree_->pierced, Embree::kPierced);
  embree_->attach(embree_->oneSided, Embree::kOneSided);
  rtcCommitScene(embree_->model);
  world::requireBuilt(embree_->device);
}

ModelRays::~ModelRays() = default;

void ModelRays::surround(const std::vector<Vec3>& offsets) {
  embree_->surroundings = rtcNewScene(embree_->device);
  const auto attach = [&](Vec3 offset) {
    RTCGeometry copy = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(copy, embree_->model);
    const float matrix[12] = {1, 0, 0, 0, 1, 0, 0, 0, 1, offset.x, offset.y, offset.z};
    rtcSetGeometryTransform(copy, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
    rtcCommitGeometry(copy);
    rtcAttachGeometry(embree_->surroundings, copy);
    rtcReleaseGeometry(copy);
  };
  attach(Vec3(0.0F));
  for (const Vec3 offset : offsets) attach(offset);
  rtcCommitScene(embree_->surroundings);
  world::requireBuilt(embree_->device);
}

void ModelRays::intersect(const Mask& mask, RTCRayHit16& rays, Among among, Backs backs) const {
  Embree::Context context{{}, backs};
  // The flags stay "incoherent": amid leaves that is faster by a third even for primary rays.
  rtcInitIntersectContext(&context.embree);
  endInactive(mask, rays.ray);
  rtcIntersect16(mask.lane, embree_->scene(among), &context.embree, &rays);
  for (std::size_t i = 0; i < kPacket; ++i) {
    if (mask.lane[i] == 0 || rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
    rays.hit.primID[i] = embree_->triangles(rays.hit.geomID[i])[rays.hit.primID[i]];
  }
}

void ModelRays::occluded(const Mask& mask, RTCRay16& rays, Among among) const {
  Embree::Context context{{}, Backs::kMet};
  rtcInitIntersectContext(&context.embree);
  endInactive(mask, rays);
  rtcOccluded16(mask.lane, embree_->scene(among), &context.embree, &rays);
}

}  // namespace grove::bake
