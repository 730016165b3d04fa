#pragma once

namespace grove::cli {

/// Prints the score of this machine (`grove bench machine`), by which figures of different processors compare. Returns
/// the process's exit code.
int runBenchMachine(bool json);

}  // namespace grove::cli
