#include "pipeline/memory_ledger.h"

namespace grove::pipeline {

void MemoryLedger::add(const char* holder, std::string_view subject, Work work, std::int64_t bytes) {
  const std::lock_guard lock(mutex_);
  MemoryTotal& total = totals_[{holder, subject}];
  total.work = work;
  total.bytes += bytes;
}

std::map<MemoryKey, MemoryTotal> MemoryLedger::totals() const {
  const std::lock_guard lock(mutex_);
  std::map<MemoryKey, MemoryTotal> totals;
  for (const auto& [key, total] : totals_) {
    totals.emplace(MemoryKey{std::string(key.first), std::string(key.second)}, total);
  }
  return totals;
}

HeldMemory::HeldMemory(MemoryLedger& ledger, const char* holder, std::string_view subject, Work work, std::size_t bytes)
    : ledger_(ledger), holder_(holder), subject_(subject), work_(work) {
  set(bytes);
}

HeldMemory::~HeldMemory() { set(0); }

void HeldMemory::set(std::size_t bytes) {
  const auto now = static_cast<std::int64_t>(bytes);
  if (now == bytes_) return;
  ledger_.add(holder_, subject_, work_, now - bytes_);
  bytes_ = now;
}

}  // namespace grove::pipeline
