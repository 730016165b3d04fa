#include "stream/load/load_visitor.h"

#include <algorithm>
#include <utility>

namespace grove::stream {

LoadVisitor::LoadVisitor(int index, const LoadPlan& plan, JpegDecoder& decoder)
    : index_(index), plan_(plan), check_(index, decoder) {}

void LoadVisitor::agreedOn(std::string_view subProtocol) {
  const bool moves = subProtocol == kSubProtocolWithNearness;
  video_ = moves || subProtocol == kSubProtocolWithVideo;
  if (moves) replies_.push_back(encode(Limits{.border = true, .nearness = true}));
}

std::vector<std::uint8_t> LoadVisitor::nextMessage(double now) {
  if (video_ && !std::exchange(offerSent_, true)) return encode(Offer{plan_.codecs});
  if (!std::exchange(helloSent_, true)) {
    return encode(Hello{"Load " + std::to_string(index_ + 1), static_cast<std::uint32_t>(plan_.width),
                        static_cast<std::uint32_t>(plan_.height)});
  }
  if (!replies_.empty()) {
    std::vector<std::uint8_t> reply = std::move(replies_.front());
    replies_.pop_front();
    return reply;
  }
  if (!inputDue_ || !isLetIn()) return {};
  inputDue_ = false;
  return encode(steer(now));
}

void LoadVisitor::receive(std::span<const std::uint8_t> message, double now) {
  const ServerMessage parsed = parseServerMessage(message);
  if (const auto* refusal = std::get_if<Refusal>(&parsed)) {
    fail("invalid message from the server: " + refusal->reason);
  } else if (const auto* welcome = std::get_if<Welcome>(&parsed)) {
    take(*welcome);
  } else if (const auto* frame = std::get_if<FrameMessage>(&parsed)) {
    if (video_) fail("a Frame arrived under a sub-protocol with Pictures");
    takePicture(PictureHeader{frame->header}, frame->picture, message.size(), now);
  } else if (const auto* picture = std::get_if<PictureMessage>(&parsed)) {
    if (!video_) fail("a Picture arrived under a sub-protocol with Frames");
    takePicture(picture->header, picture->picture, message.size(), now);
  } else if (const auto* status = std::get_if<Status>(&parsed)) {
    takeStatus(*status, now);
  }
}

void LoadVisitor::beginCounting(double now) {
  std::vector<std::string> errors = std::move(statistics_.errors);
  statistics_ = {};
  statistics_.errors = std::move(errors);
  statistics_.screenAtFirst = screen_;
  lastUpdate_ = now;
  limitedSince_ = now;
}

void LoadVisitor::endCounting(double now) {
  recordUpdate(now);
  isLimitedBy(limit_, now);
}

void LoadVisitor::take(const Welcome& welcome) {
  welcome_ = welcome;
  steering_.emplace(index_, plan_, welcome);
}

world::Input LoadVisitor::steer(double now) {
  if (!walksSince_) walksSince_ = now;
  world::Input input = steering_->at(now - *walksSince_);
  input.number = ++lastInput_;
  latency_.sent(input.number, now);
  return input;
}

void LoadVisitor::takePicture(const PictureHeader& header, std::span<const std::uint8_t> picture, std::size_t bytes,
                              double now) {
  const std::string name = "frame " + std::to_string(header.frame);
  if (header.frame <= lastFrame_) fail(name + " arrived late or twice");
  if (header.lastInput < lastInputOfPicture_ || header.lastInput > lastInput_) {
    fail("a frame shows input " + std::to_string(header.lastInput) + " out of order");
  }
  if (lastFrame_ > 0 && header.frame > lastFrame_) statistics_.dropped += header.frame - lastFrame_ - 1;
  lastFrame_ = header.frame;
  lastInputOfPicture_ = header.lastInput;
  screen_ = ShownPicture{header.codec, header.height};
  showsInput(header.lastInput, now);
  recordUpdate(now);
  ++statistics_.frames;
  ++statistics_.shown[*screen_];
  statistics_.bytes += bytes;
  if (const auto fault = check_.check(header, picture)) fail("the picture of " + name + " " + *fault);
  reply(header, now);
}

void LoadVisitor::reply(const PictureHeader& header, double now) {
  if (!video_) {
    replies_.assign(1, encode(Ack{header.frame}));  // acknowledges all earlier ones, too
    return;
  }
  if (check_.takeBroken()) replies_.push_back(encode(Broken{header.frame}));
  const auto arrived = static_cast<std::uint32_t>(static_cast<std::uint64_t>(now * 1e6));
  replies_.push_back(encode(Presented{header.frame, 0, arrived}));
}

void LoadVisitor::takeStatus(const Status& status, double now) {
  if (status.lastInput > lastInput_) {
    fail("a Status acknowledges input " + std::to_string(status.lastInput) + ", which was not sent");
    return;
  }
  isLimitedBy(status.limitedBy, now);
  if (status.lastInput <= lastInputShown_) return;
  showsInput(status.lastInput, now);
  recordUpdate(now);
}

void LoadVisitor::showsInput(std::uint32_t input, double now) {
  lastInputShown_ = std::max(lastInputShown_, input);
  latency_.shown(input, now, statistics_.latencyMilliseconds);
}

void LoadVisitor::isLimitedBy(LimitedBy limit, double now) {
  statistics_.limitedSeconds[limit_] += now - std::exchange(limitedSince_, now);
  limit_ = limit;
}

void LoadVisitor::recordUpdate(double now) {
  statistics_.longestGapSeconds = std::max(statistics_.longestGapSeconds, now - lastUpdate_);
  lastUpdate_ = now;
}

}  // namespace grove::stream
