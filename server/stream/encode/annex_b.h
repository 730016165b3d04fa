#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace grove::stream {

/// Types of H.264 units (ITU-T H.264, table 7-1) that a stream of Grove may contain.
enum class UnitType : std::uint8_t {
  kSlice = 1,
  kIndependentSlice = 5,  ///< IDR
  kInformation = 6,       ///< SEI
  kSequenceParameters = 7,
  kPictureParameters = 8,
  kDelimiter = 9,
};

/// Returns the types of the units of an Annex B byte stream, in order; empty if the bytes are no such stream.
[[nodiscard]] std::optional<std::vector<UnitType>> unitTypes(std::span<const std::uint8_t> bytes);

}  // namespace grove::stream
