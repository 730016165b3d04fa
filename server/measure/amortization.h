#pragma once

#include <map>
#include <string>

#include "pipeline/memory_ledger.h"
#include "pipeline/timeline.h"

/// The paper's means of measuring amortization (sections 3.1 and 5.3).
namespace grove::measure {

/// CPU milliseconds that one frame of one visitor needs.
struct FrameCost {
  double acrossUser = 0.0;  ///< c_i: in one frame's time, however many visitors share it
  double onDemand = 0.0;    ///< the part of c_i that is done because somebody looks, not by a clock
  double backend = 0.0;     ///< c_b0: on backend nodes, for this visitor, without compression
  double compressor = 0.0;  ///< what compression adds to c_b0
  double frontend = 0.0;    ///< c_f

  [[nodiscard]] double backendCompressed() const noexcept { return backend + compressor; }  ///< c_b1
  [[nodiscard]] double perUser() const noexcept { return backend + compressor + frontend; }
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
  double seconds = 0.0;         ///< of the monotonic clock
  double processSeconds = 0.0;  ///< CPU of the whole process

  [[nodiscard]] static Reading of(const pipeline::Timeline& timeline);
};

/// Who was served between two readings.
struct Served {
  double visitors = 0.0;          ///< mean
  double frames = 0.0;            ///< of all visitors together
  double framesPerSecond = 30.0;  ///< that each visitor is meant to get
};

/// Costs of a frame by type of object; "" is what serves no single type (camera, encoder, transport).
///
/// Work on a clock of its own counts by the run, as many of them as fall into a frame's time at their nominal rate;
/// other work of across-user kind by what was done while a visitor got one frame. So shared and private mode can be
/// compared even where the machine is too slow for the nominal rate.
[[nodiscard]] std::map<std::string, FrameCost> frameCosts(const Reading& before, const Reading& after,
                                                          const Served& served);
[[nodiscard]] FrameCost sum(const std::map<std::string, FrameCost>& costs);

/// Bytes of a ledger: of what is shared, and of one visitor.
struct MemoryShare {
  double acrossUser = 0.0;       ///< m_i
  double perUserBackend = 0.0;   ///< m_b
  double perUserFrontend = 0.0;  ///< m_f
  [[nodiscard]] double beta() const noexcept { return acrossUserShare(acrossUser, perUserBackend, perUserFrontend); }
  MemoryShare& operator+=(const MemoryShare& more) noexcept;
};
[[nodiscard]] std::map<std::string, MemoryShare> memoryShares(const pipeline::MemoryLedger& ledger, int visitors);
[[nodiscard]] MemoryShare sum(const std::map<std::string, MemoryShare>& shares);

}  // namespace grove::measure
