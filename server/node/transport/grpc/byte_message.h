#pragma once

#include <grpcpp/support/byte_buffer.h>

#include <string>
#include <vector>

namespace grove::node {

/// Converts bytes to one gRPC message.
[[nodiscard]] inline grpc::ByteBuffer messageOf(const std::string& text) {
  const grpc::Slice slice(text);
  return {&slice, 1};
}

/// Converts back; empty if the library cannot read it.
[[nodiscard]] inline std::string bytesOf(const grpc::ByteBuffer& message) {
  std::string bytes;
  std::vector<grpc::Slice> slices;
  if (!message.Dump(&slices).ok()) return bytes;
  for (const grpc::Slice& slice : slices) bytes.append(reinterpret_cast<const char*>(slice.begin()), slice.size());
  return bytes;
}

}  // namespace grove::node
