#include "cli/bench/capacity/capacity_search.h"

#include <map>

namespace grove::cli {
namespace {

constexpr int kDecides = 2;  ///< equal results of trials with the same number of visitors

class CapacitySearch {
 public:
  CapacitySearch(const ServesTrial& serves, int max) : serves_(serves), max_(max) {}

  std::optional<int> run() {
    int low = 0;
    int high = 1;
    const auto isServed = [&](int visitors) { return trial(visitors); };
    while (high <= max_ && isServed(high)) {
      low = high;
      high *= 2;
    }
    while (!stopped_ && high - low > 1) {
      const int middle = (low + high) / 2;
      (isServed(middle) ? low : high) = middle;
    }
    return confirmed(low);
  }

 private:
  struct Results {
    int served = 0;
    int missed = 0;
  };

  bool trial(int visitors) {
    if (visitors > max_ || stopped_) return false;
    const std::optional<bool> served = serves_(visitors);
    stopped_ = !served;
    if (stopped_) return false;
    ++(*served ? results_[visitors].served : results_[visitors].missed);
    return *served;
  }

  bool isCertain(int visitors) {
    if (visitors == 0) return true;
    if (visitors > max_) return false;
    const Results& results = results_[visitors];
    while (!stopped_ && results.served < kDecides && results.missed < kDecides) (void)trial(visitors);
    return results.served >= kDecides;
  }

  std::optional<int> confirmed(int capacity) {
    while (!stopped_ && !isCertain(capacity)) --capacity;
    while (!stopped_ && isCertain(capacity + 1)) ++capacity;
    return stopped_ ? std::nullopt : std::optional(capacity);
  }

  const ServesTrial& serves_;
  const int max_;
  bool stopped_ = false;
  std::map<int, Results> results_;
};

}  // namespace

std::optional<int> findCapacity(const ServesTrial& serves, int max) { return CapacitySearch(serves, max).run(); }

}  // namespace grove::cli
