#include "stream/adapt/stream_control.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace grove::stream {
namespace {

/// Rate for refining the picture, and for smoke, while the camera stands still.
constexpr double kStillBitsPerSecond = 1.3e6;
/// Refinement proceeds in steps, so that no single picture takes long.
constexpr Quantiser kRefinement = 2.0;
constexpr double kIndependentSeconds = 0.25;
/// Seconds. Predictions of more than that are mostly wrong when the visitor turns off.
constexpr double kMaxLead = 0.250;

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
  policy_.update(0.0, wish(governed_.share()), {.bitsPerSecond = std::numeric_limits<double>::infinity()});
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

bool StreamControl::isHidden() const {
  const std::lock_guard lock(mutex_);
  return limits_.hidden;
}

bool StreamControl::wantsNearness() const {
  const std::lock_guard lock(mutex_);
  return moves();
}

double StreamControl::leadSeconds() const {
  if (!wantsNearness()) return 0.0;
  const std::lock_guard lock(mutex_);
  return std::min(link_.roundTrip() + kDrawingSeconds, kMaxLead);
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
  if (border_.percent() > 0) camera = withBorder(camera, border_.percent());
  return border_.percent();
}

std::optional<std::uint32_t> StreamControl::takeCapture(std::uint32_t frame) {
  const std::lock_guard lock(mutex_);
  return capture_.take(frame);
}

const EncoderKind& StreamControl::kind() const {
  const std::lock_guard lock(mutex_);
  // A visitor who insists on a codec offers only that one.
  std::vector<std::uint8_t> codecs = offer_;
  if (codecChoice_.savesWork() && std::ranges::any_of(codecs, CodecChoice::isWorkSaver)) {
    std::erase_if(codecs, std::not_fn(CodecChoice::isWorkSaver));
  }
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
  Choice choice{&kind, {.quantiser = range.usual, .still = still}, 0.0};
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
