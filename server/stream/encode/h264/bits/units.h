#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "stream/encode/annex_b.h"
#include "stream/encode/h264/bits/bit_writer.h"

namespace grove::stream::h264 {

/// Size of a picture in pixels, even numbers.
struct PictureSize {
  int width = 0;
  int height = 0;

  [[nodiscard]] int macroblocksAcross() const { return (width + 15) / 16; }
  [[nodiscard]] int macroblocksDown() const { return (height + 15) / 16; }
  friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// pic_init_qp; slice headers write the difference from it.
inline constexpr int kFirstQuantiser = 26;
/// frame_num counts modulo this.
inline constexpr std::uint32_t kFrameNumbers = 256;

/// Header of a picture's only slice.
struct SliceHeader {
  bool independent = false;         ///< IDR
  std::uint32_t frameNumber = 0;    ///< since the last independent picture, below kFrameNumbers
  std::uint32_t independentId = 0;  ///< differs between adjacent independent pictures, at most 65535
  int quantiser = kFirstQuantiser;  ///< of the first macroblock
};

/// Sequence and picture parameters: Constrained Baseline, one reference, no reordering, BT.601 full range
/// (ITU-T H.264, 7.3.2.1, 7.3.2.2 and annex E).
[[nodiscard]] BitWriter sequenceParameters(const PictureSize& size);
[[nodiscard]] BitWriter pictureParameters();
/// Section 7.3.3.
void writeHeader(const SliceHeader& header, BitWriter& out);

/// Appends a unit to a byte stream (annex B): start code, type, and the payload with the bytes that keep start codes
/// out of it.
void appendUnit(UnitType type, std::span<const std::uint8_t> payload, std::vector<std::uint8_t>& out);

}  // namespace grove::stream::h264
