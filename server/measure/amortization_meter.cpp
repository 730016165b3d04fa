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

double unreportedCost(const Amortization& measured) {
  const FrameCost cost = sum(measured.costs);
  const double frames = measured.visitors * measured.framesPerSecond;
  if (frames <= 0.0) return 0.0;
  const double reported = cost.acrossUser * measured.framesPerSecond + cost.perUser() * frames;
  return std::max(0.0, 1000.0 * measured.cpuCores - reported) / frames;
}

double privateFrameCost(const Amortization& measured) {
  const FrameCost cost = sum(measured.costs);
  // Alone, a visitor has all the work that depends on nobody, and of the work on demand at least his share.
  const double onDemand = cost.onDemandShared / std::max(1.0, measured.visitors);
  return cost.independent() + onDemand + cost.perUser() + unreportedCost(measured);
}

Capacity capacityOf(const Amortization& measured, double nominalFramesPerSecond) {
  const FrameCost cost = sum(measured.costs);
  const double nominal = nominalFramesPerSecond / 1000.0;
  const double clocked = cost.independent() * measured.framesPerSecond / 1000.0;
  Capacity capacity;
  capacity.base = clocked + cost.onDemandShared * nominal;
  capacity.visitor = (cost.perUser() + unreportedCost(measured)) * nominal;
  capacity.privateVisitor = clocked + (privateFrameCost(measured) - cost.independent()) * nominal;
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
  measured.costs = frameCosts(first.reading, last.reading, {.visitors = measured.visitors, .frames = frames});
  measured.memory = memoryShares(memory_, std::max(1, last.visitors));
  measured.reuse = reuseBetween(first.reading, last.reading);
  return measured;
}

}  // namespace grove::measure
