#include "measure/linear_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

namespace grove::measure {
namespace {

using Points = std::vector<std::pair<double, double>>;

TEST(StudentQuantile, MatchesTables) {
  EXPECT_NEAR(studentQuantile(0.95, 1), 12.7062, 5e-5);
  EXPECT_NEAR(studentQuantile(0.95, 2), 4.30265, 5e-6);
  EXPECT_NEAR(studentQuantile(0.95, 3), 3.18245, 5e-6);
  EXPECT_NEAR(studentQuantile(0.95, 4), 2.77645, 5e-6);
  EXPECT_NEAR(studentQuantile(0.95, 10), 2.22814, 5e-6);
  EXPECT_NEAR(studentQuantile(0.95, 30), 2.04227, 5e-6);
  EXPECT_NEAR(studentQuantile(0.95, 100000), 1.95996, 5e-5);
  EXPECT_NEAR(studentQuantile(0.90, 5), 2.01505, 5e-6);
  EXPECT_NEAR(studentQuantile(0.99, 7), 3.49948, 5e-6);
}

TEST(LinearFit, FindsALineExactly) {
  const auto fit = linearFit(Points{{1.0, 2.5}, {2.0, 3.0}, {4.0, 4.0}, {8.0, 6.0}});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->a.value, 2.0, 1e-12);
  EXPECT_NEAR(fit->b.value, 0.5, 1e-12);
  EXPECT_NEAR(fit->b.high - fit->b.low, 0.0, 1e-9);
  EXPECT_NEAR(fit->rSquared, 1.0, 1e-12);
  EXPECT_NEAR(fit->residual, 0.0, 1e-9);
  EXPECT_NEAR(fit->at(10.0), 7.0, 1e-12);
}

/// Anscombe's first set (1973): y = 3.0001 + 0.50009 x, standard errors 1.1247 and 0.1179, r^2 0.6665, residual 1.2366.
TEST(LinearFit, GivesTheErrorsOfAnscombesFirstSet) {
  const auto fit = linearFit(Points{{10, 8.04},
                                    {8, 6.95},
                                    {13, 7.58},
                                    {9, 8.81},
                                    {11, 8.33},
                                    {14, 9.96},
                                    {6, 7.24},
                                    {4, 4.26},
                                    {12, 10.84},
                                    {7, 4.82},
                                    {5, 5.68}});
  ASSERT_TRUE(fit);
  const double t = 2.262157;  // 95 %, 9 degrees of freedom
  EXPECT_NEAR(fit->a.value, 3.00009, 1e-4);
  EXPECT_NEAR(fit->b.value, 0.50009, 1e-4);
  EXPECT_NEAR(fit->a.high - fit->a.value, t * 1.1247, 1e-3);
  EXPECT_NEAR(fit->b.value - fit->b.low, t * 0.1179, 1e-3);
  EXPECT_NEAR(fit->rSquared, 0.66654, 1e-4);
  EXPECT_NEAR(fit->residual, 1.2366, 1e-4);
}

TEST(LinearFit, TwoPointsHaveNoError) {
  const auto fit = linearFit(Points{{1.0, 1.0}, {3.0, 5.0}});
  ASSERT_TRUE(fit);
  EXPECT_DOUBLE_EQ(fit->a.value, -1.0);
  EXPECT_DOUBLE_EQ(fit->b.value, 2.0);
  EXPECT_TRUE(std::isinf(fit->b.high));
  EXPECT_TRUE(std::isinf(fit->a.low));
}

TEST(LinearFit, NeedsTwoDifferentX) {
  EXPECT_FALSE(linearFit(Points{}));
  EXPECT_FALSE(linearFit(Points{{1.0, 1.0}}));
  EXPECT_FALSE(linearFit(Points{{0.1, 1.0}, {0.1, 2.0}, {0.1, 3.0}}));
}

TEST(LinearFit, ConstantData) {
  const auto fit = linearFit(Points{{1.0, 4.0}, {2.0, 4.0}, {3.0, 4.0}});
  ASSERT_TRUE(fit);
  EXPECT_DOUBLE_EQ(fit->b.value, 0.0);
  EXPECT_DOUBLE_EQ(fit->rSquared, 1.0);
}

}  // namespace
}  // namespace grove::measure
