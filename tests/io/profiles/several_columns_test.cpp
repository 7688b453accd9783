// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "samples.hpp"
#include "treadmark/io/profiles/judge_profile.hpp"

namespace treadmark::io {
namespace {

using testing::columns;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::parse;
using testing::Point;
using testing::TemporaryFolder;
using testing::wheel;

/// Lines of a header and of the wheel, each point as the format says of (y, z) and (y, z + 1): another wheel.
template <class Line>
std::string wheel_lines(const std::string& header, const Line& line) {
  std::string text = header + "\n";
  int count = 0;
  for (const Point& p : wheel()) text += line(++count, p) + "\n";
  return text;
}

std::string two_wheels(const std::string& header) {
  return wheel_lines(header,
                     [](int, Point p) { return fmt::format("{:.6f};{:.6f};{:.6f};{:.6f}", p.y, p.z, p.y, p.z + 1.0); });
}

SourcedProfile sourced(const std::string& text) {
  const TemporaryFolder folder;
  return read_sourced_profile(folder.write("p.csv", text), Body::wheel, {});
}

std::vector<std::string> doubts_in(const std::string& text) {
  std::vector<std::string> out;
  for (const ProfileRemark& remark : judge_profile(sourced(text)).remarks) out.push_back(remark.name);
  return out;
}

std::string notes_of(const std::string& text) {
  std::string out;
  for (const std::string& note : sourced(text).source.notes) out += note + "\n";
  return out;
}

ProfileOptions as_they_are() {
  ProfileOptions options;
  options.placement = ProfileOptions::Placement::as_in_file;
  options.smoothing = {};
  return options;
}

double largest(const Profile& p) { return *std::max_element(p.z.begin(), p.z.end()); }

TEST(SideBySide, SeveralProfilesAreRefusedByTheirNames) {
  for (const char* header : {"yL;zL;yR;zR", "y1;z1;y2;z2", "y left [mm];z left [mm];y right [mm];z right [mm]",
                             "Y_1;Z_1;Y_2;Z_2", "y;z;y2;z2", "lateral A;height A;lateral B;height B"}) {
    SCOPED_TRACE(header);
    TREADMARK_EXPECT_ERROR(parse(two_wheels(header), Body::wheel), "the columns hold several profiles: 1 (", 1, 1);
    TREADMARK_EXPECT_ERROR(parse(two_wheels(header), Body::wheel), "'sample#1' to '#2'", 1, 1);
  }
  const std::string numbered = wheel_lines(
      "Messpunkt;Rad links y;Rad links z;Rad rechts y;Rad rechts z",
      [](int n, Point p) { return fmt::format("{};{:.6f};{:.6f};{:.6f};{:.6f}", n, p.y, p.z, p.y, p.z + 1.0); });
  TREADMARK_EXPECT_ERROR(parse(numbered, Body::wheel), "2 (Rad rechts y, Rad rechts z)", 1, 1);
  const std::string shared = wheel_lines(
      "y;z left;z right", [](int, Point p) { return fmt::format("{:.6f};{:.6f};{:.6f}", p.y, p.z, p.z + 1.0); });
  TREADMARK_EXPECT_ERROR(parse(shared, Body::wheel), "1 (y, z left), 2 (y, z right)", 1, 1);
}

TEST(SideBySide, ANumberBehindTheNameChoosesOne) {
  const std::string text = two_wheels("yL;zL;yR;zR");
  const TemporaryFolder folder;
  const std::string file = folder.write("p.csv", text).string();
  const double first = largest(read_profile(file + "#1", Body::wheel, as_they_are())),
               second = largest(read_profile(file + "#2", Body::wheel, as_they_are()));
  EXPECT_NEAR(second - first, 1e-3, 1e-9);
  TREADMARK_EXPECT_ERROR(read_profile(file + "#3", Body::wheel, {}), "there is no profile 3 in the file", 1, 1);
  const std::string one = folder.write("one.csv", columns(wheel())).string();
  EXPECT_EQ(read_profile(one + "#1", Body::wheel, {}).y.size(), wheel().size());
  TREADMARK_EXPECT_ERROR(read_profile(one + "#2", Body::wheel, {}), "there is no profile 2", 0, 0);
}

TEST(SideBySide, WhatBelongsToOneProfileIsNotSeveral) {
  const Profile expected = parse(columns(wheel()), Body::wheel);
  const auto of_one = [&](const char* header, auto line) { return parse(wheel_lines(header, line), Body::wheel); };
  const auto with_more = [](int n, Point p) { return fmt::format("{:.6f};{:.6f};{:.6f}", p.y, p.z, 0.01 * n); };
  for (const char* header : {"y;z;z deviation", "y;z;z raw", "y left;z left;temperature", "y;z;y2", "Y1;Z1;t"})
    EXPECT_EQ(of_one(header, with_more).z, expected.z) << header;
  const auto three = [](int, Point p) { return fmt::format("12.5;{:.6f};{:.6f}", p.y, p.z); };
  for (const char* header : {"x;y;z", "x1;y1;z1", "X left;Y left;Z left"})
    EXPECT_EQ(of_one(header, three).z, expected.z) << header;
  EXPECT_THAT(doubts_in(wheel_lines("y left;z left;temperature", with_more)), IsEmpty());
}

TEST(SideBySide, ColumnsWithoutNamesAreDoubtedWhereAnotherProfileMayStand) {
  std::string text = two_wheels("");
  text.erase(0, 1);
  EXPECT_THAT(doubts_in(text), ElementsAre("columns"));
  EXPECT_THAT(judge_profile(sourced(text)).remarks.at(0).text, HasSubstr("column 4 runs as column 2 does"));
  // weights, curvatures, angles and arc lengths are none
  for (const double size : {0.0, 0.01, 60.0}) {
    std::string one;
    for (const Point& p : wheel()) one += fmt::format("{:.6f} {:.6f} {:.6f}\n", p.y, p.z, size * (60.0 - p.y) / 60.0);
    EXPECT_THAT(doubts_in(one), IsEmpty()) << size;
    EXPECT_EQ(notes_of(one).find("columns not used: 3") != std::string::npos, size > 0.0) << size;
  }
}

TEST(SideBySide, NamesThatAreNotKnownAreSaid) {
  const auto two = [](int, Point p) { return fmt::format("{:.6f};{:.6f}", p.y, p.z); };
  const auto three = [](int n, Point p) { return fmt::format("{:.6f};{:.6f};{:.6f}", p.y, p.z, 20.0 + 0.01 * n); };
  // one is known, the other is not: what it holds is a guess
  EXPECT_THAT(doubts_in(wheel_lines("y;dR", two)), ElementsAre("columns"));
  EXPECT_THAT(doubts_in(wheel_lines("y;z deviation", two)), ElementsAre("columns"));
  EXPECT_THAT(judge_profile(sourced(wheel_lines("y;dR", two))).remarks.at(0).text,
              HasSubstr("column 'y' was taken as y, column 'dR' as z"));
  // of more columns than two the choice is a guess, too
  EXPECT_THAT(doubts_in(wheel_lines("across;down;warmth", three)), ElementsAre("columns"));
  // of two there is none, and which is which the shape tells
  EXPECT_THAT(doubts_in(wheel_lines("across;down", two)), IsEmpty());
  EXPECT_THAT(notes_of(wheel_lines("across;down", two)), HasSubstr("line 1 does not name both y and z"));
  // other words for them, and titles
  for (const char* header :
       {"Quer;H\xC3\xB6he", "Quer;Hoehe", "Lateral [mm];Vertical [mm]", "Distance;Height", "Wheel 7 of the left side"})
    EXPECT_THAT(doubts_in(wheel_lines(header, two)), IsEmpty()) << header;
  EXPECT_THAT(doubts_in("# left wheel, z down\n" + columns(wheel())), IsEmpty());
}

TEST(UnitsOfColumns, OnlyWordsThatSayTheUnitOfLengthsCount) {
  const auto size = [](const std::string& head) {
    const Profile p = parse(head + "\n" + columns(wheel()), Body::wheel, as_they_are());
    return p.y.front() - p.y.back();
  };
  const double mm = 0.130;
  for (const char* head : {"# scanner calibrated in m, speed 2 m/s", "# speed unit: m/s", "# unit of speed is m",
                           "# stations every 1 in; numbers in mm", "# made in 3 m", "# all values in mm",
                           "# unit: 1 mm", "# units = 1.000 mm"})
    EXPECT_NEAR(size(head), mm, 1e-9) << head;
  std::string inches = "# coordinates in inches\n";
  for (const Point& p : wheel()) inches += fmt::format("{:.8f} {:.8f}\n", p.y / 25.4, p.z / 25.4);
  EXPECT_NEAR(parse(inches, Body::wheel, as_they_are()).y.front(), 0.060, 1e-8);
}

TEST(UnitsOfColumns, UnitsThatAreNotConvertedAreNamed) {
  const auto scaled = [](const std::string& head, double factor) {
    std::string text = head + "\n";
    for (const Point& p : wheel()) text += fmt::format("{:.6f} {:.6f}\n", factor * p.y, factor * p.z);
    return text;
  };
  TREADMARK_EXPECT_ERROR(parse(scaled("# unit mil", 1.0 / 0.0254), Body::wheel), "set scale_to_mm = 0.0254", 0, 0);
  TREADMARK_EXPECT_ERROR(parse(scaled("y[mil] z[mil]", 1.0 / 0.0254), Body::wheel), "its unit is 'mil'", 0, 0);
  for (const char* head : {"# unit: cm", "# units are centimetres", "y[cm] z[cm]", "y[0.01mm] z[0.01mm]"})
    EXPECT_THAT(doubts_in(scaled(head, 1.0)), ElementsAre("unit")) << head;
  ProfileOptions options;
  options.scale = 10.0;
  const TemporaryFolder folder;
  const auto file = folder.write("cm.csv", scaled("# unit: cm", 0.1));
  EXPECT_TRUE(read_sourced_profile(file, Body::wheel, options).source.doubts.empty());
  EXPECT_THAT(notes_of(scaled("# unit: Pendolino", 1.0)), HasSubstr("its unit is 'pendolino'"));
  EXPECT_THAT(doubts_in(scaled("# unit: Pendolino", 1.0)), IsEmpty());
  EXPECT_EQ(notes_of(scaled("# unit tests of the instrument", 1.0)).find("unit"), std::string::npos);
}

}  // namespace
}  // namespace treadmark::io
