#include "node/simulation_data.h"

namespace grove::node {

std::shared_ptr<const PackedData> SimulationData::packed(pipeline::Timeline& timeline) const {
  const std::string_view type = packedType();
  if (type.empty()) return nullptr;
  std::call_once(once_, [&] {
    const pipeline::TimedRun timed(timeline, "Snapshot Packing", pipeline::Work::kAcrossUser, {}, type);
    packed_ = std::make_shared<const PackedData>(PackedData{type, pack()});
    packedBytes_.store(packed_->bytes.capacity(), std::memory_order_relaxed);
  });
  return packed_;
}

}  // namespace grove::node
