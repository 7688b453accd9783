// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What is read from sections whose right reading is known by construction: which side of a rail is worn, which way a
// tread without its flange points, where the back of a flange is, what a check rail and an outline are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/io/profiles/judge_profile.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/model/shape/surface_spec.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
namespace fs = std::filesystem;

using Points = std::vector<Vec2>;  // (y, z) [mm], z down
using Change = std::function<Vec2(const Vec2&)>;

constexpr double kApart = 0.05;  // [mm]

Points standard_points(const char* name) {
  const Profile profile = analytic::sample_profile(StandardProfile{name}, 0.2e-3);
  Points out;
  for (std::size_t i = 0; i < profile.y.size(); ++i) out.emplace_back(1e3 * profile.y[i], 1e3 * profile.z[i]);
  return out;
}

/// Head, web and foot, once round.
Points outline_points(const char* name) {
  Points out;
  for (const Vec2& p : library_outline(name, 0.2e-3)) out.push_back(1e3 * p);
  return out;
}

/// Points that fell together are one.
Points each(const Points& points, const Change& change) {
  Points out;
  for (const Vec2& p : points)
    if (const Vec2 q = change(p); out.empty() || (q - out.back()).norm() > kApart) out.push_back(q);
  return out;
}

Points those(Points points, const std::function<bool(const Vec2&)>& keep) {
  std::erase_if(points, [&](const Vec2& p) { return !keep(p); });
  return points;
}

Points noisy(Points points, double sigma) {
  std::mt19937 draw(7);
  std::normal_distribution<double> normal(0.0, sigma);
  for (Vec2& p : points) p += Vec2(normal(draw), normal(draw));
  return points;
}

/// How the file is written: as of a left rail or wheel, z up, from another origin.
struct Way {
  bool left = false, up = false;
  Vec2 origin = Vec2::Zero();
  double roll = 0.0;

  Points of(Points points) const {
    const Eigen::Rotation2Dd turn(roll);
    for (Vec2& p : points) {
      p = turn * p + origin;
      p = Vec2(left ? -p.x() : p.x(), up ? -p.y() : p.y());
    }
    return points;
  }
};

class Readings : public ::testing::Test {
 protected:
  fs::path write(const Points& points) {
    std::string text;
    for (const Vec2& p : points) text += fmt::format("{:.6f} {:.6f}\n", p.x(), p.y());
    return folder_.write(fmt::format("p{}.txt", ++count_), text);
  }
  io::SourcedProfile read(const Points& points, Body body) { return io::read_sourced_profile(write(points), body, {}); }
  /// Without comparing with nominal sections.
  io::ProfileJudgement judged(const Points& points, Body body) {
    return io::judge_profile(read(points, body), {{}, {}, false, {}});
  }
  static std::vector<std::string> names(const std::vector<io::ProfileRemark>& remarks) {
    std::vector<std::string> out;
    for (const io::ProfileRemark& remark : remarks) out.push_back(remark.name);
    return out;
  }
  std::vector<std::string> doubts(const Points& points, Body body) { return names(app::doubts_of(read(points, body))); }
  static std::string fact(const io::ProfileJudgement& judgement, const std::string& name) {
    for (const auto& [key, value] : judgement.facts)
      if (key == name) return value;
    return {};
  }

 private:
  TemporaryFolder folder_;
  int count_ = 0;
};

// --- the worn side of a rail

/// Half of the width of a head so far below its top.
double half_at(const Points& head, double z) {
  for (std::size_t i = head.size() - 1; i > 0; --i)
    if (head[i - 1].y() <= z && head[i].y() >= z)
      return head[i - 1].x() +
             (z - head[i - 1].y()) / (head[i].y() - head[i - 1].y()) * (head[i].x() - head[i - 1].x());
  return 0.0;
}

/// A face of 1:4 that has taken `side` away 14 mm below the nominal top, and a top that has lost `top`.
Change inclined_wear(const Points& head, double top, double side) {
  const double gauge = half_at(head, 14.0);
  return [=](const Vec2& p) {
    const double z = std::fabs(p.x()) < gauge ? std::max(p.y(), top + p.x() * p.x() / 520.0) : p.y();
    return Vec2(std::max(p.x(), -gauge + side + 0.25 * (14.0 - z)), z);
  };
}

/// An upright face and a level top.
Change upright_wear(const Points& head, double top, double side) {
  const double gauge = half_at(head, 14.0);
  return
      [=](const Vec2& p) { return Vec2(p.y() < 34.0 ? std::max(p.x(), -gauge + side) : p.x(), std::max(p.y(), top)); };
}

