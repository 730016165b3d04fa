#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace grove {

/// XXH3, 64 bits, of bytes that come in pieces.
class Checksum {
 public:
  Checksum();
  ~Checksum();
  Checksum(Checksum&&) noexcept;
  Checksum& operator=(Checksum&&) noexcept;

  void add(std::span<const std::byte> bytes);
  [[nodiscard]] std::uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

[[nodiscard]] std::uint64_t checksumOf(std::span<const std::byte> bytes);

}  // namespace grove
