#include "stream/web_server/connection.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "pipeline/clocks.h"
#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

/// The protocol's clocks, without waiting for them.
class ConnectionTest : public ServedWorld {
 protected:
  static MessagePiece whole(const std::vector<std::uint8_t>& bytes) { return {bytes, true, true, true}; }

  /// Says Hello and returns the first frame's number.
  std::uint32_t enter() {
    EXPECT_FALSE(connection_.receive(whole(encode(Hello{"Ada", 320, 180})), now_));
    EXPECT_FALSE(connection_.takeMessage().empty());
    while (!connection_.hasSomethingToSend()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return connection_.takeFrame()->header.frame;
  }

  const double now_ = pipeline::wallSeconds();
  log::Limited visitorLog_;
  const Connection::Door door_{[] { return std::make_shared<int>(); }, visitorLog_};
  Connection connection_{host_, "a test", now_, [] {}, door_, kSubProtocol};
};

TEST_F(ConnectionTest, EndsWithoutHello) {
  EXPECT_FALSE(connection_.overdue(now_ + 9.9));
  const auto refusal = connection_.overdue(now_ + 10.0);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, CloseCode::kNoHello);
  EXPECT_FALSE(connection_.overdue(now_ + 20.0)) << "only once";
}

TEST_F(ConnectionTest, EndsWithoutAcknowledgements) {
  enter();
  EXPECT_EQ(host_.visitors(), 1U);
  EXPECT_FALSE(connection_.overdue(now_ + 24.0));
  const auto refusal = connection_.overdue(pipeline::wallSeconds() + 25.0);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, CloseCode::kNoAcknowledgement);
  EXPECT_EQ(host_.visitors(), 0U);
}

TEST_F(ConnectionTest, RepeatedAcknowledgementsDoNotKeepAPlace) {
  const std::uint32_t frame = enter();
  ASSERT_FALSE(connection_.receive(whole(encode(Ack{frame})), now_));
  while (!connection_.hasSomethingToSend()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const double next = pipeline::wallSeconds();
  ASSERT_FALSE(connection_.receive(whole(encode(Ack{0})), now_ + 10.0));
  ASSERT_FALSE(connection_.receive(whole(encode(Ack{frame})), now_ + 20.0));
  EXPECT_TRUE(connection_.overdue(next + 25.0));
}

TEST_F(ConnectionTest, RefusesAcknowledgementsOfUnsentFrames) {
  enter();
  const auto refusal = connection_.receive(whole(encode(Ack{0xFFFFFFFFU})), now_);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, CloseCode::kProtocolError);
  EXPECT_EQ(host_.visitors(), 0U);
}

TEST_F(ConnectionTest, LimitsMessagesPerSecond) {
  ASSERT_FALSE(connection_.receive(whole(encode(Hello{"Ada", 320, 180})), now_));
  const auto ack = encode(Ack{0});
  for (int second = 0; second < 3; ++second) {
    for (int i = 0; i < 499; ++i) ASSERT_FALSE(connection_.receive(whole(ack), now_ + second));
  }
  std::optional<Refusal> refusal;
  for (int i = 0; i < 3 && !refusal; ++i) refusal = connection_.receive(whole(ack), now_ + 2.5);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, CloseCode::kFlood);
}

