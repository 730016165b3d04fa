#include "node/transport/grpc/reconnecting/link_standing.h"

#include "base/log.h"

namespace grove::node {

void LinkStanding::welcomed() {
  if (wasWelcomed_ && status_.state != LinkState::kWelcomed) log::info(peer_ + " is back");
  wasWelcomed_ = true;
  status_ = {LinkState::kWelcomed, {}};
}

void LinkStanding::refused(const std::string& reason) {
  if (status_.state != LinkState::kRefused || status_.reason != reason) {
    log::error(peer_ + " refuses this process: " + reason);
  }
  status_ = {LinkState::kRefused, reason};
}

void LinkStanding::mistrusted(const std::string& reason) {
  if (status_.state != LinkState::kUntrusted || status_.reason != reason) {
    log::error("this process does not trust " + peer_ + ": " + reason);
  }
  status_ = {LinkState::kUntrusted, reason};
}

void LinkStanding::failed(const CallFailure& failure) {
  using Kind = CallFailure::Kind;
  if (failure.kind == Kind::kRefused) return refused(failure.reason);
  if (failure.kind == Kind::kUntrusted) return mistrusted(failure.reason);
  if (isKeptAway()) return;
  if (failure.kind == Kind::kSilent && status_.state != LinkState::kWelcomed) return silent(failure.reason);
  lost(failure);
}

void LinkStanding::silent(const std::string& reason) {
  if (status_.state != LinkState::kSilent) log::warning(peer_ + " is silent: " + reason);
  status_ = {LinkState::kSilent, reason};
}

void LinkStanding::lost(const CallFailure& failure) {
  if (status_.state == LinkState::kSilent) {
    status_.state = wasWelcomed_ ? LinkState::kLost : LinkState::kConnecting;
  }
  const bool isNew = failure.reason != status_.reason;
  const bool mayWantTls = failure.kind == CallFailure::Kind::kMayWantTls;
  if (status_.state == LinkState::kWelcomed) {
    log::warning(peer_ + " is lost: " + failure.reason);
    status_.state = LinkState::kLost;
  } else if (isNew && (status_.state == LinkState::kConnecting || mayWantTls)) {
    log::warning(peer_ + " does not respond: " + failure.reason);
  }
  status_.reason = failure.reason;
}

}  // namespace grove::node
