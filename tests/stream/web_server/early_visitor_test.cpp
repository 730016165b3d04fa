#include "stream/web_server/early_visitor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <thread>

#include "gl/shader_library.h"
#include "gl/workers.h"
#include "node/local/local_world.h"
#include "node/object_types.h"
#include "stream/session/host.h"
#include "stream/web_server/raw_websocket.h"
#include "stream/web_server/websocket_server.h"

namespace grove::stream {
namespace {

constexpr const char* kAsksForWaiting = "Sec-WebSocket-Protocol: grove.v1.1\r\n";

/// A server whose world comes later than its visitors.
class EarlyVisitorTest : public testing::Test {
 protected:
  EarlyVisitorTest() { server_.start(); }
  ~EarlyVisitorTest() override { server_.stop(); }

  void makeWorld() {
    node::LoadedScene scene;
    scene.layout.name = "Late";
    host_.emplace(node::localWorld(std::move(scene), types_.backends, gl_), types_.frontends,
                  HostOptions{.maxVisitors = 1}, [](std::string_view, float) {});
    server_.open(*host_);
  }

  /// The next message that is not Waiting.
  static ServerMessage afterWaiting(RawWebsocket& websocket, std::vector<std::uint8_t>& bytes) {
    while (const auto message = websocket.receive()) {
      bytes = message->bytes;
      const ServerMessage parsed = parseServerMessage(bytes);
      if (!std::holds_alternative<Waiting>(parsed)) return parsed;
    }
    return Refusal{};
  }

  gl::ShaderLibrary shaders_;
  gl::Workers gl_{gl::ContextKind::kAuto, shaders_, 1};
  node::ObjectTypes types_;
  std::optional<Host> host_;
  WebsocketServer server_{{.visitors = {"127.0.0.1", 0}, .operators = {}}};
};

TEST_F(EarlyVisitorTest, PageIsServedDuringPreparation) {
  EXPECT_EQ(request(server_.port(), "GET", "/").status, 200);
  EXPECT_EQ(request(server_.port(), "GET", "/sharing.json").status, 503);
  EXPECT_EQ(request(server_.operatorPort(), "GET", "/statistics.json").status, 503);
  makeWorld();
  // The server's thread opens when it is woken.
  RawWebsocket websocket(server_.port());
  websocket.send(encode(Hello{"Ada", 320, 180}));
  ASSERT_TRUE(websocket.receive());
  EXPECT_EQ(request(server_.port(), "GET", "/sharing.json").status, 200);
}

TEST_F(EarlyVisitorTest, SeesProgressAndEntersOnTheSameSocket) {
  RawWebsocket websocket(server_.port(), kAsksForWaiting);
  ASSERT_EQ(websocket.status(), 101);
  server_.report("growing trees", 0.25F);
  websocket.send(encode(Hello{"Ada", 640, 360}));
  for (const std::uint8_t percent : {25, 75}) {
    std::optional<Waiting> newest;
    while (!newest || newest->percent != percent) {
      const auto message = websocket.receive();
      ASSERT_TRUE(message);
      const ServerMessage parsed = parseServerMessage(message->bytes);
      ASSERT_TRUE(std::holds_alternative<Waiting>(parsed));
      newest = std::get<Waiting>(parsed);
    }
    EXPECT_EQ(newest->step, "growing trees");
    EXPECT_EQ(newest->place, 1);
    server_.report("growing trees", 0.75F);
  }
  makeWorld();
  std::vector<std::uint8_t> bytes;
  const ServerMessage greeting = afterWaiting(websocket, bytes);
  ASSERT_TRUE(std::holds_alternative<Welcome>(greeting));
  EXPECT_EQ(std::get<Welcome>(greeting).world, "Late");
  const ServerMessage frame = afterWaiting(websocket, bytes);
  ASSERT_TRUE(std::holds_alternative<FrameMessage>(frame));
  EXPECT_EQ(std::get<FrameMessage>(frame).header.width, 640);
}

TEST_F(EarlyVisitorTest, OlderPagesGetNoProgress) {
  RawWebsocket websocket(server_.port());
  websocket.send(encode(Hello{"Ada", 320, 180}));
  server_.report("growing trees", 0.25F);
  makeWorld();
  const auto first = websocket.receive();
  ASSERT_TRUE(first);
  EXPECT_TRUE(std::holds_alternative<Welcome>(parseServerMessage(first->bytes)));
}

TEST_F(EarlyVisitorTest, ClosesClientsThatSendMoreThanHello) {
  RawWebsocket websocket(server_.port(), kAsksForWaiting);
  websocket.send(encode(Hello{"Ada", 320, 180}));
  for (int i = 0; i < 20; ++i) websocket.send(encode(Ack{1}));
  const auto close = websocket.receiveClose();
  ASSERT_TRUE(close);
  EXPECT_EQ(close->code, static_cast<int>(CloseCode::kFlood));
  EXPECT_EQ(request(server_.port(), "GET", "/").status, 200);
}

TEST_F(EarlyVisitorTest, ReportsABadHelloAfterPreparation) {
  RawWebsocket first(server_.port(), kAsksForWaiting);
  first.send(encode(Ack{1}));
  RawWebsocket second(server_.port(), kAsksForWaiting);
  second.send(encode(Hello{"Ada", 320, 180}));
  RawWebsocket third(server_.port(), kAsksForWaiting);
  third.send(encode(Hello{"Bob", 320, 180}));
  makeWorld();
  const auto wrong = first.receiveClose();
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->code, static_cast<int>(CloseCode::kProtocolError));
  // There is room for one, whichever of them the server comes to first.
  std::vector<std::uint8_t> bytes;
  const bool isSecondIn = std::holds_alternative<Welcome>(afterWaiting(second, bytes));
  const auto thirdClose = isSecondIn ? third.receiveClose() : std::nullopt;
  ASSERT_TRUE(isSecondIn ? thirdClose.has_value() : bytes.size() >= 2);
  // The second's was read already: a close begins with its code.
  EXPECT_EQ(isSecondIn ? thirdClose->code : bytes[0] << 8U | bytes[1], static_cast<int>(CloseCode::kFull));
}

TEST_F(EarlyVisitorTest, ForgetsVisitorsWhoLeaveEarly) {
  {
    RawWebsocket gone(server_.port(), kAsksForWaiting);
    gone.send(encode(Hello{"Ada", 320, 180}));
    ASSERT_TRUE(gone.receive());
    gone.socket().reset();
  }
  // By then the server has seen the reset.
  EXPECT_EQ(request(server_.port(), "GET", "/").status, 200);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  makeWorld();
  RawWebsocket next(server_.port(), kAsksForWaiting);
  next.send(encode(Hello{"Bob", 320, 180}));
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(std::holds_alternative<Welcome>(afterWaiting(next, bytes)));
}

TEST_F(EarlyVisitorTest, ClosesWhenTheServerStopsDuringPreparation) {
  RawWebsocket websocket(server_.port(), kAsksForWaiting);
  websocket.send(encode(Hello{"Ada", 320, 180}));
  ASSERT_TRUE(websocket.receive());
  std::jthread stopper([this] { server_.stop(); });
  const auto close = websocket.receiveClose();
  ASSERT_TRUE(close);
  EXPECT_EQ(close->code, static_cast<int>(CloseCode::kGoingAway));
}

}  // namespace
}  // namespace grove::stream
