#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "measure/amortization.h"

namespace grove::measure {

/// What sharing saved in the last seconds.
struct Amortization {
  double seconds = 0.0;          ///< measured period
  double visitors = 0.0;         ///< mean
  double framesPerSecond = 0.0;  ///< of one visitor
  double cpuCores = 0.0;         ///< of the whole process
  std::map<std::string, FrameCost> costs;
  std::map<std::string, MemoryShare> memory;
  std::map<std::string, pipeline::Reuse> reuse;
};

/// Costs of serving at the nominal frame rate, in cores, and how many visitors a machine of some cores serves with
/// them.
struct Capacity {
  /// Visitors whose frames wait for a core get a latency above 100 ms (99th percentile) before all cores are busy: runs
  /// of `grove bench amortize --capacity` serve up to this share of the cores, and fail at 86 %.
  static constexpr double kUsableShare = 0.82;

  double base = 0.0;            ///< a: across-user work
  double visitor = 0.0;         ///< b: of one more visitor
  double privateVisitor = 0.0;  ///< of one visitor in private mode: at least so much
  [[nodiscard]] int visitorsFit(double cores) const noexcept;
  [[nodiscard]] int privateVisitorsFit(double cores) const noexcept;
};
/// Converts costs that were measured with pictures of `scale` times the wanted width and height to whole ones. A
/// visitor's own cost grows by the pixels at most.
[[nodiscard]] Capacity atFullSize(Capacity measured, double scale) noexcept;
/// Corrects an estimate of the visitors that a machine serves by those that it serves now: `now` of them at the nominal
/// frame rate, or too many, so that it makes their pictures smaller.
[[nodiscard]] int correctedFit(int estimate, int now, bool areServed, bool areTooMany) noexcept;
/// Milliseconds per frame of CPU that no stage accounts for (sockets, clocks, drivers), shared out to the visitors.
[[nodiscard]] double unreportedCost(const Amortization& measured);
/// Milliseconds behind the same frame in private mode, at least.
[[nodiscard]] double privateFrameCost(const Amortization& measured);
/// An estimate for the nominal frame rate, which visitors may not have had: work on clocks stays as it was measured,
/// the rest grows with the frames.
[[nodiscard]] Capacity capacityOf(const Amortization& measured, double nominalFramesPerSecond);

/// Keeps an eye on a timeline and a ledger, which outlive it. Any thread.
class AmortizationMeter {
 public:
  AmortizationMeter(const pipeline::Timeline& timeline, const pipeline::MemoryLedger& memory,
                    double nominalFramesPerSecond);

  /// To be called about once a second.
  void sample(int visitors);

  /// Of the last seconds; nothing if nobody got a frame in them.
  [[nodiscard]] std::optional<Amortization> newest() const;

  [[nodiscard]] double nominalFramesPerSecond() const noexcept { return nominal_; }

 private:
  struct Sample {
    Reading reading;
    std::uint64_t frames = 0;  ///< of all visitors since the start
    int visitors = 0;
  };

  const pipeline::Timeline& timeline_;
  const pipeline::MemoryLedger& memory_;
  const double nominal_;
  mutable std::mutex mutex_;
  std::deque<Sample> samples_;
};

}  // namespace grove::measure
