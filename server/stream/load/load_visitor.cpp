#include "stream/load/load_visitor.h"

#include <utility>

namespace grove::stream {
namespace {

constexpr std::uint64_t kFramesPerDecodedOne = 30;

}  // namespace

LoadVisitor::LoadVisitor(int index, int width, int height, JpegDecoder& decoder)
    : index_(index), width_(width), height_(height), decoder_(decoder) {}

std::vector<std::uint8_t> LoadVisitor::nextMessage(double now) {
  if (!std::exchange(helloSent_, true)) {
    return encode(Hello{"Load " + std::to_string(index_ + 1), static_cast<std::uint32_t>(width_),
                        static_cast<std::uint32_t>(height_)});
  }
  if (const auto ack = std::exchange(acknowledge_, std::nullopt)) return encode(*ack);
  if (!inputDue_ || !isLetIn()) return {};
  inputDue_ = false;
  return encode(steer(now));
}

void LoadVisitor::receive(std::span<const std::uint8_t> message, double now) {
  const ServerMessage parsed = parseServerMessage(message);
  if (const auto* refusal = std::get_if<Refusal>(&parsed)) {
    fail("a message of the server is wrong: " + refusal->reason);
  } else if (const auto* welcome = std::get_if<Welcome>(&parsed)) {
    welcome_ = *welcome;
  } else if (const auto* frame = std::get_if<FrameMessage>(&parsed)) {
    receiveFrame(*frame, message.size(), now);
  }
}

void LoadVisitor::beginCounting() {
  std::vector<std::string> errors = std::move(statistics_.errors);
  statistics_ = {};
  statistics_.errors = std::move(errors);
}

world::Input LoadVisitor::steer(double now) {
  if (!walksSince_) walksSince_ = now;
  world::Input input = stroll(index_, welcome_->yaw, now - *walksSince_);
  input.number = ++lastInput_;
  latency_.sent(input.number, now);
  return input;
}

void LoadVisitor::receiveFrame(const FrameMessage& frame, std::size_t bytes, double now) {
  const FrameHeader& header = frame.header;
  if (header.frame <= lastFrame_) fail("frame " + std::to_string(header.frame) + " came late or twice");
  if (header.lastInput < lastInputShown_ || header.lastInput > lastInput_) {
    fail("a frame shows input " + std::to_string(header.lastInput) + " out of order");
  }
  if (lastFrame_ > 0 && header.frame > lastFrame_) statistics_.dropped += header.frame - lastFrame_ - 1;
  lastFrame_ = header.frame;
  lastInputShown_ = header.lastInput;
  acknowledge_ = Ack{header.frame};
  latency_.shown(header.lastInput, now, statistics_.latencyMilliseconds);
  ++statistics_.frames;
  statistics_.bytes += bytes;
  checkPicture(frame);
}

void LoadVisitor::checkPicture(const FrameMessage& frame) {
  const auto expected = std::pair<int, int>(frame.header.width, frame.header.height);
  if (decoder_.size(frame.picture) != expected) {
    fail("the picture of frame " + std::to_string(frame.header.frame) + " is not of the size that it should have");
    return;
  }
  // Not all visitors in the same frame: to decode takes as long as to encode.
  const bool decodeThis = (framesReceived_++ + 7 * static_cast<std::uint64_t>(index_)) % kFramesPerDecodedOne == 0;
  if (decodeThis && decoder_.decode(frame.picture) == nullptr) {
    fail("the picture of frame " + std::to_string(frame.header.frame) + " is damaged");
  }
}

}  // namespace grove::stream
