#include "stream/encode_stage.h"

#include <algorithm>
#include <limits>

#include "world/world.h"

namespace grove::stream {
namespace {

template <class Number>
Number saturate(double value) {
  return static_cast<Number>(std::clamp(value, 0.0, static_cast<double>(std::numeric_limits<Number>::max())));
}

FrameHeader describe(const node::FinishedFrame& frame, std::uint8_t codec) {
  FrameHeader header;
  header.codec = codec;
  header.width = saturate<std::uint16_t>(frame.image->width());
  header.height = saturate<std::uint16_t>(frame.image->height());
  header.visitors = saturate<std::uint16_t>(static_cast<double>(frame.view->players.size()));
  header.frame = frame.view->frame;
  header.lastInput = frame.view->lastInput;
  header.serverMicroseconds = saturate<std::uint32_t>((world::World::now() - frame.view->time) * 1e6);
  return header;
}

}  // namespace

EncodeStage::EncodeStage(std::unique_ptr<Encoder> encoder, Deliver deliver, pipeline::MemoryLedger& memory,
                         pipeline::Executor& executor, pipeline::Timeline& timeline)
    : Stage({.name = "Encoder",
             .work = pipeline::Work::kPerUserFrontend,
             .capacity = 1,
             .overflow = pipeline::Overflow::kDropOldest,
             .finishes = true},
            executor, timeline),
      encoder_(std::move(encoder)),
      deliver_(std::move(deliver)),
      held_(memory, "encoders", "", pipeline::Work::kPerUserFrontend) {}

void EncodeStage::process(std::span<node::FinishedFrame> items, pipeline::Run& /*run*/) {
  for (const node::FinishedFrame& item : items) {
    const auto frame = std::make_shared<EncodedFrame>();
    // Neighbouring frames are of like size: room for a little more than the last one saves growing.
    frame->bytes.reserve(EncodedFrame::kHeadroom + kFrameHeaderBytes + lastBytes_ + lastBytes_ / 8);
    frame->bytes.resize(EncodedFrame::kHeadroom + kFrameHeaderBytes);
    encoder_->encode(*item.image, frame->bytes);
    lastBytes_ = frame->bytes.size();
    frame->header = describe(item, encoder_->codec());
    encode(frame->header, std::span(frame->bytes).subspan<EncodedFrame::kHeadroom, kFrameHeaderBytes>());
    held_.set(encoder_->bytes() + frame->bytes.capacity());
    deliver_(frame);
  }
}

}  // namespace grove::stream
