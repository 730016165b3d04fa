#pragma once

#include <map>
#include <memory>
#include <span>

#include "node/backend/backend_half.h"
#include "objects/fluid/backend/simulation/fluid_simulation.h"

namespace grove::objects::fluid {

/// The simulation node of all fires in the world. Each fire ticks on its own clock and publishes an immutable snapshot;
/// a request returns the newest one (section 4.1). Construction simulates the first seconds, so that the first visitor
/// sees a full plume. After two seconds without visitors the simulations sleep, at no cost, and continue from the same
/// state when a visitor arrives.
class FluidBackend final : public node::BackendHalf {
 public:
  /// `tickSeconds`: CPU time that a tick may take of one core.
  FluidBackend(const node::BackendServices& services, world::TypeIndex self,
               double tickSeconds = FluidSimulation::kTick);
  ~FluidBackend() override;

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kSimulation; }
  [[nodiscard]] pipeline::Executor& executor() override { return services_.workers; }
  /// Each quality step has finer cells, see cellsAt(). Air, smoke and simulated time continue without a break.
  void setQuality(int step) override;
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override;

 private:
  class Fire;

  const node::BackendServices services_;
  std::map<world::ObjectId, std::unique_ptr<Fire>> fires_;
};

}  // namespace grove::objects::fluid
