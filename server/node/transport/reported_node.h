#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

#include "node/messages/node_report.h"
#include "node/transport/peer_clock.h"

namespace grove::node {

/// A backend node's reports of its own work, for a frontend process. Thread-safe.
class ReportedNode {
 public:
  using Clock = std::chrono::steady_clock;

  /// `now`: seconds of this process's clock.
  void add(NodeReport report, double now);
  /// Drops a trace that is not expected.
  void add(std::shared_ptr<const NodeTrace> trace);
  /// Drops the report and the clock: the node may have restarted.
  void welcomed();

  [[nodiscard]] std::optional<NodeReport> report() const;
  /// Seconds that the node's clock is ahead of this process's, less the time that a report travels; nothing before the
  /// first report.
  [[nodiscard]] std::optional<double> ahead() const;

  /// Returns a new request, whose answer is expected from now on. The answer to an earlier request is dropped.
  [[nodiscard]] TraceRequest expectTrace();
  /// Returns null if the trace does not arrive in time.
  [[nodiscard]] std::shared_ptr<const NodeTrace> waitForTrace(Clock::time_point until);

 private:
  mutable std::mutex mutex_;
  std::condition_variable traced_;
  std::optional<NodeReport> report_;
  PeerClock clock_;
  std::uint32_t expected_ = 0;  ///< number of the newest request
  std::shared_ptr<const NodeTrace> trace_;
};

}  // namespace grove::node
