#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "stream/protocol/protocol.h"

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
Json fieldsOf(const Offer& offer) { return {{"message", "Offer"}, {"codecs", offer.codecs}}; }
Json fieldsOf(const Limits& limits) {
  return {{"message", "Limits"},
          {"hidden", limits.hidden},
          {"border", limits.border},
          {"nearness", limits.nearness},
          {"framesPerSecond", limits.framesPerSecond},
          {"kilobitsPerSecond", limits.kilobitsPerSecond},
          {"lines", limits.lines}};
}
Json fieldsOf(const Broken& broken) { return {{"message", "Broken"}, {"frame", broken.frame}}; }
Json fieldsOf(const Presented& presented) {
  return {{"message", "Presented"},
          {"frame", presented.frame},
          {"held", presented.heldTenthsOfMilliseconds / 10.0},
          {"arrived", presented.arrivedMicroseconds}};
}
Json fieldsOf(const Painted& painted) {
  Json fields = fieldsOf(static_cast<const Presented&>(painted));
  fields["message"] = "Painted";
  fields["decode"] = painted.decodeTenthsOfMilliseconds / 10.0;
  fields["paint"] = painted.paintTenthsOfMilliseconds / 10.0;
  return fields;
}
Json fieldsOf(const Capture& capture) { return {{"message", "Capture"}, {"number", capture.number}}; }
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
Json fieldsOf(const Status& status) {
  return {{"message", "Status"},
          {"limitedBy", static_cast<int>(status.limitedBy)},
          {"framesPerSecond", status.framesPerSecond},
          {"quality", status.quality},
          {"width", status.width},
          {"height", status.height},
          {"roundTripMilliseconds", status.roundTripMilliseconds},
          {"visitors", status.visitors},
          {"kilobitsPerSecond", status.kilobitsPerSecond},
          {"lastInput", status.lastInput}};
}
Json fieldsOf(const Refining& refining) {
  const bool known = refining.secondsLeft != Refining::kUnknownSeconds;
  return {{"message", "Refining"},
          {"percent", refining.percent},
          {"secondsLeft", known ? Json(refining.secondsLeft) : Json(nullptr)},
          {"step", refining.step}};
}

Json fieldsOf(const Times& times) {
  return {{"message", "Times"},
          {"queued", times.queuedTenthsOfMilliseconds / 10.0},
          {"drawn", times.drawnTenthsOfMilliseconds / 10.0},
          {"encoded", times.encodedTenthsOfMilliseconds / 10.0},
          {"socket", times.socketTenthsOfMilliseconds / 10.0},
          {"line", times.lineTenthsOfMilliseconds / 10.0}};
}

Json fieldsOf(const People& people) {
  Json list = Json::array();
  for (const Person& person : people.people) {
    list.push_back({{"visitor", person.visitor},
                    {"red", person.colour & 0xFFU},
                    {"green", (person.colour >> 8U) & 0xFFU},
                    {"blue", person.colour >> 16U},
                    {"name", person.name}});
  }
  return {{"message", "People"}, {"othersAreLost", people.othersAreLost}, {"people", list}};
}

std::string hex(std::span<const std::uint8_t> bytes) {
  std::string text;
  for (const std::uint8_t byte : bytes) {
    constexpr const char* kDigits = "0123456789abcdef";
    text += kDigits[byte >> 4U];
    text += kDigits[byte & 15U];
  }
  return text;
}

Json fieldsOf(const FrameHeader& header, const char* message, std::span<const std::uint8_t> picture) {
  return {{"message", message},
          {"codec", header.codec},
          {"width", header.width},
          {"height", header.height},
          {"visitors", header.visitors},
          {"frame", header.frame},
          {"lastInput", header.lastInput},
          {"serverMicroseconds", header.serverMicroseconds},
          {"picture", hex(picture)}};
}
Json fieldsOf(const FrameMessage& frame) { return fieldsOf(frame.header, "Frame", frame.picture); }
Json fieldsOf(const PictureMessage& picture) {
  const PictureHeader& header = picture.header;
  Json fields = fieldsOf(header, "Picture", picture.picture);
  fields["independent"] = header.independent;
  fields["border"] = header.border;
  fields["yaw"] = header.yaw;
  fields["pitch"] = header.pitch;
  fields["tanHalfX"] = header.tanHalfX;
  fields["tanHalfY"] = header.tanHalfY;
  fields["fire"] = header.fire / 255.0;
  if (const auto& space = header.space) {
    fields["space"] = {{"eye", {space->eye.x, space->eye.y, space->eye.z}},
                       {"visitor", {space->visitor.x, space->visitor.y, space->visitor.z}},
                       {"velocity", {space->velocity.x, space->velocity.y}},
                       {"sinceInput", space->sinceInputMicroseconds / 1000.0},
                       {"moving", Json::array()},
                       {"nearness", hex(space->nearness)}};
    for (const MovingPart& part : space->moving) {
      fields["space"]["moving"].push_back({{"left", part.left},
                                           {"top", part.top},
                                           {"right", part.right},
                                           {"bottom", part.bottom},
                                           {"nearest", part.nearestCentimetres / 100.0},
                                           {"farthest", part.farthestCentimetres / 100.0},
                                           {"velocity", {part.velocity.x, 0, part.velocity.y}}});
    }
  }
  fields["labels"] = Json::array();
  for (const Label& label : header.labels) {
    fields["labels"].push_back({{"visitor", label.visitor},
                                {"x", label.x / 65535.0},
                                {"y", label.y / 65535.0},
                                {"opacity", label.opacity / 255.0}});
  }
  return fields;
}

