#include <algorithm>
#include <cmath>

#include "stream/adapt/stream_control.h"
#include "stream/protocol/saturate.h"

// Status messages to the page.
namespace grove::stream {
namespace {

constexpr double kStatusSeconds = 0.5;

}  // namespace

Status StreamControl::statusNow() const {
  const StreamPlan& plan = policy_.plan();
  Status status;
  status.limitedBy = limitedBy();
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

LimitedBy StreamControl::limitedBy() const {
  const LimitedBy planned = policy_.plan().limitedBy;
  if (planned == LimitedBy::kLine && wantedBitsPerSecond() < link_.bitsPerSecond()) return LimitedBy::kVisitor;
  if (planned != LimitedBy::kNothing) return planned;
  const LimitedBy who = work_.sparesBrowser() ? LimitedBy::kBrowser
                        : isGoverned()        ? LimitedBy::kMachine
                                              : work_.shortOf();
  // Older pages do not understand kBrowser.
  if (who == LimitedBy::kBrowser && page_ < PageLevel::kTimed) return LimitedBy::kNothing;
  if (who != LimitedBy::kNothing) return who;
  const bool limits = limits_.lines > 0 || limits_.framesPerSecond > 0 || limits_.kilobitsPerSecond > 0;
  return limits ? LimitedBy::kVisitor : LimitedBy::kNothing;
}

Status StreamControl::status() const {
  const std::lock_guard lock(mutex_);
  return statusNow();
}

std::optional<Status> StreamControl::takeStatus(double now, std::size_t visitors) {
  const std::lock_guard lock(mutex_);
  if (page_ == PageLevel::kBasic || limits_.hidden) return std::nullopt;
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

std::optional<Times> StreamControl::takeTimes(double now) {
  const std::lock_guard lock(mutex_);
  return page_ >= PageLevel::kTimed ? times_.take(now) : std::nullopt;
}

}  // namespace grove::stream
