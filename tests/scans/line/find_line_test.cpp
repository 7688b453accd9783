// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/line/find_line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "treadmark/scans/line/line_doubts.hpp"
#include "treadmark/scans/line/track_rails.hpp"
#include "treadmark/tests/scans/line/known_lines.hpp"
#include "treadmark/tests/scans/placement/cases.hpp"

namespace treadmark::scans {
namespace {

using ::testing::HasSubstr;
using tests::bent;
using tests::circle;
using tests::Clothoid;
using tests::Frames;

constexpr double kNoise = 30e-6;

/// Points of 60E1 along x, with or without a squat in the middle of it.
std::vector<Vec3> straight_rail(double length, double per_metre, bool squat, std::uint64_t seed = 1,
                                double from = 0.0) {
  SurfaceSpec spec{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  if (squat)
    spec.defects.squats.push_back({.length = 40e-3, .width = 30e-3, .depth = 0.5e-3, .x_center = from + 0.5 * length});
  const auto surface = create_surface(spec);
  constexpr int kAcross = 60;
  return tests::simple_cloud(*surface, Body::rail, from, from + length, -35.5e-3, 35.5e-3,
                             static_cast<int>(per_metre * length / kAcross), kAcross, kNoise, 0.0, {}, seed)
      .points_C;
}

/// As import does: by a piece where the rail is long.
FoundLine found_in(const std::vector<Vec3>& points, const RailLine* given = nullptr) {
  const SurfaceElements whole = look_for_elements(points);
  const auto piece = find_piece(points, {}, whole, LengthUnit::metre);
  PlaceSettings settings;
  const RoughPlace base = piece ? *piece : find_roughly(points, {}, Body::rail);
  return find_line(points, {}, base, whole, settings, given);
}

/// How far the line lies off a true one but for a shift, and the largest error of its bend, away from its ends.
struct LineError {
  double across = 0.0, bend = 0.0, stated = 0.0;
};
LineError error_of(const FoundLine& found, const Frames& truth, const std::function<double(double)>& bend, double from,
                   double to, double margin) {
  // the origin of the section is a choice: the same all along
  LineError out;
  const RailLine& line = found.line;
  Vec2 shift = Vec2::Zero();
  bool first = true;
  for (double s = from + margin; s <= to - margin; s += 0.1) {
    const Pose frame = truth(s);
    const double at = line.nearest(frame.origin);
    const auto place = line.locate(frame.origin, at);
    EXPECT_TRUE(place.has_value());
    if (!place) continue;
    const Vec2 off(place->y(), place->z());
    if (first) shift = off, first = false;
    out.across = std::max(out.across, (off - shift).norm());
    const LineTurn turn = line.turn(place->x());
    // both in the axes of the section, which may be rolled against those of the truth
    out.bend = std::max(out.bend, std::fabs(std::hypot(turn.lateral, turn.vertical) - std::fabs(bend(s))));
  }
  for (const LineStation& station : found.stations) out.stated = std::max(out.stated, station.error.lateral);
  return out;
}

TEST(FindLine, StraightRailsStayStraight) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const FoundLine found = found_in(straight_rail(0.6, 200e3, true, seed));
    EXPECT_FALSE(found.bent) << "a squat is no bend " << seed;
    EXPECT_GT(found.stations.front().error.lateral, 0.0);
  }
  EXPECT_FALSE(found_in(straight_rail(6.0, 30e3, true)).bent);
}

TEST(FindLine, CurvesOfManyRadii) {
  for (const double radius : {300.0, -1000.0, 5000.0}) {
    const double length = 10.0;
    const Frames truth = circle(1.0 / radius, 0.05);
    const FoundLine found = found_in(bent(straight_rail(length, 30e3, true), truth, tests::some_frame(7)));
    EXPECT_TRUE(found.bent) << radius;
    const Pose X_CL = tests::some_frame(7);
    const Frames in_cloud = [&](double s) { return X_CL * truth(s); };
    const LineError error = error_of(
        found, in_cloud, [=](double) { return 1.0 / radius; }, 0.0, length, 0.2);
    constexpr double kAlignment = 0.2e-3, kPart = 0.01;  // as asked for
    EXPECT_LT(error.across, kAlignment) << radius;
    EXPECT_LT(error.bend, std::max(kPart / std::fabs(radius), 4.0 * error.stated)) << radius;
    EXPECT_LT(error.stated, kPart / std::fabs(radius)) << radius;
    EXPECT_TRUE(found.kinks.empty()) << radius;
  }
}

TEST(FindLine, AShortPieceSaysHowWellItKnows) {
  constexpr double kRadius = 300.0;
  const FoundLine found = found_in(bent(straight_rail(0.5, 300e3, false), circle(1.0 / kRadius)));
  ASSERT_TRUE(found.bent);
  const LineStation& middle = found.stations[found.stations.size() / 2];
  EXPECT_NEAR(middle.turn.lateral, 1.0 / kRadius, 4.0 * middle.error.lateral);
  EXPECT_LT(middle.error.lateral, 0.2 / kRadius);
}

TEST(FindLine, TransitionWithCant) {
  const Clothoid line{15.0, 30.0, 1.0 / 300.0, 0.08};
  constexpr double kLength = 60.0;
  const Frames truth = line.frames(-1.0, kLength + 1.0);
  const FoundLine found = found_in(bent(straight_rail(kLength, 8e3, true), truth));
  ASSERT_TRUE(found.bent);
  const LineError error = error_of(
      found, truth, [&](double s) { return line.bend(s); }, 0.0, kLength, 1.0);
  EXPECT_LT(error.across, 0.2e-3);
  EXPECT_LT(error.bend, 0.01 * line.curvature);
  // the cant's ramp
  double twist = 0.0, count = 0.0;
  for (const LineStation& station : found.stations)
    if (const Vec3 p = found.line.position(station.along); p.x() > 20.0 && p.x() < 40.0)
      twist += station.turn.twist, count += 1.0;
  EXPECT_NEAR(twist / count, line.cant_angle / line.length, 0.02 * line.cant_angle / line.length);
}

/// Where the bend of the rail begins to grow at once, splines that are too long would leave what looks like damage.
TEST(FindLine, ShortTransitionsLeaveNoDamage) {
  const Clothoid line{2.0, 4.0, 1.0 / 300.0, 10e-3 / 1.5};
  constexpr double kLength = 10.0, kFlat = 20e-6;
  const Frames truth = line.frames(-1.0, kLength + 1.0);
  const FoundLine found = found_in(bent(straight_rail(kLength, 30e3, true), truth));
  ASSERT_TRUE(found.bent);
  const LineError error = error_of(
      found, truth, [&](double s) { return line.bend(s); }, 0.0, kLength, 0.5);
  EXPECT_LT(error.across, kFlat);
}

TEST(FindLine, StraightenedPointsLieOnTheStraightRail) {
  const std::vector<Vec3> straight = straight_rail(10.0, 30e3, false);
  std::vector<Vec3> points = bent(straight, circle(1.0 / 300.0));
  const FoundLine found = found_in(points);
  found.line.straighten(points);
  // distances between places far apart along the rail come back: some 3 mm beside the line shift by 1e-5 of the length
  const double length = (points.back() - points.front()).x() - (straight.back() - straight.front()).x();
  EXPECT_LT(std::fabs(length), 5e-3);
  double low = 1e9, high = -1e9;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double off = points[k].z() - straight[k].z();
    low = std::min(low, off), high = std::max(high, off);
  }
  // the frame may be rolled as a whole; heights do not wander along the rail by more than that
  EXPECT_LT(high - low, 2e-3);
}

