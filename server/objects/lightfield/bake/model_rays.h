#pragma once

#include <embree3/rtcore_ray.h>

#include <memory>
#include <vector>

#include "models/model.h"
#include "objects/lightfield/bake/texture_sampler.h"

namespace grove::bake {

inline constexpr std::size_t kPacket = 16;

/// Rays at a model, sixteen at a time, with the holes of its textures. Immutable after construction; any number of
/// threads may trace.
class ModelRays {
 public:
  /// Keeps references to both. Throws EnvironmentError.
  ModelRays(const models::Model& model, const std::vector<TextureSampler>& textures);
  ~ModelRays();
  ModelRays(const ModelRays&) = delete;
  ModelRays& operator=(const ModelRays&) = delete;

  /// Surrounds the model with copies of itself at these offsets (metres), for rays that ask for them. Once.
  void surround(const std::vector<world::Vec3>& offsets);

  /// Which rays of a packet are alive.
  struct alignas(64) Mask {
    std::int32_t lane[kPacket]{};
  };
  enum class Among { kModel, kSurroundings };
  /// Whether rays meet the backs of surfaces that have one side: those of light do, those of eyes do not.
  enum class Backs { kMet, kPassed };

  /// Nearest hits; hit.geomID stays RTC_INVALID_GEOMETRY_ID where there is none, else hit.primID is the model's
  /// triangle and hit.Ng points to the side that its corners wind counter-clockwise around.
  void intersect(const Mask& mask, RTCRayHit16& rays, Among among, Backs backs) const;
  /// tfar becomes negative where something is hit. Of rays that are not alive, tnear and tfar hold nothing afterwards.
  void occluded(const Mask& mask, RTCRay16& rays, Among among) const;

 private:
  struct Embree;
  std::unique_ptr<Embree> embree_;
};

}  // namespace grove::bake
