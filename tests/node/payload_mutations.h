#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <random>

#include "allocations.h"
#include "mutations.h"
#include "node/messages/shared_data.h"

namespace grove::tests {

/// What unpacking a payload may take: bytes of memory for each byte of it, and in any case.
struct MemoryBound {
  std::size_t perByte = 0;
  std::size_t always = std::size_t{1} << 16U;
};

/// Unpacks mutations of a payload. `repair` may give them the right checksum. Would catch one that throws anything but
/// PackingError, or takes memory for bytes that are not there.
template <class Unpack, class Repair>
void expectMutationsAreRefusedOrSmall(const node::PackedBytes& whole, const MemoryBound& bound, const Unpack& unpack,
                                      const Repair& repair) {
  std::mt19937 random(8);
  int refused = 0;
  for (int i = 0; i < kMutations; ++i) {
    node::PackedBytes bytes = mutated(whole, whole, random);
    repair(bytes);
    const Allocations allocations;
    try {
      unpack(bytes);
    } catch (const node::PackingError&) {
      ++refused;
    }
    ASSERT_LE(allocations.bytes(), bound.always + bound.perByte * bytes.size()) << "mutation " << i;
  }
  EXPECT_GT(refused, kMutations / 4);
  EXPECT_LT(refused, kMutations) << "mutations that nothing can read test nothing";
}

template <class Unpack>
void expectMutationsAreRefusedOrSmall(const node::PackedBytes& whole, const MemoryBound& bound, const Unpack& unpack) {
  expectMutationsAreRefusedOrSmall(whole, bound, unpack, [](node::PackedBytes&) {});
}

}  // namespace grove::tests
