#include "node/transport/reported_node.h"

#include <utility>

namespace grove::node {

void ReportedNode::add(NodeReport report, double now) {
  const std::lock_guard lock(mutex_);
  clock_.addReport(report.sent, now);
  report_ = std::move(report);
}

void ReportedNode::add(std::shared_ptr<const NodeTrace> trace) {
  const std::lock_guard lock(mutex_);
  if (expected_ == 0 || trace->number != expected_) return;
  trace_ = std::move(trace);
  traced_.notify_all();
}

void ReportedNode::welcomed() {
  const std::lock_guard lock(mutex_);
  report_.reset();
  clock_ = {};
}

std::optional<NodeReport> ReportedNode::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

std::optional<double> ReportedNode::ahead() const {
  const std::lock_guard lock(mutex_);
  return clock_.at(0.0);
}

TraceRequest ReportedNode::expectTrace() {
  const std::lock_guard lock(mutex_);
  trace_ = nullptr;
  return {.number = ++expected_};
}

std::shared_ptr<const NodeTrace> ReportedNode::waitForTrace(Clock::time_point until) {
  std::unique_lock lock(mutex_);
  traced_.wait_until(lock, until, [this] { return trace_ != nullptr; });
  return std::exchange(trace_, nullptr);
}

}  // namespace grove::node
