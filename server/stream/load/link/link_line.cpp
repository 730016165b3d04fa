#include "stream/load/link/link_line.h"

#include <algorithm>
#include <cassert>

namespace grove::stream {
namespace {

constexpr std::size_t kMinQueueBytes = std::size_t{64} << 10U;
constexpr std::size_t kMaxQueueBytes = std::size_t{16} << 20U;
constexpr std::size_t kMaxLineBytes = std::size_t{64} << 20U;
constexpr double kQueueSeconds = 0.25;
constexpr LinkTime kJitterPeriod = std::chrono::milliseconds(10);

double seconds(LinkTime time) { return std::chrono::duration<double>(time).count(); }

/// Hashes a number (Steele, Lea and Flood: Fast splittable pseudorandom number generators, 2014).
std::uint64_t mixed(std::uint64_t value) {
  value += 0x9E3779B97F4A7C15U;
  value = (value ^ (value >> 30U)) * 0xBF58476D1CE4E5B9U;
  value = (value ^ (value >> 27U)) * 0x94D049BB133111EBU;
  return value ^ (value >> 31U);
}

}  // namespace

LinkLine::LinkLine(LinkSchedule schedule, LinkTime delay, LinkTime jitter, std::uint64_t seed)
    : schedule_(std::move(schedule)), delay_(delay), jitter_(jitter), seed_(mixed(seed)) {
  const double onItsWay = schedule_.maxRate() / 8.0 * seconds(delay + jitter);
  const double max = onItsWay + schedule_.maxRate() / 8.0 * kQueueSeconds + static_cast<double>(2 * kMinQueueBytes);
  maxBytes_ = static_cast<std::size_t>(std::min(max, static_cast<double>(kMaxLineBytes)));
}

std::size_t LinkLine::room(LinkTime now) {
  while (gone_ < pieces_.size() && pieces_[gone_].leaves <= now) queued_ -= pieces_[gone_++].bytes.size();
  const std::size_t queue = queueBytes(now);
  if (queued_ >= queue || bytes_ >= maxBytes_) return 0;
  const std::size_t free = std::min(queue - queued_, maxBytes_ - bytes_);
  return free < kPieceBytes ? 0 : free;
}

std::optional<LinkTime> LinkLine::nextRoom() const {
  if (gone_ == pieces_.size()) return std::nullopt;
  return pieces_[gone_].leaves;
}

void LinkLine::put(std::span<const std::uint8_t> bytes, LinkTime now) {
  assert(!endArrives_);
  while (!bytes.empty()) {
    const auto piece = bytes.first(std::min(bytes.size(), kPieceBytes));
    bytes = bytes.subspan(piece.size());
    lastLeaves_ = schedule_.finish(std::max(now, lastLeaves_), 8.0 * static_cast<double>(piece.size()));
    lastArrives_ = arrivalOf(lastLeaves_);
    pieces_.push_back({{piece.begin(), piece.end()}, lastLeaves_, lastArrives_});
    queued_ += piece.size();
    bytes_ += piece.size();
  }
}

void LinkLine::end(LinkTime now) { endArrives_ = arrivalOf(std::max(now, lastLeaves_)); }

std::span<const std::uint8_t> LinkLine::arrived(LinkTime now) const {
  if (pieces_.empty() || pieces_.front().arrives > now) return {};
  return std::span(pieces_.front().bytes).subspan(fetched_);
}

void LinkLine::fetched(std::size_t bytes) {
  fetched_ += bytes;
  const std::size_t whole = pieces_.front().bytes.size();
  assert(fetched_ <= whole);
  if (fetched_ < whole) return;
  if (gone_ > 0) {
    --gone_;
  } else {
    queued_ -= whole;
  }
  bytes_ -= whole;
  fetched_ = 0;
  pieces_.pop_front();
}

std::optional<LinkTime> LinkLine::nextArrival() const {
  if (pieces_.empty()) return endArrives_;
  return pieces_.front().arrives;
}

bool LinkLine::isOver(LinkTime now) const { return pieces_.empty() && endArrives_ && *endArrives_ <= now; }

LinkTime LinkLine::arrivalOf(LinkTime leaves) { return std::max(lastArrives_, leaves + delay_ + extraDelay(leaves)); }

LinkTime LinkLine::extraDelay(LinkTime leaves) const {
  const std::uint64_t drawn = mixed(seed_ ^ static_cast<std::uint64_t>(leaves / kJitterPeriod));
  const double share = static_cast<double>(drawn >> 11U) * 0x1p-53;
  return LinkTime{static_cast<LinkTime::rep>(share * static_cast<double>(jitter_.count()))};
}

std::size_t LinkLine::queueBytes(LinkTime now) const {
  const auto wanted = static_cast<std::size_t>(schedule_.rateAt(now) / 8.0 * kQueueSeconds);
  return std::clamp(wanted, kMinQueueBytes, kMaxQueueBytes);
}

}  // namespace grove::stream