TEST(FindLine, DoubtsByPlace) {
  std::vector<Vec3> points = straight_rail(6.0, 30e3, false);
  std::erase_if(points, [](const Vec3& p) { return p.x() > 2.0 && p.x() < 4.0; });
  points = bent(points, circle(1.0 / 300.0));
  const FoundLine gap = found_in(points);
  EXPECT_LT(std::fabs(gap.line.length() - 6.0), 0.05);
  ASSERT_EQ(gap.gaps.size(), 1u);
  EXPECT_NEAR(gap.gaps.front().to - gap.gaps.front().from, 2.0, 0.5);
  const auto named = [](const std::vector<measured::Doubt>& doubts, const std::string& name) {
    return std::any_of(doubts.begin(), doubts.end(), [&](const measured::Doubt& d) { return d.name == name; });
  };
  EXPECT_TRUE(named(line_doubts(points, {}, {}, gap), "line_gap"));
  EXPECT_FALSE(named(line_doubts(points, {}, {}, gap), "several_rails"));

  const Frames curve = circle(1.0 / 300.0);
  std::vector<Vec3> both = straight_rail(6.0, 30e3, false), other = both;
  for (Vec3& p : other) p.y() += 1.5;
  const std::size_t one = both.size();
  both.insert(both.end(), other.begin(), other.end());
  both = bent(both, curve);
  std::vector<Vec3> alone(both.begin(), both.begin() + static_cast<std::ptrdiff_t>(one));
  FoundLine found = found_in(alone);
  EXPECT_TRUE(named(line_doubts(both, {}, {}, found), "several_rails"));

  // in the order of a trolley that goes back from 4 m to 2 m
  std::vector<Vec3> order = straight_rail(4.0, 30e3, false, 1), back = straight_rail(2.0, 30e3, false, 2, 2.0),
                    rest = straight_rail(4.0, 30e3, false, 3, 2.0);
  const auto by_x = [](const Vec3& a, const Vec3& b) { return a.x() < b.x(); };
  std::sort(order.begin(), order.end(), by_x);
  std::sort(back.rbegin(), back.rend(), by_x);
  std::sort(rest.begin(), rest.end(), by_x);
  order.insert(order.end(), back.begin(), back.end());
  order.insert(order.end(), rest.begin(), rest.end());
  order = bent(order, curve);
  found = found_in(order);
  const auto doubts = line_doubts(order, {}, {}, found);
  ASSERT_TRUE(named(doubts, "backward_run"));
  EXPECT_THAT(doubts.front().text, HasSubstr("go back"));
  std::vector<Vec3> once = straight_rail(6.0, 30e3, false);
  std::sort(once.begin(), once.end(), by_x);
  once = bent(once, curve);
  EXPECT_FALSE(named(line_doubts(once, {}, {}, found_in(once)), "backward_run"));
}

