#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "pipeline/timeline.h"

namespace grove::pipeline {

/// The purpose of memory: the paper's m_i, m_b and m_f (section 5.3.1).
struct MemoryKey {
  std::string holder;
  std::string subject;
  friend auto operator<=>(const MemoryKey&, const MemoryKey&) = default;  // NOLINT(modernize-use-nullptr): its own 0
};

struct MemoryTotal {
  Work work = Work::kAcrossUser;
  std::int64_t bytes = 0;
};

/// Sums of allocated bytes, by holder and by the type of object that they serve. Holders report by HeldMemory, where
/// they allocate. Any thread.
class MemoryLedger {
 public:
  /// `holder` is a string literal; `subject` outlives the ledger, empty: no type of object.
  void add(const char* holder, std::string_view subject, Work work, std::int64_t bytes);

  [[nodiscard]] std::map<MemoryKey, MemoryTotal> totals() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::pair<std::string_view, std::string_view>, MemoryTotal> totals_;
};

/// Entry of one holder in a ledger, removed by its destructor. The ledger outlives it. One thread at a time.
class HeldMemory {
 public:
  HeldMemory(MemoryLedger& ledger, const char* holder, std::string_view subject, Work work, std::size_t bytes = 0);
  ~HeldMemory();
  HeldMemory(const HeldMemory&) = delete;
  HeldMemory& operator=(const HeldMemory&) = delete;

  /// Sets the current size.
  void set(std::size_t bytes);

 private:
  MemoryLedger& ledger_;
  const char* const holder_;
  const std::string_view subject_;
  const Work work_;
  std::int64_t bytes_ = 0;
};

}  // namespace grove::pipeline
