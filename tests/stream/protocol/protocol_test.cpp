#include "stream/protocol/protocol.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

namespace grove::stream {
namespace {

using Bytes = std::vector<std::uint8_t>;

CloseCode codeOf(const ClientMessage& message) {
  const auto* refusal = std::get_if<Refusal>(&message);
  return refusal == nullptr ? CloseCode{} : refusal->code;
}

TEST(Protocol, RefusesOtherLengths) {
  const std::vector<Bytes> messages = {encode(Hello{"Ada", 1280, 720}),
                                       encode(world::Input{1, 2, 0.5F, 0.25F}),
                                       encode(Ack{3}),
                                       encode(Resize{640, 360}),
                                       encode(Painted{}),
                                       encode(Capture{5})};
  for (const Bytes& message : messages) {
    EXPECT_FALSE(std::holds_alternative<Refusal>(parseClientMessage(message)));
    for (std::size_t length = 0; length < message.size(); ++length) {
      EXPECT_EQ(codeOf(parseClientMessage(std::span(message).first(length))), CloseCode::kProtocolError) << length;
    }
    Bytes longer = message;
    longer.push_back(0);
    EXPECT_EQ(codeOf(parseClientMessage(longer)), CloseCode::kProtocolError);
  }
}

TEST(Protocol, RefusesUnknownTypesAndReservedBytes) {
  EXPECT_EQ(codeOf(parseClientMessage(Bytes{0x05, 0, 0, 0})), CloseCode::kProtocolError);
  EXPECT_EQ(codeOf(parseClientMessage(encode(Welcome{}))), CloseCode::kProtocolError);
  Bytes ack = encode(Ack{1});
  ack[2] = 1;
  EXPECT_EQ(codeOf(parseClientMessage(ack)), CloseCode::kProtocolError);
  EXPECT_EQ(codeOf(parseClientMessage(Bytes(kLargestClientMessage + 1, 1))), CloseCode::kProtocolError);
}

TEST(Protocol, ReportsOtherVersionsByCode) {
  EXPECT_EQ(codeOf(parseClientMessage(Bytes{0x01, 2})), CloseCode::kWrongVersion);
  Bytes hello = encode(Hello{"Ada", 1280, 720});
  hello[1] = 200;
  EXPECT_EQ(codeOf(parseClientMessage(hello)), CloseCode::kWrongVersion);
}

TEST(Protocol, RefusesNotANumberAngles) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_EQ(codeOf(parseClientMessage(encode(world::Input{1, 0, bad, 0}))), CloseCode::kProtocolError);
    EXPECT_EQ(codeOf(parseClientMessage(encode(world::Input{1, 0, 0, bad}))), CloseCode::kProtocolError);
  }
}

TEST(Protocol, RefusesSizesOutOfRange) {
  for (const std::uint32_t bad : {0U, 15U, 16385U, 100000U, 0xFFFFFFFFU}) {
    EXPECT_EQ(codeOf(parseClientMessage(encode(Resize{bad, 720}))), CloseCode::kProtocolError);
    EXPECT_EQ(codeOf(parseClientMessage(encode(Resize{1280, bad}))), CloseCode::kProtocolError);
    const ClientMessage hello = parseClientMessage(encode(Hello{"Ada", 1280, bad}));
    ASSERT_EQ(codeOf(hello), CloseCode::kProtocolError);
    EXPECT_NE(std::get<Refusal>(hello).reason.find(std::to_string(bad)), std::string::npos);
  }
  EXPECT_TRUE(std::holds_alternative<Resize>(parseClientMessage(encode(Resize{16, 16384}))));
}

TEST(Protocol, RefusesLongNames) {
  Bytes hello = encode(Hello{std::string(64, 'a'), 1280, 720});
  EXPECT_EQ(std::get<Hello>(parseClientMessage(hello)).name.size(), 64U);
  hello[2] = 65;
  hello.push_back('a');
  EXPECT_EQ(codeOf(parseClientMessage(hello)), CloseCode::kProtocolError);
}

TEST(Protocol, SanitizesNames) {
  Bytes hello = encode(Hello{"Ada12", 1280, 720});
  hello[12] = '\n';
  hello[13] = 0xFF;
  EXPECT_EQ(std::get<Hello>(parseClientMessage(hello)).name, "?a12");
}

TEST(Protocol, DropsUnknownKeys) {
  EXPECT_EQ(std::get<world::Input>(parseClientMessage(encode(world::Input{1, 0xFF, 0, 0}))).keys, 0x3F);
}

