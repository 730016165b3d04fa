#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "node/backend/peers/ended_frames.h"
#include "node/backend/peers/subscriptions.h"
#include "node/transport/peer_clock.h"
#include "node/transport/transport.h"

namespace grove::node {

/// A frontend process from a backend node's point of view: its link, its process number after the welcome, its clock,
/// its frames that have ended, and what it has subscribed to. Pending requests keep it alive after it has left; their
/// results are dropped. Thread-safe.
class Peer {
 public:
  explicit Peer(std::shared_ptr<BackendEnd> link) : link_(std::move(link)) {}

  [[nodiscard]] BackendEnd& link() const noexcept { return *link_; }

  /// Its process number; nothing before the welcome and after a refusal.
  [[nodiscard]] std::optional<ProcessId> process() const noexcept { return process_; }
  void welcomeAs(ProcessId process) noexcept { process_ = process; }
  void dismiss();

  /// Returns why a message other than a hello is refused: the peer is not welcomed, or the message names a session of
  /// another process. Nothing if it is accepted.
  [[nodiscard]] std::optional<std::string> objectionTo(const ToBackend& message) const;
  /// Logs a refused message, at most once a second.
  void logRefusal(const std::string& objection) { refusals_.warning(objection); }

  /// Logs once that its updates are refused because the simulations follow another process.
  void reportForeignWorld();

  /// Returns whether a request for a trace at `now` (seconds) is served: at most two per second are. A server sends one
  /// per second, but their travel times differ.
  [[nodiscard]] bool takeTrace(double now);

  /// Updates the estimate of the peer's clock, in seconds.
  void addClockReport(double theirs);
  /// Records that a frame has begun.
  void begin(const View& view);
  void end(const Cancel& cancel);
  void forget(SessionId session);
  /// The most recent sessions that the peer has named and not removed.
  [[nodiscard]] std::vector<SessionId> sessions() const;
  /// Whether a frame has ended or its deadline has passed, by the peer's clock.
  [[nodiscard]] bool isOver(const View& view) const;

  [[nodiscard]] Subscriptions& subscriptions() noexcept { return subscriptions_; }

  /// The quality step that it requests for across-user work.
  [[nodiscard]] int quality() const noexcept { return quality_; }
  void setQuality(int step) noexcept { quality_ = step; }

 private:
  const std::shared_ptr<BackendEnd> link_;
  std::atomic<std::optional<ProcessId>> process_{};
  std::atomic<int> quality_{0};
  Subscriptions subscriptions_;
  log::Limited refusals_;
  std::atomic<bool> isForeignReported_{false};
  mutable std::mutex mutex_;
  PeerClock clock_;
  EndedFrames ended_;
  std::optional<double> traced_;  ///< seconds
};

}  // namespace grove::node
