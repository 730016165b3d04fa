#include "base/version.h"

namespace grove {

std::string_view version() noexcept { return GROVE_VERSION; }

}  // namespace grove
