#pragma once

#include <string>
#include <utility>

#include "node/transport/grpc/calls/call_failure.h"
#include "node/transport/transport.h"

namespace grove::node {

/// The state of the link to a node or to the world's owner. Logs each change once. One thread at a time.
class LinkStanding {
 public:
  /// `peer`: the other end's name in log lines.
  explicit LinkStanding(std::string peer) : peer_(std::move(peer)) {}

  [[nodiscard]] const LinkStatus& status() const noexcept { return status_; }
  [[nodiscard]] bool isAnswered() const noexcept {
    return status_.state != LinkState::kConnecting && status_.state != LinkState::kSilent;
  }
  /// Whether only the operator of this process or of the peer can change the state.
  [[nodiscard]] bool isKeptAway() const noexcept {
    return status_.state == LinkState::kRefused || status_.state == LinkState::kUntrusted;
  }

  void welcomed();
  /// The peer refuses this process.
  void refused(const std::string& reason);
  /// This process rejects the peer's certificate.
  void mistrusted(const std::string& reason);
  /// A call has ended.
  void failed(const CallFailure& failure);

 private:
  void lost(const CallFailure& failure);
  void silent(const std::string& reason);

  const std::string peer_;
  LinkStatus status_{.state = LinkState::kConnecting};
  bool wasWelcomed_ = false;
};

}  // namespace grove::node
