#pragma once

namespace grove::pipeline {

/// Share of some workers that have work, averaged over about the last kSeconds. One thread at a time.
class BusyShare {
 public:
  static constexpr double kSeconds = 0.3;

  explicit BusyShare(int workers) : workers_(workers) {}

  /// From `now` on (seconds of a monotonic clock), one more or one less worker has work.
  void begin(double now);
  void end(double now);

  /// 0 to 1.
  [[nodiscard]] double at(double now) const;

 private:
  [[nodiscard]] double runningShare() const { return static_cast<double>(running_) / workers_; }

  const int workers_;
  int running_ = 0;
  double mean_ = 0.0;  ///< at since_
  double since_ = 0.0;
};

}  // namespace grove::pipeline
