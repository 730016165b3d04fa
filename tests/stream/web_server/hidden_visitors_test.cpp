#include <memory>

#include "pipeline/clocks.h"
#include "stream/web_server/connection.h"
#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

/// Connections to a full world of two, without sockets: clocks of the protocol without waiting for them.
class HiddenVisitors : public ServedWorld {
 protected:
  std::unique_ptr<Host> makeHost(double graceSeconds) {
    node::LoadedScene scene;
    scene.layout.name = "Nowhere";
    return std::make_unique<Host>(node::localWorld(std::move(scene), types_.backends, gl_), types_.frontends,
                                  HostOptions{.maxVisitors = 2, .hiddenGraceSeconds = graceSeconds},
                                  [](std::string_view, float) {});
  }
  static MessagePiece whole(const std::vector<std::uint8_t>& bytes) { return {bytes, true, true, true}; }

  std::unique_ptr<Connection> connect(Host& host) {
    const Connection::Door door{[] { return std::make_shared<int>(); }, log_};
    return std::make_unique<Connection>(
        host, "a test", now_, [] {}, door, kSubProtocolWithVideo);
  }
  std::optional<Refusal> enter(Connection& connection) const {
    return connection.receive(whole(encode(Hello{"Ada", 320, 180})), now_);
  }
  void hide(Connection& connection, bool hidden = true) const {
    EXPECT_FALSE(connection.receive(whole(encode(Limits{.hidden = hidden})), now_));
  }

  const double now_ = pipeline::wallSeconds();
  log::Limited log_;
};

/// Sixteen of them kept everybody else out for as long as they liked.
TEST_F(HiddenVisitors, YieldToNewcomersLongestHiddenFirst) {
  const auto host = makeHost(0.0);
  const auto first = connect(*host);
  const auto second = connect(*host);
  ASSERT_FALSE(enter(*first));
  ASSERT_FALSE(enter(*second));
  hide(*second);
  hide(*first);
  const auto newcomer = connect(*host);
  EXPECT_FALSE(enter(*newcomer));
  EXPECT_EQ(host->visitors(), 2U);
  EXPECT_FALSE(first->overdue(now_));
  const auto why = second->overdue(now_);
  ASSERT_TRUE(why);
  EXPECT_EQ(why->code, CloseCode::kHidden);
}

TEST_F(HiddenVisitors, KeepTheirPlacesForAPeriod) {
  const auto host = makeHost(1e6);
  const auto first = connect(*host);
  const auto second = connect(*host);
  ASSERT_FALSE(enter(*first));
  ASSERT_FALSE(enter(*second));
  hide(*first);
  const auto refusal = enter(*connect(*host));
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, CloseCode::kFull);
  EXPECT_FALSE(first->overdue(now_));
}

TEST_F(HiddenVisitors, KeepTheirPlacesWhenVisibleAgain) {
  const auto host = makeHost(0.0);
  const auto first = connect(*host);
  const auto second = connect(*host);
  ASSERT_FALSE(enter(*first));
  ASSERT_FALSE(enter(*second));
  hide(*first);
  hide(*first, false);
  const auto refusal = enter(*connect(*host));
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->code, CloseCode::kFull);
}

TEST_F(HiddenVisitors, LeaveWithoutPong) {
  const auto host = makeHost(0.0);
  const auto visitor = connect(*host);
  ASSERT_FALSE(enter(*visitor));
  hide(*visitor);
  EXPECT_FALSE(visitor->overdue(now_ + 9.9));
  EXPECT_FALSE(visitor->takePing());
  EXPECT_FALSE(visitor->overdue(now_ + 10.1));
  EXPECT_TRUE(visitor->takePing());
  EXPECT_FALSE(visitor->takePing()) << "one";
  visitor->ponged();
  EXPECT_FALSE(visitor->overdue(now_ + 20.5));
  EXPECT_TRUE(visitor->takePing());
  EXPECT_FALSE(visitor->overdue(now_ + 35.0));
  const auto why = visitor->overdue(now_ + 36.0);
  ASSERT_TRUE(why) << "for more than five minutes a dead one kept the place";
  EXPECT_EQ(why->code, CloseCode::kNoAcknowledgement);
  EXPECT_EQ(host->visitors(), 0U);
}

}  // namespace
}  // namespace grove::stream
