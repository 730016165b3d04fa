#pragma once

#include <string>

namespace grove::stream {

/// The codecs that frames can be sent in, each with the library that encodes it and the version of that library that
/// this program was built with, as in "JPEG (libjpeg-turbo 2.1.5)".
[[nodiscard]] std::string codecs();

}  // namespace grove::stream
