#include "stream/websocket_server.h"

#include <gmock/gmock.h>

#include "base/error.h"
#include "stream/served_world.h"

namespace grove::stream {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

using WebsocketServerTest = ServedWorld;

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

TEST_F(WebsocketServerTest, SaysGoodbyeWhenItStops) {
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

TEST_F(WebsocketServerTest, NamesAPortThatIsTaken) {
  EXPECT_THAT([&] { WebsocketServer(host_, "127.0.0.1", port()); },
              ThrowsMessage<EnvironmentError>(HasSubstr("in use")));
  GoodClient client(port());
  EXPECT_TRUE(client.receiveFrames(1));
}

TEST_F(WebsocketServerTest, NamesAnAddressThatIsNotHere) {
  EXPECT_THROW(WebsocketServer(host_, "192.0.2.1", 0), EnvironmentError);
  EXPECT_THROW(WebsocketServer(host_, "no-such-host.invalid", 0), EnvironmentError);
  EXPECT_THROW(WebsocketServer(host_, "127.0.0.1", 70'000), EnvironmentError);
}

TEST_F(WebsocketServerTest, ListensOnAllAddressesAndByName) {
  for (const char* address : {"0.0.0.0", "localhost"}) {
    WebsocketServer other(host_, address, 0);
    other.start();
    EXPECT_EQ(request(other.port(), "GET", "/healthz").status, 200) << address;
  }
}

}  // namespace
}  // namespace grove::stream
