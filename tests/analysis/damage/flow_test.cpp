// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/damage/flow.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>

#include "treadmark/tests/analysis/damage/cells.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::damage {
namespace {

using ::testing::HasSubstr;

constexpr double kYield = 300e6, kPerCycle = 2e-3, kFlowTurn = 2.0 * std::numbers::pi, kWheel = 0.46;

FlowLaw ratchetting(int layers, double step) {
  FlowLaw law;
  law.theory = FlowTheory::ratchetting;
  law.shear_yield = kYield;
  law.strain_per_cycle = kPerCycle;
  for (int k = 1; k <= layers; ++k) law.depths.push_back(k * step);
  return law;
}

SurfaceRecord empty(const SurfaceCells& cells, const FlowLaw& law) {
  return SurfaceRecord(cells.nu, 0, law.depths.size());
}

/// Elements of a square of some half-width round (u, 0), with stresses by depth.
std::vector<PassedShear> square(const SurfaceCells& cells, const FlowLaw& law, double element, int half, double u,
                                const std::function<Vec2(double depth, int along)>& stress) {
  std::vector<PassedShear> out;
  for (int iy = -half; iy < half; ++iy)
    for (int ix = -half; ix < half; ++ix)
      for (std::size_t depth = 0; depth < law.depths.size(); ++depth)
        out.push_back({u + (ix + 0.5) * element / (cells.body == Body::wheel ? kWheel : 1.0), iy * element,
                       (iy + 1) * element, depth, stress(law.depths[depth], ix)});
  return out;
}

double moved(const CellSheet& volume) {
  double sum = 0.0;
  for (const auto& [j, row] : volume.rows())
    for (const double value : row) sum += std::fabs(value);
  return 0.5 * sum;
}

/// Stresses that fall linearly from s at the surface to nothing at a depth d strain a layer by C (s / k (1 - z / d) -
/// 1) down to h = d (1 - k / s): by width, C (s / k - 1) h^2 / 6 of volume goes across in every passage.
TEST(MaterialFlow, EvenStressesCarryTheVolumeOfTheClosedForm) {
  constexpr double kStress = 750e6, kDeep = 5e-3, kPassages = 400.0;
  const double h = kDeep * (1.0 - kYield / kStress);
  const double expected = kPerCycle * (kStress / kYield - 1.0) * h * h / 6.0 * kPassages;
  for (const Body body : {Body::wheel, Body::rail}) {
    const SurfaceCells cells = cells_of(body, kWheel, 1, 0.5e-3, 81);
    const FlowLaw law = ratchetting(80, 0.05e-3);
    const SurfaceRecord fresh = empty(cells, law);
    SurfaceRecord record = fresh;
    MaterialFlow flow(cells, law, fresh);
    flow.meet(square(cells, law, 1e-3, 10, 0.0, [](double z, int) { return Vec2(0.0, kStress * (1.0 - z / kDeep)); }),
              {1e-3, 1e-3}, {});
    flow.end_passage(record, kPassages);
    flow.displace(record);
    const double way = body == Body::wheel ? kFlowTurn * kWheel : 1.0;
    double behind = 0.0, before = 0.0;
    for (int j = 0; j < cells.ny; ++j) {
      const double y = cells.y(j), volume = record.volume.at(0, j);
      if (std::fabs(y) < 9e-3) {
        EXPECT_NEAR(volume, 0.0, 1e-12 * expected * way) << y;
      }
      (y < 0.0 ? behind : before) += volume;
    }
    EXPECT_NEAR(behind, expected * way, 1e-3 * expected * way);
    EXPECT_NEAR(before, -expected * way, 1e-3 * expected * way);
    EXPECT_NEAR(record.volume.sum(), 0.0, 1e-14 * expected * way);
    const int middle = 40;
    EXPECT_NEAR(record.flow[9].strain.at(0, middle), kPassages * kPerCycle * (kStress * 0.9 / kYield - 1.0), 1e-12);
  }
}

TEST(MaterialFlow, NothingMovesBelowTheYieldNorWhereBothDirectionsAreAlike) {
  const SurfaceCells cells = cells_of(Body::wheel, kWheel, 1440, 0.5e-3, 41);
  const FlowLaw law = ratchetting(4, 1e-3);
  const SurfaceRecord fresh = empty(cells, law);
  for (const double size : {0.999 * kYield, 2.0 * kYield}) {
    SurfaceRecord record = fresh;
    MaterialFlow flow(cells, law, fresh);
    const auto both = [&](double z, int ix) { return z > 3.5e-3 ? Vec2(0, 0) : Vec2(ix < 0 ? -size : size, 0.0); };
    flow.meet(square(cells, law, 0.5e-3, 6, 1.0, both), {0.5e-3, 0.5e-3}, {1.0, 0.8, 1.2});
    flow.end_passage(record, 1e4);
    flow.displace(record);
    if (size < kYield) {
      EXPECT_EQ(record.memory_bytes(), 0u);
      continue;
    }
    // every point in the middle of the stretch has met both directions
    for (int j = 0; j < cells.ny; ++j)
      for (int i = 0; i < cells.nu; ++i)
        if (const double u = cells.u(i); u > 0.81 && u < 1.19) {
          EXPECT_EQ(record.flow[1].strain.at(i, j), 0.0);
        }
    EXPECT_GT(moved(record.volume), 0.0);  // at its ends they have not
    EXPECT_NEAR(record.volume.sum(), 0.0, 1e-13 * moved(record.volume));
  }
}

/// A wheel that is the same all round: what goes along comes from behind, and strains are those of one passage.
TEST(MaterialFlow, PlacesOfATurnFlowAsOne) {
  const SurfaceCells cells = cells_of(Body::wheel, kWheel, 1440, 0.5e-3, 41),
                     round = cells_of(Body::wheel, kWheel, 1, 0.5e-3, 41);
  const FlowLaw law = ratchetting(4, 1e-3);
  const Vec2 stress(500e6, -400e6);
  const auto oblique = [&](double z, int) { return z > 3.5e-3 ? Vec2(0, 0) : Vec2(stress); };
  const SurfaceRecord fresh = empty(cells, law), fresh_round = empty(round, law);
  SurfaceRecord record = fresh, expected = fresh_round;
  MaterialFlow flow(cells, law, fresh), even(round, law, fresh_round);
  const double edges[] = {-0.2, -0.003, 0.0007, 0.11, 0.5, 3.0, kFlowTurn - 0.2};
  for (int k = 0; k < 6; ++k) {
    const double middle = 0.3 * edges[k] + 0.7 * edges[k + 1];
    flow.meet(square(cells, law, 0.5e-3, 6, middle, oblique), {0.5e-3, 0.5e-3}, {middle, edges[k], edges[k + 1]});
  }
  flow.end_passage(record, 10.0);
  flow.displace(record);
  even.meet(square(round, law, 0.5e-3, 6, 0.0, oblique), {0.5e-3, 0.5e-3}, {});
  even.end_passage(expected, 10.0);
  even.displace(expected);
  const double strain = 10.0 * kPerCycle * (stress.norm() / kYield - 1.0);
  ASSERT_GT(moved(expected.volume), 0.0);
  for (int j = 0; j < cells.ny; ++j)
    for (int i = 0; i < cells.nu; ++i) {
      EXPECT_NEAR(record.volume.at(i, j) * cells.nu, expected.volume.at(0, j), 1e-12 * moved(expected.volume));
      if (std::fabs(cells.y(j)) < 2.5e-3) {
        EXPECT_NEAR(record.flow[0].strain.at(i, j), strain, 1e-12);
      }
    }
}

/// Where the traction ends, what it carries piles up: a part of a turn loses behind and gains before.
TEST(MaterialFlow, VolumeGoesAlongTheStress) {
  const SurfaceCells cells = cells_of(Body::rail, kWheel, 200, 0.5e-3, 41);
  const FlowLaw law = ratchetting(3, 1e-3);
  const SurfaceRecord fresh = empty(cells, law);
  SurfaceRecord record = fresh;
  MaterialFlow flow(cells, law, fresh);
  flow.meet(square(cells, law, 1e-3, 4, 0.1, [](double z, int) { return Vec2(z > 2.5e-3 ? 0.0 : 600e6, 0.0); }),
            {1e-3, 1e-3}, {0.1, 0.08, 0.12});
  flow.end_passage(record, 3.0);
  flow.displace(record);
  // C over the two layers that flow, with the weights of the trapezoidal rule, times the width of 8 mm
  const double expected = 3.0 * kPerCycle * (1e-3 * 1e-3 + 1e-3 * 2e-3) * 8e-3;
  double behind = 0.0, before = 0.0;
  for (const auto& [j, row] : record.volume.rows())
    for (int i = 0; i < cells.nu; ++i) (cells.u(i) < 0.1 ? behind : before) += row[static_cast<std::size_t>(i)];
  EXPECT_NEAR(behind, expected, 1e-9 * expected);
  EXPECT_NEAR(before, -expected, 1e-9 * expected);
}

/// Contact that reaches beyond the ends of a rail strains its cells alone, each as in the middle.
TEST(MaterialFlow, NothingIsKeptBeyondTheEndsOfARail) {
  const SurfaceCells cells = cells_of(Body::rail, kWheel, 21, 0.5e-3, 41);
  const FlowLaw law = ratchetting(3, 1e-3);
  const SurfaceRecord fresh = empty(cells, law);
  SurfaceRecord record = fresh;
  MaterialFlow flow(cells, law, fresh);
  flow.meet(square(cells, law, 0.5e-3, 4, 0.01, [](double z, int) { return Vec2(z > 2.5e-3 ? 0.0 : 600e6, 0.0); }),
            {0.5e-3, 0.5e-3}, {0.01, -0.01, 0.03});
  flow.end_passage(record, 2.0);
  flow.displace(record);
  for (const auto& [j, row] : record.flow[0].strain.rows()) {
    ASSERT_EQ(row.size(), 21u);
    for (const double strain : row) EXPECT_NEAR(strain, 2.0 * kPerCycle, 1e-12) << j;
  }
  EXPECT_EQ(record.flow[0].strain.rows().size(), 8u);  // 4 mm
  EXPECT_THROW(record.volume.ref(21, 0), std::out_of_range);
  record.volume.ref(20, 0) = 1.0;
  EXPECT_THROW(static_cast<void>(record.volume.at(21, 0)), std::out_of_range);
}

/// Hardened material yields at more, and at last not at all: k beta sqrt(1 - exp(-alpha g)) is the stress.
TEST(MaterialFlow, HardeningEndsIt) {
  const SurfaceCells cells = cells_of(Body::rail, kWheel, 1, 1e-3, 21);
  FlowLaw law = ratchetting(2, 1e-3);
  law.hardening_factor = 2.0, law.hardening_rate = 3.0;
  EXPECT_DOUBLE_EQ(law.yield_after(0.0), kYield);
  EXPECT_DOUBLE_EQ(law.yield_after(1.0), 2.0 * kYield * std::sqrt(1.0 - std::exp(-3.0)));
  const double stress = 1.5 * kYield, at_rest = -std::log(1.0 - 0.75 * 0.75) / 3.0;
  SurfaceRecord record = empty(cells, law);
  double before = -1.0;
  for (int update = 0; update < 4000; ++update) {
    const SurfaceRecord present = record;
    MaterialFlow flow(cells, law, present);
    flow.meet(square(cells, law, 1e-3, 4, 0.0, [&](double z, int) { return Vec2(z > 1.5e-3 ? 0.0 : stress, 0.0); }),
              {1e-3, 1e-3}, {});
    flow.end_passage(record, 1.0);
    const double strain = record.flow[0].strain.at(0, 10);
    EXPECT_GE(strain, before);
    before = strain;
  }
  EXPECT_NEAR(before, at_rest, 2e-3 * at_rest);
}

TEST(MaterialFlow, RefusesToFlowBelowItsDepths) {
  const SurfaceCells cells = cells_of(Body::rail, kWheel, 1, 1e-3, 21);
  const FlowLaw law = ratchetting(2, 1e-3);
  SurfaceRecord record = empty(cells, law);
  MaterialFlow flow(cells, law, record);
  flow.meet(square(cells, law, 1e-3, 4, 0.0, [](double, int) { return Vec2(400e6, 0.0); }), {1e-3, 1e-3}, {});
  EXPECT_THAT(testing::error_of([&] { flow.end_passage(record, 1.0); }), HasSubstr("flows at 2 mm, the deepest"));
}

TEST(FlowLawCheck, RefusesNumbersThatMakeNoSense) {
  const auto error = [](auto change) {
    FlowLaw law = ratchetting(2, 1e-3);
    change(law);
    return testing::error_of([&] { check(law); });
  };
  EXPECT_EQ(error([](FlowLaw&) {}), "");
  EXPECT_THAT(error([](FlowLaw& law) { law.shear_yield = -1.0; }), HasSubstr("positive shear_yield_MPa"));
  EXPECT_THAT(error([](FlowLaw& law) { law.strain_per_cycle = 0.0; }), HasSubstr("positive strain_per_cycle"));
  EXPECT_THAT(error([](FlowLaw& law) { law.depths = {1e-3}; }), HasSubstr("at least two depths"));
  EXPECT_THAT(error([](FlowLaw& law) { law.depths = {2e-3, 1e-3}; }), HasSubstr("increase"));
  EXPECT_THAT(error([](FlowLaw& law) { law.hardening_factor = 2.0; }), HasSubstr("go together"));
}

}  // namespace
}  // namespace treadmark::damage
