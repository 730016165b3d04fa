#pragma once

#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "node/messages.h"
#include "pipeline/stage.h"
#include "stream/encode/encoder.h"

namespace grove::cli {

/// Replaces a visitor's encode stage: keeps the newest frame for take(). Encodes it first if it has an encoder, always
/// with the encoder's usual quantiser, without rate control.
class FrameShelf final : public pipeline::Stage<node::FinishedFrame> {
 public:
  /// `encoder` may be null.
  FrameShelf(std::unique_ptr<stream::Encoder> encoder, pipeline::Executor& executor, pipeline::Timeline& timeline);

  /// Waits for a frame; nothing if it does not come within a minute.
  [[nodiscard]] std::optional<node::FinishedFrame> take();

 protected:
  void process(std::span<node::FinishedFrame> items, pipeline::Run& run) override;

 private:
  const std::unique_ptr<stream::Encoder> encoder_;
  std::vector<std::uint8_t> bytes_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::optional<node::FinishedFrame> frame_;
};

}  // namespace grove::cli
