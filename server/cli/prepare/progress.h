#pragma once

#include <mutex>
#include <set>
#include <string>
#include <string_view>

namespace grove::cli {

/// Shows slow preparation on stderr: a bar that moves on a terminal, one line per label elsewhere. Any thread.
class Progress {
 public:
  Progress();
  /// Shows the note behind the bar, on a terminal only.
  void show(std::string_view label, float share, std::string_view note = {});
  void finish();

 private:
  const bool terminal_;
  std::mutex mutex_;
  std::string label_;
  int percent_ = -1;
  std::set<std::string> announced_;
};

}  // namespace grove::cli
