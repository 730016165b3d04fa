#pragma once

#include <optional>
#include <string>

namespace grove::cli {

/// Options of `grove bench lightfield`.
struct BenchLightfieldOptions {
  int size = 512;                   ///< pixels per edge of a picture
  int requests = 300;               ///< measured, in each of three repeats
  int threads = 0;                  ///< 0: one per core
  std::optional<std::string> file;  ///< light field; default: a small oak, baked into a temporary file
  bool json = false;
};

/// Renders pictures of one light field from random eyes around it, without a cache, and prints the rate of all threads
/// and the quality against the field's held-out views, with and without depth correction. Returns the process's exit
/// code. Throws LightFieldError and EnvironmentError.
int runBenchLightfield(const BenchLightfieldOptions& options);

}  // namespace grove::cli
