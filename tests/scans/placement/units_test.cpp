// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/scans/placement/place.hpp"
#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using ::testing::HasSubstr;

TEST(Units, OfWheelsAndRailsByTheirSize) {
  for (const auto& [body, metres] :
       {std::pair{Body::wheel, 0.16}, std::pair{Body::wheel, 0.46}, std::pair{Body::wheel, 0.74},
        std::pair{Body::rail, 0.035}, std::pair{Body::rail, 0.072}, std::pair{Body::rail, 0.15}})
    for (const LengthUnit unit : kLengthUnits) {
      const double size = metres / metres_per(unit);
      EXPECT_EQ(unit_by_size(body, size), unit) << metres << ' ' << symbol(unit);
      EXPECT_NO_THROW(check_unit(body, size, unit));
    }
}

TEST(Units, ThatDoNotFitAreListed) {
  for (const Body body : {Body::wheel, Body::rail}) {
    const bool wheel = body == Body::wheel;
    // in mm, but a thousand times too large: as metres written with the decimal point lost
    const double size = wheel ? 460e6 : 72e6;
    const auto error = tests::error_of([&] { unit_by_size(body, size); });
    ASSERT_TRUE(error);
    EXPECT_EQ(error->kind(), ErrorKind::input_data);
    EXPECT_THAT(
        error->message(),
        HasSubstr(wheel ? "the radius found in the scan, 4.6e+08, is that of no wheel in any unit"
                        : "the width of the section found in the scan, 7.2e+07, is that of no rail in any unit"));
    EXPECT_THAT(error->message(),
                HasSubstr(wheel ? ": 4.6e+05 m in mm, 4.6e+08 m in m, 460 m in um, 1.168e+07 m in in"
                                : ": 7.2e+04 m in mm, 7.2e+07 m in m, 72 m in um, 1.829e+06 m in in"));
    EXPECT_THAT(error->advice(), HasSubstr("--unit"));
  }
}

TEST(Units, ThatWereGivenWronglyAreNamedWithTheRightOne) {
  struct Case {
    Body body;
    double size;
    LengthUnit given;
    const char *message, *advice;
  };
  for (const Case& c :
       {Case{Body::wheel, 460.0, LengthUnit::metre, "in m the radius would be 460 m, far too large",
             "with --unit mm it fits"},
        Case{Body::wheel, 460.0, LengthUnit::micrometre, "in um the radius would be 0.00046 m, far too small",
             "with --unit mm it fits"},
        Case{Body::wheel, 0.46, LengthUnit::millimetre, "in mm the radius would be 0.00046 m, far too small",
             "with --unit m it fits"},
        Case{Body::wheel, 18.1, LengthUnit::millimetre, "in mm the radius would be 0.0181 m, far too small",
             "with --unit in it fits"},
        Case{Body::wheel, 460e3, LengthUnit::millimetre, "in mm the radius would be 460 m, far too large",
             "with --unit um it fits"},
        Case{Body::wheel, 460e6, LengthUnit::millimetre, "in mm the radius would be 4.6e+05 m, far too large", ""},
        Case{Body::rail, 72.0, LengthUnit::inch, "in in the width of the section would be 1.829 m, far too large",
             "with --unit mm it fits"},
        Case{Body::rail, 2.83, LengthUnit::millimetre,
             "in mm the width of the section would be 0.00283 m, far too small", "with --unit in it fits"},
        Case{Body::rail, 0.072, LengthUnit::millimetre,
             "in mm the width of the section would be 7.2e-05 m, far too small", "with --unit m it fits"},
        Case{Body::rail, 72e6, LengthUnit::micrometre, "in um the width of the section would be 72 m, far too large",
             ""}}) {
    const auto error = tests::error_of([&] { check_unit(c.body, c.size, c.given); });
    ASSERT_TRUE(error) << c.message;
    EXPECT_EQ(error->kind(), ErrorKind::input_data);
    EXPECT_EQ(error->message(), c.message);
    const std::string other = c.body == Body::wheel ? "rail" : "wheel";
    EXPECT_EQ(error->advice(),
              fmt::format("{}{}is it a {} (--body {})?", c.advice, *c.advice != 0 ? "; or " : "", other, other));
  }
}

TEST(Units, OfARoughPlaceAreChangedThroughout) {
  RoughPlace place;
  place.elements.position = {Vec3(1.0, 2.0, 3.0), Vec3(-4.0, 5.0, 6.0)};
  place.elements.normal = {Vec3::UnitX(), Vec3::UnitZ()};
  place.elements.weight = {1.0f, 0.5f};
  place.elements.size = 2.0;
  place.elements.centre = {7.0, 8.0, 9.0};
  place.elements.radius = 10.0;
  place.elements.flat_part = 0.9;
  place.elements.spacing = 0.25;
  place.rough = {{Vec3(1.0, 0.0, -2.0), Vec3::UnitY()}, 0.8, 0.5};
  place.size = 460.0;
  scale(place, 0.5);
  EXPECT_EQ(place.elements.position[1], Vec3(-2.0, 2.5, 3.0));
  EXPECT_EQ(place.elements.normal[1], Vec3::UnitZ());
  EXPECT_EQ(place.elements.size, 1.0);
  EXPECT_EQ(place.elements.centre, Vec3(3.5, 4.0, 4.5));
  EXPECT_EQ(place.elements.radius, 5.0);
  EXPECT_EQ(place.elements.flat_part, 0.9);
  EXPECT_EQ(place.elements.spacing, 0.125);
  EXPECT_EQ(place.rough.axis.point, Vec3(0.5, 0.0, -1.0));
  EXPECT_EQ(place.rough.axis.direction, Vec3::UnitY());
  EXPECT_EQ(place.size, 230.0);
}

}  // namespace
}  // namespace treadmark::scans
