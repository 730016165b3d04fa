#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/log.h"
#include "node/backend/ended_frames.h"
#include "node/backend/peer_clock.h"
#include "node/transport/transport.h"

namespace grove::node {

/// One frontend process as a backend node knows it: its link, its number once it is welcome, its clock, and which of
/// its frames have ended. Requests under way hold it, so it may leave meanwhile; what it would have got is lost. Any
/// thread.
class Peer {
 public:
  explicit Peer(std::shared_ptr<BackendEnd> link) : link_(std::move(link)) {}

  [[nodiscard]] BackendEnd& link() const noexcept { return *link_; }

  /// Its number among the node's frontend processes; nothing before it is welcome, or after it was refused.
  [[nodiscard]] std::optional<ProcessId> process() const noexcept { return process_; }
  void welcomeAs(ProcessId process) noexcept { process_ = process; }
  void dismiss() noexcept { process_ = std::optional<ProcessId>(); }

  /// Why it may not say this, which is no hello: it is not welcome, or speaks of sessions of another process.
  [[nodiscard]] std::optional<std::string> objectionTo(const ToBackend& message) const;
  /// Logs what it does wrong, at most once a second.
  void reproach(const std::string& objection) { refusals_.warning(objection); }

  /// Logs once that its updates are refused, since another process owns the world.
  void reportForeignWorld();

  /// It tells what its clock shows.
  void hearClock(double theirs);
  /// A frame begins.
  void begin(const View& view);
  void end(const Cancel& cancel);
  void forget(SessionId session);
  /// The newest that it has spoken of and not forgotten.
  [[nodiscard]] std::vector<SessionId> sessions() const;
  /// Whether nobody waits for this frame of its any more.
  [[nodiscard]] bool isOver(const View& view) const;

  /// How good it wants across-user work.
  [[nodiscard]] int quality() const noexcept { return quality_; }
  void setQuality(int step) noexcept { quality_ = step; }

 private:
  const std::shared_ptr<BackendEnd> link_;
  std::atomic<std::optional<ProcessId>> process_{};
  std::atomic<int> quality_{0};
  log::Limited refusals_;
  std::atomic<bool> isForeignReported_{false};
  mutable std::mutex mutex_;
  PeerClock clock_;
  EndedFrames ended_;
};

}  // namespace grove::node