const std::vector<Way> kWays{
    {false, false, {0.0, 0.0}}, {false, true, {12.3, -7.1}}, {true, false, {0.0, 0.0}}, {true, true, {-753.5, 40.0}}};

TEST_F(Readings, AWornTopDoesNotHideTheWornSide) {
  for (const char* name : {"60E1", "54E1", "49E1"})
    for (const double top : {0.0, 0.3, 3.0})
      for (const double side : {3.0, 4.0}) {
        const Points head = standard_points(name), worn = noisy(each(head, inclined_wear(head, top, side)), 0.01);
        for (const Way& way : kWays) {
          const auto found = doubts(way.of(worn), Body::rail);
          EXPECT_EQ(std::count(found.begin(), found.end(), "gauge_side"), way.left ? 1 : 0)
              << name << ' ' << top << ' ' << side << ' ' << way.left;
          EXPECT_THAT(found, Not(Contains("upside_down")));
        }
      }
}

TEST_F(Readings, AnUprightWornFaceShowsInTheAxesOfTheRail) {
  for (const char* name : {"60E1", "54E1", "49E1"})
    for (const double top : {0.5, 2.0})
      for (const double side : {2.0, 4.0}) {
        const Points head = standard_points(name), worn = each(head, upright_wear(head, top, side));
        EXPECT_THAT(doubts(worn, Body::rail), Not(Contains("gauge_side"))) << name << top << side;
        EXPECT_THAT(doubts(Way{true}.of(worn), Body::rail), Contains("gauge_side")) << name << top << side;
      }
}

TEST_F(Readings, AWebShowsTheWornSideInAnyAxes) {
  for (const char* name : {"60E1", "54E1", "49E1"}) {
    const Points head = standard_points(name), outline = outline_points(name),
                 part = those(outline, [](const Vec2&p) { return p.y() < 85.0; });
    for (const Change& wear : {inclined_wear(head, 1.0, 3.0), upright_wear(head, 3.0, 4.0)})
      for (const bool left : {false, true})
        for (const Way& way : {Way{left, false}, Way{left, true, Vec2(-11.0, 23.0), 0.025}}) {
          for (const Points& points : {part, outline}) {
            const auto found = doubts(way.of(each(points, wear)), Body::rail);
            EXPECT_EQ(std::count(found.begin(), found.end(), "gauge_side"), left ? 1 : 0)
                << name << ' ' << left << ' ' << way.roll << ' ' << points.size();
          }
        }
  }
}

TEST_F(Readings, RailsThatAreWornAlikeOnBothSidesShowNoGaugeSide) {
  for (const LibraryProfile& row : profile_library()) {
    if (row.body != Body::rail || row.family || row.shape.find("inclined") != std::string::npos) continue;
    const Points head = standard_points(row.name.c_str());
    for (const double milled : {0.0, 2.0}) {
      const Points points = each(head, [&](const Vec2& p) { return Vec2(p.x(), std::max(p.y(), milled)); });
      EXPECT_THAT(doubts(Way{false, false, Vec2(-1.5, 0.0)}.of(points), Body::rail), Not(Contains("gauge_side")))
          << row.name << milled;
    }
  }
}

TEST_F(Readings, ALeftRailIsMeasuredMirroredOrDoubted) {
  constexpr double kMm = 1e3, kClose = 0.05;  // [mm] of noise and of the nominal section's arcs
  for (const char* name : {"60E1", "54E1"})
    for (const double top : {0.3, 3.0})
      for (const double side : {3.0, 4.0}) {
        const Points head = standard_points(name), worn = noisy(each(head, inclined_wear(head, top, side)), 0.01);
        app::MeasureRequest request;
        request.body = Body::rail;
        request.nominal = name;
        request.alignment = measures::RailAlignment::none;
        const auto measured = [&](const Points& points) {
          const app::MeasuredFile file = app::measure_file(write(points).string(), request);
          return std::pair{std::get<app::RailNumbers>(file.numbers), file.doubtful};
        };
        const auto [right, right_doubtful] = measured(worn);
        EXPECT_FALSE(right_doubtful);
        EXPECT_NEAR(kMm * right.w1.value, top, kClose);
        EXPECT_NEAR(kMm * right.w2.value, side, kClose);
        EXPECT_TRUE(measured(Way{true}.of(worn)).second) << name << top << side;
        request.mirror_y = true;
        const auto [left, left_doubtful] = measured(Way{true}.of(worn));
        EXPECT_FALSE(left_doubtful) << name << top << side;
        EXPECT_NEAR(left.w2.value, right.w2.value, 1e-6);
        EXPECT_TRUE(measured(worn).second) << name << top << side;
      }
}

