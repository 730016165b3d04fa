#include "stream/web_server/websocket_server.h"

#include <gmock/gmock.h>

#include <chrono>

#include "base/error.h"
#include "eventually.h"
#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class WebsocketServerTest : public ServedWorld {
 protected:
  WebsocketServer serverAt(const std::string& address, int at) {
    return {host_, {.visitors = {address, at}, .operators = {}}};
  }
};

TEST_F(WebsocketServerTest, GreetsThenStreams) {
  RawWebsocket websocket(port());
  ASSERT_EQ(websocket.status(), 101);
  websocket.send(encode(Hello{"Ada", 640, 360}));
  const auto first = websocket.receive();
  ASSERT_TRUE(first);
  const ServerMessage parsed = parseServerMessage(first->bytes);
  const auto* welcome = std::get_if<Welcome>(&parsed);
  ASSERT_NE(welcome, nullptr);
  EXPECT_EQ(welcome->world, "Nowhere");
  EXPECT_EQ(host_.visitors(), 1U);
  const auto second = websocket.receive();
  ASSERT_TRUE(second);
  const ServerMessage frame = parseServerMessage(second->bytes);
  ASSERT_TRUE(std::holds_alternative<FrameMessage>(frame));
  EXPECT_EQ(std::get<FrameMessage>(frame).header.width, 640);
}

TEST_F(WebsocketServerTest, TakesMessagesInFragments) {
  GoodClient client(port());
  ASSERT_TRUE(client.receiveFrames(1));
  const auto input = encode(world::Input{9, 0, 0.25F, 0});
  client.websocket().send(std::span(input).first(5), RawWebsocket::kBinary, false);
  client.websocket().send(std::span(input).subspan(5), RawWebsocket::kContinuation, true);
  while (client.lastFrame().lastInput != 9) ASSERT_TRUE(client.receiveFrames(1));
}

TEST_F(WebsocketServerTest, SendsNoMoreThanTwoFramesUnacknowledged) {
  RawWebsocket lazy(port());
  lazy.send(encode(Hello{"lazy", 320, 180}));
  GoodClient good(port());
  ASSERT_TRUE(good.receiveFrames(20));
  lazy.send({}, RawWebsocket::kPing);
  int frames = 0;
  while (const auto message = lazy.receive()) {
    if (message->opcode != RawWebsocket::kBinary) break;
    if (std::holds_alternative<FrameMessage>(parseServerMessage(message->bytes))) ++frames;
  }
  EXPECT_LE(frames, 2);
}

TEST_F(WebsocketServerTest, ChangesTheSize) {
  GoodClient client(port(), 320, 180);
  ASSERT_TRUE(client.receiveFrames(2));
  client.websocket().send(encode(Resize{640, 480}));
  while (client.lastFrame().width != 640) ASSERT_TRUE(client.receiveFrames(1));
  EXPECT_EQ(client.lastFrame().height, 480);
}

TEST_F(WebsocketServerTest, SendsGoodbyeOnStop) {
  GoodClient client(port());
  ASSERT_TRUE(client.receiveFrames(1));
  RawWebsocket silent(port());
  server_.stop();
  const auto close = client.websocket().receiveClose();
  ASSERT_TRUE(close);
  EXPECT_EQ(close->code, 1001);
  EXPECT_EQ(host_.visitors(), 0U);
  EXPECT_THROW(RawSocket{port()}, std::runtime_error);
}

TEST_F(WebsocketServerTest, NamesAPortInUse) {
  EXPECT_THAT([&] { serverAt("127.0.0.1", port()); }, ThrowsMessage<EnvironmentError>(HasSubstr("in use")));
  GoodClient client(port());
  EXPECT_TRUE(client.receiveFrames(1));
}