/// Two straights that meet at an angle: the line rounds it over the metre that its splines are long, and says so.
TEST(FindLine, KinksAreTold) {
  constexpr double kAngle = 4e-3, kAt = 3.0, kLength = 6.0;
  const Frames kink = [=](double s) {
    const double on = std::max(0.0, s - kAt);
    return Pose{Vec3(std::min(s, kAt) + on * std::cos(kAngle), on * std::sin(kAngle), 0.0),
                rotation_z(s < kAt ? 0.0 : kAngle)};
  };
  const std::vector<Vec3> points = bent(straight_rail(kLength, 30e3, false), kink);
  const FoundLine found = found_in(points);
  ASSERT_FALSE(found.kinks.empty());
  bool is_there = false;
  for (const LineKink& one : found.kinks)
    if (one.from - found.line.from() < kAt && one.to - found.line.from() > kAt) {
      is_there = true;
      // no more than the rounding of the angle over a spline
      EXPECT_GT(one.off, 20e-6);
      EXPECT_LT(one.off, kAngle * 1.5);
    }
  EXPECT_TRUE(is_there);
  const auto doubts = line_doubts(points, {}, {}, found);
  ASSERT_FALSE(doubts.empty());
  EXPECT_EQ(doubts.front().name, "line_kink");
  EXPECT_THAT(doubts.front().text, HasSubstr("it bends more suddenly than"));
}

TEST(FindLine, TracksAndSwitchesByPlace) {
  constexpr double kLength = 12.0;
  const Frames curve = circle(1.0 / 300.0);
  const std::vector<Vec3> own = straight_rail(kLength, 8e3, false);
  const auto beside = [&](double at, double rate) {
    std::vector<Vec3> out = own;
    for (Vec3& p : out) p.y() += at + rate * p.x();
    return out;
  };
  const FoundLine found = found_in(bent(own, curve));
  const auto doubts_with = [&](const std::vector<std::vector<Vec3>>& others) {
    std::vector<Vec3> all = own;
    for (const std::vector<Vec3>& other : others) all.insert(all.end(), other.begin(), other.end());
    std::string out;
    for (const measured::Doubt& doubt : line_doubts(bent(all, curve), {}, {}, found))
      out += doubt.name + ": " + doubt.text;
    return out;
  };
  const std::string tracks = doubts_with({beside(1.5, 0.0), beside(4.0, 0.0), beside(-2.5, 0.0)});
  for (const char* place :
       {"1\\.(49|50|51) m to its right", "(3\\.99|4\\.00|4\\.01) m to its right", "2\\.(49|50|51) m to its left"})
    EXPECT_THAT(tracks, ::testing::ContainsRegex(place));
  EXPECT_THAT(tracks, ::testing::Not(HasSubstr("switch: ")));
  const std::string turnout = doubts_with({beside(-1.3, 1.0 / kLength)});
  EXPECT_THAT(turnout, HasSubstr("switch: "));
  EXPECT_THAT(turnout, HasSubstr("one comes nearer"));
  EXPECT_THAT(turnout, HasSubstr("to its left"));
}