Json fieldsOf(const Ground& ground) {
  Json hills = Json::array();
  for (const world::Hill& hill : ground.hills) {
    hills.push_back({{"x", hill.centre.x}, {"z", hill.centre.y}, {"radius", hill.radius}, {"height", hill.height}});
  }
  Json obstacles = Json::array();
  for (const world::Obstacle& obstacle : ground.obstacles) {
    obstacles.push_back({{"x", obstacle.centre.x}, {"z", obstacle.centre.y}, {"radius", obstacle.radius}});
  }
  return {{"message", "Ground"}, {"radius", ground.radius}, {"hills", hills}, {"obstacles", obstacles}};
}

Json fieldsOf(const CapturedMessage& captured) {
  return {{"message", "Captured"},
          {"codec", captured.header.codec},
          {"width", captured.header.width},
          {"height", captured.header.height},
          {"number", captured.header.number},
          {"picture", hex(captured.picture)}};
}

Bytes encodeAgain(const Hello& hello) { return encode(hello); }
Bytes encodeAgain(const world::Input& input) { return encode(input); }
Bytes encodeAgain(const Ack& ack) { return encode(ack); }
Bytes encodeAgain(const Resize& resize) { return encode(resize); }
Bytes encodeAgain(const Welcome& welcome) { return encode(welcome); }
Bytes encodeAgain(const Waiting& waiting) { return encode(waiting); }
Bytes encodeAgain(const Offer& offer) { return encode(offer); }
Bytes encodeAgain(const Limits& limits) { return encode(limits); }
Bytes encodeAgain(const Broken& broken) { return encode(broken); }
Bytes encodeAgain(const Presented& presented) { return encode(presented); }
Bytes encodeAgain(const Painted& painted) { return encode(painted); }
Bytes encodeAgain(const Capture& capture) { return encode(capture); }
Bytes encodeAgain(const Times& times) { return encode(times); }
Bytes encodeAgain(const People& people) { return encode(people); }
Bytes encodeAgain(const Ground& ground) { return encode(ground); }
Bytes encodeAgain(const Status& status) { return encode(status); }
Bytes encodeAgain(const Refining& refining) { return encode(refining); }
Bytes encodeAgain(const Refusal&) { return {}; }
Bytes encodeAgain(const PictureMessage& picture) {
  Bytes bytes(pictureHeaderBytes(picture.header));
  encode(picture.header, bytes);
  bytes.insert(bytes.end(), picture.picture.begin(), picture.picture.end());
  return bytes;
}
Bytes encodeAgain(const FrameMessage& frame) {
  Bytes bytes(kFrameHeaderBytes);
  encode(frame.header, std::span(bytes).first<kFrameHeaderBytes>());
  bytes.insert(bytes.end(), frame.picture.begin(), frame.picture.end());
  return bytes;
}

Bytes encodeAgain(const CapturedMessage& captured) {
  Bytes bytes(kCapturedHeaderBytes);
  encode(captured.header, std::span(bytes).first<kCapturedHeaderBytes>());
  bytes.insert(bytes.end(), captured.picture.begin(), captured.picture.end());
  return bytes;
}

bool isFromServer(const Json& fields) {
  static const std::set<std::string> kMessages{"Welcome",  "Waiting",  "Frame", "Picture", "Status",
                                               "Refining", "Captured", "Times", "People",  "Ground"};
  return kMessages.contains(fields["message"]);
}

TEST(GoldenMessages, DecodeToTheirFields) {
  for (const Json& entry : golden()) {
    const Bytes bytes = fromHex(entry["hex"]);
    const auto fields = [](const auto& message) { return fieldsOf(message); };
    const Json read = isFromServer(entry["fields"]) ? std::visit(fields, parseServerMessage(bytes))
                                                    : std::visit(fields, parseClientMessage(bytes));
    EXPECT_EQ(read, entry["fields"]) << entry["name"];
  }
}

TEST(GoldenMessages, EncodeToTheirBytes) {
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
  EXPECT_EQ(messages,
            (std::set<std::string>{"Ack",      "Broken", "Capture", "Captured", "Frame",   "Ground",  "Hello",
                                   "Input",    "Limits", "Offer",   "Painted",  "People",  "Picture", "Presented",
                                   "Refining", "Resize", "Status",  "Times",    "Waiting", "Welcome"}));
}

}  // namespace
}  // namespace grove::stream
