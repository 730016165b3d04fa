#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "pipeline/timeline.h"

namespace grove::node {

/// Simulation data as bytes, for a wire between machines. Immutable once shared.
struct PackedData {
  std::string_view type;  ///< name of the object type that unpacks it; outlives the data
  std::vector<std::byte> bytes;
};

/// Bytes that are no packed data of the type that was asked to unpack them, or that are damaged.
class PackingError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A simulation node's answer: immutable, shared by all visitors. A type derives its snapshot from this.
class SimulationData {
 public:
  SimulationData() = default;
  virtual ~SimulationData() = default;
  SimulationData(const SimulationData&) = delete;
  SimulationData& operator=(const SimulationData&) = delete;

  /// The data as bytes: packed once, by the first call, whoever asks and however often; that is across-user work, and
  /// goes into the caller's timeline as a run of its own. Null if this data travels by reference only. Any thread.
  [[nodiscard]] std::shared_ptr<const PackedData> packed(pipeline::Timeline& timeline) const;

  /// Memory of the packed form; 0 until somebody asked for it. Any thread.
  [[nodiscard]] std::size_t packedBytes() const noexcept { return packedBytes_.load(std::memory_order_relaxed); }

 private:
  /// Name of the object type whose unpack() takes pack()'s bytes; empty if there is no such form.
  [[nodiscard]] virtual std::string_view packedType() const { return {}; }
  [[nodiscard]] virtual std::vector<std::byte> pack() const { return {}; }

  mutable std::once_flag once_;
  mutable std::atomic<std::size_t> packedBytes_{0};
  mutable std::shared_ptr<const PackedData> packed_;
};

}  // namespace grove::node
