#include "node/messages/wire/nesting.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include <cstdint>

namespace grove::node {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::internal::WireFormatLite;
using google::protobuf::io::CodedInputStream;

/// Reads up to the innermost limit. Recursion is as deep as the schema, in which no type contains itself.
bool partsAreNested(CodedInputStream& bytes, const Descriptor& type) {
  while (const std::uint32_t tag = bytes.ReadTag()) {
    if (WireFormatLite::GetTagWireType(tag) != WireFormatLite::WIRETYPE_LENGTH_DELIMITED) {
      if (!WireFormatLite::SkipField(&bytes, tag)) return false;
      continue;
    }
    int length = 0;
    if (!bytes.ReadVarintSizeAsInt(&length) || length > bytes.BytesUntilLimit()) return false;
    const FieldDescriptor* const field = type.FindFieldByNumber(WireFormatLite::GetTagFieldNumber(tag));
    const Descriptor* const part = field == nullptr ? nullptr : field->message_type();
    if (part == nullptr) {
      bytes.Skip(length);
      continue;
    }
    const CodedInputStream::Limit outer = bytes.PushLimit(length);
    if (!partsAreNested(bytes, *part)) return false;
    bytes.PopLimit(outer);
  }
  return bytes.ConsumedEntireMessage();
}

}  // namespace

bool isNested(std::string_view header, const Descriptor& type) {
  const auto size = static_cast<int>(header.size());
  CodedInputStream bytes(reinterpret_cast<const std::uint8_t*>(header.data()), size);
  bytes.PushLimit(size);
  return partsAreNested(bytes, type);
}

}  // namespace grove::node