TEST_F(WebsocketServerTest, NamesAForeignAddress) {
  EXPECT_THROW(serverAt("192.0.2.1", 0), EnvironmentError);
  EXPECT_THROW(serverAt("no-such-host.invalid", 0), EnvironmentError);
  EXPECT_THROW(serverAt("127.0.0.1", 70'000), EnvironmentError);
}

TEST_F(WebsocketServerTest, ListensOnAllAddressesAndByName) {
  for (const char* address : {"0.0.0.0", "localhost"}) {
    WebsocketServer other = serverAt(address, 0);
    other.start();
    EXPECT_EQ(request(other.port(), "GET", "/healthz").status, 200) << address;
  }
}

TEST_F(WebsocketServerTest, NamesAnOperatorPortInUse) {
  EXPECT_THAT(
      [&] {
        WebsocketServer(host_, {.visitors = {"127.0.0.1", 0}, .operators = HostPort{"127.0.0.1", port()}});
      },
      ThrowsMessage<EnvironmentError>(HasSubstr("--operator")));
}

/// Visitors of an address that is not the one of a proxy on this machine.
class OneAddress : public ServedWorld {
 protected:
  static constexpr const char* kElsewhere = "127.0.0.2";
  RawWebsocket visitor() {
    RawWebsocket visitor(limited_.port(), "", 0, kElsewhere);
    visitor.send(encode(Hello{"Ada", 320, 180}));
    return visitor;
  }
  static bool isWelcomed(RawWebsocket& visitor) {
    const auto first = visitor.receive();
    return first && first->opcode == RawWebsocket::kBinary;
  }
  OneAddress() { limited_.start(); }

  WebsocketServer limited_{
      host_,
      {.visitors = {"127.0.0.1", 0},
       .operators = {},
       .rules = {.allowance = {.sockets = 6, .visitors = 2, .socketsPerSecond = 20, .burst = 30}}}};
};

TEST_F(OneAddress, VisitorsAreLimited) {
  auto one = std::make_unique<RawWebsocket>(visitor());
  RawWebsocket two = visitor();
  ASSERT_TRUE(isWelcomed(*one));
  ASSERT_TRUE(isWelcomed(two));
  const auto close = visitor().receiveClose();
  ASSERT_TRUE(close);
  EXPECT_EQ(close->code, static_cast<int>(CloseCode::kFull));
  EXPECT_THAT(close->reason, HasSubstr("your address"));
  GoodClient other(limited_.port());
  EXPECT_TRUE(other.receiveFrames(2)) << "another address is not concerned";
  one.reset();
  EXPECT_TRUE(tests::eventually([&] {
    RawWebsocket next = visitor();
    return isWelcomed(next);
  })) << "who leaves makes room";
}

TEST_F(OneAddress, SocketsAreLimited) {
  std::vector<RawSocket> idle;
  idle.reserve(6);
  for (int i = 0; i < 6; ++i) idle.emplace_back(limited_.port(), 0, kElsewhere);
  for (RawSocket& each : idle) ASSERT_TRUE(each.send("GET"));
  RawSocket more(limited_.port(), 0, kElsewhere);
  EXPECT_TRUE(more.receive().empty()) << "closed at once";
  EXPECT_EQ(request(limited_.port(), "GET", "/healthz").status, 200);
  EXPECT_EQ(request(limited_.operatorPort(), "GET", "/healthz").status, 200);
  EXPECT_EQ(host_.timeline().counters().at("refused connections"), 1);
}

TEST_F(OneAddress, ReconnectsAreLimited) {
  int answered = 0;
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 100; ++i) {
    RawSocket socket(limited_.port(), 0, kElsewhere);
    socket.send("GET /healthz HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
    answered += socket.receiveAll().ends_with("ok") ? 1 : 0;
  }
  EXPECT_GE(answered, 25) << "a page's files come at once";
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  EXPECT_LE(answered, 30 + 20 * took.count() + 1) << took.count() << " s";
  EXPECT_EQ(request(limited_.port(), "GET", "/healthz").status, 200);
}

}  // namespace
}  // namespace grove::stream
