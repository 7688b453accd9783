// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "contact_calls.hpp"

namespace treadmark::testing {
namespace {

/// Units of CONTACT, 21 x 21 or fewer elements of 0.5 mm, h = 0.001 (x^2 + y^2) /mm, rolling with spin.
void set_paraboloid(int ire, int icp, int elements, int units = CNTC_un_cntc) {
  const double l = units == CNTC_un_cntc ? 1.0 : 1e-3, stress = 1.0 / (l * l) * 1.0;
  const double pascal = units == CNTC_un_cntc ? 1.0 : 1e6;
  static_cast<void>(stress);
  set_flags(ire, icp, {{CNTC_if_units, units}, {CNTC_ic_tang, 3}, {CNTC_ic_pvtime, 2}, {CNTC_ic_sens, 3}});
  cntc_setmaterialparameters(Int{ire}, Int{icp}, Int{0}, Int{4}, Reals{0.28, 0.28, 82000.0 * pascal, 82000.0 * pascal});
  cntc_setfrictionmethod(Int{ire}, Int{icp}, Int{0}, Int{2}, Reals{0.3, 0.3});
  const double corner = -0.25 * elements;
  cntc_setpotcontact(Int{ire}, Int{icp}, Int{1}, Int{6},
                     Reals{1.0 * elements, 1.0 * elements, corner * l, corner * l, 0.5 * l, 0.5 * l});
  cntc_setundeformeddistc(Int{ire}, Int{icp}, Int{1}, Int{6}, Reals{0.001 / l, 0.0, 0.001 / l, 0.0, 0.0, 0.0});
  cntc_setpenetration(Int{ire}, Int{icp}, Real{0.03 * l});
  cntc_setcreepages(Int{ire}, Int{icp}, Real{0.001}, Real{0.0005}, Real{1e-4 / l});
  cntc_setreferencevelocity(Int{ire}, Int{icp}, Real{10000.0 * l});
}

// Numbers of CONTACT's library, built with gfortran, through its Python wrapper.
TEST(ContactLibraryBasic, ParaboloidAsTheReference) {
  const Library library;
  set_paraboloid(1, 2, 21);
  EXPECT_EQ(calculate(1, 2), 0);
  const Forces f = forces_of(1, 2);
  EXPECT_NEAR(f.fn, 17655.33, kForce * 17655.33);
  EXPECT_NEAR(f.fx, -3629.247, kForce * 17655.33);
  EXPECT_NEAR(f.fy, -2225.104, kForce * 17655.33);
  EXPECT_NEAR(f.mz, -234.1223, 0.01 * 234.0);
  const Triple area = triple_of(cntc_getcontactpatchareas, 1, 2);
  EXPECT_NEAR(area.a, 48.25, kArea * 48.25);
  EXPECT_NEAR(area.b, 19.5, kArea * 48.25);
  EXPECT_NEAR(area.c, 28.75, kArea * 48.25);
  const auto s = sensitivities_of(1, 2);
  EXPECT_NEAR(s[0][0], 878829.0, kSensitivity * 878829.0);
  const double expected[3][3] = {
      {-461.515, 112.188, 271.345}, {129.041, -546.020, -997.186}, {-571534.0, 948970.0, -1.11731e7}};
  for (std::size_t row = 0; row < 3; ++row) {
    double size = 0.0;
    for (const double value : expected[row]) size = std::max(size, std::abs(value));
    for (std::size_t column = 0; column < 3; ++column)
      EXPECT_NEAR(s[column + 1][row + 1], expected[row][column], kSensitivity * size) << row << " " << column;
  }
  EXPECT_THAT(s[0], ::testing::ElementsAre(::testing::_, 0.0, 0.0, 0.0));
  EXPECT_EQ(flag(1, 2, CNTC_if_ncase), 1);
}

TEST(ContactLibraryBasic, CountsElementsAtTheBorder) {
  const Library library;
  set_paraboloid(1, 1, 9);
  EXPECT_EQ(calculate(1, 1), 32);
}

TEST(ContactLibraryBasic, TheSameInEveryUnit) {
  const Library library;
  const int units[] = {CNTC_un_cntc, CNTC_un_si, CNTC_un_spck};
  for (int k = 0; k < 3; ++k) {
    set_paraboloid(k + 1, 1, 21, units[k]);
    ASSERT_EQ(calculate(k + 1, 1), 0);
  }
  const Forces mm = forces_of(1, 1), si = forces_of(2, 1), wheel = forces_of(3, 1);
  EXPECT_NEAR(si.fx, mm.fx, 1e-6 * mm.fn);
  EXPECT_NEAR(si.mz, 1e-3 * mm.mz, 1e-9 * mm.fn);
  EXPECT_DOUBLE_EQ(wheel.fn, si.fn);
  EXPECT_DOUBLE_EQ(wheel.fx, -si.fx);
  EXPECT_DOUBLE_EQ(wheel.fy, -si.fy);
  EXPECT_DOUBLE_EQ(wheel.mz, -si.mz);
  const Triple creepage = triple_of(cntc_getcreepages, 3, 1);
  EXPECT_DOUBLE_EQ(creepage.a, -0.001);
  EXPECT_DOUBLE_EQ(creepage.c, -0.1);
  EXPECT_NEAR(value_of(cntc_getmaximumpressure, 2, 1), 1e6 * value_of(cntc_getmaximumpressure, 1, 1), 1.0);
  EXPECT_NEAR(value_of(cntc_getpenetration, 2, 1), 0.03e-3, 1e-12);
  // Sensitivities keep their sign: [per m] against [per mm], [per rad/m] against [per rad/mm].
  const auto a = sensitivities_of(1, 1), b = sensitivities_of(3, 1);
  EXPECT_NEAR(b[0][0], 1e3 * a[0][0], 1e-6 * std::abs(b[0][0]));
  EXPECT_NEAR(b[1][1], a[1][1], 1e-5 * std::abs(a[1][1]));
  EXPECT_NEAR(b[3][2], 1e-3 * a[3][2], 1e-5 * std::abs(a[3][2]) * 1e-3);
  // A change of units changes how stored values are told, not them.
  set_flags(1, 1, {{CNTC_if_units, CNTC_un_si}});
  EXPECT_NEAR(value_of(cntc_getpenetration, 1, 1), 0.03e-3, 1e-12);
}

// The example program of CONTACT in SIMPACK's units: forces act on the wheel.
TEST(ContactLibraryBasic, HertzBySemiAxes) {
  const Library library;
  const int ire = 1, icp = 2;
  set_flags(ire, icp, {{CNTC_if_units, CNTC_un_spck}});
  cntc_setreferencevelocity(Int{ire}, Int{icp}, Real{24.0});
  cntc_setrollingstepsize(Int{ire}, Int{icp}, Real{0.0}, Real{0.0005});
  cntc_setcreepages(Int{ire}, Int{icp}, Real{0.001}, Real{0.0}, Real{0.4});
  cntc_setmaterialparameters(Int{ire}, Int{icp}, Int{0}, Int{4}, Reals{0.28, 0.28, 82e9, 82e9});
  cntc_setfrictionmethod(Int{ire}, Int{icp}, Int{0}, Int{2}, Reals{0.3, 0.3});
  cntc_setpenetration(Int{ire}, Int{icp}, Real{5e-5});
  cntc_sethertzcontact(Int{ire}, Int{icp}, Int{-3}, Int{5}, Reals{21.0, 33.0, 0.00425, 0.007, 21.0 / 17.0});
  cntc_setsolverflags(Int{ire}, Int{icp}, Int{0}, Int{4}, Ints{999, 30, 30, 1}, Int{1}, Real{1e-4});
  EXPECT_EQ(calculate(ire, icp), 0);
  const Forces f = forces_of(ire, icp);
  EXPECT_NEAR(f.fn, 42083.1, kForce * 42083.1);
  EXPECT_NEAR(f.fx, 4883.3, kForce * 42083.1);
  EXPECT_NEAR(f.fy, 4617.4, kForce * 42083.1);
  EXPECT_NEAR(f.mz, 23.7, 0.3);
  int mx = 0, my = 0;
  cntc_getnumelements(Int{ire}, Int{icp}, &mx, &my);
  EXPECT_EQ(mx, 21);
  EXPECT_EQ(my, 33);
  EXPECT_NEAR(value_of(cntc_getmaximumpressure, ire, icp), 675.4e6, kForce * 675.4e6);
  EXPECT_NEAR(value_of(cntc_getmaximumtraction, ire, icp), 202.1e6, kForce * 202.1e6);
  Reals sx(21 * 33), sy(21 * 33), p(21 * 33);
  cntc_getmicroslip(Int{ire}, Int{icp}, sx.count(), sx, sy);
  EXPECT_NEAR(sx[4 + 21 * 7], -0.00491, 1e-4);
  EXPECT_NEAR(sy[2 + 21 * 11], 0.00135, 1e-4);
  cntc_getfielddata(Int{ire}, Int{icp}, Int{CNTC_fld_px}, p.count(), p);
  EXPECT_NEAR(p[9 + 21 * 12], 180.0e6, kForce * 202.1e6);
  const Reals hertz = answer(10, cntc_gethertzcontact, ire, icp);
  EXPECT_NEAR(hertz[2], 0.00425, 1e-9);
  EXPECT_NEAR(hertz[5], std::sqrt(0.00425 * 0.007), 1e-9);
  EXPECT_NEAR(hertz[4], 2.0 / (hertz[0] + hertz[1]), 1e-9);
  // Rigid slip: w = xi - phi y, seen from half a step before, of the reference program with the opposite sign.
  Reals wx(21 * 33);
  cntc_getfielddata(Int{ire}, Int{icp}, Int{CNTC_fld_wx}, wx.count(), wx);
  EXPECT_NEAR(wx[10 + 21 * 16], 0.001, 1e-6);
}

// The second problem of that program: distances of elements, Polach's friction, an elastic layer.
TEST(ContactLibraryBasic, ElementsWithALayerAndFallingFriction) {
  const Library library;
  const int ire = 2, icp = 2;
  set_flags(ire, icp, {{CNTC_if_units, CNTC_un_spck}});
  cntc_setreferencevelocity(Int{ire}, Int{icp}, Real{24.0});
  cntc_setrollingstepsize(Int{ire}, Int{icp}, Real{0.0}, Real{0.0005});
  cntc_setcreepages(Int{ire}, Int{icp}, Real{0.001}, Real{0.0}, Real{0.4});
  cntc_setfrictionmethod(Int{ire}, Int{icp}, Int{5}, Int{3}, Reals{0.30, 0.60, std::numbers::ln2 / 1.25});
  EXPECT_EQ(flag(ire, icp, CNTC_ic_frclaw), 4);
  cntc_setmaterialparameters(Int{ire}, Int{icp}, Int{4}, Int{8}, Reals{0.28, 0.28, 82e9, 82e9, 100e6, 1e-5, 0.0, 0.0});
  cntc_setnormalforce(Int{ire}, Int{icp}, Real{42083.0});
  const int mx = 23, my = 33;
  const double corner = -0.00725, step = 0.0005;
  cntc_setpotcontact(Int{ire}, Int{icp}, Int{1}, Int{6}, Reals{1.0 * mx, 1.0 * my, corner, corner, step, step});
  Reals h;
  for (int iy = 0; iy < my; ++iy)
    for (int ix = 0; ix < mx; ++ix) {
      const double x = corner + (ix + 0.5) * step, y = corner + (iy + 0.5) * step;
      h.push_back(1.214 * x * x + 0.5731 * y * y);
    }
  cntc_setundeformeddistc(Int{ire}, Int{icp}, Int{9}, h.count(), h);
  EXPECT_EQ(calculate(ire, icp), 14);
  const Forces f = forces_of(ire, icp);
  EXPECT_NEAR(f.fn, 42083.0, 1.0);
  EXPECT_NEAR(f.fx, 2374.7, kForce * 42083.0);
  EXPECT_NEAR(f.fy, 1433.2, kForce * 42083.0);
  EXPECT_NEAR(f.mz, 10.2, 0.3);
  EXPECT_NEAR(value_of(cntc_getpenetration, ire, icp), 5.0e-5, 1e-6);
  EXPECT_NEAR(value_of(cntc_getmaximumtraction, ire, icp), 122.7e6, kStress * 122.7e6);
  cntc_setnormalforce(Int{ire}, Int{icp}, Real{19563.0});
  cntc_setcreepages(Int{ire}, Int{icp}, Real{0.001}, Real{0.0}, Real{-0.3});
  calculate(ire, icp);
  const Forces again = forces_of(ire, icp);
  EXPECT_NEAR(again.fx, 1251.4, kForce * 19563.0);
  EXPECT_NEAR(again.fy, -405.2, kForce * 19563.0);
}

// Old functions for the material, as example scripts call them, do what the new one does.
TEST(ContactLibraryBasic, OldFunctionsSetTheSameMaterial) {
  const Library library;
  for (const int ire : {1, 2}) set_paraboloid(ire, 1, 21);
  cntc_setmaterialparameters(Int{1}, Int{1}, Int{4}, Int{8}, Reals{0.28, 0.28, 60e3, 60e3, 8200.0, 1.25, 0.0, 0.0});
  cntc_setmaterialproperties(Int{2}, Int{1}, Real{60e3}, Real{0.28}, Real{60e3}, Real{0.28});
  cntc_setinterfaciallayer(Int{2}, Int{1}, Int{4}, Int{4}, Reals{8200.0, 1.25, 0.0, 0.0});
  EXPECT_EQ(flag(2, 1, CNTC_ic_mater), 4);
  ASSERT_EQ(calculate(1, 1), 0);
  ASSERT_EQ(calculate(2, 1), 0);
  EXPECT_DOUBLE_EQ(forces_of(1, 1).fx, forces_of(2, 1).fx);
  Reals numbers(22, -999.0);
  cntc_getparameters(Int{2}, Int{1}, Int{2}, numbers.count(), numbers);
  EXPECT_DOUBLE_EQ(numbers[0], 60e3);
  EXPECT_DOUBLE_EQ(numbers[14], 8200.0);
  EXPECT_NEAR(numbers[15], 1.25, 1e-12);
}

/// One square element, as the example of stresses below the surface.
void set_one_element() {
  set_flags(1, 1, {{CNTC_ic_norm, 1}, {CNTC_ic_tang, 0}, {CNTC_ic_sbsfil, 1}});
  cntc_setmaterialproperties(Int{1}, Int{1}, Real{1.0}, Real{0.28}, Real{1.0}, Real{0.28});
  cntc_sethertzcontact(Int{1}, Int{1}, Int{-3}, Int{5}, Reals{1.0, 1.0, 0.5, 0.5, 1.0});
  cntc_setreferencevelocity(Int{1}, Int{1}, Real{10000.0});
  cntc_setnormalforce(Int{1}, Int{1}, Real{1.0});
  cntc_setfrictionmethod(Int{1}, Int{1}, Int{0}, Int{2}, Reals{1.0, 1.0});
}

TEST(ContactLibraryBasic, StressesBelowOneElement) {
  const Library library;
  set_one_element();
  const Reals depths{0.0, 0.1, 0.3, 0.5, 1.0, 2.5, 5.0};
  subs_addblock(Int{1}, Int{1}, Int{1}, Int{9}, Int{1}, Int{1}, depths.count(), Real{0.0}, Real{0.0}, Reals(depths));
  subs_addblock(Int{1}, Int{1}, Int{2}, Int{9}, Int{3}, Int{2}, Int{2}, Reals{-1.0, 0.0, 1.0}, Reals{-2.0, 2.0},
                Reals{0.5, 1.0});
  EXPECT_EQ(calculate(1, 1), 1);  // the only element is at the border
  int nx = 0, ny = 0, nz = 0, error = -1;
  subs_getblocksize(Int{1}, Int{1}, Int{2}, &nx, &ny, &nz);
  EXPECT_THAT((std::vector{nx, ny, nz}), ::testing::ElementsAre(3, 2, 2));
  subs_calculate(Int{1}, Int{1}, &error);
  EXPECT_EQ(error, 0);
  Reals table(4 * depths.size());
  subs_getresults(Int{1}, Int{1}, Int{1}, depths.count(), Int{4}, Ints{6, 7, 8, 99}, table);
  const double uz[] = {0.403992, 0.379564, 0.321411, 0.265158, 0.170504, 0.075856, 0.038601},
               hydrostatic[] = {-0.853333, -0.702176, -0.448778, -0.284444, -0.109387, -0.020899, -0.005379},
               mises[] = {0.220000, 0.438178, 0.664177, 0.624662, 0.340080, 0.076071, 0.020110};
  for (std::size_t i = 0; i < depths.size(); ++i) {
    EXPECT_NEAR(table[i], uz[i], 1e-5);
    EXPECT_NEAR(table[depths.size() + i], hydrostatic[i], 1e-5);
    EXPECT_NEAR(table[2 * depths.size() + i], mises[i], 1e-5);
    EXPECT_EQ(table[3 * depths.size() + i], -999.0);
  }
  Reals second(4 * 12);
  subs_getresults(Int{1}, Int{1}, Int{2}, Int{12}, Int{4}, Ints{1, 2, 3, 8}, second);
  EXPECT_THAT((Reals(second.begin(), second.begin() + 4)), ::testing::ElementsAre(-1.0, 0.0, 1.0, -1.0));
  const double order[] = {0.01101, 0.01622, 0.01101, 0.01101, 0.01622, 0.01101, 0.02659, 0.03656, 0.02659};
  for (std::size_t i = 0; i < std::size(order); ++i) EXPECT_NEAR(second[36 + i], order[i], 1e-5);
  EXPECT_TRUE(std::filesystem::exists(library.folder() / "caddon_re001_cp1.0001.subs"));

  set_flags(1, 1, {{CNTC_ic_tang, 3}, {CNTC_ic_force, 1}});
  cntc_settangentialforces(Int{1}, Int{1}, Real{0.999}, Real{0.0});
  EXPECT_EQ(calculate(1, 1), 1);
  EXPECT_NEAR(triple_of(cntc_getcreepages, 1, 1).a, -0.643026, 0.643026 * kCreepage);
  subs_calculate(Int{1}, Int{1}, &error);
  subs_getresults(Int{1}, Int{1}, Int{1}, depths.count(), Int{3}, Ints{8, 9, 4}, table);
  EXPECT_NEAR(table[0], 1.744247, 1e-4);
  EXPECT_NEAR(table[depths.size()], 2.010074, 1e-4);
  EXPECT_NEAR(table[2 * depths.size()], 0.482063, 1e-4);
  EXPECT_NEAR(value_of(cntc_getpenetration, 1, 1), 0.807984, 1e-4);
  subs_addblock(Int{1}, Int{1}, Int{0}, Int{0}, Int{0}, Int{0}, Int{0}, nullptr, nullptr, nullptr);
  subs_getblocksize(Int{1}, Int{1}, Int{1}, &nx, &ny, &nz);
  EXPECT_EQ(nx, -1);
}

TEST(ContactLibraryBasic, DefaultsOfANewProblem) {
  const Library library;
  int error = -1, version = 0;
  cntc_initialize(Int{7}, Int{3}, &version, &error, " ", Int{1});
  EXPECT_EQ(error, 0);
  EXPECT_EQ(version, 2520);
  int mx = 0, my = 0;
  cntc_getnumelements(Int{7}, Int{1}, &mx, &my);
  EXPECT_EQ(mx, 1);
  EXPECT_EQ(my, 1);
  EXPECT_THAT(answer(6, cntc_getpotcontact, 7, 1), ::testing::ElementsAre(1.0, 1.0, 0.0, 0.0, 2.0, 2.0));
  const Reals hertz = answer(4, cntc_gethertzcontact, 7, 1);
  EXPECT_THAT(hertz, ::testing::Pointwise(::testing::DoubleNear(1e-12), Reals{1e-3, 1e-3, 5.0, 5.0}));
  EXPECT_DOUBLE_EQ(value_of(cntc_getreferencevelocity, 7, 1), 1000.0);
  Reals rolling(6), friction(7);
  cntc_getparameters(Int{7}, Int{1}, Int{1}, Int{6}, rolling);
  EXPECT_DOUBLE_EQ(rolling[2], 2.0);
  cntc_getparameters(Int{7}, Int{1}, Int{3}, Int{7}, friction);
  EXPECT_THAT(friction,
              ::testing::Pointwise(::testing::DoubleNear(1e-12), Reals{0.0, 1.0, 0.001, 10.0, 0.0, 0.3, 0.3}));
}

TEST(ContactLibraryBasic, PressedApartThereAreNoForces) {
  const Library library;
  set_paraboloid(1, 1, 21);
  cntc_setpenetration(Int{1}, Int{1}, Real{-0.01});
  EXPECT_EQ(calculate(1, 1), 0);
  EXPECT_EQ(forces_of(1, 1).fn, 0.0);
  EXPECT_EQ(triple_of(cntc_getcontactpatchareas, 1, 1).a, 0.0);
}

TEST(ContactLibraryBasic, ShiftIsInLengthsAndGoesOn) {
  const Library library;
  set_paraboloid(1, 1, 21);
  set_flags(1, 1, {{CNTC_ic_tang, 1}, {CNTC_ic_sens, 0}});
  cntc_setcreepages(Int{1}, Int{1}, Real{0.0005}, Real{0.0}, Real{0.0});
  ASSERT_EQ(calculate(1, 1), 0);
  const double once = forces_of(1, 1).fx;
  EXPECT_LT(once, 0.0);
  EXPECT_DOUBLE_EQ(triple_of(cntc_getcreepages, 1, 1).a, 0.0005);
  set_flags(1, 1, {{CNTC_ic_pvtime, 0}});
  ASSERT_EQ(calculate(1, 1), 0);
  EXPECT_LT(forces_of(1, 1).fx, 1.5 * once);  // further in the same direction
  set_flags(1, 1, {{CNTC_ic_pvtime, 2}});
  ASSERT_EQ(calculate(1, 1), 0);
  EXPECT_NEAR(forces_of(1, 1).fx, once, 1e-6 * std::abs(once));
  EXPECT_EQ(flag(1, 1, CNTC_if_ncase), 3);
}

}  // namespace
}  // namespace treadmark::testing
