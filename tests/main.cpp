#include <gmock/gmock.h>

#include "base/simd/target.h"

/// Tests run as the target that GROVE_SIMD names, as Grove itself does.
int main(int argc, char** argv) {
  testing::InitGoogleMock(&argc, argv);
  grove::simd::chooseTarget();
  return RUN_ALL_TESTS();
}
