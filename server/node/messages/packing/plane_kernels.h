#pragma once

#include <cstddef>
#include <cstdint>

/// Words of four bytes as four planes of bytes, and back.
namespace grove::node {

/// Byte b of word i becomes planes[b * count + i].
void splitPlanes(const std::uint32_t* words, std::size_t count, std::uint8_t* planes);

/// The inverse.
void joinPlanes(const std::uint8_t* planes, std::size_t count, std::uint32_t* words);

}  // namespace grove::node
