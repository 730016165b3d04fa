#include "stream/encode/encode_stage.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

#include "base/checksum.h"
#include "base/error.h"
#include "base/log.h"
#include "node/limits.h"
#include "pipeline/clocks.h"
#include "stream/encode/jpeg/jpeg_encoder.h"
#include "stream/late_walk/nearness_code.h"
#include "stream/protocol/saturate.h"

namespace grove::stream {
namespace {

/// Higher qualities look the same, and files double.
constexpr int kCaptureQuality = 95;

PictureHeader describe(const node::FinishedFrame& frame) {
  const node::View& view = *frame.view;
  PictureHeader header;
  header.width = saturate<std::uint16_t>(frame.picture->width());
  header.height = saturate<std::uint16_t>(frame.picture->height());
  header.visitors = saturate<std::uint16_t>(static_cast<double>(view.players.size()));
  header.frame = view.frame;
  header.lastInput = view.lastInput;
  header.border = static_cast<std::uint8_t>(view.borderPercent);
  header.yaw = view.camera.pose.yaw;
  header.pitch = view.camera.pose.pitch;
  header.tanHalfX = view.camera.tanHalfX();
  header.tanHalfY = view.camera.tanHalfY();
  return header;
}

/// Loudness falls with distance.
std::uint8_t nearnessOf(const std::vector<world::Vec3>& fires, world::Vec3 ear) {
  constexpr float kBeside = 1.5F;  // metres
  float nearness = 0.0F;
  for (const world::Vec3& fire : fires) {
    nearness = std::max(nearness, kBeside / std::max(kBeside, glm::distance(fire, ear)));
  }
  return saturate<std::uint8_t>(std::lround(nearness * 255.0F));
}

std::vector<Label> labelsOf(const node::FinishedFrame& frame) {
  static_assert(node::kMaxLabelsPerFrame <= kMaxLabels);
  const auto wire = [](float share) { return saturate<std::uint16_t>(std::lround(share * 65535.0F)); };
  const node::ProcessId own = node::processOf(frame.view->viewer);
  std::vector<Label> labels;
  labels.reserve(frame.labels.size());
  for (const node::Label& label : frame.labels) {
    labels.push_back({.visitor = node::shortIdOf(label.object - world::kFirstPlayerObject, own),
                      .x = wire(label.place.x / static_cast<float>(frame.picture->width())),
                      .y = wire(label.place.y / static_cast<float>(frame.picture->height())),
                      .opacity = saturate<std::uint8_t>(std::ceil(label.opacity * 255.0F))});
  }
  return labels;
}

MovingPart movingPartOf(const node::Mover& mover) {
  const auto centimetres = [](float metres) { return saturate<std::uint16_t>(std::lround(metres * 100.0F)); };
  return {.left = saturate<std::uint16_t>(mover.rect.left),
          .top = saturate<std::uint16_t>(mover.rect.top),
          .right = saturate<std::uint16_t>(mover.rect.right),
          .bottom = saturate<std::uint16_t>(mover.rect.bottom),
          .nearestCentimetres = centimetres(mover.nearest),
          .farthestCentimetres = centimetres(mover.farthest),
          .velocity = {mover.velocity.x, mover.velocity.z}};
}

Space spaceOf(const node::FinishedFrame& frame) {
  const node::View& view = *frame.view;
  Space space;
  space.eye = view.camera.pose.position;
  space.visitor = view.viewerEye;
  space.velocity = {view.viewerVelocity.x, view.viewerVelocity.z};
  space.sinceInputMicroseconds = saturate<std::uint32_t>(view.inputAge * 1e6);
  static_assert(node::kMaxMoversPerFrame <= kMaxMovingParts);
  std::ranges::transform(frame.movers, std::back_inserter(space.moving), movingPartOf);
  encodeNearness(NearnessGrid(*frame.nearness), space.nearness);
  return space;
}

}  // namespace

EncodeStage::EncodeStage(std::shared_ptr<StreamControl> control, PageLevel page, std::vector<world::Vec3> fires,
                         Outputs outputs, pipeline::MemoryLedger& memory, pipeline::Executor& executor,
                         pipeline::Timeline& timeline)
    : Stage({.name = "Encoder",
             .work = pipeline::Work::kPerUserFrontend,
             .capacity = 1,
             .overflow = pipeline::Overflow::kDropOldest,
             .finishes = true},
            executor, timeline),
      control_(std::move(control)),
      asPictures_(page >= PageLevel::kAdaptive),
      page_(page),
      fires_(std::move(fires)),
      outputs_(std::move(outputs)),
      held_(memory, "encoders", "", pipeline::Work::kPerUserFrontend) {}

void EncodeStage::process(std::span<node::FinishedFrame> items, pipeline::Run& /*run*/) {
  for (const node::FinishedFrame& item : items) encodeNext(item);
}

void EncodeStage::encodeNext(const node::FinishedFrame& frame) {
  if (const auto number = control_->takeCapture(frame.view->frame)) {
    capture(frame, *number);
    return;
  }
  const EncoderKind& kind = control_->kind();
  Encoder* encoder = encoderOf(kind);
  if (encoder == nullptr) return;
  const world::Camera& camera = frame.view->camera;
  const bool still = lastCamera_ == camera;
  const bool same = asPictures_ && isSame(frame, still);
  lastCamera_ = camera;
  const double pixels = static_cast<double>(frame.picture->width()) * frame.picture->height();
  StreamControl::Choice choice = control_->choose(kind, encoder->range(), pixels, still, same, pipeline::wallSeconds());
  if (same && !choice.order.independent && choice.order.quantiser >= lastQuantiser_) {
    control_->unchanged(frame.view->lastInput);
    return;
  }
  if (encoder->usesMotion()) choice.order.motion = motion_.next(frame);
  const double began = pipeline::wallSeconds();
  control_->took(FrameTimes::Place::kDrawing, began - frame.view->time);
  const std::shared_ptr<EncodedFrame> made = begin(frame);
  const std::size_t before = made->bytes.size();
  bool independent = true;
  try {
    independent = encoder->encode(*frame.picture, choice.order, made->bytes);
  } catch (const EnvironmentError& e) {
    // The encoder's state is unknown; a new one starts with an independent picture, of another codec if there is one.
    log::error(e.what());
    encoder_.reset();
    control_->failed(kind);
    return;
  }
  control_->took(FrameTimes::Place::kEncoder, pipeline::wallSeconds() - began);
  lastQuantiser_ = choice.order.quantiser;
  control_->encoded(choice, independent, pixels, made->bytes.size() - before);
  lastBytes_ = made->bytes.size();
  made->allowedBytes = choice.bytes;
  made->header.codec = encoder->codec();
  made->header.independent = independent;
  made->header.serverMicroseconds = saturate<std::uint32_t>((pipeline::wallSeconds() - frame.view->time) * 1e6);
  writeHeader(*made);
  held_.set(encoder->bytes() + motion_.bytes() + made->bytes.capacity());
  outputs_.frame(made);
}

void EncodeStage::writeHeader(EncodedFrame& made) const {
  const std::span room = std::span(made.bytes).subspan<EncodedFrame::kHeadroom>();
  if (asPictures_) {
    encode(made.header, room.first(pictureHeaderBytes(made.header)));
  } else {
    encode(static_cast<const FrameHeader&>(made.header), room.first<kFrameHeaderBytes>());
  }
}

void EncodeStage::capture(const node::FinishedFrame& frame, std::uint32_t number) {
  CapturedHeader header;
  header.width = saturate<std::uint16_t>(frame.picture->width());
  header.height = saturate<std::uint16_t>(frame.picture->height());
  header.number = number;
  std::vector<std::uint8_t> message(kCapturedHeaderBytes);
  encode(header, std::span(message).first<kCapturedHeaderBytes>());
  try {
    JpegEncoder encoder(kCaptureQuality);
    encoder.encode(*frame.picture, {.quantiser = encoder.range().usual, .independent = true}, message);
  } catch (const EnvironmentError& e) {
    log::error(e.what());
    return;
  }
  outputs_.captured(std::move(message));
}

Encoder* EncodeStage::encoderOf(const EncoderKind& kind) {
  if (encoder_ && kind_ == kind.name) return encoder_.get();
  try {
    encoder_ = kind.make();
    kind_ = kind.name;
    motion_ = {};
    lastCamera_.reset();
  } catch (const EnvironmentError& e) {
    log::error(e.what());
    encoder_.reset();
    control_->failed(kind);
  }
  return encoder_.get();
}

bool EncodeStage::isSame(const node::FinishedFrame& frame, bool still) {
  if (!still) {
    lastHash_ = 0;
    return false;
  }
  const std::uint64_t hash = checksumOf(std::as_bytes(std::span(frame.picture->bytes)));
  return std::exchange(lastHash_, hash) == hash;
}

std::shared_ptr<EncodedFrame> EncodeStage::begin(const node::FinishedFrame& frame) const {
  auto made = std::make_shared<EncodedFrame>();
  made->header = describe(frame);
  if (page_ >= PageLevel::kNaming) {
    made->header.fire = nearnessOf(fires_, frame.view->camera.pose.position);
    made->header.labels = labelsOf(frame);
  }
  if (control_->wantsNearness() && frame.nearness) made->header.space = spaceOf(frame);
  const std::size_t header =
      EncodedFrame::kHeadroom + (asPictures_ ? pictureHeaderBytes(made->header) : kFrameHeaderBytes);
  // Neighbouring frames have similar sizes: a little more room than the last one avoids growing.
  made->bytes.reserve(header + lastBytes_ + lastBytes_ / 8);
  made->bytes.resize(header);
  return made;
}

}  // namespace grove::stream
