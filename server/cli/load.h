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
  std::optional<std::string> codec;  ///< the only one that is offered; both if not given
  bool insecure = false;             ///< take any certificate
  bool look = false;
  bool stand = false;
  std::string walkFile;              ///< a walk to follow; empty: a stroll
  std::optional<std::string> shape;  ///< see stream::parseLinkProfile()
  bool json = false;
};

/// Measures a running server with real websocket clients and prints the figures to stdout. Returns the exit status: 1
/// if nobody was let in, 2 if the address or the line's profile is wrong. Throws world::WalkError.
int runLoad(const LoadOptions& options);

}  // namespace grove::cli
