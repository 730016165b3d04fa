#include "base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "base/error.h"

namespace grove {

AtomicFile::AtomicFile(std::filesystem::path file)
    : file_(std::move(file)),
      partial_(file_.string() + ".partial-XXXXXX"),
      descriptor_(mkostemp(partial_.data(), O_CLOEXEC)) {
  if (descriptor_ < 0) fail("cannot create a file there");
}

AtomicFile::~AtomicFile() {
  if (descriptor_ < 0) return;
  close(descriptor_);
  unlink(partial_.c_str());
}

void AtomicFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot write");
    offset += static_cast<std::uint64_t>(written);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void AtomicFile::commit() {
  constexpr mode_t kReadableByAll = 0644;  // mkostemp makes it private
  if (fchmod(descriptor_, kReadableByAll) != 0 || fsync(descriptor_) != 0) fail("cannot write");
  if (rename(partial_.c_str(), file_.c_str()) != 0) fail("cannot put the finished file in its place");
  close(std::exchange(descriptor_, -1));
  // The new name, too, must reach the disk.
  const std::filesystem::path folder = file_.has_parent_path() ? file_.parent_path() : std::filesystem::path(".");
  const int directory = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;
  fsync(directory);
  close(directory);
}

void AtomicFile::fail(const std::string& what) const {
  throw EnvironmentError(what + ": " + std::generic_category().message(errno), file_.string(),
                         "the folder must exist, be writable and have room");
}

}  // namespace grove
