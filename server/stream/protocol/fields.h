#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "stream/protocol/message_type.h"
#include "stream/protocol/protocol.h"
#include "stream/protocol/wire.h"

/// The fields of messages in the order of PROTOCOL.md, once for reading and writing: `each` takes any number of fields.
namespace grove::stream {

template <class T, class Message>
concept Of = std::same_as<std::remove_const_t<T>, Message>;

void fields(Of<world::Input> auto& input, const auto& each) {
  each(input.keys, Reserved<2>(), input.number, input.yaw, input.pitch);
}
void fields(Of<Ack> auto& ack, const auto& each) { each(Reserved<3>(), ack.frame); }
void fields(Of<Resize> auto& resize, const auto& each) { each(Reserved<3>(), resize.width, resize.height); }
void fields(Of<Broken> auto& broken, const auto& each) { each(Reserved<3>(), broken.frame); }
void fields(Of<Presented> auto& presented, const auto& each) {
  each(Reserved<1>(), presented.heldTenthsOfMilliseconds, presented.frame, presented.arrivedMicroseconds);
}
void fields(Of<Painted> auto& painted, const auto& each) {
  each(Reserved<1>(), painted.heldTenthsOfMilliseconds, painted.frame, painted.arrivedMicroseconds,
       painted.decodeTenthsOfMilliseconds, painted.paintTenthsOfMilliseconds);
}
void fields(Of<Capture> auto& capture, const auto& each) { each(Reserved<3>(), capture.number); }

void fields(Of<FrameHeader> auto& header, const auto& each) {
  each(header.codec, header.width, header.height, header.visitors, header.frame, header.lastInput,
       header.serverMicroseconds);
}
/// `flags` and `labels` are numbers on the wire.
void fields(Of<PictureHeader> auto& header, auto& flags, auto& labels, const auto& each) {
  each(header.codec, flags, header.border, header.width, header.height, header.visitors, labels, header.fire,
       header.frame, header.lastInput, header.serverMicroseconds, header.yaw, header.pitch, header.tanHalfX,
       header.tanHalfY);
}
void fields(Of<Label> auto& label, const auto& each) {
  each(label.visitor, label.x, label.y, label.opacity, Reserved<1>());
}
void fields(Of<MovingPart> auto& part, const auto& each) {
  each(part.left, part.top, part.right, part.bottom, part.nearestCentimetres, part.farthestCentimetres, part.velocity.x,
       part.velocity.y);
}
/// Without the moving parts and the bytes of the grid, whose numbers are on the wire.
void fields(Of<Space> auto& space, auto& nearnessBytes, auto& moving, const auto& each) {
  each(space.eye.x, space.eye.y, space.eye.z, space.visitor.x, space.visitor.y, space.visitor.z, space.velocity.x,
       space.velocity.y, space.sinceInputMicroseconds, nearnessBytes, moving, Reserved<1>());
}
void fields(Of<world::Hill> auto& hill, const auto& each) {
  each(hill.centre.x, hill.centre.y, hill.radius, hill.height);
}
void fields(Of<world::Obstacle> auto& obstacle, const auto& each) {
  each(obstacle.centre.x, obstacle.centre.y, obstacle.radius);
}
void fields(Of<CapturedHeader> auto& header, const auto& each) {
  each(header.codec, header.width, header.height, Reserved<2>(), header.number);
}
void fields(Of<Status> auto& status, const auto& each) {
  each(status.limitedBy, status.framesPerSecond, status.quality, status.width, status.height,
       status.roundTripMilliseconds, status.visitors, status.kilobitsPerSecond, status.lastInput);
}
void fields(Of<Times> auto& times, const auto& each) {
  each(Reserved<1>(), times.queuedTenthsOfMilliseconds, times.drawnTenthsOfMilliseconds,
       times.encodedTenthsOfMilliseconds, times.socketTenthsOfMilliseconds, times.lineTenthsOfMilliseconds);
}

[[nodiscard]] inline auto into(WireReader& reader) {
  return [&reader](auto&&... values) { (reader.read(values), ...); };
}
[[nodiscard]] inline auto into(WireWriter& writer) {
  return [&writer](const auto&... values) { (writer.put(values), ...); };
}

/// A message of these fields only.
template <class Message>
[[nodiscard]] std::vector<std::uint8_t> encodeFields(MessageType type, const Message& message) {
  WireWriter writer;
  writer.put(type);
  fields(message, into(writer));
  return writer.take();
}

/// Fills `message` from what follows the type, or returns why it cannot.
template <class Message>
[[nodiscard]] std::optional<Refusal> parseFields(WireReader reader, std::string_view name, Message& message) {
  fields(message, into(reader));
  if (!reader.whole()) return wrongLength(name);
  if (!reader.zeros()) return reservedBytes(name);
  return std::nullopt;
}

}  // namespace grove::stream
