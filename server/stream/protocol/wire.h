#pragma once

#include <algorithm>
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
concept WireNumber = std::unsigned_integral<T> || std::same_as<T, float> || std::is_enum_v<T>;

template <WireNumber T>
using WireBits =
    std::conditional_t<sizeof(T) == 1, std::uint8_t, std::conditional_t<sizeof(T) == 2, std::uint16_t, std::uint32_t>>;

/// Bytes of a message that must be zero.
template <std::size_t N>
struct Reserved {};

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

  template <WireNumber T>
  void read(T& value) {
    value = take<T>();
  }
  template <std::size_t N>
  void read(Reserved<N> /*bytes*/) {
    for (std::size_t i = 0; i < N; ++i) zeros_ = take<std::uint8_t>() == 0 && zeros_;
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

  std::span<const std::uint8_t> takeBytes(std::size_t count) {
    if (rest_.size() < count) {
      exhausted_ = true;
      rest_ = {};
    }
    const std::span<const std::uint8_t> bytes = rest_.first(std::min(count, rest_.size()));
    rest_ = rest_.subspan(bytes.size());
    return bytes;
  }

  [[nodiscard]] std::span<const std::uint8_t> rest() const noexcept { return rest_; }
  [[nodiscard]] std::string_view restAsText() const noexcept {
    return {reinterpret_cast<const char*>(rest_.data()), rest_.size()};
  }
  [[nodiscard]] bool exhausted() const noexcept { return exhausted_; }
  /// Whether it was all read, and no more.
  [[nodiscard]] bool whole() const noexcept { return !exhausted_ && rest_.empty(); }
  /// Whether all reserved bytes so far were zero.
  [[nodiscard]] bool zeros() const noexcept { return zeros_; }

 private:
  std::span<const std::uint8_t> rest_;
  bool exhausted_ = false;
  bool zeros_ = true;
};

/// Appends numbers to a message.
class WireWriter {
 public:
  template <WireNumber T>
  WireWriter& put(T value) {
    const auto bits = std::bit_cast<WireBits<T>>(value);
    for (std::size_t i = 0; i < sizeof(T); ++i) bytes_.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
    return *this;
  }
  template <std::size_t N>
  WireWriter& put(Reserved<N> /*bytes*/) {
    bytes_.insert(bytes_.end(), N, 0);
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
