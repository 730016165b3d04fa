#pragma once

#include <string>
#include <utility>

#include "node/transport/grpc/calls/call_failure.h"
#include "node/transport/transport.h"

namespace grove::node {

/// How the link to a node or to the world's owner stands. Logs what changes, once. One thread at a time.
class LinkStanding {
 public:
  /// `peer` is the other end, as the log names it.
  explicit LinkStanding(std::string peer) : peer_(std::move(peer)) {}

  [[nodiscard]] const LinkStatus& status() const noexcept { return status_; }
  [[nodiscard]] bool isAnswered() const noexcept {
    return status_.state != LinkState::kConnecting && status_.state != LinkState::kSilent;
  }
  /// Whether nothing changes unless somebody changes his mind: the peer, or whoever runs it.
  [[nodiscard]] bool isKeptAway() const noexcept {
    return status_.state == LinkState::kRefused || status_.state == LinkState::kUntrusted;
  }

  void welcomed();
  /// By the peer.
  void refused(const std::string& reason);
  /// The peer, by this process.
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
