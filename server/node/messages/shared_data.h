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
#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"

namespace grove::node {

/// Bytes that are no packed data of the type that was asked to unpack them, or that are damaged.
class PackingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

using PackedBytes = std::vector<std::byte>;

/// What serves every visitor: a panorama, maps, a light field's picture for a view cell, a tick's snapshot. Immutable
/// once shared. A type derives its own from this; in one process they travel by reference.
class SharedData {
 public:
  /// `cadence` is how many versions a second a clock makes, whoever looks; 0: they are made because somebody does.
  explicit SharedData(Version version = 0, double cadence = 0.0) : version_(version), cadence_(cadence) {}
  virtual ~SharedData() = default;
  SharedData(const SharedData&) = delete;
  SharedData& operator=(const SharedData&) = delete;

  /// The data as bytes, which the frontend half of the object's type unpacks: packed once, by the first call, whoever
  /// asks and however often. That is across-user work, and goes into the caller's timeline as a run of its own for
  /// `subject`, which outlives the timeline. Any thread.
  [[nodiscard]] std::shared_ptr<const PackedBytes> packed(pipeline::Timeline& timeline, std::string_view subject) const;

  [[nodiscard]] Version version() const noexcept { return version_; }
  /// Whether a clock changes it.
  [[nodiscard]] bool isClocked() const noexcept { return cadence_ > 0.0; }

  /// Reports its memory as long as it lives, once, whoever shares it: by who made it, before it is shared. The ledger
  /// outlives the data.
  void holdIn(pipeline::MemoryLedger& memory, const char* holder, std::string_view subject, pipeline::Work work);

  /// Memory that it takes, the packed form included.
  [[nodiscard]] std::size_t bytes() const noexcept { return ownBytes() + packedBytes_.load(std::memory_order_relaxed); }

 private:
  /// Memory of the data itself.
  [[nodiscard]] virtual std::size_t ownBytes() const noexcept = 0;
  [[nodiscard]] virtual PackedBytes pack() const = 0;

  const Version version_;
  const double cadence_;
  mutable std::optional<pipeline::HeldMemory> held_;
  mutable std::once_flag once_;
  mutable std::atomic<std::size_t> packedBytes_{0};
  mutable std::shared_ptr<const PackedBytes> packed_;
};

}  // namespace grove::node
