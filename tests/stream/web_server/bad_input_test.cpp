#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "eventually.h"
#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Each test has a good client beside the bad one, which must get frames throughout.
class BadInput : public ServedWorld {
 protected:
  BadInput() : good_(std::make_unique<GoodClient>(port())) { EXPECT_TRUE(good_->receiveFrames(2)); }

  /// What the server says to a visitor that sends this after its Hello.
  std::optional<RawWebsocket::Close> answerTo(const Bytes& message,
                                              RawWebsocket::Opcode opcode = RawWebsocket::kBinary) {
    GoodClient bad(port());
    EXPECT_TRUE(bad.receiveFrames(1));
    bad.websocket().send(message, opcode);
    return bad.websocket().receiveClose();
  }

  void expectRefused(const std::optional<RawWebsocket::Close>& close, CloseCode code, std::string_view reason) {
    ASSERT_TRUE(close);
    EXPECT_EQ(close->code, static_cast<int>(code));
    EXPECT_NE(close->reason.find(reason), std::string::npos) << close->reason;
    EXPECT_TRUE(good_->receiveFrames(3));
  }

  /// The last frame that was made and put into the way of a visitor; 0 if there is none.
  std::uint32_t newestFrameOf(std::uint32_t session) {
    std::uint32_t newest = 0;
    for (const pipeline::TimelineEvent& event : host_.timeline().events()) {
      if (event.tag.session == session && event.stage == std::string_view("Encoder")) {
        newest = std::max(newest, event.tag.frame);
      }
    }
    return newest;
  }

  void TearDown() override {
    EXPECT_TRUE(good_->receiveFrames(3));
    good_.reset();
    EXPECT_TRUE(becomesEmpty());
  }

  std::unique_ptr<GoodClient> good_;
};

TEST_F(BadInput, Garbage) {
  expectRefused(answerTo({0xDE, 0xAD, 0xBE, 0xEF}), CloseCode::kProtocolError, "unknown message type 222");
  expectRefused(answerTo({0x02, 0x00}), CloseCode::kProtocolError, "Input has the wrong length");
}

TEST_F(BadInput, NotAWebsocket) {
  GoodClient bad(port());
  EXPECT_TRUE(bad.receiveFrames(1));
  bad.websocket().socket().send(std::string(5000, '\xFF'));
  bad.websocket().receiveClose();
  RawSocket(port()).send(std::string("\0\1\2\3garbage", 11));
}

