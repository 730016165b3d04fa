#pragma once

#include <optional>
#include <string>

namespace grove::cli {

/// Options of `grove load`.
struct LoadOptions {
  std::string url;  ///< ws://HOST:PORT/, or wss://
  int sessions = 1;
  double seconds = 10.0;
  int width = 1280;                  ///< pixels
  int height = 720;                  ///< pixels
  std::optional<std::string> codec;  ///< the only offered codec; both if not given
  bool insecure = false;             ///< accept any certificate
  bool look = false;
  bool stand = false;
  double warmUp = 0.0;  ///< seconds before the measurement
  bool lateWalk = false;
  std::string walkFile;              ///< a walk to follow; empty: a stroll
  std::optional<std::string> shape;  ///< see stream::parseLinkProfile()
  bool json = false;
};

/// Measures a running server with real websocket clients and prints the figures to stdout. Returns the exit status: 1
/// if no visitor was admitted, 2 if the address or the line's profile is invalid. Throws world::WalkError.
int runLoad(const LoadOptions& options);

}  // namespace grove::cli
