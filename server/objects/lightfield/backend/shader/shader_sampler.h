#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "gl/workers.h"
#include "objects/lightfield/backend/sampler.h"
#include "pipeline/memory_ledger.h"

namespace grove::objects::lightfield {

/// The Sampler for GPUs: shaders/lightfield/sample.frag, one triangle per picture. Makes the same pictures as
/// SimdSampler, whose header describes the method.
///
/// Draws the pictures of a call one below the other into one target and reads it back at the end. Every GL worker keeps
/// the light fields that it has drawn as textures of at most `maxBytes`.
class ShaderSampler final : public Sampler {
 public:
  static constexpr std::size_t kDefaultBytes = std::size_t{4} << 30U;

  /// The workers outlive the sampler.
  explicit ShaderSampler(gl::Workers& workers, DepthCorrection correction = DepthCorrection::kOn,
                         std::size_t maxBytes = kDefaultBytes);
  /// Reports the textures and targets to `memory`, which outlives the sampler.
  ShaderSampler(gl::Workers& workers, pipeline::MemoryLedger& memory);
  /// Not on a worker: waits until each has dropped its textures.
  ~ShaderSampler() override;

  /// On a worker. Throws EnvironmentError if a light field is too large for the driver or for `maxBytes`.
  void render(std::span<const SampleRequest> requests, std::span<raster::Image* const> images) override;

 private:
  class Target;
  gl::Workers& workers_;
  const DepthCorrection correction_;
  const std::size_t maxBytes_;
  pipeline::MemoryLedger* memory_ = nullptr;      ///< null: no reports
  std::vector<std::unique_ptr<Target>> targets_;  // one per worker, used only by its thread
};

}  // namespace grove::objects::lightfield
