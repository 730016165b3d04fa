#include "cli/bench/encode/encode_trial.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "cli/bench/codec_names.h"
#include "cli/figures.h"
#include "measure/percentile.h"
#include "measure/pictures/picture_quality.h"

namespace grove::cli {
namespace {

/// Comparing two pictures takes ten times as long as encoding one.
constexpr std::size_t kFramesPerComparison = 10;
double likeness(const stream::DecodedPicture& shown, const raster::YuvImage& frame) {
  const std::vector<std::uint32_t> colours = raster::rgbaOf(frame);
  const measure::Mask all(colours.size(), 1);
  return measure::structuralSimilarity({colours, frame.width()}, {shown.colour, shown.width}, all);
}

void report(const WalkEncoder& encoder, EncodeTrial& trial) {
  const std::vector<double>& times = encoder.times();
  trial.pictures = times.size();
  trial.quantiser = encoder.quantiser();
  trial.cpuMilliseconds = median(times);
  trial.meanMilliseconds = std::accumulate(times.begin(), times.end(), 0.0) / static_cast<double>(times.size());
  trial.p99Milliseconds = measure::percentile(times, 0.99);
  trial.kilobitsPerSecond = encoder.kilobitsPerSecond();
}

}  // namespace

EncodeTrial tryEncoder(const stream::EncoderRegistry& encoders, const stream::EncoderKind& kind,
                       const EncodeSetting& setting, KeptFrames& frames, const std::stop_token& stop,
                       const std::function<void(std::span<const std::uint8_t>)>& keep) {
  EncodeTrial trial{.codec = codecName(kind.codec), .encoder = kind.name, .setting = setting};
  trial.minSsim = 1.0;
  WalkEncoder encoder(encoders, kind, setting, frames.width(), frames.height());
  WalkDecoder page(kind.codec);
  std::size_t compared = 0;
  for (std::size_t i = 0; i < frames.count() && (i == 0 || !stop.stop_requested()); ++i) {
    const node::FinishedFrame frame = frames.read(i);
    if (const auto picture = encoder.send(frame)) {
      page.show(*picture);
      if (keep) keep(picture->bytes);
    }
    if (i % kFramesPerComparison != 0) continue;
    const double ssim = likeness(page.shown(), *frame.picture);
    trial.ssim += ssim;
    trial.minSsim = std::min(trial.minSsim, ssim);
    ++compared;
  }
  trial.ssim /= static_cast<double>(compared);
  report(encoder, trial);
  return trial;
}

}  // namespace grove::cli
