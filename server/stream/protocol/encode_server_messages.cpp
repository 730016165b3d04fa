#include <algorithm>
#include <cassert>

#include "stream/protocol/message_type.h"
#include "stream/protocol/printable.h"
#include "stream/protocol/protocol.h"
#include "stream/protocol/server_text_limits.h"
#include "stream/protocol/wire.h"

namespace grove::stream {
namespace {

void putColour(WireWriter& writer, std::uint32_t colour) {
  for (const std::uint32_t shift : {0U, 8U, 16U}) writer.put(static_cast<std::uint8_t>(colour >> shift));
}

/// Writes one number after the other into a given buffer.
class HeaderWriter {
 public:
  explicit HeaderWriter(std::span<std::uint8_t> out) : out_(out) {}
  template <WireNumber T>
  HeaderWriter& put(T value) {
    const auto bytes = toWire(value);
    std::ranges::copy(bytes, out_.begin());
    out_ = out_.subspan(bytes.size());
    return *this;
  }
  [[nodiscard]] bool full() const noexcept { return out_.empty(); }

 private:
  std::span<std::uint8_t> out_;
};

}  // namespace

std::vector<std::uint8_t> encode(const Welcome& welcome) {
  const std::string world = printable(welcome.world, kMaxWorldNameBytes);
  WireWriter writer;
  writer.put(toByte(MessageType::kWelcome)).put(kProtocolVersion).put(welcome.framesPerSecond).put(welcome.visitor);
  putColour(writer, welcome.colour);
  writer.put(static_cast<std::uint8_t>(world.size())).put(welcome.yaw).put(welcome.pitch).put(world);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Waiting& waiting) {
  const std::string step = printable(waiting.step, kMaxStepBytes);
  WireWriter writer;
  writer.put(toByte(MessageType::kWaiting)).put(waiting.percent).put(waiting.place);
  writer.put(static_cast<std::uint32_t>(step.size())).put(step);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Status& status) {
  WireWriter writer;
  writer.put(toByte(MessageType::kStatus)).put(static_cast<std::uint8_t>(status.limitedBy));
  writer.put(status.framesPerSecond).put(status.quality).put(status.width).put(status.height);
  writer.put(status.roundTripMilliseconds).put(status.visitors).put(status.kilobitsPerSecond).put(status.lastInput);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Refining& refining) {
  const std::string step = printable(refining.step, kMaxStepBytes);
  WireWriter writer;
  writer.put(toByte(MessageType::kRefining)).put(refining.percent).put(refining.secondsLeft);
  writer.put(static_cast<std::uint32_t>(step.size())).put(step);
  return writer.take();
}

std::vector<std::uint8_t> encode(const Times& times) {
  WireWriter writer;
  writer.put(toByte(MessageType::kTimes)).put(std::uint8_t{0});
  writer.put(times.queuedTenthsOfMilliseconds).put(times.drawnTenthsOfMilliseconds);
  writer.put(times.encodedTenthsOfMilliseconds).put(times.socketTenthsOfMilliseconds);
  writer.put(times.lineTenthsOfMilliseconds);
  return writer.take();
}

std::vector<std::uint8_t> encode(const People& people) {
  WireWriter writer;
  writer.put(toByte(MessageType::kPeople)).put(static_cast<std::uint8_t>(people.othersAreLost));
  writer.put(static_cast<std::uint16_t>(people.people.size()));
  for (const Person& person : people.people) {
    const std::string name = printable(person.name, kMaxPersonNameBytes);
    writer.put(person.visitor);
    putColour(writer, person.colour);
    writer.put(static_cast<std::uint8_t>(name.size())).put(name);
  }
  return writer.take();
}

void encode(const FrameHeader& header, std::span<std::uint8_t, kFrameHeaderBytes> out) {
  HeaderWriter writer(out);
  writer.put(toByte(MessageType::kFrame)).put(header.codec).put(header.width).put(header.height);
  writer.put(header.visitors).put(header.frame).put(header.lastInput).put(header.serverMicroseconds);
  assert(writer.full());
}

void encode(const PictureHeader& header, std::span<std::uint8_t> out) {
  assert(header.labels.size() <= kMaxLabels);
  HeaderWriter writer(out);
  writer.put(toByte(MessageType::kPicture)).put(header.codec);
  writer.put(header.independent ? kIndependentFlag : std::uint8_t{0}).put(header.border);
  writer.put(header.width).put(header.height).put(header.visitors);
  writer.put(static_cast<std::uint8_t>(header.labels.size())).put(header.fire);
  writer.put(header.frame).put(header.lastInput).put(header.serverMicroseconds);
  writer.put(header.yaw).put(header.pitch).put(header.tanHalfX).put(header.tanHalfY);
  for (const Label& label : header.labels) {
    writer.put(label.visitor).put(label.x).put(label.y).put(label.opacity).put(std::uint8_t{0});
  }
  assert(writer.full());
}

void encode(const CapturedHeader& header, std::span<std::uint8_t, kCapturedHeaderBytes> out) {
  HeaderWriter writer(out);
  writer.put(toByte(MessageType::kCaptured)).put(header.codec).put(header.width).put(header.height);
  writer.put(std::uint16_t{0}).put(header.number);
  assert(writer.full());
}

}  // namespace grove::stream
