#include "base/simd/target.h"

#include <gmock/gmock.h>
#include <stdlib.h>

#include "base/error.h"
#include "each_target.h"

namespace grove::simd {
namespace {

/// GROVE_SIMD set for a while.
class Wanted {
 public:
  explicit Wanted(const char* name) { setenv("GROVE_SIMD", name, 1); }
  ~Wanted() {
    unsetenv("GROVE_SIMD");
    if (had_) setenv("GROVE_SIMD", before_.c_str(), 1);
    chooseTarget();
  }
  Wanted(const Wanted&) = delete;
  Wanted& operator=(const Wanted&) = delete;

 private:
  bool had_ = getenv("GROVE_SIMD") != nullptr;
  std::string before_ = had_ ? getenv("GROVE_SIMD") : "";
};

/// Fails if kernels run as another target than the one that was chosen.
TEST(Target, KernelsUseTheCurrentTarget) {
  std::vector<Target> used;
  tests::onEachTarget([&] { used.push_back(currentTarget()); });
  EXPECT_EQ(used, availableTargets());
}

/// Fails if the variable is not heeded.
TEST(Target, EnvironmentForcesALowerOne) {
  const Target lowest = availableTargets().back();
  const Wanted wanted(nameOf(lowest).c_str());
  chooseTarget();
  EXPECT_EQ(currentTarget(), lowest);
}

/// Fails if a name that is none runs silently as something else.
TEST(Target, ListsTargets) {
  const Target before = currentTarget();
  const Wanted wanted("avx9");
  try {
    chooseTarget();
    FAIL() << "accepted";
  } catch (const EnvironmentError& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("avx9"));
    EXPECT_THAT(e.what(), testing::HasSubstr(nameOf(availableTargets().back())));
  }
  EXPECT_EQ(currentTarget(), before);
}

}  // namespace
}  // namespace grove::simd
