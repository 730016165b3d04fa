#pragma once

#include <optional>
#include <string>

namespace grove::cli {

/// `grove bench lightfield`.
struct BenchLightfieldOptions {
  int size = 512;                   ///< pixels an edge of a picture
  int requests = 300;               ///< measured, in each of three repeats
  int threads = 0;                  ///< 0: one per core
  std::optional<std::string> file;  ///< light field; default: a small oak, baked into a temporary file
  bool json = false;
};

/// Renders pictures of one light field from random eyes around it, without a cache, and prints how many a second all
/// threads make and how close the field's held-out views are met, with and without depth. Returns the process's exit
/// code. Throws LightFieldError and EnvironmentError.
int runBenchLightfield(const BenchLightfieldOptions& options);

}  // namespace grove::cli
