#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "pipeline/clocks.h"
#include "stream/encode/jpeg/jpeg_decoder.h"
#include "stream/web_server/served_world.h"

namespace grove::stream {
namespace {

/// A page of v1.3 that turns on the spot.
class TimedPage {
 public:
  explicit TimedPage(int port)
      : websocket_(port, "Sec-WebSocket-Protocol: grove.v1.3, grove.v1.2, grove.v1.1, grove.v1\r\n") {
    websocket_.send(encode(Hello{"Ada", 640, 360}));
  }

  template <class Message>
  void say(const Message& message) {
    websocket_.send(encode(message));
  }

  /// Goes on until `done` with a message; what it returns is handed on. None at the end, or after 20 seconds.
  template <class Result>
  std::optional<Result> listen(const std::function<std::optional<Result>(const ServerMessage&)>& done) {
    const double deadline = pipeline::wallSeconds() + 20.0;
    while (pipeline::wallSeconds() < deadline) {
      const auto message = websocket_.receive();
      if (!message || message->opcode != RawWebsocket::kBinary) return std::nullopt;
      const ServerMessage parsed = parseServerMessage(message->bytes);
      if (const auto* picture = std::get_if<PictureMessage>(&parsed)) acknowledge(picture->header.frame);
      if (auto result = done(parsed)) return result;
    }
    return std::nullopt;
  }

 private:
  void acknowledge(std::uint32_t frame) {
    Painted painted;
    painted.frame = frame;
    painted.heldTenthsOfMilliseconds = 80;
    painted.decodeTenthsOfMilliseconds = 30;
    painted.paintTenthsOfMilliseconds = 5;
    painted.arrivedMicroseconds = static_cast<std::uint32_t>(pipeline::wallSeconds() * 1e6);
    say(painted);
    ++input_;
    say(world::Input{input_, 0, 0.1F * static_cast<float>(input_), 0.0F});
  }

  RawWebsocket websocket_;
  std::uint32_t input_ = 0;
};

class TimedPageTest : public ServedWorld {};

// Faults: a capture of the stream's size or quality instead of the window's; a wrong number; a picture that no decoder
// takes; a stream that ends with it.
TEST_F(TimedPageTest, CaptureHasTheWindowSize) {
  TimedPage page(port());
  Limits limits;
  limits.lines = 180;
  page.say(limits);
  const auto isSmall = [](const ServerMessage& message) -> std::optional<bool> {
    const auto* picture = std::get_if<PictureMessage>(&message);
    return picture != nullptr && picture->header.height == 180 ? std::optional(true) : std::nullopt;
  };
  ASSERT_TRUE(page.listen<bool>(isSmall));
  page.say(Capture{77});
  struct Shot {
    CapturedHeader header;
    std::vector<std::uint8_t> picture;
  };
  const auto shot = page.listen<Shot>([](const ServerMessage& message) -> std::optional<Shot> {
    const auto* captured = std::get_if<CapturedMessage>(&message);
    if (captured == nullptr) return std::nullopt;
    return Shot{captured->header, {captured->picture.begin(), captured->picture.end()}};
  });
  ASSERT_TRUE(shot);
  EXPECT_EQ(shot->header.number, 77U);
  EXPECT_EQ(shot->header.width, 640);
  EXPECT_EQ(shot->header.height, 360);
  JpegDecoder decoder;
  const DecodedPicture* const image = decoder.decode(shot->picture);
  ASSERT_NE(image, nullptr);
  EXPECT_EQ(image->width, 640);
  EXPECT_EQ(image->height, 360);
  EXPECT_TRUE(page.listen<bool>(isSmall)) << "the stream goes on as it was";
}

// Fault: times that are never sent, or all nothing.
TEST_F(TimedPageTest, GetsFrameTimes) {
  TimedPage page(port());
  const auto times = page.listen<Times>([](const ServerMessage& message) -> std::optional<Times> {
    const auto* found = std::get_if<Times>(&message);
    return found == nullptr ? std::nullopt : std::optional(*found);
  });
  ASSERT_TRUE(times);
  EXPECT_GT(times->drawnTenthsOfMilliseconds, 0);
}

// Fault: a page of v1.2 that uses what it did not agree on, and gets it.
TEST_F(TimedPageTest, OlderPagesMayNotUseNewMessages) {
  RawWebsocket websocket(port(), "Sec-WebSocket-Protocol: grove.v1.2\r\n");
  websocket.send(encode(Hello{"Ada", 640, 360}));
  websocket.send(encode(Capture{1}));
  const auto close = websocket.receiveClose();
  ASSERT_TRUE(close);
  EXPECT_EQ(close->code, static_cast<int>(CloseCode::kProtocolError));
}

}  // namespace
}  // namespace grove::stream
