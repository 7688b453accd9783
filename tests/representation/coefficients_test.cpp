// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What a hierarchical spline of the wheel flat takes beside the spline through slices of it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/backends/spline/slices/slice_surface.hpp"
#include "treadmark/tests/representation/example_cases.hpp"
#include "treadmark/tests/representation/kinds.hpp"

namespace treadmark::testing {
namespace {

TEST(Coefficients, AnEighthOfThoseOfTheSplineIsEnoughForTheWheelFlat) {
  constexpr double kResolution = 0.25e-3;
  constexpr Region kRegion{-0.25, 0.25, -35e-3, 40e-3};
  io::CaseFile file = wheel_flat_example({0.0});
  const io::WheelRailCase& input = wheel_rail(file.cases.front());
  const NaturalSurface wheel = app::read_surface(input.wheel, Body::wheel, input.wheelset.nominal_radius);
  const auto spline = represent(wheel, {"spline", kResolution, {}}).surface;
  const RepresentedSurface thb = represent(wheel, {"thb", kResolution, {-0.494, 0.494}});
  const auto* slices = dynamic_cast<const spline::SliceWheel*>(spline.get());
  ASSERT_NE(slices, nullptr);
  const double of_spline = 1.0 * slices->net().spans() * slices->net().lines();
  const double of_thb = std::atof(thb.note.c_str());
  ASSERT_GT(of_thb, 1000.0) << thb.note;
  EXPECT_LE(of_thb, of_spline / 8.0) << of_spline;
  const double spline_off = distance(*wheel.surface, *spline, Body::wheel, kRegion, 20000).max;
  EXPECT_LE(distance(*wheel.surface, *thb.surface, Body::wheel, kRegion, 20000).max, spline_off);
}

}  // namespace
}  // namespace treadmark::testing
