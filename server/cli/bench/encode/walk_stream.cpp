#include "cli/bench/encode/walk_stream.h"

#include "base/checksum.h"
#include "base/error.h"
#include "pipeline/clocks.h"

namespace grove::cli {
namespace {

/// Of a line that is faster than the visitor's limit, seconds.
constexpr double kRoundTrip = 0.020;

double asMilliseconds(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-6; }

}  // namespace

WalkEncoder::WalkEncoder(const stream::EncoderRegistry& encoders, const stream::EncoderKind& kind,
                         const EncodeSetting& setting, int width, int height)
    : kind_(kind),
      setting_(setting),
      control_(encoders, std::make_shared<stream::Governor>([] { return 0.0; }), stream::PageLevel::kAdaptive,
               setting.framesPerSecond, width, height),
      encoder_(kind.make()) {
  stream::Limits limits;
  limits.kilobitsPerSecond = static_cast<std::uint32_t>(setting.kilobitsPerSecond);
  control_.limit(limits);
}

std::optional<SentPicture> WalkEncoder::send(const node::FinishedFrame& frame) {
  const double now = ++frames_ / setting_.framesPerSecond;
  const world::Camera& camera = frame.view->camera;
  const double pixels = static_cast<double>(frame.picture->width()) * frame.picture->height();
  const bool still = camera_ == camera;
  const std::uint64_t hash = checksumOf(std::as_bytes(std::span(frame.picture->bytes)));
  const bool same = still && hash == hash_;
  camera_ = camera;
  hash_ = hash;
  stream::StreamControl::Choice choice = control_.choose(kind_, encoder_->range(), pixels, still, same, now);
  if (setting_.quantiser) choice.order.quantiser = *setting_.quantiser;
  if (same && !choice.order.independent && choice.order.quantiser >= quantiser_) return std::nullopt;
  quantiser_ = choice.order.quantiser;
  bytes_.clear();
  const std::int64_t begin = pipeline::threadCpuNanoseconds();
  if (encoder_->usesMotion()) choice.order.motion = motion_.next(frame);
  const bool independent = encoder_->encode(*frame.picture, choice.order, bytes_);
  times_.push_back(asMilliseconds(pipeline::threadCpuNanoseconds() - begin));
  quantisers_ += quantiser_;
  sent_ += bytes_.size();
  control_.encoded(choice, independent, pixels, bytes_.size());
  control_.sent(static_cast<std::uint32_t>(frames_), 0, bytes_.size(), choice.bytes, now);
  static_cast<void>(control_.acknowledged(static_cast<std::uint32_t>(frames_),
                                          {.acknowledged = now + kRoundTrip, .pageSeconds = now + kRoundTrip / 2}));
  return SentPicture{bytes_, independent};
}

double WalkEncoder::kilobitsPerSecond() const noexcept {
  return 8e-3 * static_cast<double>(sent_) * setting_.framesPerSecond / frames_;
}

void WalkDecoder::show(const SentPicture& picture) {
  shown_ = decode(picture);
  if (shown_ == nullptr) throw EnvironmentError("makes pictures that cannot be decoded", "encoder", "");
}

const stream::DecodedPicture* WalkDecoder::decode(const SentPicture& picture) {
  if (codec_ == stream::kCodecH264) return h264_.decode(picture.bytes);
  return codec_ == stream::kCodecJpeg ? jpeg_.decode(picture.bytes)
                                      : patches_.decode(picture.bytes, picture.independent);
}

}  // namespace grove::cli
