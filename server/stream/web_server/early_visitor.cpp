#include "stream/web_server/early_visitor.h"

namespace grove::stream {
namespace {

/// Offer, Limits and Hello are three messages.
constexpr std::size_t kMaxPieces = 16;
constexpr std::size_t kMaxBytes = 4 * kLargestClientMessage;

constexpr double kChangeSeconds = 0.25;
constexpr double kSilenceSeconds = 1.0;

}  // namespace

std::optional<Refusal> EarlyVisitor::receive(const MessagePiece& piece) {
  bytes_ += piece.bytes.size();
  if (pieces_.size() == kMaxPieces || bytes_ > kMaxBytes) {
    return Refusal{CloseCode::kFlood, "more than a greeting before the world is ready"};
  }
  Piece stored{{piece.bytes.begin(), piece.bytes.end()}, piece};
  stored.piece.bytes = {};
  pieces_.push_back(std::move(stored));
  return std::nullopt;
}

std::optional<Refusal> EarlyVisitor::replayTo(Connection& connection, double now) const {
  for (const Piece& stored : pieces_) {
    MessagePiece piece = stored.piece;
    piece.bytes = stored.bytes;
    if (auto why = connection.receive(piece, now)) return why;
  }
  return std::nullopt;
}

bool EarlyVisitor::wants(const Waiting& waiting, double now) const {
  // A browser that has sent nothing is not waiting.
  if (!knowsWaiting_ || pieces_.empty()) return false;
  if (!reportedAt_) return true;
  const bool isOther = waiting.step != reported_.step || waiting.percent != reported_.percent;
  return now - *reportedAt_ >= (isOther ? kChangeSeconds : kSilenceSeconds);
}

std::vector<std::uint8_t> EarlyVisitor::take(const Waiting& waiting, double now) {
  reported_ = waiting;
  reportedAt_ = now;
  return encode(waiting);
}

}  // namespace grove::stream