TEST(Protocol, RandomBytesAreReadOrRefused) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<std::size_t> length(0, kLargestClientMessage + 8);
  const std::vector<Bytes> good = {encode(Hello{"Ada", 1280, 720}),
                                   encode(world::Input{1, 2, 0.5F, 0.25F}),
                                   encode(Ack{3}),
                                   encode(Resize{640, 360}),
                                   encode(Welcome{}),
                                   encode(Waiting{2, 40, "step"})};
  std::size_t accepted = 0;
  std::size_t refused = 0;
  for (std::size_t i = 0; i < 100'000; ++i) {
    // Exact size on the heap, so that the address sanitizer sees any read past the end.
    Bytes message;
    if (i % 2 == 0) {
      message.resize(length(random));
      for (std::uint8_t& value : message) value = static_cast<std::uint8_t>(byte(random));
    } else {
      message = good[(i / 2) % good.size()];
      message[length(random) % message.size()] = static_cast<std::uint8_t>(byte(random));
      if (i % 3 == 0) message.resize(length(random) % (message.size() + 2));
      message.shrink_to_fit();
    }
    const ClientMessage client = parseClientMessage(message);
    if (const auto* refusal = std::get_if<Refusal>(&client)) {
      ++refused;
      ASSERT_FALSE(refusal->reason.empty());
      ASSERT_LE(refusal->reason.size(), 100U);
    } else {
      ++accepted;
    }
    const ServerMessage server = parseServerMessage(message);
    if (const auto* frame = std::get_if<FrameMessage>(&server)) {
      ASSERT_EQ(frame->picture.size() + kFrameHeaderBytes, message.size());
    }
  }
  EXPECT_GT(accepted, 5'000U);
  EXPECT_GT(refused, 50'000U);
}

TEST(Protocol, RefusesImpossibleWaits) {
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(encode(Waiting{0, 0, ""}))));
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(encode(Waiting{1, 101, ""}))));
}

TEST(Protocol, TruncatesStepNames) {
  const ServerMessage read = parseServerMessage(encode(Waiting{1, 0, std::string(100, 'a')}));
  ASSERT_TRUE(std::holds_alternative<Waiting>(read));
  EXPECT_EQ(std::get<Waiting>(read).step, std::string(64, 'a'));
}

TEST(Protocol, RefusesImpossibleLabels) {
  PictureHeader header;
  header.labels.resize(kMaxLabels);
  const std::size_t most = pictureHeaderBytes(kMaxLabels);
  Bytes picture(most);
  encode(header, picture);
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(picture))) << "no bytes after the labels";
  picture.push_back(7);
  EXPECT_EQ(std::get<PictureMessage>(parseServerMessage(picture)).header.labels.size(), kMaxLabels);
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(std::span(picture).first(most - 1))));
  Bytes reserved = picture;
  reserved[most - 1] = 1;
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(reserved)));
  Bytes more = picture;
  more[10] = kMaxLabels + 1;
  more.resize(pictureHeaderBytes(kMaxLabels + 1));
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(more)));
}

/// Of a message that is valid only as a whole.
void expectExactLength(const Bytes& message) {
  for (std::size_t length = 0; length < message.size(); ++length) {
    EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(std::span(message).first(length)))) << length;
  }
  Bytes longer = message;
  longer.push_back(0);
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(longer)));
}

// Faults: a reader past the end of a space; a visitor who walks to a place that is not a number.
TEST(Protocol, RefusesImpossibleSpaces) {
  PictureHeader header;
  header.space = Space{.eye = {1.0F, 2.0F, 3.0F}, .nearness = {1, 2, 3}};
  Bytes picture(pictureHeaderBytes(header));
  ASSERT_EQ(picture.size(), kPictureHeaderBytes + kSpaceBytes + 3);
  encode(header, picture);
  for (std::size_t length = 0; length <= picture.size(); ++length) {
    EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(std::span(picture).first(length)))) << length;
  }
  picture.push_back(7);
  ASSERT_TRUE(std::holds_alternative<PictureMessage>(parseServerMessage(picture)));
  for (std::size_t field = 0; field < 8; ++field) {
    Bytes infinite = picture;
    infinite[kPictureHeaderBytes + 4 * field + 2] = 0x80;
    infinite[kPictureHeaderBytes + 4 * field + 3] = 0x7F;
    EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(infinite))) << field;
  }
  Bytes reserved = picture;
  reserved[kPictureHeaderBytes + kSpaceBytes - 1] = 1;
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(reserved)));
  Bytes longer = picture;
  longer[kPictureHeaderBytes + kSpaceBytes - 4] = 4;
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(longer))) << "no byte is left for the picture";
}

