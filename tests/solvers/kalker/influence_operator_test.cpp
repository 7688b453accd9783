// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/influence_operator.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include "operator_fields.hpp"
#include "point_solutions.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"

namespace treadmark::kalker {
namespace {

using testing::Box;
using testing::by_operator;
using testing::Fields;
using testing::kDx;
using testing::kDy;
using testing::kShearModulus;
using testing::random_tractions;

/// No two coefficients alike and no symmetry; counts its calls.
class LopsidedKernel final : public InfluenceKernel {
 public:
  InfluenceBlock at(double X, double Y) const override {
    ++calls;
    InfluenceBlock block;
    double index = 1.0;
    for (const auto& [name, c] : kAllCoefficients) {
      block.*c = kDx / (index + std::abs(X / kDx - 0.1 * index) + 2.0 * std::abs(Y / kDy + 0.2 * index));
      index += 1.0;
    }
    return block;
  }
  bool symmetric() const override { return false; }
  bool coupled() const override { return true; }
  mutable std::atomic<int> calls = 0;
};

/// The same coefficients as another kernel, but nothing is known of their symmetry.
class WithoutSymmetry final : public InfluenceKernel {
 public:
  explicit WithoutSymmetry(std::shared_ptr<const InfluenceKernel> kernel) : kernel_(std::move(kernel)) {}
  InfluenceBlock at(double X, double Y) const override { return kernel_->at(X, Y); }
  bool symmetric() const override { return false; }
  bool coupled() const override { return kernel_->coupled(); }

 private:
  std::shared_ptr<const InfluenceKernel> kernel_;
};

Fields direct_sum(const Box& c, const InfluenceKernel& kernel, const Fields& p) {
  return testing::direct_sum(p, kShearModulus, [&](int i, int j) {
    return kernel.at((i % c.nx - j % c.nx) * kDx + c.shift_x, (i / c.nx - j / c.nx) * kDy + c.shift_y);
  });
}

void expect_near(const Fields& found, const Fields& expected) {
  constexpr double kRounding = 1e-18;  // [m], of displacements of some micrometres
  for (std::size_t i = 0; i < found.x.size(); ++i) {
    ASSERT_NEAR(found.x[i], expected.x[i], kRounding) << i;
    ASSERT_NEAR(found.y[i], expected.y[i], kRounding) << i;
    ASSERT_NEAR(found.n[i], expected.n[i], kRounding) << i;
  }
}

class InfluenceOperators : public ::testing::TestWithParam<Box> {};

TEST_P(InfluenceOperators, EqualTheDirectSum) {
  const Box c = GetParam();
  const auto half_spaces = std::make_shared<ConstantElements>(kDx, kDy, 0.28, 0.1);
  const auto p = random_tractions(static_cast<std::size_t>(c.nx * c.ny));
  for (const std::shared_ptr<const InfluenceKernel>& kernel :
       {std::shared_ptr<const InfluenceKernel>(half_spaces),
        std::shared_ptr<const InfluenceKernel>(std::make_shared<LopsidedKernel>())}) {
    InfluenceOperator op(c.nx, c.ny, kDx, kDy, kShearModulus, kernel, c.shift_x, c.shift_y);
    expect_near(by_operator(op, p), direct_sum(c, *kernel, p));
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, InfluenceOperators,
                         ::testing::Values(Box{1, 1}, Box{7, 1}, Box{1, 5, 0.1e-3, 0.0}, Box{13, 8},
                                           Box{13, 8, kDx, 0.0}, Box{8, 13, 0.13e-3, -0.4e-3}, Box{9, 9, 0.0, 0.2e-3},
                                           Box{17, 1, -0.5e-3, 0.4e-3}));

TEST(InfluenceOperator, SymmetryChangesNoCoefficient) {
  const auto kernel = std::make_shared<ConstantElements>(kDx, kDy, 0.28, 0.1);
  for (const auto& [shift_x, shift_y] : {std::pair{0.0, 0.0}, {0.3e-3, 0.0}, {0.0, -0.2e-3}}) {
    InfluenceOperator folded(6, 5, kDx, kDy, kShearModulus, kernel, shift_x, shift_y);
    InfluenceOperator plain(6, 5, kDx, kDy, kShearModulus, std::make_shared<WithoutSymmetry>(kernel), shift_x, shift_y);
    for (int diy = -4; diy <= 4; ++diy)
      for (int dix = -5; dix <= 5; ++dix)
        for (const auto& [name, c] : kAllCoefficients)
          EXPECT_DOUBLE_EQ(folded.at(dix, diy).*c, plain.at(dix, diy).*c) << name << ' ' << dix << ' ' << diy;
  }
}

TEST(InfluenceOperator, EvaluatesCoefficientsOnceAndWhenNeeded) {
  const auto kernel = std::make_shared<LopsidedKernel>();
  InfluenceOperator op(4, 3, kDx, kDy, kShearModulus, kernel);
  EXPECT_EQ(kernel->calls, 0);
  const auto p = random_tractions(12);
  by_operator(op, p);
  by_operator(op, p);
  EXPECT_EQ(kernel->calls, 7 * 5);
}

TEST(InfluenceOperator, ResultsMayReplaceTheTractions) {
  InfluenceOperator op(5, 4, kDx, kDy, kShearModulus, std::make_shared<LopsidedKernel>());
  Fields p = random_tractions(20);
  std::vector<double> ux(20), uy(20);
  op.tangential_by_tangential(p.x, p.y, ux, uy);
  op.tangential_by_tangential(p.x, p.y, p.x, p.y);
  EXPECT_EQ(p.x, ux);
  EXPECT_EQ(p.y, uy);
}

TEST(InfluenceOperator, UncoupledBodiesGiveExactZeros) {
  InfluenceOperator op(5, 4, kDx, kDy, kShearModulus, std::make_shared<ConstantElements>(kDx, kDy, 0.28, 0.0));
  const Fields p = random_tractions(20);
  std::vector<double> ux(20, 1.0), uy(20, 1.0), un(20, 1.0);
  op.tangential_by_normal(p.n, ux, uy);
  op.normal_by_tangential(p.x, p.y, un);
  for (const auto* u : {&ux, &uy, &un}) EXPECT_EQ(*u, std::vector<double>(20, 0.0));
}

TEST(InfluenceOperator, RefusesWhatDoesNotFit) {
  const auto kernel = std::make_shared<ConstantElements>(kDx, kDy, 0.28, 0.0);
  EXPECT_THROW(InfluenceOperator(2, 2, kDx, kDy, 0.0, kernel), Error);
  EXPECT_THROW(InfluenceOperator(2, 2, kDx, kDy, kShearModulus, nullptr), Error);
  EXPECT_THROW(InfluenceOperator(0, 2, kDx, kDy, kShearModulus, kernel), Error);
  InfluenceOperator op(2, 2, kDx, kDy, kShearModulus, kernel);
  std::vector<double> four(4), three(3);
  EXPECT_THROW(op.normal_by_normal(three, four), Error);
  EXPECT_THROW(op.tangential_by_normal(four, four, three), Error);
  EXPECT_THROW(op.normal_by_tangential(four, three, four), Error);
  EXPECT_THROW(op.at(2, 0), Error);
}

}  // namespace
}  // namespace treadmark::kalker
