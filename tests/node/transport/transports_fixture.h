#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "node/tested_transports.h"
#include "node/transport/transport.h"
#include "pipeline/worker_pool.h"

/// Both ends of a link of each kind, which keep what they receive.
namespace grove::node::testing {

/// Keeps what it gets.
template <class Port, class Message>
class Mailbox : public Port {
 public:
  [[nodiscard]] std::vector<Message> messages() const {
    const std::lock_guard lock(mutex_);
    return messages_;
  }
  [[nodiscard]] std::size_t count() const { return messages().size(); }

 protected:
  void keep(Message message) {
    const std::lock_guard lock(mutex_);
    messages_.push_back(std::move(message));
  }

 private:
  mutable std::mutex mutex_;
  std::vector<Message> messages_;
};

class Backend final : public Mailbox<BackendPort, ToBackend> {
 public:
  std::atomic<pipeline::PushResult> answer = pipeline::PushResult::kAccepted;
  pipeline::PushResult receive(ToBackend message) override {
    keep(std::move(message));
    return answer;
  }
};

class Frontend final : public Mailbox<FrontendPort, ToFrontend> {
 public:
  void receive(ToFrontend message) override { keep(std::move(message)); }
};

class Transports : public ::testing::TestWithParam<TransportKind> {
 public:
  Transports() {
    transport->connect(backend);
    transport->connect(frontend);
  }
  ~Transports() override {
    transport->leaveFrontend();
    transport->leaveBackend();
    workers.drain();
  }

 protected:
  pipeline::Timeline timeline;
  pipeline::WorkerPool workers{3};
  Backend backend;
  Frontend frontend;
  const std::unique_ptr<Transport> transport = transportFactory(GetParam())(workers, timeline);
};

}  // namespace grove::node::testing
