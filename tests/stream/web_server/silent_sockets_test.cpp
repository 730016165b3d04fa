#include <deque>
#include <string>

#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

constexpr int kSockets = 24;
/// Of the sockets, some are kept for the operator.
constexpr int kForVisitors = kSockets - 8;

/// A server with few places for sockets, of which six addresses may have more than there are.
class SilentSockets : public ServedWorld {
 protected:
  SilentSockets() { crowded_.start(); }

  [[nodiscard]] static std::string address(int index) { return "127.0.2." + std::to_string(index % 6 + 1); }

  /// Opens `count` sockets that send `bytes`, which are no whole request.
  void crowd(int count, const std::string& bytes) {
    for (int i = 0; i < count; ++i) {
      silent_.emplace_back(crowded_.port(), 0, address(i).c_str());
      silent_.back().send(bytes);
    }
  }
  [[nodiscard]] RawWebsocket come(const char* from) const { return RawWebsocket(crowded_.port(), "", 0, from); }

  WebsocketServer crowded_{host_, {.visitors = {"127.0.0.1", 0}, .operators = {}, .maxSockets = kSockets}};
  std::deque<RawSocket> silent_;
};

/// Without eviction they hold every place for ten seconds, and take it again.
TEST_F(SilentSockets, YieldToNewcomers) {
  for (const char* bytes : {"", "GET / HTTP/1.1\r\nX-", "GET / HTTP/1.1\r\nHost: localhost\r\n"}) {
    crowd(3 * kForVisitors, bytes);
    for (int i = 0; i < 10; ++i) {
      RawWebsocket websocket = come("127.0.3.1");
      ASSERT_EQ(websocket.status(), 101) << bytes << i;
      GoodClient newcomer(std::move(websocket));
      ASSERT_TRUE(newcomer.receiveFrames(1)) << bytes << i;
    }
  }
}

/// A websocket that never says Hello holds its place for ten seconds, too.
TEST_F(SilentSockets, SilentWebsocketsYield) {
  std::deque<RawWebsocket> upgraded;
  for (int i = 0; i < 2 * kForVisitors; ++i) {
    upgraded.push_back(come(address(i).c_str()));
    ASSERT_EQ(upgraded.back().status(), 101) << i;
  }
  GoodClient newcomer(come("127.0.3.1"));
  EXPECT_TRUE(newcomer.receiveFrames(1));
}

/// One that was answered and sends the next request byte by byte is no better than one that was never asked.
TEST_F(SilentSockets, IdleHttpSocketsYield) {
  for (int i = 0; i < 2 * kForVisitors; ++i) {
    silent_.emplace_back(crowded_.port(), 0, address(i).c_str());
    silent_.back().send("GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n");
    ASSERT_FALSE(silent_.back().receive().empty()) << i;
    silent_.back().send("GET /");
  }
  GoodClient newcomer(come("127.0.3.1"));
  EXPECT_TRUE(newcomer.receiveFrames(1));
}

TEST_F(SilentSockets, DoNotDisplaceVisitors) {
  GoodClient early(come("127.0.2.1"));
  ASSERT_TRUE(early.receiveFrames(1));
  crowd(4 * kForVisitors, "GET");
  GoodClient late(come("127.0.3.1"));
  EXPECT_TRUE(late.receiveFrames(2));
  EXPECT_TRUE(early.receiveFrames(2));
}

}  // namespace
}  // namespace grove::stream
