#include "objects/lightfield/format/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "base/error.h"

namespace grove::objects::lightfield {
namespace {

class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& file) : descriptor_(open(file.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ < 0) {
      throw EnvironmentError("cannot open it: " + std::generic_category().message(errno), file.string(),
                             "light fields are made by `grove bake`");
    }
  }
  ~OpenFile() { close(descriptor_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

MappedFile::MappedFile(const std::filesystem::path& file) {
  const OpenFile opened(file);
  struct stat status {};
  if (fstat(opened.descriptor(), &status) != 0 || !S_ISREG(status.st_mode)) {
    throw EnvironmentError("is no plain file", file.string(), "name a light-field file");
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size == 0) return;
  void* const address = mmap(nullptr, size, PROT_READ, MAP_SHARED, opened.descriptor(), 0);
  if (address == MAP_FAILED) {
    throw EnvironmentError("cannot map it: " + std::generic_category().message(errno), file.string(),
                           "more address space may be needed (ulimit -v)");
  }
  bytes_ = {static_cast<const std::byte*>(address), size};
}

MappedFile::~MappedFile() {
  // munmap wants the pointer that mmap gave.
  if (!bytes_.empty()) munmap(const_cast<std::byte*>(bytes_.data()), bytes_.size());
}

}  // namespace grove::objects::lightfield
