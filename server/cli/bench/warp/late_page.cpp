#include "cli/bench/warp/late_page.h"

#include <array>
#include <cmath>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "cli/bench/encode/walk_stream.h"
#include "cli/bench/warp/page_warp.h"
#include "pipeline/clocks.h"
#include "stream/late_walk/nearness_code.h"
#include "stream/late_walk/nearness_grid.h"
#include "stream/protocol/protocol.h"
#include "stream/session/host.h"

namespace grove::cli {
namespace {

/// Rate of the visitor's stream.
constexpr int kKilobits = 5000;
/// From the server's camera to the picture on the screen, beyond the line's round trip: drawing, encoding, decoding and
/// waiting for the display, milliseconds.
constexpr double kServerMilliseconds = 40.0;

/// A picture as the page has it.
struct Arrived {
  std::size_t drawn = 0;    ///< when the display had this frame
  std::size_t visible = 0;  ///< first frame of the display that shows it
  std::shared_ptr<const node::View> view;
  std::vector<std::uint32_t> colours;
  stream::NearnessGrid grid;
};

std::vector<std::uint32_t> windowOfFrame(const raster::YuvImage& frame, const world::Camera& window) {
  const std::vector<std::uint32_t> all = raster::rgbaOf(frame);
  const int left = (frame.width() - window.width) / 2;
  const int top = (frame.height() - window.height) / 2;
  std::vector<std::uint32_t> part;
  part.reserve(static_cast<std::size_t>(window.width) * static_cast<std::size_t>(window.height));
  for (int y = top; y < top + window.height; ++y) {
    const auto begin = all.begin() + std::ptrdiff_t{y} * frame.width() + left;
    part.insert(part.end(), begin, begin + window.width);
  }
  return part;
}

/// Shows what has arrived, and compares.
class LatePage {
 public:
  explicit LatePage(int frameWidth) : frameWidth_(frameWidth) {}

  void receive(Arrived picture) { onTheWay_.push_back(std::move(picture)); }

  /// The display shows its frame number `index`; `truth` is what the visitor should see.
  void show(std::size_t index, const node::FinishedFrame& truth, WarpReport& report) {
    while (!onTheWay_.empty() && onTheWay_.front().visible <= index) {
      shown_ = std::move(onTheWay_.front());
      onTheWay_.pop_front();
    }
    if (shown_) compare(truth, *shown_, report);
  }

  /// The picture on the screen, as compared last; null before the first.
  [[nodiscard]] const Arrived* shown() const { return shown_ ? &*shown_ : nullptr; }
  [[nodiscard]] const std::vector<std::uint32_t>& moved() const { return moved_; }

 private:
  void compare(const node::FinishedFrame& frame, const Arrived& shown, WarpReport& report) {
    const PagePicture source{{shown.colours, frameWidth_}, shown.grid, shown.view->camera};
    const world::Camera display = windowOf(frame.view->camera, kWarpBorderPercent);
    const std::vector<std::uint32_t> truth = windowOfFrame(*frame.picture, display);
    const measure::Mask all(truth.size(), 1);
    const auto add = [&](const world::Camera& eye, Errors& errors) {
      std::vector<std::uint32_t> colours = warpedByPage(source, eye, {display.width, display.height});
      errors.add(measure::meanSquareError({colours, display.width}, {truth, display.width}, all));
      return colours;
    };
    world::Camera window = windowOf(shown.view->camera, kWarpBorderPercent);
    static_cast<void>(add(window, report.none));
    window.pose = frame.view->camera.pose;
    moved_ = add(window, report.moved);
    window.pose.position = shown.view->camera.pose.position;
    static_cast<void>(add(window, report.turned));
    ++report.frames;
  }

  const int frameWidth_;
  std::deque<Arrived> onTheWay_;
  std::optional<Arrived> shown_;
  std::vector<std::uint32_t> moved_;
};

/// Streams frames through encoder and decoder, with the nearness of their surfaces.
class Sender {
 public:
  explicit Sender(const SentWalk& frames)
      : encoders_(stream::builtinEncoders(stream::HostOptions().jpegQuality)),
        kind_(encoders_.choose(std::array{stream::kCodecH264})),
        encoder_(encoders_, kind_,
                 {std::nullopt, kKilobits, kDisplayFramesPerSecond / static_cast<double>(frames.step)},
                 frames.sent.width(), frames.sent.height()),
        decoder_(kind_.codec) {}

  [[nodiscard]] Arrived send(const node::FinishedFrame& frame, WarpReport& report) {
    if (const auto picture = encoder_.send(frame)) {
      decoder_.show(*picture);
      report.pictureBytes += static_cast<double>(picture->bytes.size());
    }
    code_.clear();
    const std::int64_t begin = pipeline::threadCpuNanoseconds();
    stream::encodeNearness(stream::NearnessGrid(*frame.nearness), code_);
    report.cpuMilliseconds += static_cast<double>(pipeline::threadCpuNanoseconds() - begin) * 1e-6;
    report.spaceBytes += static_cast<double>(stream::kSpaceBytes + code_.size());
    const world::Camera& camera = frame.view->camera;
    return {0, 0, frame.view, decoder_.shown().colour,
            stream::decodeNearness(code_, camera.width, camera.height).value()};
  }

 private:
  const stream::EncoderRegistry encoders_;
  const stream::EncoderKind& kind_;
  WalkEncoder encoder_;
  WalkDecoder decoder_;
  std::vector<std::uint8_t> code_;
};

}  // namespace

WarpReport showLate(SentWalk& frames, double delay, Film* film, const std::stop_token& stop) {
  const auto age = static_cast<std::size_t>(std::ceil((delay + kServerMilliseconds) * 1e-3 * kDisplayFramesPerSecond));
  Sender sender(frames);
  LatePage page(frames.sent.width());
  WarpReport report;
  for (std::size_t i = 0; i < frames.truth.count() && !stop.stop_requested(); ++i) {
    if (i % frames.step == 0) {
      Arrived picture = sender.send(frames.sent.read(i / frames.step), report);
      picture.drawn = i;
      picture.visible = i + age;
      page.receive(std::move(picture));
    }
    page.show(i, frames.truth.read(i), report);
    if (film != nullptr && page.shown() != nullptr) {
      const node::FinishedFrame drawn = frames.truth.read(page.shown()->drawn);
      film->add(windowOfFrame(*drawn.picture, windowOf(drawn.view->camera, kWarpBorderPercent)), page.moved());
    }
  }
  report.cpuMilliseconds /= static_cast<double>(std::max<std::size_t>(frames.sent.count(), 1));
  return report;
}

}  // namespace grove::cli
