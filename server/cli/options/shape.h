#pragma once

#include <string>

namespace grove::cli {

/// Options of `grove shape`.
struct ShapeOptions {
  std::string profile;                    ///< see stream::parseLinkProfile()
  std::string listen = "127.0.0.1:8090";  ///< HOST:PORT
  std::string target;                     ///< HOST:PORT
};

/// Forwards connections to another address over a bad line, until interrupted. Returns the exit status: 2 if the
/// profile or an address is invalid.
int runShape(const ShapeOptions& options);

}  // namespace grove::cli
