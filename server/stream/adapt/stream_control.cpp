#include "stream/adapt/stream_control.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "stream/protocol/saturate.h"

namespace grove::stream {
namespace {

/// Of what the line carries; the rest is for what the estimate is wrong by.
constexpr double kUsable = 0.8;
/// While the camera stands, the picture is refined within this, and smoke goes on in it.
constexpr double kStillBitsPerSecond = 1.3e6;
/// A picture gets finer step by step, so that no single one takes long.
constexpr Quantiser kRefinement = 2.0;
constexpr double kIndependentSeconds = 0.25;
constexpr double kStatusSeconds = 0.5;
/// Percent.
constexpr int kBorderStep = 6;
constexpr int kBorderSteps = 2;
constexpr double kBorderHysteresis = 0.3;
/// Coarser than usual by this, a picture does without its border.
constexpr Quantiser kBorderQuantisers = 6.0;
/// Of the idle line: below the first, late look has nothing to hide; from the second on it gets the whole border.
constexpr double kShortRoundTrip = 0.030;
constexpr double kLongRoundTrip = 0.100;
/// Nobody expects less of a limit than this.
constexpr double kMinKilobits = 200.0;
constexpr int kMinLines = 90;

}  // namespace

StreamControl::StreamControl(const EncoderRegistry& encoders, bool adapts, double framesPerSecond, int width,
                             int height)
    : encoders_(encoders), adapts_(adapts), serverFramesPerSecond_(framesPerSecond), width_(width), height_(height) {
  plan(0.0);
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
  // A page that nobody looked at may have lost its decoder meanwhile.
  if (limits_.hidden && !limits.hidden) wantsIndependent_ = true;
  limits_ = limits;
}

void StreamControl::broken() {
  const std::lock_guard lock(mutex_);
  wantsIndependent_ = true;
}

bool StreamControl::acknowledged(std::uint32_t frame, const Arrival& arrival) {
  const std::lock_guard lock(mutex_);
  if (frame > newestSent_) return false;
  const std::size_t before = link_.framesUnderWay();
  link_.arrived(frame, arrival);
  if (link_.framesUnderWay() < before) unacknowledgedSince_ = arrival.acknowledged;
  return true;
}

double StreamControl::secondsUnacknowledged(double now) const {
  const std::lock_guard lock(mutex_);
  return link_.framesUnderWay() == 0 || limits_.hidden ? 0.0 : now - unacknowledgedSince_;
}

StreamWish StreamControl::wish() const {
  StreamWish wish;
  double scale = 1.0;
  if (limits_.lines > 0) scale = std::min(1.0, std::max<double>(kMinLines, limits_.lines) / height_);
  wish.width = static_cast<int>(std::lround(width_ * scale));
  wish.height = static_cast<int>(std::lround(height_ * scale));
  wish.framesPerSecond = serverFramesPerSecond_;
  if (limits_.framesPerSecond > 0)
    wish.framesPerSecond = std::min<double>(limits_.framesPerSecond, serverFramesPerSecond_);
  return wish;
}

double StreamControl::bitsPerSecond() const {
  const double limit = limits_.kilobitsPerSecond > 0
                           ? std::max<double>(kMinKilobits, limits_.kilobitsPerSecond) * 1000.0
                           : LinkEstimator::kMaxBitsPerSecond;
  return kUsable * std::min(link_.bitsPerSecond(), limit);
}

void StreamControl::plan(double now) {
  if (adapts_) {
    policy_.update(now, wish(),
                   {.bitsPerSecond = bitsPerSecond(),
                    .bitsPerPixel = quantisers_.complexity(),
                    .finest = range_.finest,
                    .coarsest = range_.coarsest,
                    .isTried = link_.isMeasured()});
  } else {
    policy_.update(now, wish(), {.bitsPerSecond = std::numeric_limits<double>::infinity()});
  }
}

void StreamControl::planBorder() {
  const bool hasRoom = policy_.plan().limitedBy == LimitedBy::kNothing &&
                       newestQuantiser_ <= range_.usual + (borderSteps_ > 0 ? kBorderQuantisers : 0.0);
  if (!adapts_ || !limits_.border || !hasRoom) {
    borderSteps_ = 0;
    return;
  }
  const double share = (link_.roundTrip() - kShortRoundTrip) / (kLongRoundTrip - kShortRoundTrip);
  const double steps = kBorderSteps * std::clamp(share, 0.0, 1.0);
  // Each change begins with an independent picture, so it is not made lightly.
  if (steps >= borderSteps_ + 1 || steps < borderSteps_ - kBorderHysteresis) borderSteps_ = static_cast<int>(steps);
}

bool StreamControl::isHidden() const {
  const std::lock_guard lock(mutex_);
  return limits_.hidden;
}

bool StreamControl::mayBegin(double now, int beingMade) {
  const std::lock_guard lock(mutex_);
  if (limits_.hidden) return false;
  link_.look(now);
  plan(now);
  planBorder();
  return !link_.isFull(now, policy_.plan().framesPerSecond, static_cast<std::size_t>(beingMade));
}

double StreamControl::framesPerSecond() const {
  const std::lock_guard lock(mutex_);
  return policy_.plan().framesPerSecond;
}

int StreamControl::aim(world::Camera& camera) const {
  const std::lock_guard lock(mutex_);
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

const EncoderKind& StreamControl::kind() const {
  const std::lock_guard lock(mutex_);
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
  Choice choice{&kind, {range.usual, false}, 0.0};
  if (wantsIndependent_ && now - independentMade_ >= kIndependentSeconds) {
    choice.order.independent = true;
    wantsIndependent_ = false;
    independentMade_ = now;
  }
  if (!adapts_) return choice;
  const auto within = [&](double bits, Quantiser finest) {
    choice.bytes = bits / 8.0 / policy_.plan().framesPerSecond;
    const Quantiser wanted = quantisers_.choose(choice.order.independent, pixels, choice.bytes);
    return std::ceil(std::clamp(wanted, std::min(finest, range.coarsest), range.coarsest));
  };
  const Quantiser moving = within(bitsPerSecond(), range.usual);
  choice.order.quantiser = moving;
  // What depends on the last picture costs only what it makes better; others are made better when nothing moves at all.
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

void StreamControl::unchanged(std::uint32_t lastInput) {
  const std::lock_guard lock(mutex_);
  quantisers_.rested();
  lastInput_ = std::max(lastInput_, lastInput);
}

void StreamControl::sent(std::uint32_t frame, std::uint32_t lastInput, std::size_t bytes, double now) {
  const std::lock_guard lock(mutex_);
  if (link_.framesUnderWay() == 0) unacknowledgedSince_ = now;
  newestSent_ = std::max(newestSent_, frame);
  lastInput_ = lastInputReported_ = std::max(lastInput_, lastInput);
  wordSince_ = now;
  link_.sent(frame, bytes, now);
}

Status StreamControl::statusNow() const {
  const StreamPlan& plan = policy_.plan();
  const bool limits = limits_.lines > 0 || limits_.framesPerSecond > 0 || limits_.kilobitsPerSecond > 0;
  const bool byHim = plan.limitedBy == LimitedBy::kNothing
                         ? limits
                         : plan.limitedBy == LimitedBy::kLine && bitsPerSecond() < kUsable * link_.bitsPerSecond();
  Status status;
  status.limitedBy = byHim ? LimitedBy::kVisitor : plan.limitedBy;
  status.framesPerSecond = saturate<std::uint8_t>(std::lround(plan.framesPerSecond));
  const double share = (range_.coarsest - newestQuantiser_) / std::max(1.0, range_.coarsest - range_.finest);
  status.quality = saturate<std::uint8_t>(std::lround(100.0 * std::clamp(share, 0.0, 1.0)));
  status.width = saturate<std::uint16_t>(plan.width);
  status.height = saturate<std::uint16_t>(plan.height);
  status.roundTripMilliseconds = saturate<std::uint16_t>(std::lround(1000.0 * link_.roundTrip()));
  status.kilobitsPerSecond = link_.isMeasured() ? saturate<std::uint32_t>(link_.bitsPerSecond() / 1000.0) : 0;
  status.lastInput = lastInput_;
  return status;
}

Status StreamControl::status() const {
  const std::lock_guard lock(mutex_);
  return statusNow();
}

std::optional<Status> StreamControl::takeStatus(double now, std::size_t visitors) {
  const std::lock_guard lock(mutex_);
  if (!adapts_ || limits_.hidden) return std::nullopt;
  Status status = statusNow();
  status.visitors = saturate<std::uint16_t>(static_cast<double>(visitors));
  const bool news = status.limitedBy != reported_.limitedBy || status.framesPerSecond != reported_.framesPerSecond ||
                    status.height != reported_.height || status.visitors != reported_.visitors ||
                    lastInput_ != lastInputReported_;
  if (!news && now - wordSince_ < kStatusSeconds) return std::nullopt;
  reported_ = status;
  lastInputReported_ = lastInput_;
  wordSince_ = now;
  return status;
}

}  // namespace grove::stream
