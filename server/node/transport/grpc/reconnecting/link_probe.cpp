#include "node/transport/grpc/reconnecting/link_probe.h"

#include "node/transport/grpc/link_limits.h"

namespace grove::node {
namespace {

constexpr const char* kHealthMethod = "/grpc.health.v1.Health/Check";
constexpr std::chrono::seconds kPause{1};

}  // namespace

void LinkProbe::stop() {
  const std::lock_guard lock(mutex_);
  isStopped_ = true;
  if (context_) context_->TryCancel();
  if (next_) next_->Cancel();
}

void LinkProbe::ask() {
  {
    const std::lock_guard lock(mutex_);
    if (!isStopped_) {
      context_.emplace();
      context_->set_deadline(std::chrono::system_clock::now() + std::chrono::milliseconds(kSilenceMilliseconds));
      response_.Clear();
      asked_ = Clock::now();
      stub_.UnaryCall(&*context_, kHealthMethod, grpc::StubOptions(), &request_, &response_,
                      [this](const grpc::Status& status) { answered(status); });
      return;
    }
  }
  listener_.probed();
}

void LinkProbe::answered(const grpc::Status& status) {
  if (status.ok()) listener_.answered(Clock::now() - asked_);
  if (status.error_code() == grpc::StatusCode::DEADLINE_EXCEEDED) listener_.unanswered();
  {
    const std::lock_guard lock(mutex_);
    if (!isStopped_) {
      next_ = std::make_unique<grpc::Alarm>();
      next_->Set(std::chrono::system_clock::now() + kPause, [this](bool /*isDue*/) { ask(); });
      return;
    }
  }
  listener_.probed();
}

}  // namespace grove::node