// Faults: a part without pixels, or nowhere; a division by zero; more parts than a page expects.
TEST(Protocol, RefusesImpossibleMovingParts) {
  const auto refuses = [](std::vector<MovingPart> moving) {
    PictureHeader header;
    header.space = Space{.moving = std::move(moving), .nearness = {1}};
    Bytes picture(pictureHeaderBytes(header));
    encode(header, picture);
    picture.push_back(7);
    return std::holds_alternative<Refusal>(parseServerMessage(picture));
  };
  const MovingPart good{8, 16, 24, 300, 150, 250, {1.5F, -0.5F}};
  EXPECT_FALSE(refuses({good}));
  EXPECT_FALSE(refuses(std::vector<MovingPart>(kMaxMovingParts, good)));
  EXPECT_TRUE(refuses(std::vector<MovingPart>(kMaxMovingParts + 1, good)));
  EXPECT_TRUE(refuses({{8, 16, 8, 300, 150, 250, {}}}));
  EXPECT_TRUE(refuses({{8, 16, 24, 16, 150, 250, {}}}));
  EXPECT_TRUE(refuses({{8, 16, 24, 300, 0, 250, {}}}));
  EXPECT_TRUE(refuses({{8, 16, 24, 300, 251, 250, {}}}));
  EXPECT_TRUE(refuses({{8, 16, 24, 300, 150, 250, {std::numeric_limits<float>::quiet_NaN(), 0.0F}}}));
}

TEST(Protocol, RefusesImpossibleGround) {
  const Bytes ground = encode(Ground{40.0F, {{{1.0F, 2.0F}, 8.0F, 0.5F}}, {{{3.0F, 4.0F}, 0.5F}}});
  ASSERT_TRUE(std::holds_alternative<Ground>(parseServerMessage(ground)));
  expectExactLength(ground);
  const auto refuses = [](const Ground& bad) {
    return std::holds_alternative<Refusal>(parseServerMessage(encode(bad)));
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_TRUE(refuses({0.0F, {}, {}}));
  EXPECT_TRUE(refuses({kNan, {}, {}}));
  EXPECT_TRUE(refuses({40.0F, {{{0.0F, 0.0F}, 0.0F, 0.5F}}, {}}));
  EXPECT_TRUE(refuses({40.0F, {{{0.0F, 0.0F}, 8.0F, kNan}}, {}}));
  EXPECT_TRUE(refuses({40.0F, {}, {{{kNan, 0.0F}, 0.5F}}}));
  EXPECT_TRUE(refuses({40.0F, {}, {{{0.0F, 0.0F}, -0.5F}}}));
  Bytes many = encode(Ground{40.0F, {}, {}});
  many[1] = 65;
  many.resize(many.size() + std::size_t{65} * 16);
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(many))) << "65 hills";
}

TEST(Protocol, RefusesImpossibleRosters) {
  const Bytes people = encode(People{false, {{1, 0x4FB4FF, "Ada"}, {2, 0, "日本"}}});
  ASSERT_TRUE(std::holds_alternative<People>(parseServerMessage(people)));
  expectExactLength(people);
  Bytes reserved = people;
  reserved[1] = 2;
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(reserved)));
  Bytes long65(12 + 65, 'a');
  std::ranges::copy(encode(People{false, {{1, 0, ""}}}), long65.begin());
  long65[11] = 65;
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(long65)));
  const ServerMessage cleaned = parseServerMessage(encode(People{false, {{1, 0, "a\nb\xFF" + std::string(100, 'c')}}}));
  EXPECT_EQ(std::get<People>(cleaned).people[0].name, "ab?" + std::string(61, 'c'));
}

TEST(Protocol, RefusesTruncatedServerMessages) {
  Welcome welcome;
  welcome.world = "The clearing";
  const Bytes bytes = encode(welcome);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(std::span(bytes).first(length))));
  }
  const Bytes waiting = encode(Waiting{2, 0, "a step"});
  ASSERT_TRUE(std::holds_alternative<Waiting>(parseServerMessage(waiting)));
  for (std::size_t length = 0; length < waiting.size(); ++length) {
    EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(std::span(waiting).first(length))));
  }
  const Bytes times = encode(Times{});
  ASSERT_TRUE(std::holds_alternative<Times>(parseServerMessage(times)));
  for (std::size_t length = 0; length < times.size(); ++length) {
    EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(std::span(times).first(length))));
  }
  std::array<std::uint8_t, kCapturedHeaderBytes> captured{};
  encode(CapturedHeader{}, captured);
  EXPECT_TRUE(std::holds_alternative<CapturedMessage>(parseServerMessage(captured)));
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(std::span(captured).first(kCapturedHeaderBytes - 1))));
  std::array<std::uint8_t, kFrameHeaderBytes> frame{};
  encode(FrameHeader{}, frame);
  EXPECT_TRUE(std::holds_alternative<FrameMessage>(parseServerMessage(frame)));
  EXPECT_TRUE(std::holds_alternative<Refusal>(parseServerMessage(std::span(frame).first(kFrameHeaderBytes - 1))));
}

}  // namespace
}  // namespace grove::stream
