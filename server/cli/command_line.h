#pragma once

namespace grove::cli {

/// Parses the command line, runs the sub-command and returns the process's exit code: 0, 1 for a failure, 2 for bad
/// options; both come with one line on stderr.
int run(int argc, char** argv);

}  // namespace grove::cli
