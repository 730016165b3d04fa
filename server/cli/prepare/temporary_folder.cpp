#include "cli/prepare/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <system_error>

#include "base/error.h"

namespace grove::cli {

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  std::string name = (parent / "grove-XXXXXX").string();
  if (error || mkdtemp(name.data()) == nullptr) {
    throw EnvironmentError("cannot make a folder: " + (error ? error.message() : std::strerror(errno)), parent.string(),
                           "set GROVE_CACHE or TMPDIR to a writable folder");
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace grove::cli
