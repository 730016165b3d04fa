#pragma once

#include <stdexcept>
#include <string>

namespace grove {

/// A failure of the environment: what failed, where, and how to fix it. Programming mistakes assert instead, and an
/// expected failure is a return value.
class EnvironmentError : public std::runtime_error {
 public:
  EnvironmentError(const std::string& what, const std::string& where, const std::string& mend)
      : std::runtime_error(where + ": " + what + (mend.empty() ? "" : " (" + mend + ")")) {}
};

}  // namespace grove
