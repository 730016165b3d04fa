#include "node/transport/grpc/packet_frame.h"

#include <google/protobuf/io/coded_stream.h>
#include <grpcpp/support/proto_buffer_reader.h>

#include <array>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace grove::node {
namespace {

grpc::Slice sliceOf(const std::shared_ptr<const PackedBytes>& bulk) {
  auto held = std::make_unique<std::shared_ptr<const PackedBytes>>(bulk);
  // The library takes a non-const pointer but never writes.
  void* const bytes = const_cast<std::byte*>(bulk->data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  const auto release = [](void* holder) {
    const std::unique_ptr<std::shared_ptr<const PackedBytes>> last(
        static_cast<std::shared_ptr<const PackedBytes>*>(holder));
  };
  return {bytes, bulk->size(), release, held.release()};
}

}  // namespace

grpc::ByteBuffer frameOf(const Packet& packet) {
  std::string front(kFramePrefixBytes, '\0');
  front.reserve(kFramePrefixBytes + packet.header.size());
  const auto length = static_cast<std::uint32_t>(packet.header.size());
  for (std::size_t i = 0; i < 4; ++i) front[i] = static_cast<char>(length >> (8 * i) & 0xFFU);
  front[4] = packet.bulk ? '\1' : '\0';
  front += packet.header;
  std::vector<grpc::Slice> slices{grpc::Slice(front)};
  if (packet.bulk && !packet.bulk->empty()) slices.push_back(sliceOf(packet.bulk));
  return {slices.data(), slices.size()};
}

std::optional<Packet> packetOf(const grpc::ByteBuffer& message) {
  // A second reference to the same slices, because the library's reader wants a message that is not const.
  grpc::ByteBuffer same = message;
  grpc::ProtoBufferReader slices(&same);
  google::protobuf::io::CodedInputStream reader(&slices);
  const auto read = [&](void* to, std::size_t count) { return reader.ReadRaw(to, static_cast<int>(count)); };
  std::array<unsigned char, kFramePrefixBytes> prefix{};
  if (!read(prefix.data(), prefix.size())) return std::nullopt;
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i) length |= std::size_t{prefix[i]} << (8 * i);
  const std::size_t left = message.Length() - kFramePrefixBytes;
  if (prefix[4] > 1 || length > left || length > kMaxHeaderBytes || (prefix[4] == 0 && length != left)) {
    return std::nullopt;
  }
  Packet packet{std::string(length, '\0'), nullptr};
  if (!read(packet.header.data(), length)) return std::nullopt;
  if (prefix[4] == 0) return packet;
  PackedBytes bulk(left - length);
  if (!read(bulk.data(), bulk.size())) return std::nullopt;
  packet.bulk = std::make_shared<const PackedBytes>(std::move(bulk));
  return packet;
}

}  // namespace grove::node
