#pragma once

#include <string>

namespace grove::cli {

struct Outcome {
  int exit = -1;
  std::string output;  ///< stdout, or stderr where asked for
};

/// Runs the real program.
Outcome grove(const std::string& arguments, bool wantErrors = true);

/// What the real program does, in a fork of this one: for the many command lines that end once they are read, where
/// starting it, which loads LLVM for OSMesa, takes longer than all that it does.
Outcome groveHere(const std::string& arguments, bool wantErrors = true);

/// Runs a command of bash; its stdout.
Outcome shell(const std::string& script);

/// Runs it and interrupts it (SIGINT) after so many seconds; its stdout.
Outcome groveStoppedAfter(double seconds, const std::string& arguments);

}  // namespace grove::cli
