// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/judge_profile.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "samples.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::io {
namespace {

using testing::columns;
using testing::Point;
using testing::TemporaryFolder;
using testing::wheel;

/// A rail head [mm], z down: crown of radius 300 mm, corners of 13 mm, sides down to 30 mm.
std::vector<Point> head(double step = 0.5) {
  std::vector<Point> points;
  for (double z = 30.0; z > 14.0; z -= step) points.push_back({-36.0, z});
  for (double a = -90.0; a <= 0.0; a += 2.0)
    points.push_back({-23.0 + 13.0 * std::sin(a * M_PI / 180.0), 13.9 - 13.0 * std::cos(a * M_PI / 180.0)});
  for (double y = -22.5; y <= 22.5; y += step) points.push_back({y, y * y / 600.0});
  const std::size_t half = points.size();
  for (std::size_t i = half; i-- > 0;)
    if (points[i].y < -22.6) points.push_back({-points[i].y, points[i].z});
  return points;
}

std::vector<Point> mapped(std::vector<Point> points, double (*y)(Point), double (*z)(Point)) {
  for (Point& p : points) p = {y(p), z(p)};
  return points;
}

SourcedProfile read(const std::vector<Point>& points, Body body, const ProfileOptions& options = {}) {
  const TemporaryFolder folder;
  return read_sourced_profile(folder.write("p.txt", columns(points)), body, options);
}

std::vector<std::string> names(const ProfileJudgement& judgement) {
  std::vector<std::string> out;
  for (const ProfileRemark& remark : judgement.remarks) out.push_back(remark.name);
  return out;
}

std::string fact(const ProfileJudgement& judgement, const std::string& name) {
  for (const auto& [key, value] : judgement.facts)
    if (key == name) return value;
  return "none";
}

std::vector<std::string> doubts(const std::vector<Point>& points, Body body, const ProfileOptions& options = {},
                                const ExpectedProfile& expected = {}) {
  return names(judge_profile(read(points, body, options), expected));
}

using Names = std::vector<std::string>;

TEST(Judgement, CleanProfilesRaiseNoDoubt) {
  EXPECT_EQ(doubts(head(), Body::rail), Names{});
  EXPECT_EQ(doubts(wheel(), Body::wheel, {}, {-0.070, 0.46}), Names{});
  // z up, points in the other order
  auto up = mapped(
      wheel(), [](Point p) { return p.y; }, [](Point p) { return -p.z; });
  std::reverse(up.begin(), up.end());
  EXPECT_EQ(doubts(up, Body::wheel, {}, {-0.070, 0.46}), Names{});
}

TEST(Judgement, SaysWhatWasUnderstood) {
  const ProfileJudgement rail = judge_profile(read(head(), Body::rail));
  EXPECT_EQ(fact(rail, "y"), "-36.00 to 36.00 mm, to the right");
  EXPECT_EQ(fact(rail, "z"), "0.00 to 30.00 mm, down");
  EXPECT_EQ(fact(rail, "gauge point"), "y = -36.00 mm, 14 mm below the top");
  EXPECT_EQ(fact(rail, "unit"), "mm");
  EXPECT_EQ(fact(rail, "turned"), "y as in the file, z as in the file, order of the points as in the file");
  const ProfileJudgement round = judge_profile(read(wheel(), Body::wheel));
  EXPECT_EQ(fact(round, "flange back"), "y = -70.00 mm");
  EXPECT_NE(fact(round, "flange").find("tip at y = -58.00 mm, z = 28.00 mm"), std::string::npos);
}

TEST(Judgement, FlangeOnTheWrongSide) {
  const auto left = mapped(
      wheel(), [](Point p) { return -p.y; }, [](Point p) { return p.z; });
  EXPECT_EQ(doubts(left, Body::wheel), Names{});  // mirrored
  EXPECT_EQ(read(left, Body::wheel).source.notes.size(), 1u);
  EXPECT_TRUE(read(left, Body::wheel).source.mirrored_y);
  ProfileOptions mirror;
  mirror.mirror_y = -1;
  EXPECT_EQ(doubts(left, Body::wheel, mirror), Names{"flange_side"});
  mirror.mirror_y = 1;
  EXPECT_EQ(doubts(left, Body::wheel, mirror), Names{});
  EXPECT_EQ(doubts(wheel(), Body::wheel, mirror), Names{"flange_side"});
}

TEST(Judgement, FlangeBackElsewhere) {
  const auto miniprof = mapped(
      wheel(), [](Point p) { return p.y + 70.0; }, [](Point p) { return p.z; });
  EXPECT_EQ(doubts(miniprof, Body::wheel, {}, {-0.070, {}}), Names{});  // put on the tape line
  const std::vector<double> y = read(miniprof, Body::wheel).profile.y, wanted = read(wheel(), Body::wheel).profile.y;
  ASSERT_EQ(y.size(), wanted.size());
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], wanted[i], 1e-9);
  ProfileOptions as_in_file;
  as_in_file.placement = ProfileOptions::Placement::as_in_file;
  EXPECT_EQ(doubts(miniprof, Body::wheel, as_in_file, {-0.070, {}}), Names{"flange_back"});
  EXPECT_EQ(doubts(miniprof, Body::wheel, as_in_file, {0.0, {}}), Names{});
  EXPECT_EQ(doubts(miniprof, Body::wheel, as_in_file), Names{});  // nothing to compare with
}

