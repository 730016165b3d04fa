#pragma once

#include <string_view>

namespace google::protobuf {
class Descriptor;
}

namespace grove::node {

/// Whether each part of a header of this type lies within its parent. Without this check, the library allocates as much
/// memory as the claimed length of a text, tens of megabytes, before it finds that the bytes are missing.
[[nodiscard]] bool isNested(std::string_view header, const google::protobuf::Descriptor& type);

}  // namespace grove::node
