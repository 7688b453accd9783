// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/tabulated_kernel.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "point_solutions.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"

namespace treadmark::kalker {
namespace {

constexpr double kTableDx = 0.5e-3, kTableDy = 0.4e-3;
constexpr int kNx = 5, kNy = 3;

/// A different value for every coefficient and offset.
NumericalInfluence numbered_table() {
  NumericalInfluence table{.nx = kNx, .ny = kNy, .dx = kTableDx, .dy = kTableDy, .values = {}};
  for (int node = 0; node < kNx * kNy; ++node) {
    std::array<double, 9> values{};
    for (std::size_t i = 0; i < 9; ++i) values[i] = 1e-5 * (node * node + 10.0 * static_cast<double>(i) + 1.0);
    table.values.push_back(values);
  }
  return table;
}

std::shared_ptr<const InfluenceKernel> make_tabulated(const NumericalInfluence& table, double dx = kTableDx,
                                                      double dy = kTableDy) {
  InfluenceSettings settings;
  settings.kind = InfluenceSettings::Kind::table;
  settings.table = std::make_shared<NumericalInfluence>(table);
  return make_influence_kernel(Material{}, settings, dx, dy, 30.0, 0.0);
}

std::array<double, 9> in_order_of_the_table(const InfluenceBlock& b) {
  return {b.nn, b.nx, b.ny, b.xn, b.xx, b.xy, b.yn, b.yx, b.yy};
}

TEST(TabulatedKernel, ReproducesItsEntries) {
  const NumericalInfluence table = numbered_table();
  const auto kernel = make_tabulated(table);
  for (int iy = 0; iy < kNy; ++iy)
    for (int ix = 0; ix < kNx; ++ix) {
      const auto found = in_order_of_the_table(kernel->at((ix - 2) * kTableDx, (iy - 1) * kTableDy));
      const auto& expected = table.values[static_cast<std::size_t>(iy * kNx + ix)];
      for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(found[i], expected[i], 1e-16) << ix << ' ' << iy << ' ' << i;
    }
  EXPECT_TRUE(kernel->coupled());
  EXPECT_FALSE(kernel->symmetric());
}

TEST(TabulatedKernel, IsBilinearBetweenItsEntries) {
  const NumericalInfluence table = numbered_table();
  const auto found = in_order_of_the_table(
      make_tabulated(table)->at(-1.7 * kTableDx, 0.4 * kTableDy));  // 0.3 after column 0, 0.4 after row 1
  for (std::size_t i = 0; i < 9; ++i) {
    const double expected = 0.6 * (0.7 * table.values[5][i] + 0.3 * table.values[6][i]) +
                            0.4 * (0.7 * table.values[10][i] + 0.3 * table.values[11][i]);
    EXPECT_NEAR(found[i], expected, 1e-15);
  }
}

TEST(TabulatedKernel, IsTheHalfSpaceOutside) {
  const auto kernel = make_tabulated(numbered_table());
  const ConstantElements half_space(kTableDx, kTableDy, 0.28, 0.0);
  for (const auto& [X, Y] : {std::pair{2.01 * kTableDx, 0.0},
                             {-3 * kTableDx, kTableDy},
                             {0.0, 1.01 * kTableDy},
                             {kTableDx, -2 * kTableDy},
                             {1e9 * kTableDx, 0.0}})
    for (const auto& [name, c] : kAllCoefficients) EXPECT_EQ(kernel->at(X, Y).*c, half_space.at(X, Y).*c) << name;
}

TEST(TabulatedKernel, SeesSymmetryAndCoupling) {
  const ConstantElements half_space(kTableDx, kTableDy, 0.28, 0.0);
  NumericalInfluence table = numbered_table();
  for (int iy = 0; iy < kNy; ++iy)
    for (int ix = 0; ix < kNx; ++ix)
      table.values[static_cast<std::size_t>(iy * kNx + ix)] =
          in_order_of_the_table(half_space.at((ix - 2) * kTableDx, (iy - 1) * kTableDy));
  EXPECT_TRUE(make_tabulated(table)->symmetric());
  EXPECT_FALSE(make_tabulated(table)->coupled());
  table.values[0][4] *= 1.001;  // xx
  EXPECT_FALSE(make_tabulated(table)->symmetric());
  table.values[0][3] = 1e-9;  // xn
  EXPECT_TRUE(make_tabulated(table)->coupled());
}

TEST(TabulatedKernel, OneEntryServesTheLoadedElementAlone) {
  NumericalInfluence table{
      .nx = 1, .ny = 1, .dx = kTableDx, .dy = kTableDy, .values = {{1e-3, 0, 0, 0, 2e-3, 0, 0, 0, 3e-3}}};
  const auto kernel = make_tabulated(table);
  EXPECT_DOUBLE_EQ(kernel->at(0.0, 0.0).nn, 1e-3);
  EXPECT_DOUBLE_EQ(kernel->at(0.0, 0.0).yy, 3e-3);
  EXPECT_EQ(kernel->at(kTableDx, 0.0).nn, ConstantElements(kTableDx, kTableDy, 0.28, 0.0).at(kTableDx, 0.0).nn);
}

TEST(TabulatedKernel, RefusesOtherStepsAndBrokenTables) {
  EXPECT_NO_THROW(make_tabulated(numbered_table(), kTableDx * (1.0 + 5e-7)));
  EXPECT_THROW(make_tabulated(numbered_table(), kTableDx * (1.0 + 2e-6)), Error);
  EXPECT_THROW(make_tabulated(numbered_table(), kTableDx, kTableDy * (1.0 - 2e-6)), Error);
  NumericalInfluence table = numbered_table();
  table.values.pop_back();
  EXPECT_THROW(make_tabulated(table), Error);
  table = numbered_table();
  std::swap(table.nx, table.ny);
  table.nx = 4;
  EXPECT_THROW(make_tabulated(table), Error);
  table = numbered_table();
  table.values[3][2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(make_tabulated(table), Error);
  InfluenceSettings without_table;
  without_table.kind = InfluenceSettings::Kind::table;
  EXPECT_THROW(make_influence_kernel(Material{}, without_table, kTableDx, kTableDy, 30.0, 0.0), Error);
}

TEST(MakeInfluenceKernel, TakesTheBodiesIntoAccount) {
  Material m;
  m.poisson_2 = 0.2;
  InfluenceSettings settings;
  const CombinedMaterial combined = combine(m);
  const InfluenceBlock constant =
      make_influence_kernel(m, settings, kTableDx, kTableDy, 30.0, 0.0)->at(kTableDx, kTableDy);
  const InfluenceBlock expected =
      ConstantElements(kTableDx, kTableDy, combined.poisson, combined.difference).at(kTableDx, kTableDy);
  for (const auto& [name, c] : kAllCoefficients) EXPECT_EQ(constant.*c, expected.*c) << name;
  EXPECT_FALSE(make_influence_kernel(Material{}, settings, kTableDx, kTableDy, 30.0, 0.0)->coupled());
  settings.kind = InfluenceSettings::Kind::bilinear;
  EXPECT_NE(make_influence_kernel(m, settings, kTableDx, kTableDy, 30.0, 0.0)->at(kTableDx, kTableDy).nn, expected.nn);
  m.shear_modulus_1 = 0.0;
  EXPECT_THROW(make_influence_kernel(m, settings, kTableDx, kTableDy, 30.0, 0.0), Error);
}

}  // namespace
}  // namespace treadmark::kalker