TEST(Judgement, NominalRadiusOfTheFile) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.whl", "DiameterTaperline=840\nColumnDef=X,Y\n\n" + columns(wheel()));
  const SourcedProfile p = read_sourced_profile(file, Body::wheel, {});
  EXPECT_EQ(names(judge_profile(p, {{}, 0.46})), Names{"nominal_radius"});
  EXPECT_EQ(names(judge_profile(p, {{}, 0.42})), Names{});
}

TEST(Judgement, UnitsThatAreNotMillimetres) {
  const auto scaled = [](double factor) {
    auto points = wheel();
    for (Point& p : points) p = {factor * p.y, factor * p.z};
    return points;
  };
  const ProfileJudgement inches = judge_profile(read(scaled(1.0 / 25.4), Body::wheel));
  EXPECT_EQ(names(inches), Names{"unit"});
  EXPECT_NE(inches.remarks.at(0).text.find("set scale_to_mm = 25.4"), std::string::npos);
  EXPECT_EQ(doubts(scaled(0.1), Body::wheel), Names{"unit"});
  TREADMARK_EXPECT_ERROR(read(scaled(1e-3), Body::wheel), "is the file in metres? use a scale of 1000", 0, 0);
  TREADMARK_EXPECT_ERROR(read(scaled(1e3), Body::wheel), "is the file in micrometres? use a scale of 0.001", 0, 0);
}

TEST(Judgement, ExchangedColumns) {
  // a head whose z is read as y: seen as a rail it is refused or doubted, never taken without a word
  const auto exchanged = mapped(
      wheel(), [](Point p) { return p.z; }, [](Point p) { return p.y; });
  try {
    EXPECT_EQ(doubts(exchanged, Body::wheel), Names{"exchanged"});
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("exchanged"), std::string::npos) << error.what();
  }
  const auto rail = mapped(
      head(), [](Point p) { return p.z; }, [](Point p) { return p.y; });
  try {
    EXPECT_EQ(doubts(rail, Body::rail), Names{"exchanged"});
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("exchanged"), std::string::npos) << error.what();
  }
}

TEST(Judgement, UpsideDown) {
  ProfileOptions never;
  never.mirror_z = -1;
  const auto up = [](const std::vector<Point>& points) {
    return mapped(
        points, [](Point p) { return p.y; }, [](Point p) { return -p.z; });
  };
  EXPECT_EQ(doubts(up(wheel()), Body::wheel, never), Names{"upside_down"});
  EXPECT_EQ(doubts(up(head()), Body::rail, never), Names{"upside_down"});
}

TEST(Judgement, Gaps) {
  auto points = wheel();
  std::erase_if(points, [](const Point& p) { return p.y > 0.0 && p.y < 30.0; });
  EXPECT_EQ(doubts(points, Body::wheel), Names{"gap"});
  const ProfileJudgement judgement = judge_profile(read(points, Body::wheel));
  EXPECT_NE(judgement.remarks[0].text.find("a gap of 30 mm at y = 30.00 to 0.00 mm (lines 61 to 62)"),
            std::string::npos)
      << judgement.remarks[0].text;
}

