// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>

#include "operator_fields.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/bilinear_elements.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"
#include "treadmark/solvers/kalker/halfspace/influence_operator.hpp"
#include "treadmark/solvers/kalker/halfspace/row_inclination.hpp"
#include "treadmark/tests/solvers/kalker/angle_settings.hpp"

namespace treadmark::kalker {
namespace {

using testing::Box;
using testing::by_operator;
using testing::Fields;
using testing::kCorrections;
using testing::kDx;
using testing::kDy;
using testing::kShearModulus;
using testing::random_tractions;

/// One coefficient after the other, in turned axes; the angles as they are, without order.
Fields direct_sum(const Box& c, const InfluenceKernel& kernel, const std::vector<double>& angle,
                  AngleCorrection correction, const Fields& p) {
  return testing::direct_sum(p, kShearModulus, [&](int i, int j) {
    const InfluenceBlock plane =
        kernel.at((i % c.nx - j % c.nx) * kDx + c.shift_x, (i / c.nx - j / c.nx) * kDy + c.shift_y);
    return corrected_for_angle(
        plane, angle[static_cast<std::size_t>(j / c.nx)] - angle[static_cast<std::size_t>(i / c.nx)], correction);
  });
}

void expect_equal_products(const Fields& found, const Fields& expected) {
  double largest = 0.0;
  for (const auto* field : {&expected.x, &expected.y, &expected.n})
    for (const double u : *field) largest = std::max(largest, std::abs(u));
  const double rounding = 2e-14 * largest;
  for (std::size_t i = 0; i < found.x.size(); ++i) {
    ASSERT_NEAR(found.x[i], expected.x[i], rounding) << i;
    ASSERT_NEAR(found.y[i], expected.y[i], rounding) << i;
    ASSERT_NEAR(found.n[i], expected.n[i], rounding) << i;
  }
}

std::vector<double> uneven_angles(int rows) {
  std::vector<double> angle;
  for (int i = 0; i < rows; ++i) angle.push_back(0.3 + 0.9 * std::sin(1.7 * i) + 0.05 * i);
  return angle;
}

class TurnedProducts : public ::testing::TestWithParam<Box> {};

TEST_P(TurnedProducts, EqualTheDirectSum) {
  const Box c = GetParam();
  const auto kernel = std::make_shared<ConstantElements>(kDx, kDy, 0.28, c.difference);
  const Fields p = random_tractions(static_cast<std::size_t>(c.nx * c.ny));
  const std::vector<double> angle = uneven_angles(c.ny);
  InfluenceOperator op(c.nx, c.ny, kDx, kDy, kShearModulus, kernel, c.shift_x, c.shift_y);
  for (const AngleCorrection correction : kCorrections) {
    const RowInclination rows(angle, correction);
    expect_equal_products(by_operator(op, p, &rows), direct_sum(c, *kernel, angle, correction, p));
  }
}

INSTANTIATE_TEST_SUITE_P(Boxes, TurnedProducts,
                         ::testing::Values(Box{1, 1}, Box{7, 1}, Box{1, 6}, Box{13, 8}, Box{13, 8, 0.0, 0.0, 0.0},
                                           Box{9, 11, kDx, 0.0}, Box{8, 13, 0.13e-3, -0.4e-3},
                                           Box{8, 13, 0.13e-3, 0.0, 0.0}));

TEST(TurnedProduct, OnAStraightLineCoefficientsDependOnTheOffsetOnly) {
  const int nx = 11, ny = 9;
  const auto plane = std::make_shared<BilinearElements>(kDx, kDy, 0.3, -0.07);
  const Fields p = random_tractions(static_cast<std::size_t>(nx * ny));
  const double curvature = 120.0;
  std::vector<double> angle;
  for (int i = 0; i < ny; ++i) angle.push_back(-0.2 + curvature * i * kDy);
  for (const AngleCorrection correction : kCorrections) {
    InfluenceOperator turned(nx, ny, kDx, kDy, kShearModulus, plane);
    InfluenceOperator linear(nx, ny, kDx, kDy, kShearModulus,
                             std::make_shared<AngleCorrectedKernel>(plane, curvature, correction));
    const RowInclination rows(angle, correction);
    expect_equal_products(by_operator(turned, p, &rows), by_operator(linear, p, nullptr));
  }
}

TEST(TurnedProduct, RowsOfOneInclinationAreAPlane) {
  const int nx = 10, ny = 7;
  InfluenceOperator op(nx, ny, kDx, kDy, kShearModulus, std::make_shared<ConstantElements>(kDx, kDy, 0.28, 0.1));
  const Fields p = random_tractions(static_cast<std::size_t>(nx * ny));
  const Fields plane = by_operator(op, p, nullptr);
  for (const AngleCorrection correction : kCorrections) {
    const RowInclination rows(std::vector<double>(static_cast<std::size_t>(ny), 0.6), correction);
    expect_equal_products(by_operator(op, p, &rows), plane);
  }
}

TEST(TurnedProduct, ResultsMayReplaceTheTractions) {
  InfluenceOperator op(6, 5, kDx, kDy, kShearModulus, std::make_shared<ConstantElements>(kDx, kDy, 0.28, 0.1));
  const RowInclination rows(uneven_angles(5), AngleCorrection::half_and_half);
  const Fields p = random_tractions(30);
  Fields u = p, expected(30);
  op.tangential_by_tangential(p.x, p.y, expected.x, expected.y, &rows);
  op.tangential_by_tangential(u.x, u.y, u.x, u.y, &rows);
  EXPECT_EQ(u.x, expected.x);
  EXPECT_EQ(u.y, expected.y);
}

TEST(TurnedProduct, RefusesAnotherNumberOfRows) {
  InfluenceOperator op(6, 5, kDx, kDy, kShearModulus, std::make_shared<ConstantElements>(kDx, kDy, 0.28, 0.0));
  const RowInclination rows(uneven_angles(4), AngleCorrection::half_and_half);
  std::vector<double> p(30), u(30);
  EXPECT_THROW(op.normal_by_normal(p, u, &rows), Error);
}

InfluenceSettings settings_by_rows(std::vector<double> position, std::vector<double> inclination, int variant = 4) {
  InfluenceSettings settings = testing::settings_of(std::move(position), std::move(inclination), variant);
  settings.linear = false;
  return settings;
}

TEST(InclinationTable, IsLinearBetweenItsPositionsAndBeyond) {
  const InclinationTable table(settings_by_rows({-2e-3, 0.0, 1e-3}, {0.1, 0.3, 0.7}));
  for (const auto& [y, expected] :
       {std::pair{-3e-3, 0.0}, {-2e-3, 0.1}, {-1e-3, 0.2}, {0.0, 0.3}, {0.25e-3, 0.4}, {1e-3, 0.7}, {2e-3, 1.1}})
    EXPECT_NEAR(table.at(y), expected, 1e-15) << y;
  const Grid2 grid{0.0, -2e-3, 1e-3, 0.5e-3, 4, 5};
  const RowInclination rows = table.rows(grid, 3, 4);  // y = -0.5 ... 1 mm, beyond the grid's last row
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_NEAR(rows.difference(3, 0), 0.7 - 0.25, 1e-15);
  EXPECT_NEAR(rows.values(RowFactor::half_sine)[1], std::sin(0.15), 1e-15);
}

TEST(InclinationTable, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(InclinationTable(settings_by_rows({0.0}, {0.1})), Error);
  EXPECT_THROW(InclinationTable(settings_by_rows({0.0, 1e-3}, {0.1})), Error);
  EXPECT_THROW(InclinationTable(settings_by_rows({0.0, 1e-3, 1e-3}, {0.1, 0.2, 0.3})), Error);
  EXPECT_THROW(InclinationTable(settings_by_rows({0.0, 1e-3}, {0.1, std::nan("")})), Error);
  EXPECT_THROW(InclinationTable(settings_by_rows({0.0, 1e-3}, {0.1, 0.2}, 5)), Error);
}

}  // namespace
}  // namespace treadmark::kalker
