#include "stream/web_server/access/entrance.h"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A second server of the same world, whose visitors come through a proxy at 127.0.0.1; 127.0.0.2 is none.
class BehindProxy : public ServedWorld {
 protected:
  static constexpr const char* kAnybody = "127.0.0.2";
  static constexpr const char* kProxyElsewhere = "127.0.0.3";
  BehindProxy() { proxied_.start(); }

  [[nodiscard]] RawWebsocket come(const std::string& headers, const char* source = "127.0.0.1") const {
    return {RawSocket(proxied_.port(), 0, source), "grove.example", headers};
  }
  [[nodiscard]] static std::string from(const std::string& address) { return "X-Forwarded-For: " + address + "\r\n"; }
  /// The code with which a visitor is closed, 0 if he is let in.
  static int enter(RawWebsocket& websocket) {
    websocket.send(encode(Hello{"Ada", 320, 180}));
    const auto first = websocket.receive();
    if (!first) return -1;
    if (first->opcode == RawWebsocket::kBinary) return 0;
    return first->bytes.size() < 2 ? -1 : first->bytes[0] * 256 + first->bytes[1];
  }
  [[nodiscard]] int ask(const std::string& headers, const char* source = "127.0.0.1") const {
    RawSocket socket(proxied_.port(), 0, source);
    return request(socket, "GET", "/healthz", "Host: grove.example\r\n" + headers).status;
  }

  WebsocketServer proxied_{
      host_,
      {.visitors = {"127.0.0.1", 0},
       .operators = {},
       .rules = {.names = {"grove.example"},
                 .origins = {"https://arcade.example"},
                 .proxies = {*AddressRange::parse("127.0.0.1"), *AddressRange::parse(kProxyElsewhere)},
                 .allowance = {.sockets = 6, .visitors = 1, .socketsPerSecond = 0.01, .burst = 8}}}};
};

TEST_F(BehindProxy, PlacesCountByForwardedAddress) {
  RawWebsocket ada = come(from("203.0.113.7"));
  ASSERT_EQ(enter(ada), 0);
  RawWebsocket again = come(from("198.51.100.9, 203.0.113.7"));
  EXPECT_EQ(enter(again), static_cast<int>(CloseCode::kFull)) << "what a visitor writes before his address is nothing";
  RawWebsocket bob = come(from("203.0.113.8"));
  EXPECT_EQ(enter(bob), 0);
}

TEST_F(BehindProxy, IgnoresHeadersOfOthers) {
  RawWebsocket ada = come(from("203.0.113.7"), kAnybody);
  ASSERT_EQ(enter(ada), 0);
  RawWebsocket again = come(from("203.0.113.8"), kAnybody);
  EXPECT_EQ(enter(again), static_cast<int>(CloseCode::kFull));
  RawWebsocket renamed(RawSocket(proxied_.port(), 0, kAnybody), "rebound.example",
                       "X-Forwarded-Host: grove.example\r\n");
  EXPECT_EQ(renamed.status(), 403);
  EXPECT_EQ(come("Origin: https://evil.example\r\nX-Forwarded-Host: evil.example\r\n", kAnybody).status(), 403);
}

TEST_F(BehindProxy, SocketsCountByForwardedAddress) {
  std::vector<RawWebsocket> idle;
  idle.reserve(6);
  for (int i = 0; i < 6; ++i) {
    idle.push_back(come(from("203.0.113.7")));
    ASSERT_EQ(idle.back().status(), 101) << i;
  }
  EXPECT_EQ(come(from("203.0.113.7")).status(), 429);
  EXPECT_EQ(ask(from("203.0.113.7")), 429);
  EXPECT_EQ(come(from("203.0.113.8")).status(), 101);
  EXPECT_EQ(ask(from("203.0.113.8")), 200);
  EXPECT_EQ(host_.timeline().counters().at("refused connections"), 2);
}

TEST_F(BehindProxy, NewSocketsCountByForwardedAddress) {
  int upgraded = 0;
  for (int i = 0; i < 20; ++i) upgraded += come(from("203.0.113.7")).status() == 101 ? 1 : 0;
  EXPECT_GE(upgraded, 6);
  EXPECT_LE(upgraded, 8) << "the burst";
  EXPECT_EQ(come(from("203.0.113.8")).status(), 101);
  for (int i = 10; i < 40; ++i) {
    EXPECT_EQ(come(from("203.0.113." + std::to_string(i)), kProxyElsewhere).status(), 101)
        << "the proxy itself has no limit: " << i;
  }
}

TEST_F(BehindProxy, RequestsCountByForwardedAddress) {
  int answered = 0;
  for (int i = 0; i < 100; ++i) answered += ask(from("203.0.113.7")) == 200 ? 1 : 0;
  EXPECT_GE(answered, 60) << "each costs an eighth of a socket";
  EXPECT_LE(answered, 70);
  EXPECT_EQ(ask(from("203.0.113.8")), 200);
}

