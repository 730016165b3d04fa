#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "node/messages/shared_key.h"
#include "node/messages/use_record.h"
#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"

namespace grove::node {

/// Bytes that are damaged, or no packed data of the type that should unpack them.
class PackingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using PackedBytes = std::vector<std::byte>;

/// Data for every visitor: a panorama, maps, a light field's picture for a view cell, a tick's snapshot. Immutable once
/// shared. Object types derive their own data from this; within one process, data travels by reference.
class SharedData {
 public:
  /// `cadence`: versions per second that a clock makes; 0 if versions are made on demand.
  explicit SharedData(Version version = 0, double cadence = 0.0) : version_(version), cadence_(cadence) {}
  virtual ~SharedData() = default;
  SharedData(const SharedData&) = delete;
  SharedData& operator=(const SharedData&) = delete;

  /// Returns the data as bytes, which the frontend half of the object's type unpacks. Packs once, in the first call.
  /// That is across-user work, once for all processes: the caller's timeline gets a run for `subject`, which outlives
  /// the timeline. Any thread.
  [[nodiscard]] std::shared_ptr<const PackedBytes> packed(pipeline::Timeline& timeline, std::string_view subject) const;

  [[nodiscard]] Version version() const noexcept { return version_; }
  /// Whether a clock changes it.
  [[nodiscard]] bool isClocked() const noexcept { return cadence_ > 0.0; }

  /// Reports its memory during its life. Called once, by its maker, before it is shared. The ledger outlives the data.
  void holdIn(pipeline::MemoryLedger& memory, const char* holder, std::string_view subject, pipeline::Work work);

  /// Counts from begin() on, which the frontend process calls when the data arrives; so in each process on its own.
  [[nodiscard]] UseRecord& uses() const noexcept { return uses_; }

  /// Memory that it takes, the packed form included.
  [[nodiscard]] std::size_t bytes() const noexcept { return ownBytes() + packedBytes_.load(std::memory_order_relaxed); }

 private:
  /// Memory of the data itself.
  [[nodiscard]] virtual std::size_t ownBytes() const noexcept = 0;
  [[nodiscard]] virtual PackedBytes pack() const = 0;

  const Version version_;
  const double cadence_;
  mutable UseRecord uses_;
  mutable std::optional<pipeline::HeldMemory> held_;
  mutable std::once_flag once_;
  mutable std::atomic<std::size_t> packedBytes_{0};
  mutable std::shared_ptr<const PackedBytes> packed_;
};

}  // namespace grove::node