TEST_F(ConnectionTest, FramesAfterTheEndAreHarmless) {
  auto connection = std::make_unique<Connection>(
      host_, "a test", now_, [] {}, door_, kSubProtocol);
  ASSERT_FALSE(connection->receive(whole(encode(Hello{"Ada", 320, 180})), now_));
  EXPECT_FALSE(connection->takeMessage().empty());
  while (!connection->hasSomethingToSend()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_NE(connection->takeFrame(), nullptr);
  connection.reset();
  EXPECT_TRUE(becomesEmpty());
}

TEST(Outbox, KeepsOnlyTheNewestFrame) {
  int woken = 0;
  Outbox outbox([&] { ++woken; });
  EXPECT_TRUE(outbox.empty());
  const auto old = std::make_shared<const EncodedFrame>();
  const auto newest = std::make_shared<const EncodedFrame>();
  outbox.put(old);
  outbox.put(newest);
  EXPECT_EQ(old.use_count(), 1);
  EXPECT_EQ(outbox.take(), newest);
  EXPECT_EQ(outbox.take(), nullptr);
  EXPECT_EQ(woken, 2);
}

/// All messages that wait to be sent and tell what gets finer.
std::vector<int> percentsToldTo(Connection& connection) {
  std::vector<int> percents;
  for (auto bytes = connection.takeMessage(); !bytes.empty(); bytes = connection.takeMessage()) {
    const ServerMessage parsed = parseServerMessage(bytes);
    if (const auto* refining = std::get_if<Refining>(&parsed)) percents.push_back(refining->percent);
  }
  return percents;
}

TEST_F(ConnectionTest, ReportsRefinementToAdmittedNewPages) {
  const auto connect = [&](const char* subProtocol) {
    return std::make_unique<Connection>(
        host_, "a test", now_, [] {}, door_, subProtocol);
  };
  const auto hello = encode(Hello{"Ada", 320, 180});
  const auto newest = connect(kSubProtocolWithVideo);
  const auto older = connect(kSubProtocolWithWaiting);
  host_.report({.percent = 10, .secondsLeft = 90, .step = "oak"});
  EXPECT_FALSE(newest->hasSomethingToSend()) << "he is not in";
  ASSERT_FALSE(newest->receive(whole(hello), now_));
  ASSERT_FALSE(older->receive(whole(hello), now_));
  EXPECT_EQ(percentsToldTo(*newest), std::vector{10}) << "to who comes while it goes on";
  EXPECT_TRUE(percentsToldTo(*newest).empty()) << "once";
  host_.report({.percent = 20, .secondsLeft = 80, .step = "oak"});
  host_.report({.percent = 30, .secondsLeft = 70, .step = "oak"});
  EXPECT_TRUE(newest->hasSomethingToSend());
  EXPECT_EQ(percentsToldTo(*newest), std::vector{30}) << "the newest alone";
  host_.report({.percent = 100, .secondsLeft = 0, .step = {}});
  EXPECT_EQ(percentsToldTo(*newest), std::vector{100});
  EXPECT_TRUE(percentsToldTo(*older).empty());
  const auto late = connect(kSubProtocolWithVideo);
  ASSERT_FALSE(late->receive(whole(hello), now_));
  EXPECT_TRUE(percentsToldTo(*late).empty()) << "what was done before he came";
}

/// The names in the first message that tells who is here; nothing if none of those that wait does.
std::optional<std::vector<std::string>> namesToldTo(Connection& connection) {
  for (auto bytes = connection.takeMessage(); !bytes.empty(); bytes = connection.takeMessage()) {
    const ServerMessage parsed = parseServerMessage(bytes);
    const auto* people = std::get_if<People>(&parsed);
    if (people == nullptr) continue;
    std::vector<std::string> names;
    for (const Person& person : people->people) names.push_back(person.name);
    return names;
  }
  return std::nullopt;
}

// Faults: pages that wait for ever to learn who is here, or are told with every one of a hundred who come at once;
// older pages that get a message they do not know.
TEST_F(ConnectionTest, SendsTheRosterOncePerSecondAtMost) {
  using Names = std::vector<std::string>;
  const auto connect = [&](const char* subProtocol, const char* name) {
    auto connection = std::make_unique<Connection>(
        host_, "a test", now_, [] {}, door_, subProtocol);
    EXPECT_FALSE(connection->receive(whole(encode(Hello{name, 320, 180})), now_));
    return connection;
  };
  const auto ada = connect(kSubProtocolWithNames, "Ada");
  ASSERT_FALSE(ada->overdue(now_));
  EXPECT_TRUE(ada->hasSomethingToSend());
  EXPECT_EQ(namesToldTo(*ada), Names{"Ada"});
  ASSERT_FALSE(ada->overdue(now_ + 5.0));
  EXPECT_FALSE(namesToldTo(*ada)) << "nobody has come";
  auto older = connect(kSubProtocolWithTimes, "日本");
  ASSERT_FALSE(ada->overdue(now_ + 5.1));
  EXPECT_EQ(namesToldTo(*ada), (Names{"Ada", "日本"}));
  ASSERT_FALSE(older->overdue(now_ + 5.1));
  EXPECT_FALSE(namesToldTo(*older));
  older.reset();
  ASSERT_FALSE(ada->overdue(now_ + 6.0));
  EXPECT_FALSE(namesToldTo(*ada)) << "within the second";
  ASSERT_FALSE(ada->overdue(now_ + 6.2));
  EXPECT_EQ(namesToldTo(*ada), Names{"Ada"});
}

// Faults: a page that cannot walk ahead; an older one that gets a message it does not know.
TEST_F(ConnectionTest, SendsTheGroundToPagesThatMovePictures) {
  for (const char* subProtocol : {kSubProtocolWithNames, kSubProtocolWithNearness}) {
    Connection connection(
        host_, "a test", now_, [] {}, door_, subProtocol);
    ASSERT_FALSE(connection.receive(whole(encode(Hello{"Ada", 320, 180})), now_));
    ASSERT_TRUE(std::holds_alternative<Welcome>(parseServerMessage(connection.takeMessage())));
    const ServerMessage next = parseServerMessage(connection.takeMessage());
    const auto* ground = std::get_if<Ground>(&next);
    EXPECT_EQ(ground != nullptr, subProtocol == kSubProtocolWithNearness);
    EXPECT_TRUE(ground == nullptr || ground->radius == host_.players().radius());
  }
}

}  // namespace
}  // namespace grove::stream