// --- treads without a flange

Points tread(const char* name) {
  return those(standard_points(name), [](const Vec2& p) { return p.x() > -25.0; });
}

TEST_F(Readings, ATreadThatIsTurnedIsDoubtedAndOneInItsAxesIsNot) {
  for (const char* name : {"S1002", "EPS"}) {
    EXPECT_THAT(doubts(tread(name), Body::wheel), IsEmpty()) << name;
    EXPECT_THAT(read(tread(name), Body::wheel).source.notes, Contains(HasSubstr("no flange"))) << name;
    const auto half_turn = app::doubts_of(read(Way{true, true}.of(tread(name)), Body::wheel));
    ASSERT_THAT(names(half_turn), Contains("upside_down")) << name;
    EXPECT_THAT(half_turn.front().text, HasSubstr("mirror_y = true, mirror_z = \"yes\""));
    EXPECT_THAT(doubts(Way{false, true}.of(tread(name)), Body::wheel), Contains("upside_down")) << name;
    EXPECT_THAT(doubts(Way{true, false}.of(tread(name)), Body::wheel),
                ::testing::AnyOf(Contains("flange_side"), Contains("upside_down")))
        << name;
  }
}

TEST_F(Readings, AHollowTreadWithAFalseFlangeShowsNoSense) {
  const auto eased = [](double t) { return t <= 0.0 ? 0.0 : t >= 1.0 ? 1.0 : t * t * (3.0 - 2.0 * t); };
  const Points worn = each(tread("S1002"), [&](const Vec2& p) {
    const double t = (p.x() + 25.0) / 70.0, hollow = t < 1.0 ? 64.0 * std::pow(t * (1.0 - t), 2) : 0.0;
    return Vec2(p.x(), p.y() - hollow + 4.0 * eased((p.x() - 40.0) / 8.0));
  });
  for (const bool up : {false, true})
    EXPECT_THAT(doubts(Way{false, up}.of(worn), Body::wheel), Contains("upside_down")) << up;
}

// --- the back of a flange

/// S1002 with a straight back down to z = -40 and a burr on it: height and place [mm].
Points with_back(double burr, double at) {
  Points points = standard_points("S1002");
  for (double z = points.back().y() - 0.25; z > -40.0; z -= 0.25) points.emplace_back(-70.0, z);
  for (Vec2& p : points)
    if (p.x() < -67.0) p.x() -= burr * std::exp(-std::pow((p.y() - at) / 3.0, 2));
  return points;
}

TEST_F(Readings, ABurrDoesNotMoveTheBackOfTheFlange) {
  constexpr double kMm = 1e3, kClose = 0.01;  // [mm]
  for (const double burr : {0.0, 0.5, 1.5})
    for (const double at : {12.0, 4.0, -15.0})
      for (const Way& way : {Way{}, Way{true, false, Vec2(70.0, 0.0)}, Way{false, true, Vec2(760.0, 460.0)}}) {
        const Points points = way.of(with_back(burr, at));
        const io::ProfileJudgement seen = judged(points, Body::wheel);
        EXPECT_EQ(fact(seen, "flange back"), "y = -70.00 mm") << burr << ' ' << at;
        EXPECT_EQ(std::any_of(seen.notes.begin(), seen.notes.end(),
                              [](const std::string& note) { return note.find("burr") != std::string::npos; }),
                  burr > 0.0)
            << burr << ' ' << at;
        const app::MeasuredFile file = app::measure_file(write(points).string(), {});
        const auto& wheel = std::get<app::WheelNumbers>(file.numbers);
        EXPECT_NEAR(kMm * wheel.flange_thickness.value, 32.5, kClose) << burr << ' ' << at;
        EXPECT_NEAR(kMm * wheel.flange_height.value, 28.0, kClose) << burr << ' ' << at;
      }
}

TEST_F(Readings, ALongBackThatLeansIsDoubted) {
  const Points hollow = each(with_back(0.0, 0.0), [](const Vec2& p) {
    const double from = std::fabs(p.x() - 10.0) / 35.0;
    return Vec2(p.x(), p.y() - (from < 1.0 ? 2.0 * (1.0 + std::cos(3.14159265358979 * from)) : 0.0));
  });
  EXPECT_THAT(doubts(hollow, Body::wheel), Not(Contains("rolled")));
  for (const double roll : {-0.04, 0.04})
    EXPECT_THAT(doubts(Way{false, false, Vec2::Zero(), roll}.of(hollow), Body::wheel), Contains("rolled")) << roll;
}

