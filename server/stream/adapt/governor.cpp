#include "stream/adapt/governor.h"

#include <algorithm>
#include <array>
#include <utility>

namespace grove::stream {
namespace {

/// A walk in 15 pictures a second is nearer to the truth than one in 30 of 600 lines (`grove bench warp`).
constexpr std::array<double, 3> kMovedPerSecond = {std::numeric_limits<double>::infinity(), 20.0, 15.0};
constexpr std::array<double, 4> kScales = {1.0, 5.0 / 6.0, 2.0 / 3.0, 0.5};
/// Share of the wanted frames per second: 28 of 30.
constexpr double kEnough = 0.93;
/// Below this share of time with waiting frames, the server is not what slows a stream down.
constexpr double kMinDelayed = 0.04;
/// Streams get less when frames worth this many seconds are missing: early if half of them are, late if a tenth is.
constexpr double kMissingSeconds = 0.25;
/// The measured pace lags: this long after a change it still belongs to the previous one.
constexpr double kSettlingSeconds = 0.7;
/// Workers that are busier than this have no room. Below it, pictures are more accurate than necessary
/// (node/load_shedding.h), so larger ones may cost no more.
constexpr double kRoom = 0.85;
constexpr double kAssessedEvery = 0.25;
constexpr double kBusyCalming = 0.1;
constexpr double kFirstPatience = 5.0;
constexpr double kLongestPatience = 160.0;
/// If streams must get less this soon after they got more, the wait for the next try doubles.
constexpr double kTrialSeconds = 20.0;

}  // namespace

Governor::Stream::Stream(std::shared_ptr<Governor> governor)
    : governor_(std::move(governor)), pace_([this] {
        const std::lock_guard lock(governor_->mutex_);
        return governor_->paces_.emplace(governor_->paces_.end());
      }()) {}

Governor::Stream::~Stream() {
  const std::lock_guard lock(governor_->mutex_);
  governor_->paces_.erase(pace_);
  // The next visitor finds an idle machine.
  if (governor_->paces_.empty()) governor_->scale_ = governor_->rate_ = 0;
}

Governor::Share Governor::Stream::update(const std::optional<Pace>& pace, double now) {
  const std::lock_guard lock(governor_->mutex_);
  *pace_ = pace;
  if (now - governor_->assessed_ >= kAssessedEvery) governor_->assess(now);
  return governor_->shareNow();
}

void Governor::Stream::rest() {
  const std::lock_guard lock(governor_->mutex_);
  pace_->reset();
}

Governor::Share Governor::share() const {
  const std::lock_guard lock(mutex_);
  return shareNow();
}

void Governor::assess(double now) {
  const double passed = std::min(now - std::exchange(assessed_, now), kAssessedEvery);
  busy_ += kBusyCalming * (busyShare_() - busy_);
  if (now - changed_ < kSettlingSeconds) return;
  double wanted = 0.0;
  double achieved = 0.0;
  double delayed = 0.0;
  double streams = 0.0;
  for (const std::optional<Pace>& pace : paces_) {
    if (!pace) continue;
    wanted += pace->wanted;
    achieved += std::min(pace->achieved, pace->wanted);
    delayed += pace->delayed;
    ++streams;
  }
  if (achieved >= kEnough * wanted || delayed <= kMinDelayed * streams) {
    missing_ = 0.0;
    giveMoreIfThereIsRoom(now);
    return;
  }
  missing_ += passed * (1.0 - achieved / (kEnough * wanted));
  if (missing_ >= kMissingSeconds) giveLess(now);
}

void Governor::giveLess(double now) {
  const bool anyMoves = std::ranges::any_of(paces_, [](const auto& pace) { return pace && pace->moves; });
  if (anyMoves && rate_ + 1 < kMovedPerSecond.size()) {
    ++rate_;
  } else if (scale_ + 1 < kScales.size()) {
    ++scale_;
  } else {
    return;
  }
  const bool failed = gaveMore_ && now - changed_ < kTrialSeconds;
  patience_ = failed ? std::min(kLongestPatience, 2.0 * patience_) : kFirstPatience;
  gaveMore_ = false;
  changed_ = now;
  missing_ = 0.0;
}

void Governor::giveMoreIfThereIsRoom(double now) {
  if ((scale_ == 0 && rate_ == 0) || now - changed_ < patience_ || busy_ > kRoom) return;
  --(scale_ > 0 ? scale_ : rate_);
  gaveMore_ = true;
  changed_ = now;
}

Governor::Share Governor::shareNow() const { return {kScales[scale_], kMovedPerSecond[rate_]}; }

}  // namespace grove::stream
