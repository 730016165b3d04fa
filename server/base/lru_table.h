#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <optional>
#include <utility>

namespace grove {

/// Values by key in the order of their last use. Has no limit of its own: its owner removes the oldest. One thread at a
/// time.
template <class Key, class Value>
class LruTable {
 public:
  struct Entry {
    Key key;
    Value value;
  };

  /// Returns a value and makes it the most recently used; null if it is missing.
  [[nodiscard]] Value* use(const Key& key) {
    const auto place = places_.find(key);
    if (place == places_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, place->second);
    return &place->second->value;
  }

  /// Returns a value without using it; null if it is missing.
  [[nodiscard]] Value* find(const Key& key) {
    const auto place = places_.find(key);
    return place == places_.end() ? nullptr : &place->second->value;
  }

  [[nodiscard]] const Value* find(const Key& key) const {
    const auto place = places_.find(key);
    return place == places_.end() ? nullptr : &place->second->value;
  }

  /// Inserts a value as the most recently used, and returns the previous one.
  std::optional<Value> put(const Key& key, Value value) {
    if (Value* const known = use(key)) return std::exchange(*known, std::move(value));
    entries_.push_front({key, std::move(value)});
    places_.emplace(key, entries_.begin());
    return std::nullopt;
  }

  std::optional<Value> take(const Key& key) {
    const auto place = places_.find(key);
    if (place == places_.end()) return std::nullopt;
    Value value = std::move(place->second->value);
    entries_.erase(place->second);
    places_.erase(place);
    return value;
  }

  /// Removes the least recently used. There must be one.
  Entry takeOldest() {
    Entry oldest = std::move(entries_.back());
    places_.erase(oldest.key);
    entries_.pop_back();
    return oldest;
  }

  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }
  [[nodiscard]] bool empty() const noexcept { return entries_.empty(); }
  /// Most recently used first.
  [[nodiscard]] const std::list<Entry>& entries() const noexcept { return entries_; }

 private:
  std::list<Entry> entries_;
  std::map<Key, typename std::list<Entry>::iterator> places_;
};

}  // namespace grove
