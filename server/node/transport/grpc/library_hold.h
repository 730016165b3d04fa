#pragma once

#include <grpc/grpc.h>

namespace grove::node {

/// Keeps gRPC initialized. Without it, gRPC shuts down when its last object is destroyed, for example between two
/// calls, and the thread that destroyed it waits for gRPC's threads. One of these may wait for that thread to start the
/// next call: a deadlock.
class LibraryHold {
 public:
  LibraryHold() { grpc_init(); }
  ~LibraryHold() { grpc_shutdown(); }
  LibraryHold(const LibraryHold&) = delete;
  LibraryHold& operator=(const LibraryHold&) = delete;
};

}  // namespace grove::node