TEST(TrackRails, AreToldApart) {
  constexpr double kLength = 6.0, kApart = 1.507;
  const Pose X_CL = tests::some_frame(5);
  const Frames curve = circle(-1.0 / 300.0, 0.06);
  std::vector<Vec3> one = straight_rail(kLength, 15e3, false, 1), other = straight_rail(kLength, 15e3, false, 2);
  const std::vector<Vec3> alone = bent(one, curve, X_CL);
  const FoundLine found = found_in(alone);
  for (Vec3& p : other) p.y() += kApart;
  std::vector<Vec3> all = one;
  all.insert(all.end(), other.begin(), other.end());
  Random random(3);
  constexpr std::size_t kBallast = 40'000;
  for (std::size_t k = 0; k < kBallast; ++k)
    all.emplace_back(kLength * random.uniform(), 3.0 * random.uniform() - 0.8, 0.27 + 0.05 * random.uniform());
  const TrackRails rails = separate_rails(bent(all, curve, X_CL), found.line);
  // the line may run either way, and right is where it is then
  const bool along = found.line.at(0.5 * (found.line.from() + found.line.to()))
                         .rotation.col(0)
                         .dot((X_CL * curve(0.5 * kLength)).rotation.col(0)) > 0.0;
  const TrackRail first = along ? TrackRail::left : TrackRail::right,
                  second = along ? TrackRail::right : TrackRail::left;
  EXPECT_EQ(rails.other, second);
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    const TrackRail truth = k < one.size() ? first : k < one.size() + other.size() ? second : TrackRail::none;
    wrong += rails.of_point[k] != truth ? 1 : 0;
  }
  EXPECT_EQ(wrong, 0u);
  const auto error = tests::error_of([&] { separate_rails(alone, found.line); });
  ASSERT_TRUE(error);
  EXPECT_THAT(error->message(), HasSubstr("lies no other"));
}

TEST(FindLine, FollowsAGivenLineAcrossAGap) {
  const Frames truth = circle(1.0 / 300.0);
  std::vector<Vec3> points = straight_rail(20.0, 15e3, false), guide;
  std::erase_if(points, [](const Vec3& p) { return p.x() > 6.0 && p.x() < 14.0; });
  points = bent(points, truth);
  for (double s = 0.0; s <= 20.0; s += 1.0) guide.push_back(truth(s).apply({0.0, 0.03, 0.02}));
  const RailLine given = line_through(guide, -Vec3::UnitZ());
  const FoundLine found = found_in(points, &given);
  EXPECT_NEAR(found.line.length(), 20.0, 0.1);
}

TEST(FindLine, APieceTellsTheUnit) {
  std::vector<Vec3> points = bent(straight_rail(40.0, 15e3, false), circle(1.0 / 300.0));
  for (const double per_metre : {1e3, 1.0, 1e6}) {
    std::vector<Vec3> in_unit = points;
    for (Vec3& p : in_unit) p *= per_metre;
    const auto piece = find_piece(in_unit, {}, look_for_elements(in_unit), std::nullopt);
    ASSERT_TRUE(piece.has_value()) << per_metre;
    EXPECT_NEAR(piece->size / per_metre, 0.06, 0.025) << "most of the head's width in unit 1 / " << per_metre;
  }
}

/// Seen from a frame that is level, in a track with cant, and with sleepers that have as many points as the heads.
TEST(TrackRails, AreToldFromSleepers) {
  constexpr double kLength = 6.0, kApart = 1.507, kLower = 0.15, kSleepers = 0.172;
  const Frames curve = circle(1.0 / 300.0);
  const FoundLine found = found_in(bent(straight_rail(kLength, 15e3, false), curve));
  std::vector<Vec3> all = straight_rail(kLength, 3e3, false, 1), other = straight_rail(kLength, 3e3, false, 2);
  for (Vec3& p : other) p += Vec3(0.0, kApart, kLower);
  const std::size_t one = all.size();
  all.insert(all.end(), other.begin(), other.end());
  const std::size_t both = all.size();
  Random random(3);
  constexpr std::size_t kOfSleepers = 600'000;
  for (std::size_t k = 0; k < kOfSleepers; ++k) {
    const double y = 2.7 * random.uniform() - 0.6;
    all.emplace_back(kLength * random.uniform(), y, kSleepers + y * kLower / kApart + 5e-3 * random.uniform());
  }
  const TrackRails rails = separate_rails(bent(all, curve), found.line);
  EXPECT_EQ(rails.other, TrackRail::right);
  std::size_t wrong = 0;
  for (std::size_t k = 0; k < both; ++k)
    wrong += rails.of_point[k] == (k < one ? TrackRail::left : TrackRail::right) ? 0 : 1;
  EXPECT_EQ(wrong, 0u);
}

