#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "node/messages/shared_data.h"

/// Packing of object types' payloads: little-endian numbers, and planes of numbers compressed by LZ4.
namespace grove::node {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they are");

template <class T>
concept PackedNumber = std::integral<T> || std::floating_point<T>;

/// LZ4's highest ratio of compression.
inline constexpr std::size_t kMaxRatio = 255;

/// Appends bytes compressed by LZ4, or as they are if that is not smaller.
void appendCompressed(PackedBytes& to, std::span<const std::byte> plane);

/// The inverse; removes the bytes from the front. Throws PackingError unless they fill `plane` exactly.
void takeCompressed(std::span<const std::byte>& from, std::span<std::byte> plane);

/// Words as four planes of bytes, some thousands at a time.
void appendPlanes(PackedBytes& to, std::span<const std::uint32_t> words);
void takePlanes(std::span<const std::byte>& from, std::span<std::uint32_t> words);

class PackWriter {
 public:
  /// `bytes`: expected size, if nothing gets smaller.
  explicit PackWriter(std::size_t bytes = 0) { bytes_.reserve(bytes); }

  template <PackedNumber T>
  PackWriter& put(T value) {
    std::array<std::byte, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(T));
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    return *this;
  }

  /// Numbers of four bytes, as four planes, because neighbours share their high bytes.
  template <class T>
  requires(sizeof(T) == 4 && std::is_trivially_copyable_v<T>) PackWriter& putPlanes(std::span<const T> values) {
    appendPlanes(bytes_, {reinterpret_cast<const std::uint32_t*>(values.data()), values.size()});
    return *this;
  }

  /// Bytes, compressed by LZ4 if that makes them smaller.
  PackWriter& putBytes(std::span<const std::byte> plane) {
    appendCompressed(bytes_, plane);
    return *this;
  }

  [[nodiscard]] PackedBytes take() { return std::move(bytes_); }

 private:
  PackedBytes bytes_;
};

/// Reads what a PackWriter has written, from the front. Throws PackingError if bytes are missing.
class PackReader {
 public:
  /// `what` names the data in the error's text.
  PackReader(std::span<const std::byte> bytes, std::string what) : rest_(bytes), what_(std::move(what)) {}

  template <PackedNumber T>
  [[nodiscard]] T take() {
    if (rest_.size() < sizeof(T)) fail("is truncated");
    T value;
    std::memcpy(&value, rest_.data(), sizeof(T));
    rest_ = rest_.subspan(sizeof(T));
    return value;
  }

  template <std::floating_point T>
  [[nodiscard]] T takeFinite(T min, T max) {
    const T value = take<T>();
    if (!(value >= min && value <= max)) fail("has a number out of range");
    return value;
  }

  template <std::integral T>
  [[nodiscard]] T takeWithin(T min, T max) {
    const T value = take<T>();
    if (value < min || value > max) fail("has a number out of range");
    return value;
  }

  /// Checks that enough bytes are left for planes of this size, before memory is allocated: a small message can claim
  /// any size.
  void expect(std::size_t bytes) const {
    if (rest_.size() < bytes / kMaxRatio) fail("is too short for its size");
  }

  template <class T>
  requires(sizeof(T) == 4 && std::is_trivially_copyable_v<T>) void takePlanes(std::span<T> values) {
    node::takePlanes(rest_, {reinterpret_cast<std::uint32_t*>(values.data()), values.size()});
  }

  void takeBytes(std::span<std::byte> plane) { takeCompressed(rest_, plane); }

  /// Checks that nothing is left.
  void finish() const {
    if (!rest_.empty()) fail("has bytes left over");
  }

  [[noreturn]] void fail(const char* reason) const { throw PackingError(what_ + " " + reason); }

 private:
  std::span<const std::byte> rest_;
  const std::string what_;
};

}  // namespace grove::node
