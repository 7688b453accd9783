// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/app/surfaces/trace_line.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::error_of;

constexpr double kArcRadius = 0.08, kAngle = 0.4;

SurfaceSpec arc_rail() {
  return {Body::rail,
          0.0,
          ArcChain{-kArcRadius * std::sin(kAngle),
                   kArcRadius * (1.0 - std::cos(kAngle)),
                   -kAngle,
                   {{2.0 * kAngle * kArcRadius, 1.0 / kArcRadius}}},
          {}};
}

TEST(TraceLine, AcrossAnArcIsTheArc) {
  for (const char* backend : {"", "spline", "nurbs", "chords"}) {
    const auto rail = create_surface(arc_rail(), backend);
    TraceRequest request;
    request.at = 0.1;
    request.step = 2e-3;
    const TracedLine line = trace_line(*rail, Body::rail, request);
    ASSERT_GT(line.points.size(), 20u) << backend;
    EXPECT_NEAR(line.points.back().s, 2.0 * kAngle * kArcRadius, 2e-7) << backend;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      const TracedPoint& p = line.points[i];
      if (i + 1 < line.points.size()) {
        EXPECT_NEAR(p.s, 2e-3 * static_cast<double>(i), 1e-9) << backend;
      }
      // by arc length from one end of the arc
      const double angle = -kAngle + p.s / kArcRadius;
      EXPECT_NEAR(p.position.y(), kArcRadius * std::sin(angle), 3e-6) << backend << ' ' << i;
      EXPECT_NEAR(p.position.z(), kArcRadius * (1.0 - std::cos(angle)), 3e-6) << backend << ' ' << i;
      EXPECT_EQ(p.u, 0.1);
    }
    const TracedPoint& middle = line.points[line.points.size() / 2];
    EXPECT_NEAR(middle.curvature_along, line.backend == "chords" ? 0.0 : 1.0 / kArcRadius, 2e-2) << backend;
  }
}

TEST(TraceLine, RoundAWheelIsACircle) {
  const auto wheel = create_surface({Body::wheel, 0.46, StandardProfile{"S1002"}, {}});
  TraceRequest request;
  request.section = false;
  request.at = 10e-3;
  request.range = {-0.2, 0.3};
  request.step = 1e-3;
  const TracedLine line = trace_line(*wheel, Body::wheel, request);
  ASSERT_TRUE(line.exact_derivatives);
  const double r = std::hypot(line.points[0].position.x(), line.points[0].position.z());
  EXPECT_NEAR(line.points.back().s, 0.5 * r, 1e-11);
  EXPECT_NEAR(line.points.back().u, 0.3, 0.0);
  for (const TracedPoint& p : line.points) {
    EXPECT_NEAR(p.u, -0.2 + p.s / r, 1e-12);
    EXPECT_NEAR(p.position.y(), 10e-3, 1e-15);
    EXPECT_NEAR(p.normal.norm(), 1.0, 1e-12);
  }
}

TEST(TraceLine, IsRefusedWhereThereIsNoSurface) {
  const auto rail = create_surface(arc_rail());
  TraceRequest request;
  request.range = {-0.01, 0.05};
  EXPECT_THAT(error_of([&] { trace_line(*rail, Body::rail, request); }), HasSubstr("there is no surface"));
  request.range = {0.01, -0.01};
  EXPECT_THAT(error_of([&] { trace_line(*rail, Body::rail, request); }), HasSubstr("from a smaller to a greater"));
  request.range.reset();
  request.section = false;
  EXPECT_THAT(error_of([&] { trace_line(*rail, Body::rail, request); }), HasSubstr("a beginning and an end"));
  request.section = true;
  request.step = 0.0;
  EXPECT_THAT(error_of([&] { trace_line(*rail, Body::rail, request); }), HasSubstr("must be positive"));
}

TEST(TraceLine, IsAVerb) {
  using treadmark::testing::run_program;
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", treadmark::testing::flat_wheel_case());
  const std::string file = (input.folder() / "flat.toml").string();
  const auto across = run_program({"trace", file, "--body", "wheel", "--section-deg", "5", "--step", "5"});
  ASSERT_EQ(across.status, 0) << across.err;
  EXPECT_THAT(across.out, HasSubstr("s_mm,u_deg,v,x_mm"));
  EXPECT_THAT(across.out, HasSubstr("\n0,5,"));
  const auto along = run_program({"trace", file, "--body", "rail", "--line-mm", "3", "--range-mm=-10,20", "-o",
                                  (input.folder() / "line.csv").string()});
  ASSERT_EQ(along.status, 0) << along.err;
  EXPECT_THAT(along.out, HasSubstr("31 points over 30 mm, analytic, derivatives of the representation"));
  EXPECT_THAT(input.read("line.csv"), HasSubstr("\n30,20,"));
  EXPECT_THAT(run_program({"trace", file, "--body", "rail"}).err, HasSubstr("which line is meant"));
  EXPECT_THAT(run_program({"trace", file, "--body", "rail", "--section-deg", "5"}).err,
              HasSubstr("--section-mm for rails"));
}

}  // namespace
}  // namespace treadmark::app