/// Proxies keep connections and use them for whoever comes next.
TEST_F(BehindProxy, OneSocketServesManyVisitors) {
  std::vector<RawSocket> kept;
  kept.reserve(12);
  for (int i = 0; i < 12; ++i) kept.emplace_back(proxied_.port());
  for (int round = 0; round < 3; ++round) {
    for (RawSocket& socket : kept) {
      socket.send("GET /healthz HTTP/1.1\r\nHost: grove.example\r\n" + from("203.0.113.7") + "\r\n");
      std::string answer;
      for (std::string more = " "; !more.empty() && !answer.ends_with("\r\n\r\nok"); answer += more)
        more = socket.receive();
      ASSERT_TRUE(answer.starts_with("HTTP/1.1 200")) << round << ": what is answered holds no place";
    }
  }
}

/// Together they may well be more than one visitor would send.
TEST_F(BehindProxy, ManyVisitorsAreNoFlood) {
  RawSocket socket(proxied_.port());
  const std::string padding(2000, 'x');
  for (int i = 0; i < 61; ++i) {
    // Until it has been looked at, which is ten times a second.
    if (i == 60) std::this_thread::sleep_for(std::chrono::milliseconds(500));
    socket.send("GET /healthz HTTP/1.1\r\nHost: grove.example\r\nCookie: " + padding + "\r\n" +
                from("203.0.113." + std::to_string(i)) + "\r\n");
    std::string answer;
    for (std::string more = " "; !more.empty() && !answer.ends_with("\r\n\r\nok"); answer += more)
      more = socket.receive();
    ASSERT_TRUE(answer.starts_with("HTTP/1.1 200")) << i;
  }
}

TEST_F(BehindProxy, OriginIsComparedWithForwardedHost) {
  const std::string secure = "X-Forwarded-Proto: https\r\n";
  EXPECT_EQ(come(secure + "Origin: https://grove.example\r\n").status(), 101);
  EXPECT_EQ(come(secure + "Origin: http://grove.example\r\n").status(), 403);
  EXPECT_EQ(come("X-Forwarded-Proto: http\r\nOrigin: https://grove.example\r\n").status(), 403);
  const auto inside = [&](const std::string& headers) {
    return RawWebsocket(RawSocket(proxied_.port()), "backend.internal:8080", headers).status();
  };
  EXPECT_EQ(inside("X-Forwarded-Host: grove.example\r\nOrigin: https://grove.example\r\n"), 101);
  EXPECT_EQ(inside("X-Forwarded-Host: evil.example, grove.example\r\nOrigin: https://grove.example\r\n"), 101);
  EXPECT_EQ(inside("X-Forwarded-Host: grove.example, evil.example\r\nOrigin: https://evil.example\r\n"), 403);
  EXPECT_EQ(inside("X-Forwarded-Host: grove.example\r\nOrigin: https://backend.internal:8080\r\n"), 403);
  EXPECT_EQ(inside("Origin: https://backend.internal:8080\r\n"), 403) << "nobody knows it by that name";
}

TEST_F(BehindProxy, ListedOriginsMayConnect) {
  for (const char* const source : {"127.0.0.1", kAnybody}) {
    EXPECT_EQ(come("Origin: https://arcade.example\r\n", source).status(), 101) << source;
    EXPECT_EQ(come("Origin: http://arcade.example\r\n", source).status(), 403) << source;
    EXPECT_EQ(come("Origin: https://evil.arcade.example\r\n", source).status(), 403) << source;
    EXPECT_EQ(come("Origin: null\r\n", source).status(), 403) << source;
  }
}

TEST_F(BehindProxy, LogNamesTheForwardedAddress) {
  testing::internal::CaptureStderr();
  {
    RawWebsocket ada = come(from("198.51.100.9, 203.0.113.7"));
    EXPECT_EQ(enter(ada), 0);
    RawWebsocket bob = come(from("203.0.113.8"), kAnybody);
    EXPECT_EQ(enter(bob), 0);
  }
  EXPECT_TRUE(becomesEmpty());
  const std::string lines = testing::internal::GetCapturedStderr();
  EXPECT_THAT(lines, HasSubstr("203.0.113.7 through 127.0.0.1:"));
  EXPECT_THAT(lines, Not(HasSubstr("203.0.113.8")));
}

TEST_F(BehindProxy, MalformedHeaders) {
  EXPECT_EQ(ask(from("unknown")), 200);
  EXPECT_EQ(ask(from("") + from(",,,") + from("203.0.113.7, \x01\x02[::")), 200);
  EXPECT_EQ(ask("X-Forwarded-Host: \r\nX-Forwarded-Proto: \r\n"), 200);
  RawWebsocket split = come(from("203.0.113.9") + from("203.0.113.7"));
  EXPECT_EQ(enter(split), 0) << "in two headers, as HAProxy writes it";
  RawWebsocket second = come(from("203.0.113.7"));
  EXPECT_EQ(enter(second), static_cast<int>(CloseCode::kFull)) << "the last one counts";
  for (const char* const name : {"X-Forwarded-For", "X-Forwarded-Host", "X-Forwarded-Proto"}) {
    EXPECT_NE(ask(std::string(name) + ": " + std::string(100'000, '1') + "\r\n"), 200) << name;
  }
  EXPECT_EQ(ask(from("203.0.113.8")), 200);
}

}  // namespace
}  // namespace grove::stream
