#pragma once

#include <gtest/gtest.h>

#include <string>

#include "node/transport/transport_kind.h"
#include "sanitized.h"

namespace grove::node::testing {

inline const auto kBothInMemory = ::testing::Values(TransportKind::kReference, TransportKind::kBytes);

/// The thread sanitizer sees no locks within gRPC, which is not built with it, and so reports what is none.
#if defined(__SANITIZE_THREAD__)
inline const auto kAllTransports = kBothInMemory;
inline const auto kAllWires = ::testing::Values(TransportKind::kBytes);
#else
inline const auto kAllTransports =
    ::testing::Values(TransportKind::kReference, TransportKind::kBytes, TransportKind::kGrpc);
inline const auto kAllWires = ::testing::Values(TransportKind::kBytes, TransportKind::kGrpc);
#endif

inline std::string nameOf(TransportKind kind) {
  if (kind == TransportKind::kGrpc) return "Grpc";
  return kind == TransportKind::kBytes ? "Bytes" : "Reference";
}
inline std::string transportName(const ::testing::TestParamInfo<TransportKind>& info) { return nameOf(info.param); }

}  // namespace grove::node::testing
