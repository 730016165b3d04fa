#pragma once

#include <grpcpp/alarm.h>
#include <grpcpp/generic/async_generic_service.h>
#include <grpcpp/support/byte_buffer.h>
#include <grpcpp/support/status.h>

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "node/transport/obstacle_answers.h"

namespace grove::node {

/// A node's call for obstacles: one message each way. A worker computes the response. Reactions run on gRPC's threads;
/// gRPC owns this object during the call.
class ObstacleCall final : public grpc::ServerGenericBidiReactor,
                           public ObstacleAsker,
                           public std::enable_shared_from_this<ObstacleCall> {
 public:
  /// Calls `whenDone` at its end.
  ObstacleCall(std::shared_ptr<ObstacleAnswers> answers, std::function<void()> whenDone)
      : answers_(std::move(answers)), whenDone_(std::move(whenDone)) {}

  /// Reads the request; waits some seconds for it.
  void start();

  [[nodiscard]] bool isWaiting() const override;
  void answer(const Decoded<std::string>& cells) override;

  void OnReadDone(bool ok) override;
  void OnCancel() override { end(grpc::Status::CANCELLED); }
  void OnDone() override;

 private:
  void end(const grpc::Status& status);
  /// Returns true to the first caller, which then ends the call.
  [[nodiscard]] bool takeEnd();
  void giveUpUnasked();

  const std::shared_ptr<ObstacleAnswers> answers_;
  const std::function<void()> whenDone_;
  mutable std::mutex mutex_;
  bool isAsked_ = false;
  bool isOver_ = false;
  grpc::ByteBuffer question_;
  grpc::ByteBuffer answer_;
  grpc::Alarm patience_;
  std::shared_ptr<ObstacleCall> self_;  ///< during the call
};

}  // namespace grove::node
