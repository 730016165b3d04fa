#include "cli/bench/encode/encode_trial.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "base/checksum.h"
#include "base/error.h"
#include "cli/bench/codec_names.h"
#include "cli/bench/walk/walk_world.h"
#include "cli/figures.h"
#include "measure/percentile.h"
#include "measure/pictures/picture_quality.h"
#include "pipeline/clocks.h"
#include "stream/adapt/stream_control.h"
#include "stream/encode/h264_decoder.h"
#include "stream/encode/jpeg_decoder.h"
#include "stream/encode/scene_motion.h"

namespace grove::cli {
namespace {

/// Comparing two pictures takes ten times as long as encoding one.
constexpr std::size_t kFramesPerComparison = 10;
/// Of a line that is faster than the visitor's limit, seconds.
constexpr double kRoundTrip = 0.020;

double asMilliseconds(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) * 1e-6; }

/// Decodes a stream as a page does.
class Screen {
 public:
  explicit Screen(std::uint8_t codec) : codec_(codec) {}

  void show(std::span<const std::uint8_t> picture) {
    shown_ = codec_ == stream::kCodecJpeg ? jpeg_.decode(picture) : h264_.decode(picture);
    if (shown_ == nullptr) throw EnvironmentError("makes pictures that cannot be decoded", "encoder", "");
  }

  [[nodiscard]] double likeness(const raster::YuvImage& frame) const {
    const std::vector<std::uint32_t> colours = raster::rgbaOf(frame);
    const measure::Mask all(colours.size(), 1);
    return measure::structuralSimilarity({colours, frame.width()}, {shown_->colour, shown_->width}, all);
  }

 private:
  const std::uint8_t codec_;
  stream::JpegDecoder jpeg_;
  stream::H264Decoder h264_;
  const stream::DecodedPicture* shown_ = nullptr;
};

/// Does what stream::EncodeStage does with a frame, and measures its time.
class Visitor {
 public:
  Visitor(const stream::EncoderRegistry& encoders, const stream::EncoderKind& kind, const EncodeSetting& setting,
          int width, int height)
      : kind_(kind),
        setting_(setting),
        control_(encoders, std::make_shared<stream::Governor>([] { return 0.0; }), stream::PageLevel::kAdaptive,
                 kWalkFramesPerSecond, width, height),
        encoder_(kind.make()) {
    stream::Limits limits;
    limits.kilobitsPerSecond = static_cast<std::uint32_t>(setting.kilobitsPerSecond);
    control_.limit(limits);
  }

  /// Returns the bytes to send to a page that shows the previous frames; empty if nothing is sent.
  [[nodiscard]] std::span<const std::uint8_t> send(const node::FinishedFrame& frame) {
    const double now = ++frames_ / kWalkFramesPerSecond;
    const world::Camera& camera = frame.view->camera;
    const double pixels = static_cast<double>(frame.picture->width()) * frame.picture->height();
    const bool still = camera_ == camera;
    const std::uint64_t hash = checksumOf(std::as_bytes(std::span(frame.picture->bytes)));
    const bool same = still && hash == hash_;
    camera_ = camera;
    hash_ = hash;
    stream::StreamControl::Choice choice = control_.choose(kind_, encoder_->range(), pixels, still, same, now);
    if (setting_.quantiser) choice.order.quantiser = *setting_.quantiser;
    if (same && !choice.order.independent && choice.order.quantiser >= quantiser_) return {};
    quantiser_ = choice.order.quantiser;
    bytes_.clear();
    const std::int64_t begin = pipeline::threadCpuNanoseconds();
    if (encoder_->usesMotion()) choice.order.motion = motion_.next(camera, frame.nearness.get());
    const bool independent = encoder_->encode(*frame.picture, choice.order, bytes_);
    times_.push_back(asMilliseconds(pipeline::threadCpuNanoseconds() - begin));
    quantisers_ += quantiser_;
    sent_ += bytes_.size();
    control_.encoded(choice, independent, pixels, bytes_.size());
    control_.sent(static_cast<std::uint32_t>(frames_), 0, bytes_.size(), choice.bytes, now);
    static_cast<void>(control_.acknowledged(static_cast<std::uint32_t>(frames_),
                                            {.acknowledged = now + kRoundTrip, .pageSeconds = now + kRoundTrip / 2}));
    return bytes_;
  }

  void report(EncodeTrial& trial) const {
    trial.pictures = times_.size();
    trial.quantiser = quantisers_ / static_cast<double>(times_.size());
    trial.cpuMilliseconds = median(times_);
    trial.meanMilliseconds = std::accumulate(times_.begin(), times_.end(), 0.0) / static_cast<double>(times_.size());
    trial.p99Milliseconds = measure::percentile(times_, 0.99);
    trial.kilobitsPerSecond = 8e-3 * static_cast<double>(sent_) * kWalkFramesPerSecond / frames_;
  }

 private:
  const stream::EncoderKind& kind_;
  const EncodeSetting setting_;
  stream::StreamControl control_;
  const std::unique_ptr<stream::Encoder> encoder_;
  int frames_ = 0;
  std::optional<world::Camera> camera_;
  stream::SceneMotion motion_;
  std::uint64_t hash_ = 0;
  stream::Quantiser quantiser_ = 0.0;
  std::vector<std::uint8_t> bytes_;
  std::size_t sent_ = 0;
  std::vector<double> times_;
  double quantisers_ = 0.0;
};

}  // namespace

EncodeTrial tryEncoder(const stream::EncoderRegistry& encoders, const stream::EncoderKind& kind,
                       const EncodeSetting& setting, KeptFrames& frames, const std::stop_token& stop,
                       const std::function<void(std::span<const std::uint8_t>)>& keep) {
  EncodeTrial trial{.codec = codecName(kind.codec), .encoder = kind.name, .setting = setting};
  trial.minSsim = 1.0;
  Visitor visitor(encoders, kind, setting, frames.width(), frames.height());
  Screen screen(kind.codec);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < frames.count() && (i == 0 || !stop.stop_requested()); ++i) {
    const node::FinishedFrame frame = frames.read(i);
    if (const auto picture = visitor.send(frame); !picture.empty()) {
      screen.show(picture);
      if (keep) keep(picture);
    }
    if (i % kFramesPerComparison != 0) continue;
    const double ssim = screen.likeness(*frame.picture);
    trial.ssim += ssim;
    trial.minSsim = std::min(trial.minSsim, ssim);
    ++compared;
  }
  trial.ssim /= static_cast<double>(compared);
  visitor.report(trial);
  return trial;
}

}  // namespace grove::cli
