#include "cli/bench/encode/kept_frames.h"

#include <sys/types.h>
#include <unistd.h>

#include <cassert>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/error.h"

namespace grove::cli {
namespace {

[[noreturn]] void fail(const char* what) {
  throw EnvironmentError(what, std::filesystem::temp_directory_path().string(), "set TMPDIR to a folder with room");
}

/// `transfer` is pread or pwrite, which may transfer only a part.
template <class Bytes, class Transfer>
bool transferAll(const Transfer& transfer, int descriptor, Bytes* bytes, std::size_t size, std::size_t offset) {
  while (size > 0) {
    const ssize_t done = transfer(descriptor, bytes, size, static_cast<off_t>(offset));
    if (done <= 0) return false;
    bytes += done;
    offset += static_cast<std::size_t>(done);
    size -= static_cast<std::size_t>(done);
  }
  return true;
}

}  // namespace

KeptFrames::KeptFrames(int width, int height) {
  raster::ImagePool images;
  picture_ = raster::acquireYuv(images, {0, 0, width, height});
  std::string path = (std::filesystem::temp_directory_path() / "grove-frames-XXXXXX").string();
  const int descriptor = ::mkstemp(path.data());
  if (descriptor < 0) fail("cannot make a file for frames");
  ::unlink(path.c_str());
  file_.reset(::fdopen(descriptor, "r+b"));
  if (!file_) fail("cannot make a file for frames");
}

void KeptFrames::add(const node::FinishedFrame& frame) {
  assert(frame.picture->rect == picture_->rect);
  const auto picture = std::as_bytes(std::span(frame.picture->bytes));
  if (!transferAll(::pwrite, ::fileno(file_.get()), picture.data(), picture.size(), count() * picture.size())) {
    fail("cannot write a frame");
  }
  views_.push_back(frame.view);
  nearness_.push_back(frame.nearness);
}

node::FinishedFrame KeptFrames::read(std::size_t index) {
  const auto picture = std::as_writable_bytes(std::span(picture_->bytes));
  if (!transferAll(::pread, ::fileno(file_.get()), picture.data(), picture.size(), index * picture.size())) {
    fail("cannot read a frame");
  }
  return {.view = views_[index], .picture = picture_, .nearness = nearness_[index]};
}

}  // namespace grove::cli
