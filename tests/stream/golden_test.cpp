#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "stream/protocol.h"

namespace grove::stream {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Json = nlohmann::json;

Bytes fromHex(const std::string& hex) {
  Bytes bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<std::uint8_t>(std::stoul(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

Json golden() {
  std::ifstream file(GROVE_GOLDEN_MESSAGES);
  return Json::parse(file);
}

Json fieldsOf(const Hello& hello) {
  return {{"message", "Hello"}, {"name", hello.name}, {"width", hello.width}, {"height", hello.height}};
}
Json fieldsOf(const world::Input& input) {
  return {
      {"message", "Input"}, {"keys", input.keys}, {"number", input.number}, {"yaw", input.yaw}, {"pitch", input.pitch}};
}
Json fieldsOf(const Ack& ack) { return {{"message", "Ack"}, {"frame", ack.frame}}; }
Json fieldsOf(const Resize& resize) {
  return {{"message", "Resize"}, {"width", resize.width}, {"height", resize.height}};
}
Json fieldsOf(const Refusal& refusal) { return {{"message", "Refusal"}, {"reason", refusal.reason}}; }
Json fieldsOf(const Welcome& welcome) {
  return {{"message", "Welcome"},
          {"framesPerSecond", welcome.framesPerSecond},
          {"visitor", welcome.visitor},
          {"red", welcome.colour & 0xFFU},
          {"green", (welcome.colour >> 8U) & 0xFFU},
          {"blue", welcome.colour >> 16U},
          {"yaw", welcome.yaw},
          {"pitch", welcome.pitch},
          {"world", welcome.world}};
}
Json fieldsOf(const Waiting& waiting) {
  return {{"message", "Waiting"}, {"percent", waiting.percent}, {"place", waiting.place}, {"step", waiting.step}};
}
Json fieldsOf(const FrameMessage& frame) {
  std::string picture;
  for (const std::uint8_t byte : frame.picture) {
    constexpr const char* kDigits = "0123456789abcdef";
    picture += kDigits[byte >> 4U];
    picture += kDigits[byte & 15U];
  }
  const FrameHeader& header = frame.header;
  return {{"message", "Frame"},
          {"codec", header.codec},
          {"width", header.width},
          {"height", header.height},
          {"visitors", header.visitors},
          {"frame", header.frame},
          {"lastInput", header.lastInput},
          {"serverMicroseconds", header.serverMicroseconds},
          {"picture", picture}};
}

Bytes encodeAgain(const Hello& hello) { return encode(hello); }
Bytes encodeAgain(const world::Input& input) { return encode(input); }
Bytes encodeAgain(const Ack& ack) { return encode(ack); }
Bytes encodeAgain(const Resize& resize) { return encode(resize); }
Bytes encodeAgain(const Welcome& welcome) { return encode(welcome); }
Bytes encodeAgain(const Waiting& waiting) { return encode(waiting); }
Bytes encodeAgain(const Refusal&) { return {}; }
Bytes encodeAgain(const FrameMessage& frame) {
  Bytes bytes(kFrameHeaderBytes);
  encode(frame.header, std::span(bytes).first<kFrameHeaderBytes>());
  bytes.insert(bytes.end(), frame.picture.begin(), frame.picture.end());
  return bytes;
}

bool isFromServer(const Json& fields) {
  const Json& message = fields["message"];
  return message == "Welcome" || message == "Waiting" || message == "Frame";
}

TEST(GoldenMessages, AreReadAsTheirFields) {
  for (const Json& entry : golden()) {
    const Bytes bytes = fromHex(entry["hex"]);
    const auto fields = [](const auto& message) { return fieldsOf(message); };
    const Json read = isFromServer(entry["fields"]) ? std::visit(fields, parseServerMessage(bytes))
                                                    : std::visit(fields, parseClientMessage(bytes));
    EXPECT_EQ(read, entry["fields"]) << entry["name"];
  }
}

TEST(GoldenMessages, AreWrittenToTheByte) {
  for (const Json& entry : golden()) {
    const Bytes bytes = fromHex(entry["hex"]);
    const auto again = [](const auto& message) { return encodeAgain(message); };
    const Bytes written = isFromServer(entry["fields"]) ? std::visit(again, parseServerMessage(bytes))
                                                        : std::visit(again, parseClientMessage(bytes));
    EXPECT_EQ(written, bytes) << entry["name"];
  }
}

TEST(GoldenMessages, CoverEveryMessage) {
  std::set<std::string> messages;
  for (const Json& entry : golden()) messages.insert(entry["fields"]["message"]);
  EXPECT_EQ(messages, (std::set<std::string>{"Ack", "Frame", "Hello", "Input", "Resize", "Waiting", "Welcome"}));
}

}  // namespace
}  // namespace grove::stream