TEST(Judgement, GaugeFaceOnTheOtherSide) {
  auto points = head();
  std::erase_if(points, [](const Point& p) { return p.y < -20.0; });
  EXPECT_EQ(doubts(points, Body::rail, {}, {{}, {}, false}), Names{"gauge_side"});
  EXPECT_EQ(doubts(points, Body::rail), (Names{"gauge_point", "gauge_side"}));
}

TEST(Faults, DropOutsAreRemovedAndNamed) {
  const Profile clean = read(head(), Body::rail).profile;
  auto points = head();
  points.insert(points.begin() + 20, {0.0, 0.0});
  points.insert(points.begin() + 90, {0.0, 0.0});
  const SourcedProfile zeros = read(points, Body::rail);
  EXPECT_EQ(zeros.profile.y, clean.y);
  ASSERT_EQ(zeros.source.notes.size(), 1u);
  EXPECT_EQ(zeros.source.notes[0], "2 points were removed, drop-outs at 0 0 (line 21 and on)");
  points = head();
  points.insert(points.begin() + 50, {-9999.0, -9999.0});
  points.push_back({36.5, -9999.0});
  const SourcedProfile marks = read(points, Body::rail);
  EXPECT_EQ(marks.profile.y, clean.y);
  EXPECT_EQ(marks.source.notes.at(0), "2 points were removed, marks of nothing measured (line 51 and on)");
  // a top at 0 0 is none
  EXPECT_TRUE(std::find(clean.y.begin(), clean.y.end(), 0.0) != clean.y.end());
  EXPECT_TRUE(read(head(), Body::rail).source.notes.empty());
  points.assign(30, {49.0, 30.0});
  for (int i = 0; i < 30; ++i) points[static_cast<std::size_t>(i)].y -= i;
  points.resize(70, {0.0, 0.0});
  for (int i = 0; i < 30; ++i) points.push_back({50.0 + i, 30.0});
  TREADMARK_EXPECT_ERROR(read(points, Body::rail), "40 of 100 points are drop-outs", 31, 0);
}

TEST(Faults, SpikesAreRefusedWithTheirLine) {
  for (const double height : {8.0, -8.0, 2.5}) {
    auto points = wheel();
    points[80].z += height;
    TREADMARK_EXPECT_ERROR(read(points, Body::wheel), "a spike of", 81, 0);
    points[81].z += height;
    const Error error = testing::error_thrown_by([&] { read(points, Body::wheel); });
    EXPECT_NE(std::string(error.what()).find("a spike of"), std::string::npos) << error.what();
  }
  auto points = wheel();
  points[80].z += 0.1;  // noise, which smoothing handles
  EXPECT_NO_THROW(read(points, Body::wheel));
}

TEST(Faults, ASecondProfileIsRefusedWithItsLine) {
  auto points = wheel();
  const auto second = wheel();
  const int line = static_cast<int>(points.size()) + 1;
  points.insert(points.end(), second.begin(), second.end());
  TREADMARK_EXPECT_ERROR(read(points, Body::wheel), "a second profile begins here", line, 0);
}

TEST(Judgement, RealProfilesRaiseNoFalseAlarm) {
  TREADMARK_REQUIRE_SHARED();
  int count = 0;
  for (const char* folder : {"contact_examples", "contact_testbank/profiles", "real/profiles", "geometry"})
    for (const auto& entry : std::filesystem::directory_iterator(*shared / "data" / folder)) {
      const std::string extension = entry.path().extension().string();
      std::optional<Body> body = profile_body(entry.path());
      if (extension == ".dat") body = entry.path().filename().string()[0] == 'R' ? Body::wheel : Body::rail;
      if (!body) continue;
      ProfileOptions options;  // inputs of the reference program say themselves where their wheels have their backs
      if (folder[0] == 'c') options.placement = ProfileOptions::Placement::reference;
      const SourcedProfile p = read_sourced_profile(entry.path(), *body, options);
      const ProfileJudgement judgement = judge_profile(p, {{}, {}, false});
      EXPECT_EQ(names(judgement), Names{})
          << entry.path() << (judgement.remarks.empty() ? "" : judgement.remarks[0].text);
      ++count;
    }
  EXPECT_GE(count, 20);
}

}  // namespace
}  // namespace treadmark::io
