#pragma once

#include <embree3/rtcore_ray.h>

#include <memory>
#include <vector>

#include "models/model.h"
#include "objects/lightfield/bake/texture_sampler.h"

namespace grove::bake {

inline constexpr std::size_t kPacket = 16;

/// Traces rays against a model, sixteen at a time, with the holes of its textures. Immutable after construction; any
/// number of threads may trace.
class ModelRays {
 public:
  /// Keeps references to both. Throws EnvironmentError.
  ModelRays(const models::Model& model, const std::vector<TextureSampler>& textures);
  ~ModelRays();
  ModelRays(const ModelRays&) = delete;
  ModelRays& operator=(const ModelRays&) = delete;

  /// Surrounds the model with copies of itself at these offsets (metres), for rays that request them. Call at most
  /// once.
  void surround(const std::vector<world::Vec3>& offsets);

  /// Active rays of a packet.
  struct alignas(64) Mask {
    std::int32_t lane[kPacket]{};
  };
  enum class Among { kModel, kSurroundings };
  /// Whether rays hit the backs of one-sided surfaces: light rays do, view rays do not.
  enum class Backs { kMet, kPassed };

  /// Nearest hits. hit.geomID stays RTC_INVALID_GEOMETRY_ID without a hit; else hit.primID is the model's triangle and
  /// hit.Ng points to the side from which its corners appear counter-clockwise.
  void intersect(const Mask& mask, RTCRayHit16& rays, Among among, Backs backs) const;
  /// tfar becomes negative on a hit. tnear and tfar of inactive rays are undefined afterwards.
  void occluded(const Mask& mask, RTCRay16& rays, Among among) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace grove::bake
