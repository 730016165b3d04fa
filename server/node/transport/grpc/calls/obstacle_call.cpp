#include "node/transport/grpc/calls/obstacle_call.h"

#include <chrono>
#include <utility>
#include <variant>

#include "node/transport/grpc/byte_message.h"
#include "node/transport/grpc/link_limits.h"

namespace grove::node {

void ObstacleCall::start() {
  self_ = shared_from_this();
  // The caller checks this node's certificate before it sends its request.
  StartSendInitialMetadata();
  const auto until = std::chrono::system_clock::now() + std::chrono::milliseconds(kAnswerMilliseconds);
  patience_.Set(until, [weak = weak_from_this()](bool isDue) {
    const auto self = isDue ? weak.lock() : nullptr;
    if (self) self->giveUpUnasked();
  });
  StartRead(&question_);
}

bool ObstacleCall::isWaiting() const {
  const std::lock_guard lock(mutex_);
  return !isOver_;
}

void ObstacleCall::answer(const Decoded<std::string>& cells) {
  if (const auto* error = std::get_if<WireError>(&cells)) {
    return end({grpc::StatusCode::FAILED_PRECONDITION, error->reason});
  }
  if (!takeEnd()) return;
  answer_ = messageOf(std::get<std::string>(cells));
  StartWriteAndFinish(&answer_, grpc::WriteOptions(), grpc::Status::OK);
}

void ObstacleCall::OnReadDone(bool ok) {
  if (!ok) return end({grpc::StatusCode::INVALID_ARGUMENT, "the call has no request"});
  {
    const std::lock_guard lock(mutex_);
    isAsked_ = true;
  }
  const auto result = answers_->push({bytesOf(question_), shared_from_this()});
  question_.Clear();
  if (result != pipeline::PushResult::kAccepted) {
    end({grpc::StatusCode::RESOURCE_EXHAUSTED, "too many requests for obstacles"});
  }
}

void ObstacleCall::OnDone() {
  const std::shared_ptr<ObstacleCall> last = std::move(self_);
  whenDone_();
}

void ObstacleCall::end(const grpc::Status& status) {
  if (takeEnd()) Finish(status);
}

bool ObstacleCall::takeEnd() {
  const std::lock_guard lock(mutex_);
  return !std::exchange(isOver_, true);
}

void ObstacleCall::giveUpUnasked() {
  const bool isAsked = [this] {
    const std::lock_guard lock(mutex_);
    return isAsked_;
  }();
  if (!isAsked) end({grpc::StatusCode::DEADLINE_EXCEEDED, "the call has no request"});
}

}  // namespace grove::node
