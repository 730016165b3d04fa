#include "stream/codecs.h"

namespace grove::stream {

std::string codecs() { return "JPEG (libjpeg-turbo " GROVE_TURBOJPEG_VERSION ")"; }

}  // namespace grove::stream
