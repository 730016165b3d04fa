#pragma once

/// Stands ahead of a loop whose iterations depend on none before them, which the compiler cannot see for itself: what
/// they write overlaps nothing that later ones read.
#if defined(__clang__)
#define GROVE_INDEPENDENT_ITERATIONS _Pragma("clang loop vectorize(assume_safety)")
#else
#define GROVE_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#endif
