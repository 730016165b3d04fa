#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <random>
#include <vector>

#include "stream/adapt/link_estimator.h"

namespace grove::stream {

/// A line as a visitor may have it: one queue before one bottleneck, whose rate and further delay are functions of
/// time.
struct Bottleneck {
  std::function<double(double)> bitsPerSecond = [](double) { return 5e6; };
  double roundTrip = 0.020;  ///< seconds, of an empty line
  double jitter = 0.0;       ///< up to so many seconds more on each way
  /// When the page notices what arrives: later, if its processor does other work.
  std::function<double(double)> noticed = [](double arrival) { return arrival; };
};

/// A processor that others keep busy: in every tenth of a second, about one time in three, it stops a program for 20 to
/// 120 ms.
inline double noticedBetweenHiccups(double arrival) {
  constexpr double kSlot = 0.1;
  double noticed = arrival;
  for (double slot = std::floor(arrival / kSlot) - 1.0; slot * kSlot <= noticed; slot += 1.0) {
    std::minstd_rand random(static_cast<unsigned>(std::max(0.0, slot)) * 7919U + 17U);
    random.discard(3);
    std::uniform_real_distribution<double> share(0.0, 1.0);
    if (share(random) > 0.35) continue;
    const double begins = slot * kSlot;
    const double ends = begins + 0.020 + 0.100 * share(random);
    if (noticed >= begins && noticed < ends) noticed = ends;
  }
  return noticed;
}

/// One frame's fate.
struct Passage {
  double sent;
  double bytes;
  double queued;   ///< seconds that it waited for those before it
  double arrived;  ///< at the page
};

/// Frames of a visitor over a bottleneck, led by a LinkEstimator as a stream is led: in steps of a millisecond of a
/// clock of its own, without sleeping, the same in every run.
class SimulatedStream {
 public:
  /// What befalls acknowledgements and the page's clock; changes an Arrival, and says how often it is told.
  using Mischief = std::function<int(std::uint32_t frame, Arrival& arrival)>;

  explicit SimulatedStream(Bottleneck line, double framesPerSecond = 30.0)
      : line_(std::move(line)), framesPerSecond_(framesPerSecond) {}

  void play(Mischief mischief) { mischief_ = std::move(mischief); }
  /// A picture takes this at most, however fast the line is.
  void setBest(double bitsPerSecond) { best_ = bitsPerSecond; }

  void runUntil(double end) {
    for (; now_ < end; now_ += kStep) {
      deliverWords();
      link_.look(now_);
      if (now_ >= due_ && !link_.isFull(now_, framesPerSecond_, 0)) send();
    }
  }

  [[nodiscard]] const LinkEstimator& link() const { return link_; }
  [[nodiscard]] double now() const { return now_; }
  [[nodiscard]] const std::vector<Passage>& frames() const { return frames_; }

  /// Bits a second that arrived at the page.
  [[nodiscard]] double delivered(double from, double to) const {
    double bytes = 0.0;
    for (const Passage& each : frames_) bytes += each.arrived >= from && each.arrived < to ? each.bytes : 0.0;
    return 8.0 * bytes / (to - from);
  }
  /// Bits a second that were sent.
  [[nodiscard]] double sent(double from, double to) const {
    double bytes = 0.0;
    for (const Passage& each : frames_) bytes += each.sent >= from && each.sent < to ? each.bytes : 0.0;
    return 8.0 * bytes / (to - from);
  }
  [[nodiscard]] double frameRate(double from, double to) const {
    return static_cast<double>(std::ranges::count_if(
               frames_, [&](const Passage& each) { return each.arrived >= from && each.arrived < to; })) /
           (to - from);
  }
  /// That so large a share of the frames that were sent within this time did not exceed; seconds.
  [[nodiscard]] double queued(double from, double to, double share) const {
    std::vector<double> all;
    for (const Passage& each : frames_) {
      if (each.sent >= from && each.sent < to) all.push_back(each.queued);
    }
    if (all.empty()) return 0.0;
    std::ranges::sort(all);
    return all[std::min(all.size() - 1, static_cast<std::size_t>(share * static_cast<double>(all.size())))];
  }

 private:
  static constexpr double kStep = 0.001;
  struct Word {
    double due;
    std::uint32_t frame;
    Arrival arrival;
  };

  void deliverWords() {
    for (std::size_t i = 0; i < words_.size();) {
      if (words_[i].due > now_) {
        ++i;
        continue;
      }
      Word word = words_[i];
      words_.erase(words_.begin() + static_cast<std::ptrdiff_t>(i));
      word.arrival.acknowledged = now_;
      const int times = mischief_ ? mischief_(word.frame, word.arrival) : 1;
      for (int k = 0; k < times; ++k) link_.arrived(word.frame, word.arrival);
    }
  }

  void send() {
    due_ = std::max(due_ + 1.0 / framesPerSecond_, now_ + 0.5 / framesPerSecond_);
    // As the quantiser's control does it: the share of the rate that is used, give or take a fifth.
    const double allowed = 0.9 * link_.bitsPerSecond() / framesPerSecond_ / 8.0;
    const double bits = std::min(8.0 * allowed, best_ / framesPerSecond_);
    const double bytes = std::max(300.0, bits / 8.0 * spread_(random_));
    const std::uint32_t frame = ++number_;
    link_.sent(frame, static_cast<std::size_t>(bytes), allowed, now_);
    const double begins = std::max(now_, free_);
    free_ = begins;
    for (double left = 8.0 * bytes; left > 0.0;) {
      const double carried = kStep * line_.bitsPerSecond(free_);
      free_ += carried > left ? kStep * left / carried : kStep;
      left -= carried;
    }
    // Neither way ever changes the order: it is TCP.
    const auto delay = [&] { return 0.5 * line_.roundTrip + line_.jitter * jitter_(random_); };
    const double arrived = arrived_ = std::max(arrived_, line_.noticed(free_ + delay()));
    const double reported = reported_ = std::max(reported_, arrived + delay());
    frames_.push_back({now_, bytes, begins - now_, arrived});
    words_.push_back({reported, frame, {.held = 0.0, .pageSeconds = 1000.0 + arrived}});
  }

  const Bottleneck line_;
  const double framesPerSecond_;
  LinkEstimator link_;
  Mischief mischief_;
  double best_ = 30e6;
  double now_ = 0.0;
  double due_ = 0.0;
  double free_ = 0.0;  ///< when the bottleneck has nothing more to do
  double arrived_ = 0.0;
  double reported_ = 0.0;
  std::uint32_t number_ = 0;
  std::vector<Passage> frames_;
  std::deque<Word> words_;
  std::mt19937 random_{1};
  std::uniform_real_distribution<double> spread_{0.8, 1.2};
  std::uniform_real_distribution<double> jitter_{0.0, 1.0};
};

}  // namespace grove::stream
