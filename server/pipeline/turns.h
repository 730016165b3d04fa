#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <utility>

namespace grove::pipeline {

/// Values in lines. pop_front() serves the lines in turn, so that a long line does not delay the others; each line is
/// first-in-first-out. lineOf(value), beside the type, returns the number of a value's line. One thread at a time.
template <class T>
class Turns {
 public:
  /// Lines that can be full in a queue: a full line leaves room for others.
  static constexpr std::size_t kFullLines = 2;

  /// Whether the line of a value has room, in a queue of this capacity.
  [[nodiscard]] bool admits(const T& value, std::size_t capacity) const {
    const auto line = lines_.find(lineOf(value));
    return line == lines_.end() || kFullLines * line->second.size() < capacity;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }

  void push_back(T value) {
    lines_[lineOf(value)].push_back(std::move(value));
    ++size_;
  }
  [[nodiscard]] T& front() { return next()->second.front(); }
  void pop_front() {
    const auto line = next();
    last_ = line->first;
    line->second.pop_front();
    if (line->second.empty()) lines_.erase(line);
    --size_;
  }
  void swap(Turns& other) noexcept {
    lines_.swap(other.lines_);
    std::swap(size_, other.size_);
  }

 private:
  using Lines = std::map<std::uint64_t, std::deque<T>>;
  [[nodiscard]] typename Lines::iterator next() {
    const auto line = lines_.upper_bound(last_);
    return line == lines_.end() ? lines_.begin() : line;
  }

  Lines lines_;  ///< none is empty
  std::size_t size_ = 0;
  std::uint64_t last_ = 0;  ///< the line that was served last
};

}  // namespace grove::pipeline
