#include "node/backend/peers/peer.h"

#include <variant>

#include "pipeline/clocks.h"

namespace grove::node {
namespace {

/// The sessions that a message names; empty if it names none.
struct Subject {
  std::optional<ProcessId> operator()(const std::shared_ptr<const View>& view) const {
    return processOf(view->session);
  }
  std::optional<ProcessId> operator()(const Request& request) const {
    return request.view ? processOf(request.view->session) : request.process;
  }
  std::optional<ProcessId> operator()(const Cancel& cancel) const { return processOf(cancel.session); }
  std::optional<ProcessId> operator()(const Forget& forget) const { return processOf(forget.session); }
  std::optional<ProcessId> operator()(const auto& /*other*/) const { return std::nullopt; }
};

}  // namespace

std::optional<std::string> Peer::objectionTo(const ToBackend& message) const {
  const std::optional<ProcessId> own = process_;
  if (!own) return "a frontend process sent a message before its welcome";
  const std::optional<ProcessId> subject = std::visit(Subject(), message);
  if (!subject || *subject == *own) return std::nullopt;
  return "frontend process " + std::to_string(*own) + " names a session of process " + std::to_string(*subject);
}

void Peer::dismiss() {
  process_ = std::optional<ProcessId>();
  subscriptions_.clear();
}

void Peer::reportForeignWorld() {
  if (isForeignReported_.exchange(true)) return;
  log::info("frontend process " + std::to_string(process().value_or(0)) +
            ": its world updates are refused, because another frontend process owns the world");
}

bool Peer::takeTrace(double now) {
  constexpr double kSecondsBetween = 0.5;
  const std::lock_guard lock(mutex_);
  if (traced_ && now < *traced_ + kSecondsBetween) return false;
  traced_ = now;
  return true;
}

void Peer::addClockReport(double theirs) {
  const std::lock_guard lock(mutex_);
  clock_.addReport(theirs, pipeline::wallSeconds());
}

void Peer::begin(const View& view) {
  const std::lock_guard lock(mutex_);
  ended_.addSession(view.session);
}

void Peer::end(const Cancel& cancel) {
  const std::lock_guard lock(mutex_);
  ended_.add(cancel);
}

void Peer::forget(SessionId session) {
  const std::lock_guard lock(mutex_);
  ended_.forget(session);
}

std::vector<SessionId> Peer::sessions() const {
  const std::lock_guard lock(mutex_);
  return ended_.sessions();
}

bool Peer::isOver(const View& view) const {
  const std::lock_guard lock(mutex_);
  const std::optional<double> now = clock_.at(pipeline::wallSeconds());
  return (now && *now >= view.deadline) || ended_.contain(view);
}

}  // namespace grove::node
