#pragma once

#include <cstddef>
#include <span>
#include <string_view>

/// Files compiled into the binary (shaders, the page, scenes), see `grove_embed` in server/cmake.
namespace grove::embedded {

struct File {
  const char* path;  ///< relative to the folder from which it was embedded
  const unsigned char* bytes;
  std::size_t size;

  [[nodiscard]] std::string_view text() const { return {reinterpret_cast<const char*>(bytes), size}; }
};

std::span<const File> shaders();
std::span<const File> scenes();  ///< the default one first
std::span<const File> web();

}  // namespace grove::embedded
