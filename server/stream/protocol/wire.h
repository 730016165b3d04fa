#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace grove::stream {

/// Types that are sent as little-endian bytes.
template <class T>
concept WireNumber = std::unsigned_integral<T> || std::same_as<T, float>;

template <WireNumber T>
using WireBits = std::conditional_t<std::same_as<T, float>, std::uint32_t, T>;

/// Reads numbers from the front of a message. Past the end it returns zeros, and exhausted() is true.
class WireReader {
 public:
  explicit WireReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  template <WireNumber T>
  T take() {
    if (rest_.size() < sizeof(T)) {
      exhausted_ = true;
      rest_ = {};
      return T{};
    }
    WireBits<T> bits = 0;
    for (std::size_t i = 0; i < sizeof(T); ++i) {
      bits = static_cast<WireBits<T>>(bits | static_cast<WireBits<T>>(WireBits<T>{rest_[i]} << (8 * i)));
    }
    rest_ = rest_.subspan(sizeof(T));
    return std::bit_cast<T>(bits);
  }

  std::string_view takeText(std::size_t bytes) {
    if (rest_.size() < bytes) {
      exhausted_ = true;
      rest_ = {};
    }
    const std::string_view text = restAsText().substr(0, bytes);
    rest_ = rest_.subspan(text.size());
    return text;
  }

  [[nodiscard]] std::span<const std::uint8_t> rest() const noexcept { return rest_; }
  [[nodiscard]] std::string_view restAsText() const noexcept {
    return {reinterpret_cast<const char*>(rest_.data()), rest_.size()};
  }
  [[nodiscard]] bool exhausted() const noexcept { return exhausted_; }

 private:
  std::span<const std::uint8_t> rest_;
  bool exhausted_ = false;
};

/// Returns a number's little-endian bytes.
template <WireNumber T>
[[nodiscard]] std::array<std::uint8_t, sizeof(T)> toWire(T value) {
  const auto bits = std::bit_cast<WireBits<T>>(value);
  std::array<std::uint8_t, sizeof(T)> bytes{};
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = static_cast<std::uint8_t>(bits >> (8 * i));
  return bytes;
}

/// Appends numbers to a message.
class WireWriter {
 public:
  template <WireNumber T>
  WireWriter& put(T value) {
    for (const std::uint8_t byte : toWire(value)) bytes_.push_back(byte);
    return *this;
  }
  WireWriter& put(std::string_view text) {
    bytes_.insert(bytes_.end(), text.begin(), text.end());
    return *this;
  }
  [[nodiscard]] std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace grove::stream
