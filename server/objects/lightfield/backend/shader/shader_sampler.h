#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "gl/workers.h"
#include "objects/lightfield/backend/sampler.h"
#include "pipeline/memory_ledger.h"

namespace grove::objects::lightfield {

/// The Sampler for GPUs: shaders/lightfield/sample.frag, one triangle a picture. It makes the same pictures as
/// SimdSampler, whose header says how.
///
/// The pictures of a call are drawn one below the other into one target and read back at the end. Every GL worker keeps
/// the light fields that it has drawn as textures, `maxBytes` of them at most.
class ShaderSampler final : public Sampler {
 public:
  static constexpr std::size_t kDefaultBytes = std::size_t{4} << 30U;

  /// The workers outlive the sampler.
  explicit ShaderSampler(gl::Workers& workers, DepthCorrection correction = DepthCorrection::kOn,
                         std::size_t maxBytes = kDefaultBytes);
  /// Reports to `memory`, which outlives the sampler, of the textures and targets.
  ShaderSampler(gl::Workers& workers, pipeline::MemoryLedger& memory);
  /// Not on a worker: waits for each to drop its textures.
  ~ShaderSampler() override;

  /// On a worker. Throws EnvironmentError if a light field is too big for the driver or for `maxBytes`.
  void render(std::span<const SampleRequest> requests, std::span<raster::Image* const> images) override;

 private:
  class Target;
  gl::Workers& workers_;
  const DepthCorrection correction_;
  const std::size_t maxBytes_;
  pipeline::MemoryLedger* memory_ = nullptr;      ///< null: nobody wants to know
  std::vector<std::unique_ptr<Target>> targets_;  // by worker, each used by its thread alone
};

}  // namespace grove::objects::lightfield