TEST_F(BadInput, OversizedMessages) {
  expectRefused(answerTo(Bytes(257, 2)), CloseCode::kProtocolError, "more than 256 bytes");
  expectRefused(answerTo(Bytes(60'000, 2)), CloseCode::kProtocolError, "more than 256 bytes");
}

TEST_F(BadInput, OversizedFragmentedMessage) {
  GoodClient bad(port());
  EXPECT_TRUE(bad.receiveFrames(1));
  bad.websocket().send(Bytes(200, 2), RawWebsocket::kBinary, false);
  bad.websocket().send(Bytes(200, 2), RawWebsocket::kContinuation, true);
  expectRefused(bad.websocket().receiveClose(), CloseCode::kProtocolError, "more than 256 bytes");
}

TEST_F(BadInput, TextMessages) {
  expectRefused(answerTo({'h', 'i'}, RawWebsocket::kText), CloseCode::kProtocolError, "text");
}

TEST_F(BadInput, MessagesOutOfOrder) {
  RawWebsocket early(port());
  early.send(encode(Ack{1}));
  expectRefused(early.receiveClose(), CloseCode::kProtocolError, "the first message is not Hello");
  expectRefused(answerTo(encode(Hello{"again", 320, 180})), CloseCode::kProtocolError, "second Hello");
}

TEST_F(BadInput, OtherProtocolVersion) {
  RawWebsocket old(port());
  old.send(Bytes{0x01, 0x00, 0x00});
  expectRefused(old.receiveClose(), CloseCode::kWrongVersion, "version 0");
}

TEST_F(BadInput, NotANumberCamera) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  expectRefused(answerTo(encode(world::Input{1, 0, nan, 0})), CloseCode::kProtocolError, "not numbers");
}

TEST_F(BadInput, ImpossibleSizes) {
  expectRefused(answerTo(encode(Resize{0, 0})), CloseCode::kProtocolError, "0 x 0");
  expectRefused(answerTo(encode(Resize{100'000, 720})), CloseCode::kProtocolError, "100000 x 720");
}

TEST_F(BadInput, IgnoresOldInputsAndUnknownAcknowledgements) {
  RawWebsocket& websocket = good_->websocket();
  websocket.send(encode(world::Input{50, 0, 0.5F, 0}));
  websocket.send(encode(world::Input{7, world::kForward, 1.0F, 0}));
  websocket.send(encode(Ack{0}));
  while (good_->lastFrame().lastInput != 50) ASSERT_TRUE(good_->receiveFrames(1));
  EXPECT_TRUE(good_->receiveFrames(3));
  EXPECT_EQ(good_->lastFrame().lastInput, 50U);
}

TEST_F(BadInput, FloodOfInputs) {
  GoodClient bad(port());
  for (std::uint32_t i = 1; i < 5000; ++i) {
    if (!bad.websocket().send(encode(world::Input{i, 0, 0, 0}))) break;
  }
  // What it sent after the end may reset the connection before it reads the reason.
  const auto close = bad.websocket().receiveClose();
  EXPECT_TRUE(!close || close->code == static_cast<int>(CloseCode::kFlood));
  // With the Hello just as many as are too many, at once: nothing is left unread that would reset the connection. Where
  // a new second begins amid them they are not too many, and are sent again.
  std::string flood;
  for (std::uint32_t i = 1; i <= 500; ++i) flood += RawWebsocket::frame(encode(world::Input{i, 0, 0, 0}));
  std::optional<RawWebsocket::Close> reported;
  for (int tries = 0; tries < 5 && !reported; ++tries) {
    GoodClient slower(port());
    slower.websocket().socket().send(flood);
    reported = slower.websocket().receiveClose();
  }
  expectRefused(reported, CloseCode::kFlood, "500");
}

TEST_F(BadInput, FloodOfPings) {
  const std::string ping = RawWebsocket::frame(Bytes(125), RawWebsocket::kPing);
  std::string pings;
  while (pings.size() < 400'000) pings += ping;
  for (const bool greets : {false, true}) {
    SCOPED_TRACE(greets);
    // All at once, and then it only reads: what is sent after the end may reset the connection before that is told.
    std::optional<RawWebsocket::Close> reported;
    for (int tries = 0; tries < 5 && !reported; ++tries) {
      RawWebsocket bad(port());
      if (greets) bad.send(encode(Hello{"bad", 320, 180}));
      bad.socket().send(pings);
      reported = bad.receiveClose();
    }
    expectRefused(reported, CloseCode::kFlood, "64 KiB");
  }
}

TEST_F(BadInput, FloodOfRequests) {
  RawSocket bad(port());
  std::string requests;
  for (int i = 0; i < 100; ++i) requests += "HEAD /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n";
  EXPECT_TRUE(tests::eventually([&] { return !bad.send(requests) || bad.receive().empty(); }));
  EXPECT_TRUE(good_->receiveFrames(3));
}

TEST_F(BadInput, ClientThatNeverReads) {
  RawWebsocket deaf(port(), "", 4096);
  deaf.send(encode(Hello{"deaf", 1920, 1080}));
  // It guesses the number of each frame that was made for it, though it reads none.
  for (std::uint32_t made = 0; made < 30;) {
    ASSERT_TRUE(good_->receiveFrames(1));
    made = newestFrameOf(2);
    deaf.send(encode(Ack{made}));
  }
  EXPECT_TRUE(good_->receiveFrames(3));
  EXPECT_EQ(host_.visitors(), 2U) << "it has its place as long as it acknowledges";
  deaf.send(encode(Resize{0, 0}));
  EXPECT_TRUE(good_->receiveFrames(10));
}

TEST_F(BadInput, DisconnectWithinAMessage) {
  GoodClient bad(port());
  EXPECT_TRUE(bad.receiveFrames(1));
  bad.websocket().socket().send("\x82\x90\x01");
  bad.websocket().socket().reset();
  GoodClient early(port());
  early.websocket().socket().reset();
}

TEST_F(BadInput, TooManyVisitors) {
  std::vector<std::unique_ptr<GoodClient>> others;
  for (int i = 1; i < kMaxVisitors; ++i) {
    others.push_back(std::make_unique<GoodClient>(port()));
    EXPECT_TRUE(others.back()->receiveFrames(1));
  }
  GoodClient tooMany(port());
  expectRefused(tooMany.websocket().receiveClose(), CloseCode::kFull, "full");
}

TEST_F(BadInput, OtherOrigin) {
  const std::string own = std::string("Origin: http://127.0.0.1:") + std::to_string(port()) + "\r\n";
  EXPECT_EQ(RawWebsocket(port(), own).status(), 101);
  EXPECT_EQ(RawWebsocket(port(), "Origin: http://evil.example\r\n").status(), 403);
  EXPECT_EQ(RawWebsocket(port(), "Origin: http://127.0.0.1:1\r\n").status(), 403);
  EXPECT_EQ(RawWebsocket(port(), "Origin: null\r\n").status(), 403);
}

TEST_F(BadInput, TooManyConnections) {
  std::vector<std::unique_ptr<RawSocket>> sockets;
  sockets.reserve(300);
  for (int i = 0; i < 300; ++i) sockets.push_back(std::make_unique<RawSocket>(port()));
  EXPECT_TRUE(good_->receiveFrames(10));
  sockets.clear();
  HttpAnswer answer;
  for (int i = 0; i < 50 && answer.status != 200; ++i) {
    EXPECT_TRUE(good_->receiveFrames(3));
    answer = request(port(), "GET", "/healthz");
  }
  EXPECT_EQ(answer.status, 200);
}

}  // namespace
}  // namespace grove::stream
