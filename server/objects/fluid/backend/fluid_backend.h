#pragma once

#include <map>
#include <memory>
#include <span>

#include "node/backend/backend_half.h"
#include "objects/fluid/backend/simulation/fluid_simulation.h"

namespace grove::objects::fluid {

/// The simulation node of all fires in the world: each ticks on its own clock and publishes an immutable snapshot, and
/// an answer is no more than the newest one (section 4.1). Construction simulates the first seconds, so that the first
/// visitor meets a grown plume. A world that was empty for two seconds costs nothing: the simulations rest until
/// somebody comes, and go on where they were.
class FluidBackend final : public node::BackendHalf {
 public:
  /// `tickSeconds`: what a tick may take of a core.
  FluidBackend(const node::BackendServices& services, world::TypeIndex self,
               double tickSeconds = FluidSimulation::kTick);
  ~FluidBackend() override;

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kSimulation; }
  [[nodiscard]] pipeline::Executor& executor() override { return services_.workers; }
  /// Each step has finer cells, see cellsAt(). The air, the smoke and their time go on.
  void setQuality(int step) override;
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override;

 private:
  class Fire;

  const node::BackendServices services_;
  std::map<world::ObjectId, std::unique_ptr<Fire>> fires_;
};

}  // namespace grove::objects::fluid