// --- check rails

/// Beside the gauge side, its top so far above the running rail's.
Points with_check_rail(const Points& head, double above, double width) {
  constexpr double kDeep = 45.0, kFlangeway = 42.0, kChamfer = 2.0, kStep = 0.5;
  const double inner = head.front().x() - kFlangeway, outer = inner - width;
  const Points corners{{outer, kDeep},
                       {outer, kChamfer - above},
                       {outer + kChamfer, -above},
                       {inner - kChamfer, -above},
                       {inner, kChamfer - above},
                       {inner, kDeep},
                       {head.front().x(), kDeep},
                       head.front()};
  Points out;
  for (std::size_t k = 0; k + 1 < corners.size(); ++k) {
    const int count = std::max(1, static_cast<int>((corners[k + 1] - corners[k]).norm() / kStep));
    for (int i = 0; i < count; ++i) out.push_back(corners[k] + (corners[k + 1] - corners[k]) * i / count);
  }
  out.insert(out.end(), head.begin(), head.end());
  return out;
}

TEST_F(Readings, ACheckRailTurnsNothing) {
  for (const char* name : {"60E1", "49E1"})
    for (const bool worn : {false, true})
      for (const double above : {-10.0, 0.0, 5.0, 10.0, 15.0, 20.0, 25.0})
        for (const double width : {36.0, 60.0}) {
          const Points whole = standard_points(name), head = worn ? each(whole, inclined_wear(whole, 1.0, 3.0)) : whole;
          // 14 mm below a top that has lost 1 mm the face is a quarter of a millimetre farther out
          const double gauge = half_at(whole, 14.0) - (worn ? 3.0 - 0.25 : 0.0);
          const Points points = with_check_rail(head, above, width);
          for (const bool left : {false, true})
            for (const bool up : {false, true}) {
              const io::ProfileJudgement seen = judged(Way{left, up}.of(points), Body::rail);
              const std::string words = fmt::format("{} {} {} {} {} {}", name, worn, above, width, left, up);
              EXPECT_THAT(fact(seen, "turned"), HasSubstr(up ? "z mirrored" : "z as in the file")) << words;
              EXPECT_THAT(names(seen.remarks), Not(Contains("upside_down"))) << words;
              // a check rail stands on the gauge side
              const auto found = names(seen.remarks);
              EXPECT_EQ(std::count(found.begin(), found.end(), "gauge_side"), left ? 1 : 0) << words;
              const std::string place = fact(seen, "gauge point");
              ASSERT_THAT(place, HasSubstr("y = -")) << words;
              if (!left) {
                EXPECT_NEAR(std::stod(place.substr(place.find('-'))), -gauge, 0.1) << words;
              }
            }
        }
}

TEST_F(Readings, ASoundRailBesideACheckRailIsNotDoubted) {
  const Points head = standard_points("60E1");
  for (const double above : {-10.0, 5.0, 20.0})
    for (const bool up : {false, true})
      EXPECT_THAT(doubts(Way{false, up}.of(with_check_rail(head, above, 36.0)), Body::rail), IsEmpty()) << above;
}

// --- outlines

TEST_F(Readings, TheRimOfAWheelIsNoOutlineOfARail) {
  for (const double back : {30.0, 57.0, 75.0})
    for (const double field : {30.0, 57.0, 75.0}) {
      Points points;
      const Points wheel = standard_points("S1002");
      for (double z = -field; z < wheel.front().y() - 4.5; z += 0.5) points.emplace_back(64.0, z);
      points.emplace_back(64.0, wheel.front().y() - 4.0);
      points.insert(points.end(), wheel.begin(), wheel.end());
      for (double z = wheel.back().y() - 0.5; z > -back; z -= 0.5) points.emplace_back(-70.0, z);
      for (const Way& way : {Way{}, Way{true, true}})
        EXPECT_EQ(app::check_profile(write(way.of(points)), std::nullopt).body, Body::wheel) << back << ' ' << field;
    }
}

