#pragma once

#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace grove::stream::h264 {

/// Writes bits, the highest first, and the codes of ITU-T H.264, section 9.1.
class BitWriter {
 public:
  void clear() {
    size_ = 0;
    pending_ = 0;
    count_ = 0;
  }

  /// Writes the `count` lowest bits, at most 32; higher bits must be 0.
  void put(std::uint32_t bits, int count) {
    assert(count <= kWord && (count == kWord || bits >> count == 0));
    pending_ = pending_ << count | bits;
    count_ += count;
    if (count_ < kWord) return;
    count_ -= kWord;
    store(static_cast<std::uint32_t>(pending_ >> count_), 4);
  }

  /// Exp-Golomb, unsigned.
  void putUnsigned(std::uint32_t value) {
    const int length = std::bit_width(value + 1);
    if (2 * length - 1 <= kWord) return put(value + 1, 2 * length - 1);
    put(0, length - 1);
    put(value + 1, length);
  }

  /// Exp-Golomb, signed.
  void putSigned(int value) {
    putUnsigned(value > 0 ? 2 * static_cast<std::uint32_t>(value) - 1 : 2 * static_cast<std::uint32_t>(-value));
  }

  /// Ends a unit's payload: rbsp_trailing_bits().
  void finish() {
    put(1, 1);
    put(0, (kWord - count_) % 8);
    const int left = count_ / 8;
    if (left > 0) store(static_cast<std::uint32_t>(pending_ << (kWord - count_)), static_cast<std::size_t>(left));
    count_ = 0;
  }

  /// The payload, once it is finished.
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return std::span(bytes_).first(size_); }
  [[nodiscard]] std::size_t capacity() const { return bytes_.capacity(); }

 private:
  static constexpr int kWord = 32;

  /// Appends the first bytes of a word.
  void store(std::uint32_t word, std::size_t count) {
    if (size_ + 4 > bytes_.size()) bytes_.resize(2 * bytes_.size() + 4096);
    std::uint8_t* const to = bytes_.data() + size_;
    for (int i = 0; i < 4; ++i) to[i] = static_cast<std::uint8_t>(word >> (kWord - 8 * (i + 1)));
    size_ += count;
  }

  std::vector<std::uint8_t> bytes_;
  std::size_t size_ = 0;  ///< bytes in use
  std::uint64_t pending_ = 0;
  int count_ = 0;  ///< bits of `pending_` that are not in `bytes_`
};

/// Bits of a signed number.
[[nodiscard]] constexpr int signedBits(int value) {
  const auto code = value > 0 ? 2 * static_cast<std::uint32_t>(value) : 2 * static_cast<std::uint32_t>(-value) + 1;
  return 2 * std::bit_width(code) - 1;
}

}  // namespace grove::stream::h264
