#include "base/plain_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

#include "base/error.h"

namespace grove {
namespace {

std::string lastError() { return std::generic_category().message(errno); }

}  // namespace

// Without O_NONBLOCK, opening a pipe would wait for a writer.
PlainFile::PlainFile(std::filesystem::path file, std::string mend, std::uint64_t maxBytes)
    : file_(std::move(file)),
      mend_(std::move(mend)),
      descriptor_(open(file_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)) {
  if (descriptor_ < 0) fail("cannot open it: " + lastError());
  struct stat status {};
  const bool plain = fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  bytes_ = static_cast<std::uint64_t>(status.st_size);
  if (plain && bytes_ <= maxBytes) return;
  close(descriptor_);
  if (!plain) fail("is not a regular file");
  fail("has " + std::to_string(bytes_) + " bytes; the maximum is " + std::to_string(maxBytes));
}

PlainFile::~PlainFile() { close(descriptor_); }

std::size_t PlainFile::read(std::span<char> to) {
  std::size_t done = 0;
  while (done < to.size()) {
    const ssize_t count = ::read(descriptor_, to.data() + done, to.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail("cannot read it: " + lastError());
    if (count == 0) break;
    done += static_cast<std::size_t>(count);
  }
  return done;
}

std::string PlainFile::readAll() {
  std::string text(static_cast<std::size_t>(bytes_), '\0');
  text.resize(read(text));
  return text;
}

void PlainFile::fail(const std::string& what) const { throw EnvironmentError(what, file_.string(), mend_); }

}  // namespace grove
