#pragma once

#include <map>
#include <memory>
#include <span>

#include "node/backend/backend_half.h"
#include "objects/herd/backend/motion/motion_graph.h"

namespace grove::objects::herd {

/// The simulation node of all herds: one motion graph for all of them, and a clock for each herd, which publishes an
/// immutable snapshot at each tick (the paper's section 6 names motion graphs as the application to come). Without
/// visitors the herds sleep.
class HerdBackend final : public node::BackendHalf {
 public:
  HerdBackend(const node::BackendServices& services, world::TypeIndex self);
  ~HerdBackend() override;

  [[nodiscard]] node::NodeKind kind() const override { return node::NodeKind::kSimulation; }
  [[nodiscard]] pipeline::Executor& executor() override { return services_.workers; }
  void answer(std::span<const node::Request> requests, std::span<node::Payload> payloads) override;

 private:
  class Herd;

  const node::BackendServices services_;
  const MotionDatabase database_;
  const MotionGraph graph_;
  const pipeline::HeldMemory held_;
  std::map<world::ObjectId, std::unique_ptr<Herd>> herds_;
};

}  // namespace grove::objects::herd
