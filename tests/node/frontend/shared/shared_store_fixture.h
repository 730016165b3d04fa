#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "node/frontend/shared/shared_store.h"
#include "pipeline/clocks.h"

namespace grove::node {

/// Shared data of so many bytes.
class Block final : public SharedData {
 public:
  Block(Version version, std::size_t bytes, double cadence = 0.0) : SharedData(version, cadence), bytes_(bytes) {}

 private:
  [[nodiscard]] std::size_t ownBytes() const noexcept override { return bytes_; }
  [[nodiscard]] PackedBytes pack() const override { return {}; }
  const std::size_t bytes_;
};

inline constexpr std::size_t kMaxBytes = 1000;
inline constexpr world::ObjectId kObject = 5;

[[nodiscard]] inline Request requestFor(const SharedKey& what, double secondsLeft = 60.0) {
  auto view = std::make_shared<View>();
  view->deadline = pipeline::wallSeconds() + secondsLeft;
  Request request;
  request.view = std::move(view);
  request.object = what.object;
  request.shared = true;
  request.key = what.key;
  return request;
}

[[nodiscard]] inline Result resultOf(const SharedKey& what, Version version, std::size_t bytes = 400) {
  Result result;
  result.what = what;
  result.shared = true;
  result.version = version;
  result.payload = std::make_shared<const Block>(version, bytes);
  return result;
}

[[nodiscard]] inline Result failureOf(const SharedKey& what) {
  Result result;
  result.what = what;
  result.shared = true;
  result.payload = Failure{"broken"};
  return result;
}

[[nodiscard]] inline std::string described(const Payload& payload) {
  if (const auto* failure = std::get_if<Failure>(&payload)) return failure->reason;
  const auto& data = std::get<std::shared_ptr<const SharedData>>(payload);
  return data ? "version " + std::to_string(data->version()) : "null";
}

/// A shared store without a backend node: the test brings what it fetches.
class SharedStoreTest : public ::testing::Test {
 protected:
  void get(const SharedKey& what, double secondsLeft = 60.0) {
    store.get(requestFor(what, secondsLeft), [this](const Payload& payload) { got.push_back(described(payload)); });
  }
  /// As it would come from a backend node without a wait, asked for if it was not.
  void bring(const SharedKey& what, Version version) {
    if (store.put(resultOf(what, version))) return;
    const std::vector<SharedKey> before = fetched;
    store.get(requestFor(what), [](const Payload&) {});
    fetched = before;
    EXPECT_TRUE(store.put(resultOf(what, version)));
  }
  /// 0: it is not there.
  Version versionOf(const SharedKey& what) {
    const auto data = store.find(what);
    return data ? data->version() : 0;
  }

  bool full = false;
  bool broken = false;
  std::vector<SharedKey> fetched;
  std::vector<Version> known;    ///< of those that no frame waits for
  std::vector<bool> subscribes;  ///< the same
  std::vector<ToBackend> told;   ///< besides
  std::vector<std::string> got;
  bool awaits(const SharedKey& what) { return store.awaits(resultOf(what, 1)); }

  SharedStore store{kMaxBytes, [this](const ToBackend& message) {
                      if (!std::holds_alternative<Request>(message)) {
                        told.push_back(message);
                        return true;
                      }
                      const auto& request = std::get<Request>(message);
                      EXPECT_TRUE(request.shared);
                      if (broken) throw std::runtime_error("the wire is broken");
                      if (!full) fetched.push_back({request.object, request.key});
                      if (!request.view) known.push_back(request.known);
                      if (!request.view) subscribes.push_back(request.subscribe);
                      return !full;
                    }};
  const SharedKey own{kObject, {}};
  const SharedKey a{kObject, "a"};
  const SharedKey b{kObject, "b"};
  const SharedKey c{kObject, "c"};
};

}  // namespace grove::node
