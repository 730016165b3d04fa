#include "stream/adapt/stream_control.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "stream/protocol/saturate.h"

namespace grove::stream {
namespace {

/// Usable share of the estimated rate; the rest covers errors of the estimate.
constexpr double kUsable = 0.8;
/// Rate for refining the picture, and for smoke, while the camera stands still.
constexpr double kStillBitsPerSecond = 1.3e6;
/// Refinement proceeds in steps, so that no single picture takes long.
constexpr Quantiser kRefinement = 2.0;
constexpr double kIndependentSeconds = 0.25;
/// A view counts as still after this: a visitor who stops for a moment will walk on.
constexpr double kStillSeconds = 2.0;
/// Percent.
constexpr int kBorderStep = 6;
constexpr int kBorderSteps = 2;
constexpr double kBorderHysteresis = 0.3;
/// A picture that is coarser than usual by this has no border.
constexpr Quantiser kBorderQuantisers = 6.0;
/// Of the idle line: below the first, late look has nothing to hide; from the second on it gets the full border.
constexpr double kShortRoundTrip = 0.030;
constexpr double kLongRoundTrip = 0.100;
/// Smaller limits are raised to these.
constexpr double kMinKilobits = 200.0;
constexpr int kMinLines = 90;
/// Measured on a walk through the grove, in JPEG of the usual quality.
constexpr double kJpegBitsPerPixel = 1.1;
/// A trial of JPEG begins with this multiple of its bit rate.
constexpr double kTrust = 1.3;

}  // namespace

StreamControl::StreamControl(const EncoderRegistry& encoders, std::shared_ptr<Governor> governor, PageLevel page,
                             double framesPerSecond, int width, int height)
    : encoders_(encoders),
      page_(page),
      serverFramesPerSecond_(framesPerSecond),
      width_(width),
      height_(height),
      governed_(std::move(governor)) {
  // Before the first frame nothing speaks against the full wish.
  policy_.update(0.0, wish(governed_.scale()), {.bitsPerSecond = std::numeric_limits<double>::infinity()});
}

void StreamControl::resize(int width, int height) {
  const std::lock_guard lock(mutex_);
  width_ = width;
  height_ = height;
}

void StreamControl::offer(std::vector<std::uint8_t> codecs) {
  const std::lock_guard lock(mutex_);
  offer_ = std::move(codecs);
}

void StreamControl::limit(const Limits& limits) {
  const std::lock_guard lock(mutex_);
  // A hidden page may have lost its decoder.
  if (limits_.hidden && !limits.hidden) wantsIndependent_ = true;
  limits_ = limits;
}

void StreamControl::broken() {
  const std::lock_guard lock(mutex_);
  wantsIndependent_ = true;
}

void StreamControl::capture(std::uint32_t number) {
  const std::lock_guard lock(mutex_);
  capture_.ask(number);
}

bool StreamControl::acknowledged(std::uint32_t frame, const Arrival& arrival) {
  const std::lock_guard lock(mutex_);
  if (frame > newestSent_) return false;
  const std::size_t before = link_.framesUnderWay();
  link_.arrived(frame, arrival);
  work_.held(arrival.held);
  if (page_ >= PageLevel::kTimed) times_.add(FrameTimes::Place::kLine, 0.5 * link_.roundTrip() + link_.queueing());
  if (link_.framesUnderWay() < before) unacknowledgedSince_ = arrival.acknowledged;
  return true;
}

double StreamControl::secondsUnacknowledged(double now) const {
  const std::lock_guard lock(mutex_);
  return link_.framesUnderWay() == 0 || limits_.hidden ? 0.0 : now - unacknowledgedSince_;
}

StreamWish StreamControl::wish(double scale) const {
  StreamWish wish;
  if (limits_.lines > 0) scale = std::min(scale, std::max<double>(kMinLines, limits_.lines) / height_);
  wish.width = static_cast<int>(std::lround(width_ * scale));
  wish.height = static_cast<int>(std::lround(height_ * scale));
  wish.framesPerSecond = serverFramesPerSecond_;
  if (limits_.framesPerSecond > 0)
    wish.framesPerSecond = std::min<double>(wish.framesPerSecond, limits_.framesPerSecond);
  return wish;
}

double StreamControl::wantedBitsPerSecond() const {
  return limits_.kilobitsPerSecond > 0 ? std::max<double>(kMinKilobits, limits_.kilobitsPerSecond) * 1000.0
                                       : LinkEstimator::kMaxBitsPerSecond;
}

double StreamControl::bitsPerSecond() const { return kUsable * std::min(link_.bitsPerSecond(), wantedBitsPerSecond()); }

void StreamControl::plan(double now) {
  if (page_ == PageLevel::kBasic) {
    policy_.update(now, wish(1.0), {.bitsPerSecond = std::numeric_limits<double>::infinity()});
    return;
  }
  const double scale = governed_.update(work_.pace(policy_.plan().framesPerSecond, now), now);
  policy_.update(now, work_.relieve(wish(scale), now),
                 {.bitsPerSecond = bitsPerSecond(),
                  .bitsPerPixel = quantisers_.complexity(),
                  .framesPerSecond = work_.framesPerSecond(),
                  .finest = range_.finest,
                  .coarsest = range_.coarsest,
                  .isTried = link_.isMeasured()});
  planCodec(now);
}

void StreamControl::planCodec(double now) {
  const StreamPlan& plan = policy_.plan();
  const double jpeg =
      kJpegBitsPerPixel * plan.width * plan.height * std::min(plan.framesPerSecond, work_.framesPerSecond());
  const bool before = codecChoice_.savesWork();
  const bool savesWork = codecChoice_.update(
      now, {.isWorkScarce = work_.shortOf() == LimitedBy::kMachine || governed_.scale() < 1.0,
            .isBrowserShort = work_.shortOf() == LimitedBy::kBrowser,
            .isStill = now - moved_ > kStillSeconds,
            .isLineScarce = plan.limitedBy == LimitedBy::kLine || work_.shortOf() == LimitedBy::kLine,
            .lineBitsPerSecond = bitsPerSecond(),
            .provenBitsPerSecond = std::min(link_.proven(), wantedBitsPerSecond()),
            .workSaverBitsPerSecond = jpeg});
  if (savesWork && !before) link_.trust(kTrust * jpeg / kUsable);
}

void StreamControl::planBorder() {
  const bool hasRoom = policy_.plan().limitedBy == LimitedBy::kNothing && work_.shortOf() == LimitedBy::kNothing &&
                       newestQuantiser_ <= range_.usual + (borderSteps_ > 0 ? kBorderQuantisers : 0.0);
  if (page_ == PageLevel::kBasic || !limits_.border || !hasRoom) {
    borderSteps_ = 0;
    return;
  }
  const double share = (link_.roundTrip() - kShortRoundTrip) / (kLongRoundTrip - kShortRoundTrip);
  const double steps = kBorderSteps * std::clamp(share, 0.0, 1.0);
  // Each change begins with an independent picture, so changes need hysteresis.
  if (steps >= borderSteps_ + 1 || steps < borderSteps_ - kBorderHysteresis) borderSteps_ = static_cast<int>(steps);
}

bool StreamControl::isHidden() const {
  const std::lock_guard lock(mutex_);
  return limits_.hidden;
}

bool StreamControl::mayBegin(double now, int beingMade) {
  const std::lock_guard lock(mutex_);
  if (limits_.hidden) {
    work_.rest();
    governed_.rest();
    return false;
  }
  link_.look(now);
  plan(now);
  planBorder();
  if (!link_.isFull(now, policy_.plan().framesPerSecond, static_cast<std::size_t>(beingMade))) return true;
  work_.waitsForPage(link_, now);
  return false;
}

void StreamControl::waitsForServer(double now) {
  const std::lock_guard lock(mutex_);
  work_.waitsForServer(now);
}

void StreamControl::begins(double now) {
  const std::lock_guard lock(mutex_);
  took(FrameTimes::Place::kQueue, work_.begins(now), lock);
}

double StreamControl::framesPerSecond() const {
  const std::lock_guard lock(mutex_);
  return policy_.plan().framesPerSecond;
}

int StreamControl::aim(world::Camera& camera, std::uint32_t frame, double now) {
  const std::lock_guard lock(mutex_);
  if (capture_.begin(frame, now)) {
    camera.width = width_;
    camera.height = height_;
    return 0;
  }
  const StreamPlan& plan = policy_.plan();
  camera.width = plan.width;
  camera.height = plan.height;
  const int border = borderSteps_ * kBorderStep;
  if (border == 0) return 0;
  const double wider = 1.0 + border / 100.0;
  camera.verticalFov = static_cast<float>(2.0 * std::atan(wider * std::tan(0.5 * camera.verticalFov)));
  std::tie(camera.width, camera.height) =
      fitSize(saturate<std::uint32_t>(plan.width * wider), saturate<std::uint32_t>(plan.height * wider));
  return border;
}

std::optional<std::uint32_t> StreamControl::takeCapture(std::uint32_t frame) {
  const std::lock_guard lock(mutex_);
  return capture_.take(frame);
}

const EncoderKind& StreamControl::kind() const {
  const std::lock_guard lock(mutex_);
  // A visitor who insists on a codec offers only that one.
  constexpr std::array<std::uint8_t, 1> kSavesWork{kCodecJpeg};
  if (codecChoice_.savesWork() && std::ranges::find(offer_, kCodecJpeg) != offer_.end()) {
    return encoders_.choose(kSavesWork);
  }
  std::vector<std::uint8_t> codecs = offer_;
  std::erase_if(codecs, [&](std::uint8_t codec) { return std::ranges::find(failed_, codec) != failed_.end(); });
  return encoders_.choose(codecs);
}

void StreamControl::failed(const EncoderKind& kind) {
  const std::lock_guard lock(mutex_);
  failed_.push_back(kind.codec);
}

StreamControl::Choice StreamControl::choose(const EncoderKind& kind, const QuantiserRange& range, double pixels,
                                            bool still, bool same, double now) {
  const std::lock_guard lock(mutex_);
  range_ = range;
  if (!still) moved_ = now;
  Choice choice{&kind, {range.usual, false}, 0.0};
  if (wantsIndependent_ && now - independentMade_ >= kIndependentSeconds) {
    choice.order.independent = true;
    wantsIndependent_ = false;
    independentMade_ = now;
  }
  if (page_ == PageLevel::kBasic) return choice;
  const auto within = [&](double bits, Quantiser finest) {
    choice.bytes = bits / 8.0 / std::min(policy_.plan().framesPerSecond, work_.framesPerSecond());
    const Quantiser wanted = quantisers_.choose(choice.order.independent, pixels, choice.bytes);
    return std::ceil(std::clamp(wanted, std::min(finest, range.coarsest), range.coarsest));
  };
  const Quantiser moving = within(bitsPerSecond(), range.usual);
  choice.order.quantiser = moving;
  // A dependent picture costs only its improvement; other codecs refine only when nothing moves at all.
  if (same || (still && kind.chained)) {
    const Quantiser finer = std::max(range.finest, newestQuantiser_ - kRefinement);
    choice.order.quantiser = std::min(moving, within(std::min(bitsPerSecond(), kStillBitsPerSecond), finer));
  }
  return choice;
}

void StreamControl::encoded(const Choice& choice, bool independent, double pixels, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  newestQuantiser_ = choice.order.quantiser;
  quantisers_.encoded(independent && choice.kind->chained, pixels, choice.order.quantiser, static_cast<double>(bytes),
                      choice.bytes);
}

void StreamControl::took(FrameTimes::Place place, double seconds) {
  const std::lock_guard lock(mutex_);
  took(place, seconds, lock);
}

void StreamControl::took(FrameTimes::Place place, double seconds, const std::lock_guard<std::mutex>& /*held*/) {
  if (page_ >= PageLevel::kTimed) times_.add(place, seconds);
}

void StreamControl::unchanged(std::uint32_t lastInput) {
  const std::lock_guard lock(mutex_);
  quantisers_.rested();
  lastInput_ = std::max(lastInput_, lastInput);
}

void StreamControl::sent(std::uint32_t frame, std::uint32_t lastInput, std::size_t bytes, double allowed, double now) {
  const std::lock_guard lock(mutex_);
  if (link_.framesUnderWay() == 0) unacknowledgedSince_ = now;
  newestSent_ = std::max(newestSent_, frame);
  lastInput_ = lastInputReported_ = std::max(lastInput_, lastInput);
  wordSince_ = now;
  link_.sent(frame, bytes, allowed, now);
}

void StreamControl::written(std::uint32_t frame, double reached, double now) {
  const std::lock_guard lock(mutex_);
  const std::optional<double> waited = link_.handedOver(frame, reached);
  if (waited) took(FrameTimes::Place::kSocket, *waited + now - reached, lock);
}

}  // namespace grove::stream
