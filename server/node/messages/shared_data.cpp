#include "node/messages/shared_data.h"

namespace grove::node {

std::shared_ptr<const PackedBytes> SharedData::packed(pipeline::Timeline& timeline, std::string_view subject) const {
  std::call_once(once_, [&] {
    const pipeline::TimedRun timed(timeline, "Packing", pipeline::Work::kAcrossUser, {}, subject);
    packed_ = std::make_shared<const PackedBytes>(pack());
    packedBytes_.store(packed_->capacity(), std::memory_order_relaxed);
    if (held_) held_->set(bytes());
  });
  return packed_;
}

void SharedData::holdIn(pipeline::MemoryLedger& memory, const char* holder, std::string_view subject,
                        pipeline::Work work) {
  held_.emplace(memory, holder, subject, work, bytes());
}

}  // namespace grove::node
