#pragma once

#include <string>

namespace grove::cli {

/// Options of `grove load`.
struct LoadOptions {
  std::string url;  ///< ws://HOST:PORT/, or wss://
  int sessions = 1;
  double seconds = 10.0;
  int width = 1280;       ///< pixels
  int height = 720;       ///< pixels
  bool insecure = false;  ///< take any certificate
  bool json = false;
};

/// Measures a running server with real websocket clients and prints the figures to stdout. Returns the exit status: 1
/// if nobody was let in, 2 if the address is wrong.
int runLoad(const LoadOptions& options);

}  // namespace grove::cli
