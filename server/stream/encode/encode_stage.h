#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "node/messages.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/stage.h"
#include "stream/adapt/stream_control.h"
#include "stream/encode/encoded_frame.h"
#include "stream/encode/encoder.h"

namespace grove::stream {

/// The last box of a visitor's pipeline: makes a Frame or Picture message of a composited frame and hands it on. Newest
/// wins, before encoding: a frame that waits while an older one is encoded is replaced by the next. What the visitor's
/// screen shows already is not encoded again.
class EncodeStage final : public pipeline::Stage<node::FinishedFrame> {
 public:
  /// Where messages go; called on the executor's threads, must not block.
  struct Outputs {
    std::function<void(std::shared_ptr<const EncodedFrame>)> frame;
    std::function<void(std::vector<std::uint8_t>)> captured = {};  ///< a Captured message
  };

  /// Messages are what this `page` understands: Frames, Pictures, or Pictures that tell what is heard (`fires`: where
  /// they burn) and where names belong. Reports to `memory` the
  /// encoder and the newest frame, which waits to be sent.
  EncodeStage(std::shared_ptr<StreamControl> control, PageLevel page, std::vector<world::Vec3> fires, Outputs outputs,
              pipeline::MemoryLedger& memory, pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void process(std::span<node::FinishedFrame> items, pipeline::Run& run) override;

 private:
  void encodeNext(const node::FinishedFrame& frame);
  void capture(const node::FinishedFrame& frame, std::uint32_t number);
  /// The encoder that is wanted now, made anew if it is another than before; null if it cannot be had.
  [[nodiscard]] Encoder* encoderOf(const EncoderKind& kind);
  /// Whether not one pixel differs from the last frame's.
  [[nodiscard]] bool isSame(const node::FinishedFrame& frame, bool still);
  [[nodiscard]] std::shared_ptr<EncodedFrame> makeRoom(std::size_t labels) const;

  const std::shared_ptr<StreamControl> control_;
  const bool asPictures_;
  const bool namesAndSounds_;
  const std::vector<world::Vec3> fires_;
  const Outputs outputs_;
  std::string kind_;  ///< name of the encoder's
  std::unique_ptr<Encoder> encoder_;
  std::size_t lastBytes_ = 0;
  std::optional<world::Camera> lastCamera_;
  std::uint64_t lastHash_ = 0;
  Quantiser lastQuantiser_ = 0.0;
  pipeline::HeldMemory held_;
};

}  // namespace grove::stream
