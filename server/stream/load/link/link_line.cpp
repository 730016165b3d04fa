#include "stream/load/link/link_line.h"

#include <algorithm>
#include <cassert>

#include "stream/load/link/link_random.h"

namespace grove::stream {
namespace {

constexpr std::size_t kMinQueueBytes = std::size_t{64} << 10U;
constexpr std::size_t kMaxQueueBytes = std::size_t{16} << 20U;
constexpr std::size_t kMaxLineBytes = std::size_t{64} << 20U;
constexpr std::size_t kBehindGapBytes = std::size_t{4} << 20U;
constexpr double kQueueSeconds = 0.25;
constexpr LinkTime kJitterPeriod = std::chrono::milliseconds(10);

double seconds(LinkTime time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

LinkLine::LinkLine(LinkSchedule schedule, LinkTime delay, LinkTime jitter, std::uint64_t seed, double loss)
    : schedule_(std::move(schedule)), delay_(delay), jitter_(jitter), seed_(mixed(seed)), pieceBytes_(kPieceBytes) {
  const double onItsWay = schedule_.maxRate() / 8.0 * seconds(delay + jitter);
  double max = onItsWay + schedule_.maxRate() / 8.0 * kQueueSeconds + static_cast<double>(2 * kMinQueueBytes);
  if (loss > 0.0) {
    sender_.emplace(loss, seed, 2 * delay, jitter);
    pieceBytes_ = LossySender::kSegmentBytes;
    max += static_cast<double>(kBehindGapBytes);
  }
  maxBytes_ = static_cast<std::size_t>(std::min(max, static_cast<double>(kMaxLineBytes)));
}

std::size_t LinkLine::room(LinkTime now) {
  while (gone_ < pieces_.size() && pieces_[gone_].leaves <= now) queued_ -= pieces_[gone_++].bytes.size();
  const std::size_t queue = queueBytes(now);
  if (queued_ >= queue || bytes_ >= maxBytes_) return 0;
  const std::size_t free = std::min(queue - queued_, maxBytes_ - bytes_);
  if (free < kPieceBytes) return 0;
  // Or each filling of a full queue would end in a scrap, and scraps would be lost as often as whole segments.
  return sender_ ? free - free % pieceBytes_ : free;
}

std::optional<LinkTime> LinkLine::nextRoom() const {
  if (gone_ == pieces_.size()) return std::nullopt;
  return pieces_[gone_].leaves;
}

void LinkLine::put(std::span<const std::uint8_t> bytes, LinkTime now) {
  assert(!endArrives_);
  while (!bytes.empty()) {
    const auto piece = bytes.first(std::min(bytes.size(), pieceBytes_));
    bytes = bytes.subspan(piece.size());
    lastLeaves_ = departureOf(piece.size(), now);
    lastArrives_ = arrivalOf(lastLeaves_);
    pieces_.push_back({{piece.begin(), piece.end()}, lastLeaves_, lastArrives_});
    if (sender_) lose();
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
  ++first_;
}

std::optional<LinkTime> LinkLine::nextArrival() const {
  if (pieces_.empty()) return endArrives_;
  return pieces_.front().arrives;
}

bool LinkLine::isOver(LinkTime now) const { return pieces_.empty() && endArrives_ && *endArrives_ <= now; }

LinkTime LinkLine::departureOf(std::size_t bytes, LinkTime now) {
  LinkTime start = std::max(now, lastLeaves_);
  if (sender_) start = sender_->mayLeave(start);
  return schedule_.finish(start, 8.0 * static_cast<double>(bytes));
}

void LinkLine::lose() {
  for (const auto& [number, arrives] : sender_->sent(lastLeaves_, lastArrives_)) {
    if (number >= first_) pieces_[number - first_].arrives = arrives;
  }
}

LinkTime LinkLine::arrivalOf(LinkTime leaves) { return std::max(lastArrives_, leaves + delay_ + extraDelay(leaves)); }

LinkTime LinkLine::extraDelay(LinkTime leaves) const {
  const std::uint64_t drawn = mixed(seed_ ^ static_cast<std::uint64_t>(leaves / kJitterPeriod));
  return LinkTime{static_cast<LinkTime::rep>(shareOf(drawn) * static_cast<double>(jitter_.count()))};
}

std::size_t LinkLine::queueBytes(LinkTime now) const {
  const double rate = sender_ ? std::min(schedule_.rateAt(now), sender_->rateAt(now)) : schedule_.rateAt(now);
  const auto wanted = static_cast<std::size_t>(rate / 8.0 * kQueueSeconds);
  return std::clamp(wanted, kMinQueueBytes, kMaxQueueBytes);
}

}  // namespace grove::stream
