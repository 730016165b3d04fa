#pragma once

#include <array>
#include <cstdint>

#include "objects/lightfield/format/light_field.h"

/// The bytes of a light-field file, little-endian; FORMAT.md describes them in words.
namespace grove::objects::lightfield {

inline constexpr std::array<char, 8> kMagic{'G', 'r', 'o', 'v', 'e', 'L', 'F', '\n'};
inline constexpr std::uint32_t kFormatVersion = 3;
inline constexpr std::uint64_t kSectionAlignment = 4096;

struct Section {
  std::uint64_t offset = 0;  ///< from the start of the file, a multiple of kSectionAlignment
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;  ///< XXH3, 64 bits
};

/// Indices into Header::sections; colour k is at kColour + k.
enum SectionIndex : std::uint32_t { kDirectory, kDepth, kVoxels, kHeldOut, kNear, kColour };

struct Header {
  std::array<char, 8> magic = kMagic;
  std::uint32_t version = kFormatVersion;
  std::uint32_t headerBytes = 0;  ///< sizeof(Header)
  std::uint64_t fileBytes = 0;
  std::uint64_t headerChecksum = 0;  ///< XXH3 of the header with this field 0
  std::uint32_t subdivision = 0;
  std::uint32_t size = 0;
  std::uint32_t levels = 0;
  std::uint32_t lightings = 0;
  std::uint32_t blocks = 0;
  std::uint32_t heldOut = 0;
  float centre[3]{};
  float radius = 0.0F;
  float target[3]{};
  float extent = 0.0F;
  float boundsLow[3]{};
  float boundsHigh[3]{};
  float sunAzimuth = 0.0F;
  std::uint32_t voxelCells[3]{};
  float voxelCell = 0.0F;
  float voxelLow[3]{};
  char source[128]{};                           ///< UTF-8, zero-terminated
  Section sections[kColour + kMaxLightings]{};  ///< sections of unused lightings are all 0
};
static_assert(sizeof(Header) == 776, "no padding");

/// Followed by each held-out view's size * size colours and size * size depths.
struct HeldOutHeader {
  float eye[3]{};
  float corner[3]{};
  float perColumn[3]{};
  float perRow[3]{};
  std::uint32_t size = 0;
  std::uint32_t amid = 0;  ///< 1: the object is shown amid copies of itself
};
static_assert(sizeof(HeldOutHeader) == 56, "no padding");

/// Followed by the clusters, the vertices' x, y and z, the faces, and the colours of each lighting: of all fronts,
/// then of all backs.
struct NearHeader {
  std::uint32_t clusters = 0;
  std::uint32_t vertices = 0;
  std::uint32_t faces = 0;
  std::uint32_t colours = 0;  ///< of one lighting and side
};
static_assert(sizeof(NearHeader) == 16, "no padding");

}  // namespace grove::objects::lightfield
