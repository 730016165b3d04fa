#include "node/transport/packed_loopback.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <vector>

#include "node/registry.h"
#include "pipeline/worker_pool.h"

namespace grove::node {
namespace {

/// How often which work was done.
struct Counts {
  std::atomic<int> packed{0};
  std::atomic<int> unpacked{0};
};

/// A number, which packs into one byte.
class Number final : public SimulationData {
 public:
  Number(int value, Counts& counts) : value_(value), counts_(counts) {}
  [[nodiscard]] int value() const { return value_; }

 private:
  [[nodiscard]] std::string_view packedType() const override { return "number"; }
  [[nodiscard]] std::vector<std::byte> pack() const override {
    ++counts_.packed;
    return {static_cast<std::byte>(value_)};
  }
  int value_;
  Counts& counts_;
};

/// Data without a packed form.
class Unpackable final : public SimulationData {};

class NumberType final : public ObjectType {
 public:
  explicit NumberType(Counts& counts) : counts_(counts) {}
  [[nodiscard]] std::string_view name() const override { return "number"; }
  [[nodiscard]] std::shared_ptr<const world::Model> model(const world::Parameters&) const override { return nullptr; }
  [[nodiscard]] std::unique_ptr<BackendHalf> makeBackend(const BackendServices&, world::TypeIndex) const override {
    return nullptr;
  }
  [[nodiscard]] std::shared_ptr<const SimulationData> unpack(std::span<const std::byte> bytes) const override {
    if (bytes.front() == std::byte{13}) throw PackingError("damaged");
    ++counts_.unpacked;
    return std::make_shared<Number>(static_cast<int>(bytes.front()), counts_);
  }

 private:
  Counts& counts_;
};

/// A frontend's end of the wire.
class Mailbox final : public pipeline::Inlet<Result> {
 public:
  pipeline::PushResult push(Result result) override {
    results.push_back(std::move(result));
    return pipeline::PushResult::kAccepted;
  }
  bool tryReserve(std::function<void()>) override { return true; }
  void cancelReservation() override {}
  pipeline::PushResult pushReserved(Result result) override { return push(std::move(result)); }
  std::vector<Result> results;
};

class PackedLoopbackTest : public ::testing::Test {
 protected:
  PackedLoopbackTest() {
    registry.add(std::make_unique<NumberType>(counts));
    for (const SessionId session : {1U, 2U}) transport.connectFrontend(session, boxes[session - 1]);
  }

  /// The whole way of one frame's data to a session.
  Payload travel(SessionId session, const std::shared_ptr<const SimulationData>& data) {
    transport.send(Result{session, 1, 0, transport.compress(data)});
    Payload payload = std::move(boxes[session - 1]->results.back().payload);
    boxes[session - 1]->results.clear();
    return transport.decompress(std::move(payload));
  }
  static int valueOf(const Payload& payload) {
    return dynamic_cast<const Number&>(*std::get<std::shared_ptr<const SimulationData>>(payload)).value();
  }

  Counts counts;
  Registry registry;
  pipeline::Timeline timeline;
  PackedLoopback transport{registry, timeline};
  std::vector<std::shared_ptr<Mailbox>> boxes{std::make_shared<Mailbox>(), std::make_shared<Mailbox>()};
};

TEST_F(PackedLoopbackTest, PacksATickOnceAndUnpacksItOnceForEveryFrontend) {
  for (int tick = 0; tick < 3; ++tick) {
    const auto data = std::make_shared<Number>(100 + tick, counts);
    for (int frame = 0; frame < 4; ++frame) {
      EXPECT_EQ(valueOf(travel(1, data)), 100 + tick);
      EXPECT_EQ(valueOf(travel(2, data)), 100 + tick);
    }
  }
  EXPECT_EQ(counts.packed, 3);
  EXPECT_EQ(counts.unpacked, 6);
  const auto totals = timeline.totals();
  EXPECT_EQ(totals.at("Snapshot Packing").runs, 3U);
  EXPECT_EQ(totals.at("Snapshot Packing").work, pipeline::Work::kAcrossUser);
}

TEST_F(PackedLoopbackTest, ManyRequestsAtOncePackOnce) {
  const auto data = std::make_shared<Number>(5, counts);
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 8; ++i) {
      threads.emplace_back([&] {
        for (int k = 0; k < 100; ++k) EXPECT_EQ(valueOf(transport.decompress(transport.compress(data))), 5);
      });
    }
  }
  EXPECT_EQ(counts.packed, 1);
}

TEST_F(PackedLoopbackTest, KeepsNothingOfTicksThatAreGone) {
  auto data = std::make_shared<Number>(1, counts);
  const std::weak_ptr<const PackedData> first = data->packed(timeline);
  travel(1, data);
  data = std::make_shared<Number>(2, counts);
  travel(1, data);
  EXPECT_TRUE(first.expired());
}

TEST_F(PackedLoopbackTest, DamagedBytesBecomeAFailure) {
  const Payload payload = travel(1, std::make_shared<Number>(13, counts));
  ASSERT_TRUE(std::holds_alternative<Failure>(payload));
  EXPECT_EQ(std::get<Failure>(payload).reason, "damaged");
}

TEST_F(PackedLoopbackTest, WhatHasNoPackedFormTravelsByReference) {
  const std::shared_ptr<const SimulationData> data = std::make_shared<Unpackable>();
  EXPECT_EQ(std::get<std::shared_ptr<const SimulationData>>(travel(1, data)), data);
  EXPECT_EQ(std::get<Failure>(transport.decompress(transport.compress(Failure{"why"}))).reason, "why");
  const std::shared_ptr<const raster::Image> image = std::make_shared<raster::Image>();
  EXPECT_EQ(std::get<std::shared_ptr<const raster::Image>>(transport.decompress(transport.compress(image))), image);
  EXPECT_FALSE(timeline.totals().contains("Snapshot Packing"));
}

TEST_F(PackedLoopbackTest, ResultsForFrontendsThatHaveGoneAreDropped) {
  transport.disconnectFrontend(1);
  transport.send(Result{1, 1, 0, transport.compress(std::make_shared<Number>(1, counts))});
  EXPECT_TRUE(boxes[0]->results.empty());
}

}  // namespace
}  // namespace grove::node
