#include "cli/prepare/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "base/log.h"

namespace grove::cli {

Progress::Progress() : terminal_(isatty(STDERR_FILENO) == 1) {}

void Progress::show(std::string_view label, float share, std::string_view note) {
  constexpr int kBarWidth = 30;
  const int percent = static_cast<int>(std::clamp(share, 0.0F, 1.0F) * 100.0F);
  const std::lock_guard lock(mutex_);
  if (label == label_ && percent == percent_) return;
  label_ = label;
  percent_ = percent;
  if (!terminal_) {
    if (announced_.insert(label_).second) log::info("preparing: " + label_);
    return;
  }
  const std::string done(static_cast<std::size_t>(percent * kBarWidth / 100), '#');
  std::fprintf(stderr, "\r\033[K[%-*s] %3d %% %s%s%.*s", kBarWidth, done.c_str(), percent, label_.c_str(),
               note.empty() ? "" : ", ", static_cast<int>(note.size()), note.data());
  std::fflush(stderr);
}

void Progress::finish() {
  const std::lock_guard lock(mutex_);
  if (terminal_ && percent_ >= 0) std::fprintf(stderr, "\r\033[K");
}

}  // namespace grove::cli
