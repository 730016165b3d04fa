#pragma once

/// Goes before a loop without dependencies between its iterations, if the compiler cannot prove that: writes of an
/// iteration overlap no reads of later ones.
#if defined(__clang__)
#define GROVE_INDEPENDENT_ITERATIONS _Pragma("clang loop vectorize(assume_safety)")
#else
#define GROVE_INDEPENDENT_ITERATIONS _Pragma("GCC ivdep")
#endif