/// Without a foot down to a height, and whole; a whole one may begin anywhere.
TEST_F(Readings, OutlinesAreMeasuredByTheirWebAndFoot) {
  constexpr double kMm = 1e3, kClose = 0.02, kAngle = 2e-4;  // [mm], [rad]
  for (const char* name : {"60E1", "49E1"}) {
    const Points head = standard_points(name), outline = outline_points(name);
    std::vector<Points> parts;
    for (const double down : {95.0, 120.0})
      parts.push_back(those(outline, [&](const Vec2& p) { return p.y() < down; }));
    for (const std::size_t start : {std::size_t{0}, outline.size() / 4, outline.size() / 2}) {
      Points turned(outline.begin() + static_cast<std::ptrdiff_t>(start), outline.end());
      turned.insert(turned.end(), outline.begin(), outline.begin() + static_cast<std::ptrdiff_t>(start));
      parts.push_back(turned);
    }
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Points worn = each(parts[k], upright_wear(head, 2.0, 4.0));
      EXPECT_EQ(app::check_profile(write(worn), std::nullopt).body, Body::rail) << name << k;
      for (const Way& way : {Way{false, false, Vec2(5.0, -3.0), 0.025}, Way{true, true, Vec2(5.0, -3.0), 0.025}}) {
        const Points points = way.of(worn);
        const io::SourcedProfile seen = read(points, Body::rail);
        EXPECT_THAT(seen.source.notes, Contains(HasSubstr("contact takes its head"))) << name << k;
        EXPECT_LT(*std::max_element(seen.profile.z.begin(), seen.profile.z.end()) -
                      *std::min_element(seen.profile.z.begin(), seen.profile.z.end()),
                  45e-3)
            << name << k;
        app::MeasureRequest request;
        request.body = Body::rail;
        request.nominal = name;
        const std::string file = write(points).string();
        if (way.left) {
          EXPECT_TRUE(app::measure_file(file, request).doubtful) << name << k;
        }
        request.mirror_y = way.left;
        const app::MeasuredFile found = app::measure_file(file, request);
        const auto& rail = std::get<app::RailNumbers>(found.numbers);
        EXPECT_EQ(rail.alignment, measures::RailAlignment::unworn);
        EXPECT_NEAR(kMm * rail.w1.value, 2.0, kClose) << name << k << way.left;
        EXPECT_NEAR(kMm * rail.w2.value, 4.0, kClose) << name << k << way.left;
        EXPECT_NEAR(rail.inclination.value, -0.025, kAngle) << name << k << way.left;
        EXPECT_THAT(found.notes, Not(Contains(HasSubstr("gauge_side")))) << name << k << way.left;
      }
    }
  }
}

// --- what is said of files of another kind

void expect_refused(const std::string& file, const app::MeasureRequest& request, const char* words) {
  try {
    app::measure_file(file, request);
    ADD_FAILURE() << file << " was measured, expected: " << words;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::configuration);
    EXPECT_THAT(error.what(), HasSubstr(words));
  }
}

TEST_F(Readings, WhatBelongsToOtherKindsOfFilesIsRefused) {
  const std::string points = write(standard_points("60E1")).string();
  app::MeasureRequest request;
  request.body = Body::rail;
  for (const char* key : {"rail.shape.mirror_y=true", "foo.bar=7"}) {
    request.overrides = {key};
    for (const std::string& file : {points, std::string("60E1"), std::string("cloud.xyz"), std::string("rail.ply"),
                                    std::string("rail.slcs"), std::string("rail.vdb")})
      expect_refused(file, request, "--set changes keys of case files");
  }
  request.overrides.clear();
  request.scale_to_mm = 25.4;
  expect_refused("60E1", request, "scale belongs to");
  request.scale_to_mm = 1.0;
  request.mirror_y = true;
  for (const char* file : {"60E1", "rail.ply", "rail.slcs", "rail.vdb", "case.toml"})
    expect_refused(file, request, "mirror_y belongs to");
  for (const Body body : {Body::wheel, Body::rail})
    EXPECT_THROW(app::measure_request(body, io::given_settings(std::vector<std::string>{
                                                body == Body::wheel ? "line_mm=3" : "nominal_radius_mm=460"})),
                 Error);
}

TEST_F(Readings, ScansAreNeitherScaledNorMirrored) {
  TREADMARK_NEEDS("scans");
  app::MeasureRequest request;
  request.body = Body::rail;
  request.scale_to_mm = 25.4;
  expect_refused("cloud.xyz", request, "scale belongs to");
  request.scale_to_mm = 1.0;
  request.mirror_y = true;
  expect_refused("cloud.xyz", request, "mirror_y belongs to");
}

}  // namespace
}  // namespace treadmark::testing
