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
#include "stream/encode/scene_motion.h"

namespace grove::stream {

/// The last box of a visitor's pipeline: encodes a composited frame as a Frame or Picture message. Newest wins, before
/// encoding: a frame that waits while an older one is encoded is replaced by the next. A picture that the visitor's
/// screen already shows is not encoded again.
class EncodeStage final : public pipeline::Stage<node::FinishedFrame> {
 public:
  /// Receivers of messages; called on the executor's threads, must not block.
  struct Outputs {
    std::function<void(std::shared_ptr<const EncodedFrame>)> frame;
    std::function<void(std::vector<std::uint8_t>)> captured = {};  ///< a Captured message
  };

  /// The `page` decides the messages: Frames, Pictures, Pictures with the nearness of the fire (`fires`: positions) and
  /// the places of names, or these with a Space. Reports the encoder, and the newest frame that waits to be sent, to
  /// `memory`.
  EncodeStage(std::shared_ptr<StreamControl> control, PageLevel page, std::vector<world::Vec3> fires, Outputs outputs,
              pipeline::MemoryLedger& memory, pipeline::Executor& executor, pipeline::Timeline& timeline);

 protected:
  void process(std::span<node::FinishedFrame> items, pipeline::Run& run) override;

 private:
  void encodeNext(const node::FinishedFrame& frame);
  /// Writes the header before the picture.
  void writeHeader(EncodedFrame& made) const;
  void capture(const node::FinishedFrame& frame, std::uint32_t number);
  /// Returns the wanted encoder, made anew if it differs from the last one; null if it fails.
  [[nodiscard]] Encoder* encoderOf(const EncoderKind& kind);
  /// Returns whether no pixel differs from the last frame's.
  [[nodiscard]] bool isSame(const node::FinishedFrame& frame, bool still);
  /// Returns the frame's message up to the picture, with room for its header.
  [[nodiscard]] std::shared_ptr<EncodedFrame> begin(const node::FinishedFrame& frame) const;

  const std::shared_ptr<StreamControl> control_;
  const bool asPictures_;
  const PageLevel page_;
  const std::vector<world::Vec3> fires_;
  const Outputs outputs_;
  std::string kind_;  ///< name of the encoder's kind
  std::unique_ptr<Encoder> encoder_;
  SceneMotion motion_;  ///< between pictures of this encoder
  std::size_t lastBytes_ = 0;
  std::optional<world::Camera> lastCamera_;
  std::uint64_t lastHash_ = 0;
  Quantiser lastQuantiser_ = 0.0;
  pipeline::HeldMemory held_;
};

}  // namespace grove::stream
