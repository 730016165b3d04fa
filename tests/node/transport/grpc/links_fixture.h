#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "eventually.h"
#include "node/messages/examples.h"
#include "node/transport/grpc/grpc_frontend_end.h"
#include "node/transport/grpc/grpc_server.h"
#include "pipeline/worker_pool.h"

namespace grove::node::testing {

/// A backend node as a link sees it: welcomes or refuses, and keeps what comes.
class NodeEnd final : public BackendPort {
 public:
  explicit NodeEnd(std::shared_ptr<BackendEnd> link, std::string refusal = "")
      : link_(std::move(link)), refusal_(std::move(refusal)) {
    link_->connect(*this);
  }
  ~NodeEnd() override { link_->leaveBackend(); }
  NodeEnd(const NodeEnd&) = delete;
  NodeEnd& operator=(const NodeEnd&) = delete;

  pipeline::PushResult receive(ToBackend message) override {
    while (isHeld) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    if (std::holds_alternative<NodeHello>(message)) {
      link_->send(refusal_.empty() ? ToFrontend(examples::welcome()) : ToFrontend(NodeRefusal{refusal_}));
    }
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
    return pipeline::PushResult::kAccepted;
  }
  [[nodiscard]] std::vector<ToBackend> messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
  }
  [[nodiscard]] std::size_t count() const { return messages().size(); }
  [[nodiscard]] BackendEnd& link() const { return *link_; }
  std::atomic<bool> isHeld{false};  ///< it receives nothing more until this is over

 private:
  const std::shared_ptr<BackendEnd> link_;
  const std::string refusal_;
  mutable std::mutex mutex_;
  std::vector<ToBackend> messages_;
};

/// A process that listens, and can end.
class NodeProcess {
 public:
  explicit NodeProcess(int port = 0, std::string refusal = "")
      : server_(
            "127.0.0.1:" + std::to_string(port),
            [this, refusal](std::shared_ptr<BackendEnd> link) {
              auto end = std::make_shared<NodeEnd>(std::move(link), refusal);
              const std::lock_guard lock(mutex_);
              ends_.push_back(end);
              return std::shared_ptr<void>(std::move(end));
            },
            workers, timeline) {}

  [[nodiscard]] int port() const { return server_.port(); }
  [[nodiscard]] std::string address() const { return "127.0.0.1:" + std::to_string(port()); }
  /// That of the link which came as this one; null if it is gone, or not there yet.
  [[nodiscard]] std::shared_ptr<NodeEnd> end(std::size_t index = 0) {
    const std::lock_guard lock(mutex_);
    return index < ends_.size() ? ends_[index].lock() : nullptr;
  }

  pipeline::Timeline timeline;
  pipeline::WorkerPool workers{2};

 private:
  std::mutex mutex_;
  std::vector<std::weak_ptr<NodeEnd>> ends_;
  GrpcServer server_;
};

/// A frontend process as a link sees it.
class FrontendSide final : public FrontendPort {
 public:
  using State = GrpcFrontendEnd::State;
  explicit FrontendSide(const std::string& address) : link_(address, workers, timeline) { link_.connect(*this); }
  ~FrontendSide() override { link_.leaveFrontend(); }
  FrontendSide(const FrontendSide&) = delete;
  FrontendSide& operator=(const FrontendSide&) = delete;

  void receive(ToFrontend message) override {
    while (isHeld) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
  }
  [[nodiscard]] std::size_t count() const {
    const std::lock_guard lock(mutex_);
    return messages_.size();
  }
  pipeline::PushResult send(ToBackend message) { return link_.send(std::move(message)); }
  /// Whether it comes to be so.
  [[nodiscard]] bool becomes(State state) {
    return tests::eventually([&] { return link_.status().state == state; });
  }
  [[nodiscard]] bool isWelcomed() {
    (void)send(examples::hello());
    return becomes(State::kWelcomed);
  }
  [[nodiscard]] GrpcFrontendEnd& link() { return link_; }
  std::atomic<bool> isHeld{false};

  pipeline::Timeline timeline;
  pipeline::WorkerPool workers{2};

 private:
  mutable std::mutex mutex_;
  std::vector<ToFrontend> messages_;
  GrpcFrontendEnd link_;
};

}  // namespace grove::node::testing
