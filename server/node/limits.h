#pragma once

#include <cstddef>

/// The bounds of the queues of Figure 4.2.
namespace grove::node {

/// Only the nearest objects are drawn, at most this many.
inline constexpr std::size_t kMaxObjectsPerFrame = 1024;

/// Requests or results of all sessions that wait at one stage of a backend node.
inline constexpr std::size_t kBackendQueue = 4096;

/// Requests per run of a backend stage.
inline constexpr std::size_t kBackendBatch = 64;

inline constexpr int kMaxFramesInFlight = 8;

/// Seconds for which a backdrop serves at most. Frames that extend it make requests for its view.
inline constexpr double kMaxBackdropAge = 3.0;

/// Only the nearest names are shown, at most this many.
inline constexpr std::size_t kMaxLabelsPerFrame = 24;

/// Only the motion of the nearest objects is reported, of at most this many.
inline constexpr std::size_t kMaxMoversPerFrame = 16;

/// Versions of subscribed data that a backend node sends before the first of them is acknowledged.
inline constexpr std::size_t kMaxUnacknowledged = 8;

/// Versions that a frontend process acknowledges at once.
inline constexpr std::size_t kAcknowledgedAtOnce = 4;
static_assert(kAcknowledgedAtOnce < kMaxUnacknowledged, "otherwise node and frontend process wait for each other");

/// The finest step of across-user quality.
inline constexpr int kMaxQuality = 2;

}  // namespace grove::node
