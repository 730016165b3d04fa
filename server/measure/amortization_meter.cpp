#include "measure/amortization_meter.h"

#include <algorithm>
#include <cmath>

namespace grove::measure {
namespace {

/// Samples that a measurement spans: long enough to be steady, short enough to be live.
constexpr std::size_t kSpan = 6;

std::uint64_t framesOf(const Reading& reading) {
  const auto found = reading.costs.find({"Encoder", ""});
  return found == reading.costs.end() ? 0 : found->second.runs;
}

int fit(double cores, double base, double visitor) {
  if (visitor <= 0.0) return 0;
  return static_cast<int>(std::max(0.0, std::floor((Capacity::kUsableShare * cores - base) / visitor)));
}

}  // namespace

int Capacity::visitorsFit(double cores) const noexcept { return fit(cores, base, visitor); }
int Capacity::privateVisitorsFit(double cores) const noexcept { return fit(cores, 0.0, privateVisitor); }

Capacity atFullSize(Capacity measured, double scale) noexcept {
  const double more = measured.visitor * (1.0 / (scale * scale) - 1.0);
  measured.visitor += more;
  measured.privateVisitor += more;
  return measured;
}

int correctedFit(int estimate, int now, bool areServed, bool areTooMany) noexcept {
  if (areTooMany) return std::clamp(estimate, 0, std::max(0, now - 1));
  return areServed ? std::max(estimate, now) : estimate;
}

Capacity capacityOf(const Amortization& measured, double nominalFramesPerSecond) {
  const FrameCost cost = sum(measured.costs);
  const double coresPerMillisecond = nominalFramesPerSecond / 1000.0;
  const double frames = measured.visitors * measured.framesPerSecond;
  const double clocked = cost.acrossUser - cost.onDemand;
  const double reported =
      (clocked * nominalFramesPerSecond + cost.onDemand * measured.framesPerSecond + cost.perUser() * frames) / 1000.0;
  Capacity capacity;
  capacity.unreported =
      frames > 0.0 ? std::max(0.0, measured.cpuCores - reported) / frames * nominalFramesPerSecond : 0.0;
  capacity.base = cost.acrossUser * coresPerMillisecond;
  capacity.visitor = cost.perUser() * coresPerMillisecond + capacity.unreported;
  // Alone, a visitor has all the clocked work, and of the work on demand at least his share.
  const double own = clocked + cost.onDemand / std::max(1.0, measured.visitors);
  capacity.privateVisitor = own * coresPerMillisecond + capacity.visitor;
  return capacity;
}

AmortizationMeter::AmortizationMeter(const pipeline::Timeline& timeline, const pipeline::MemoryLedger& memory,
                                     double nominalFramesPerSecond)
    : timeline_(timeline), memory_(memory), nominal_(nominalFramesPerSecond) {}

void AmortizationMeter::sample(int visitors) {
  Sample sample{Reading::of(timeline_), 0, visitors};
  sample.frames = framesOf(sample.reading);
  const std::lock_guard lock(mutex_);
  samples_.push_back(std::move(sample));
  if (samples_.size() > kSpan) samples_.pop_front();
}

std::optional<Amortization> AmortizationMeter::newest() const {
  const std::lock_guard lock(mutex_);
  if (samples_.size() < 2) return std::nullopt;
  const Sample& first = samples_.front();
  const Sample& last = samples_.back();
  const auto frames = static_cast<double>(last.frames - first.frames);
  Amortization measured;
  measured.seconds = last.reading.seconds - first.reading.seconds;
  for (std::size_t i = 1; i < samples_.size(); ++i) measured.visitors += samples_[i].visitors;
  measured.visitors /= static_cast<double>(samples_.size() - 1);
  if (frames <= 0.0 || measured.visitors <= 0.0 || measured.seconds <= 0.0) return std::nullopt;
  measured.framesPerSecond = frames / measured.visitors / measured.seconds;
  measured.cpuCores = (last.reading.processSeconds - first.reading.processSeconds) / measured.seconds;
  measured.costs = frameCosts(first.reading, last.reading,
                              {.visitors = measured.visitors, .frames = frames, .framesPerSecond = nominal_});
  measured.memory = memoryShares(memory_, std::max(1, last.visitors));
  return measured;
}

}  // namespace grove::measure
