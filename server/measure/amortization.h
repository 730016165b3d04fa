#pragma once

#include <map>
#include <string>

#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"

/// The paper's means of measuring amortization (sections 3.1 and 5.3).
namespace grove::measure {

/// CPU milliseconds behind one frame of one visitor, as they were used.
struct FrameCost {
  double acrossUser = 0.0;      ///< c_i: while one visitor got one frame, however many share it
  double onDemandShared = 0.0;  ///< the part of c_i that views caused: shared data that at least two visitors used
  double backend = 0.0;         ///< c_b0: on backend nodes, for this visitor, without compression
  double compressor = 0.0;      ///< what compression adds to c_b0
  double frontend = 0.0;        ///< c_f
  double onDemandOwn = 0.0;     ///< the part of c_b0 for shared data that at most one visitor used

  [[nodiscard]] double backendCompressed() const noexcept { return backend + compressor; }  ///< c_b1
  [[nodiscard]] double perUser() const noexcept { return backend + compressor + frontend; }
  [[nodiscard]] double independent() const noexcept { return acrossUser - onDemandShared; }  ///< of views
  FrameCost& operator+=(const FrameCost& more) noexcept;
};

/// The across-user share of one visitor's cost, alpha or beta: i / (i + b + f); 0 if there is no cost at all.
[[nodiscard]] double acrossUserShare(double i, double b, double f) noexcept;

[[nodiscard]] double alpha0(const FrameCost& cost) noexcept;  ///< without compression
[[nodiscard]] double alpha1(const FrameCost& cost) noexcept;  ///< with it

/// The paper's law M = N (1 - alpha) + alpha: how many visitors an architecture without sharing serves with what serves
/// `shared` visitors here.
[[nodiscard]] double privateVisitors(double shared, double alpha) noexcept;

/// What is needed to know the costs of a while from totals that only grow.
struct Reading {
  std::map<pipeline::CostKey, pipeline::StageTotal> costs;
  std::map<std::string, pipeline::Reuse> reuse;
  double seconds = 0.0;         ///< of the monotonic clock
  double processSeconds = 0.0;  ///< CPU of the whole process

  [[nodiscard]] static Reading of(const pipeline::Timeline& timeline);
};

/// Who was served between two readings.
struct Served {
  double visitors = 0.0;  ///< mean
  double frames = 0.0;    ///< of all visitors together
};

/// Costs of a frame by type of object; "" is what serves no single type (camera, encoder, transport).
///
/// Across-user work counts by what was done while a visitor got one frame; on a machine that is too slow for the
/// nominal rate, a frame has more ticks of a clock. Of work on demand, the share of its data (by bytes, which grow with
/// the texels that were computed) that at least two visitors used is across-user, the rest per-user. So the costs,
/// times the frames that there were, are the CPU of all stages.
[[nodiscard]] std::map<std::string, FrameCost> frameCosts(const Reading& before, const Reading& after,
                                                          const Served& served);
[[nodiscard]] FrameCost sum(const std::map<std::string, FrameCost>& costs);

/// By type of object.
[[nodiscard]] std::map<std::string, pipeline::Reuse> reuseBetween(const Reading& before, const Reading& after);
[[nodiscard]] pipeline::Reuse sum(const std::map<std::string, pipeline::Reuse>& reuse);

/// Bytes of a ledger: of what is shared, and of one visitor.
struct MemoryShare {
  double acrossUser = 0.0;       ///< m_i
  double perUserBackend = 0.0;   ///< m_b
  double perUserFrontend = 0.0;  ///< m_f
  [[nodiscard]] double beta() const noexcept { return acrossUserShare(acrossUser, perUserBackend, perUserFrontend); }
  MemoryShare& operator+=(const MemoryShare& more) noexcept;
};
/// Data that was made on demand lies in stores with one bound for all visitors, so its memory is across-user.
[[nodiscard]] std::map<std::string, MemoryShare> memoryShares(const pipeline::MemoryLedger& ledger, int visitors);
[[nodiscard]] MemoryShare sum(const std::map<std::string, MemoryShare>& shares);

}  // namespace grove::measure
