#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <cstddef>
#include <optional>

#include "node/messages/wire/wire.h"

namespace grove::node {

inline constexpr std::size_t kFramePrefixBytes = 5;

/// A packet as one message of gRPC: the length of its header (32 bits, little endian), whether bulk bytes follow (one
/// byte, 0 or 1), the header, and those bytes. The bulk is not copied: the message holds it.
[[nodiscard]] grpc::ByteBuffer frameOf(const Packet& packet);

/// Nothing if the bytes are no such message.
[[nodiscard]] std::optional<Packet> packetOf(const grpc::ByteBuffer& message);

}  // namespace grove::node
