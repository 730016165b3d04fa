#include <algorithm>

#include "pipeline/clocks.h"
#include "stream/session/host.h"
#include "stream/session/session.h"

// Messages from the visitor's page.
namespace grove::stream {
namespace {

constexpr double kTenthOfMillisecond = 1e-4;
/// A browser that takes longer than this to decode or to paint a picture is busy with other work.
constexpr double kBusySeconds = 0.025;

}  // namespace

std::optional<Refusal> Session::input(const world::Input& input) {
  const double now = pipeline::wallSeconds();
  world::Players& players = host_.players();
  const auto before = players.find(player_, now);
  if (!players.apply(player_, input, now)) {
    // The visitor may have left already, for a reason that refusal() reports.
    if (!players.find(player_, now)) return std::nullopt;
    return Refusal{CloseCode::kProtocolError, "the direction of an input is not a number"};
  }
  const auto after = players.find(player_, now);
  if (before && after && ((before->keys ^ after->keys) & world::kBlow) != 0) reportBreath();
  return std::nullopt;
}

std::optional<Refusal> Session::resize(const Resize& resize) {
  const auto [width, height] = fitSize(resize.width, resize.height);
  control_->resize(width, height);
  return std::nullopt;
}

void Session::offer(const Offer& offer) { control_->offer(offer.codecs); }

void Session::limit(const Limits& limits) {
  control_->limit(limits);
  const double now = pipeline::wallSeconds();
  {
    const std::lock_guard lock(mutex_);
    if (limits.hidden && !hiddenSince_) hiddenSince_ = now;
  }
  startIfDue(now);
}

double Session::secondsHidden(double now) const {
  const std::lock_guard lock(mutex_);
  return hiddenSince_ && control_->isHidden() ? now - *hiddenSince_ : 0.0;
}

void Session::broken() { control_->broken(); }

std::optional<Refusal> Session::acknowledge(const Ack& ack) {
  return arrived(ack.frame, {.acknowledged = pipeline::wallSeconds()});
}

std::optional<Refusal> Session::acknowledge(const Presented& presented) {
  return arrived(presented.frame, arrivalOf(presented));
}

std::optional<Refusal> Session::acknowledge(const Painted& painted) {
  Arrival arrival = arrivalOf(painted);
  const double decode = painted.decodeTenthsOfMilliseconds * kTenthOfMillisecond;
  arrival.browserBusy = std::max(decode, painted.paintTenthsOfMilliseconds * kTenthOfMillisecond) > kBusySeconds;
  return arrived(painted.frame, arrival);
}

Arrival Session::arrivalOf(const Presented& presented) {
  const std::lock_guard lock(mutex_);
  return {.acknowledged = pipeline::wallSeconds(),
          .held = presented.heldTenthsOfMilliseconds * kTenthOfMillisecond,
          .pageSeconds = pageClock_.seconds(presented.arrivedMicroseconds)};
}

std::optional<Refusal> Session::arrived(std::uint32_t frame, const Arrival& arrival) {
  if (!control_->acknowledged(frame, arrival)) {
    return Refusal{CloseCode::kProtocolError, "acknowledges a frame that was never sent"};
  }
  if (!control_->isHidden()) {
    const std::lock_guard lock(mutex_);
    hiddenSince_.reset();
  }
  startIfDue(arrival.acknowledged);
  return std::nullopt;
}

}  // namespace grove::stream
