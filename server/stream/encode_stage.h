#pragma once

#include <functional>
#include <memory>

#include "node/messages.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/stage.h"
#include "stream/encoder.h"

namespace grove::stream {

/// The last box of a visitor's pipeline: makes a Frame message of a composited frame and hands it on. Newest wins: a
/// frame that waits while an older one is encoded is replaced by the next.
class EncodeStage final : public pipeline::Stage<node::FinishedFrame> {
 public:
  using Deliver = std::function<void(std::shared_ptr<const EncodedFrame>)>;

  /// `deliver` is called on the executor's threads and must not block. Tells `memory` of the encoder and of the newest
  /// frame, which waits to be sent.
  EncodeStage(std::unique_ptr<Encoder> encoder, Deliver deliver, pipeline::MemoryLedger& memory,
              pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void process(std::span<node::FinishedFrame> items, pipeline::Run& run) override;

 private:
  const std::unique_ptr<Encoder> encoder_;
  const Deliver deliver_;
  std::size_t lastBytes_ = 0;
  pipeline::HeldMemory held_;
};

}  // namespace grove::stream