TEST(LineThrough, RefusesWhatIsNoLine) {
  const std::vector<Vec3> one{Vec3::Zero()}, twice{Vec3::Zero(), Vec3::Zero()},
      back{Vec3::Zero(), Vec3(2.0, 0.0, 0.0), Vec3(1.0, 0.1, 0.0)};
  EXPECT_THROW(line_through(one, -Vec3::UnitZ()), Error);
  EXPECT_THROW(line_through(twice, -Vec3::UnitZ()), Error);
  const auto error = tests::error_of([&] { line_through(back, -Vec3::UnitZ()); });
  ASSERT_TRUE(error);
  EXPECT_THAT(error->message(), HasSubstr("turns back at its point 2"));
}

/// A track of a satellite receiver: centimetres of scatter, a step that lasts, a point that is off by itself.
TEST(LineThrough, JumpsAreNotFollowed) {
  constexpr double kLength = 40.0, kStep = 0.5, kScatter = 5e-3;
  const Frames truth = circle(1.0 / 300.0);
  Random random(11);
  std::vector<Vec3> guide;
  for (int k = 0; k <= static_cast<int>(kLength / kStep); ++k) {
    const double s = kStep * k;
    Vec3 p = truth(s).apply(kScatter * Vec3(tests::gaussian(random), tests::gaussian(random), tests::gaussian(random)));
    if (k > 24) p += truth(s).rotation.col(1) * 0.8;
    if (k == 44) p += Vec3(0.0, 0.0, 1.0);
    guide.push_back(p);
  }
  std::vector<LineJump> jumps;
  const RailLine line = line_through(guide, -Vec3::UnitZ(), &jumps);
  ASSERT_EQ(jumps.size(), 3u);
  constexpr double kPlace = 0.4, kSize = 0.1;
  EXPECT_NEAR(jumps[0].along, 12.0, kPlace);
  EXPECT_NEAR(jumps[0].size, 0.8, kSize);
  EXPECT_NEAR(jumps[1].along, 21.5, kPlace);
  EXPECT_NEAR(jumps[2].size, 1.0, kSize);
  // as if there had been none: a circle from end to end, within what the scatter at the jumps leaves
  constexpr double kOff = 0.08;
  for (double s = 0.0; s <= kLength; s += 1.0) {
    const Vec3 p = truth(s).origin;
    const auto place = line.locate(p, line.nearest(p));
    ASSERT_TRUE(place.has_value()) << s;
    EXPECT_LT(std::hypot(place->y(), place->z()), kOff) << s;
  }
  // scatter is evened out: followed from point to point it would be some 0.06 1/m
  for (double s = 1.0; s < kLength - 1.0; s += 0.5)
    EXPECT_LT(std::hypot(line.turn(s).lateral, line.turn(s).vertical), 3.0 / 300.0) << s;
  std::vector<LineJump> none;
  std::vector<Vec3> exact;
  for (double s = 0.0; s <= kLength; s += 5.0) exact.push_back(truth(s).origin);
  line_through(exact, -Vec3::UnitZ(), &none);
  EXPECT_TRUE(none.empty());
}

TEST(LineThrough, DensePointsAreThinned) {
  constexpr double kLength = 20.0;
  const Frames truth = circle(1.0 / 300.0);
  std::vector<Vec3> guide;
  for (int k = 0; k <= 20'000; ++k) guide.push_back(truth(kLength * k / 20'000.0).origin);
  const RailLine line = line_through(guide, -Vec3::UnitZ());
  EXPECT_NEAR(line.length(), kLength, 1e-3);
  EXPECT_LT((line.position(line.to()) - guide.back()).norm(), 5e-3);
}

TEST(LineThrough, PassesThroughItsPoints) {
  const Frames truth = circle(1.0 / 300.0);
  std::vector<Vec3> guide;
  for (double s = 0.0; s <= 60.0; s += 5.0) guide.push_back(truth(s).origin);
  const RailLine line = line_through(guide, -Vec3::UnitZ());
  for (const Vec3& p : guide) {
    const auto place = line.locate(p, line.nearest(p));
    ASSERT_TRUE(place.has_value());
    constexpr double kFreeEnds = 8e-3;  // splines end straight: some 0.07 h^2/R off a circle there
    EXPECT_LT(std::hypot(place->y(), place->z()), kFreeEnds);
  }
}

}  // namespace
}  // namespace treadmark::scans
