#pragma once

#include <grpc/support/log.h>

namespace grove::node {

/// Keeps gRPC from writing to stderr in a form of its own: what it has to say is in the states and errors of the links.
inline void silenceLibrary() {
  gpr_set_log_function([](gpr_log_func_args*) {});
}

}  // namespace grove::node
