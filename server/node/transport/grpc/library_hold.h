#pragma once

#include <grpc/grpc.h>

namespace grove::node {

/// Keeps gRPC's library, which else ends with the last of its objects: between two calls, on a thread that then waits
/// for gRPC's own, of which one may be about to begin the next call.
class LibraryHold {
 public:
  LibraryHold() { grpc_init(); }
  ~LibraryHold() { grpc_shutdown(); }
  LibraryHold(const LibraryHold&) = delete;
  LibraryHold& operator=(const LibraryHold&) = delete;
};

}  // namespace grove::node
