#pragma once

#include <string_view>

namespace google::protobuf {
class Descriptor;
}

namespace grove::node {

/// Whether each part of a header, which is to be a message of this type, lies within the part that holds it. The
/// library sets aside as much memory as a text says that it is long, tens of megabytes, before it finds that it is not
/// there.
[[nodiscard]] bool isNested(std::string_view header, const google::protobuf::Descriptor& type);

}  // namespace grove::node
