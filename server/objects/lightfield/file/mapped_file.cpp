#include "objects/lightfield/file/mapped_file.h"

#include <sys/mman.h>

#include <cerrno>
#include <cstdint>
#include <limits>
#include <system_error>

#include "base/error.h"
#include "base/log.h"
#include "base/plain_file.h"

namespace grove::objects::lightfield {

MappedFile::MappedFile(const std::filesystem::path& file)
    : cutMessage_(file.string() +
                  ": was truncated while it was in use, or its disk fails: parts of it are missing until it is "
                  "restored and the server restarted") {
  const PlainFile opened(file, "light fields are made by `grove bake`", std::numeric_limits<std::uint64_t>::max());
  const auto size = static_cast<std::size_t>(opened.bytes());
  if (size == 0) return;
  void* const address = mmap(nullptr, size, PROT_READ, MAP_SHARED, opened.descriptor(), 0);
  if (address == MAP_FAILED) {
    throw EnvironmentError("cannot map it: " + std::generic_category().message(errno), file.string(),
                           "more address space may be needed (ulimit -v)");
  }
  bytes_ = {static_cast<const std::byte*>(address), size};
  guard_.emplace(bytes_);
}

MappedFile::~MappedFile() {
  guard_.reset();
  // munmap needs the pointer from mmap.
  if (!bytes_.empty()) munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

void MappedFile::release() const noexcept {
  // If it fails, the pages stay, which costs memory only.
  if (!bytes_.empty()) (void)madvise(const_cast<std::byte*>(bytes_.data()), bytes_.size(), MADV_DONTNEED);
}

void MappedFile::reportOnce() const noexcept {
  if (!reported_.exchange(true)) log::warning(cutMessage_);
}

}  // namespace grove::objects::lightfield
