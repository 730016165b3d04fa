#pragma once

#include <barrier>
#include <functional>
#include <thread>
#include <vector>

namespace grove::objects::fluid {

/// Threads that share the work on one grid: each takes a slab of z-planes. The results do not depend on their number.
/// Idle threads sleep. Used by one thread, which does a part itself; a team of one has no threads.
class Team {
 public:
  explicit Team(int width);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  [[nodiscard]] int width() const noexcept { return width_; }

  /// Calls work(0) to work(width - 1) in parallel and waits for all. They must not throw.
  void run(const std::function<void(int)>& work);

 private:
  void serve(int part);
  void stop() noexcept;

  const int width_;
  const std::function<void(int)>* work_ = nullptr;  ///< null: stop
  std::barrier<> begin_;
  std::barrier<> end_;
  std::vector<std::thread> threads_;
};

/// Planes from `first` to before `end`, both even.
struct Slab {
  int first = 0;
  int end = 0;

  /// One of `parts` slabs of about equal size.
  [[nodiscard]] static Slab of(int part, int parts, int cells) noexcept {
    const int pairs = cells / 2;
    return {2 * (pairs * part / parts), 2 * (pairs * (part + 1) / parts)};
  }
};

}  // namespace grove::objects::fluid
