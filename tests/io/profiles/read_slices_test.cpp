// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/read_slices.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "samples.hpp"

namespace treadmark::io {
namespace {

using testing::columns;
using testing::kRound;
using testing::TemporaryFolder;

Profile straight(Body body) {
  Profile p;
  p.body = body;
  p.y = body == Body::rail ? std::vector<double>{-0.02, 0.0, 0.02} : std::vector<double>{0.02, 0.0, -0.02};
  p.z = {0.0, 0.0, 0.0};
  p.name = "straight";
  return p;
}

SliceSet parse_set(const std::string& text, Body body = Body::rail) {
  return parse_slices(text, "set.slcs", body,
                      [&](const std::string&, const SourcePosition&) { return straight(body); });
}

/// Four slices at the given positions.
std::string text(const std::string& scale, const std::vector<std::string>& values, const std::string& counts = "0 0 0",
                 const std::string& tail = "") {
  std::string result = scale + "\n" + std::to_string(values.size()) + "\n" + counts + "\n1\n";
  for (const std::string& value : values) result += value + " 'a'\n";
  return result + tail;
}

const std::vector<std::string> kFour = {"0", "10", "20", "30"};

TEST(ReadSlices, KnowsItsExtensions) {
  EXPECT_TRUE(is_slices_file("a.slcs"));
  EXPECT_TRUE(is_slices_file("a.b/c.SLCW"));
  EXPECT_FALSE(is_slices_file("a.prr"));
  EXPECT_FALSE(is_slices_file("slcs"));
}

TEST(ReadSlices, PlacesRailSlicesInMetres) {
  const SliceSet set = parse_set(text("1.5 1000.", {"0", "0.5", "0.75", "2"}));
  ASSERT_EQ(set.u.size(), 4u);
  EXPECT_NEAR(set.u[0], 1.5, kRound);
  EXPECT_NEAR(set.u[2], 2.25, kRound);
  EXPECT_EQ(set.profiles.size(), 4u);
  EXPECT_TRUE(set.features.empty());
  EXPECT_FALSE(set.approximate_u);
  EXPECT_EQ(set.name, "set.slcs");
}

TEST(ReadSlices, PlacesWheelSlicesInRadians) {
  const SliceSet set = parse_set(text("90. 0.017453292519943295", {"-180", "-90", "0", "90"}), Body::wheel);
  EXPECT_NEAR(set.u[0], -0.5 * std::numbers::pi, kRound);
  EXPECT_NEAR(set.u[3], std::numbers::pi, kRound);
}

TEST(ReadSlices, FollowsTheRecordGrammar) {
  const SliceSet set = parse_set(
      "% comment\n\n 0 % OFFSET\n\n 1 U_SCALE trailing words\r\n4 NSLC\n0 0\n0 extra\n2%approximate\n"
      "0 'a' x\n10\n 'b' % y\n20 'c'\n\t30\t'd'\n% end\n\n");
  EXPECT_TRUE(set.approximate_u);
  EXPECT_NEAR(set.u[3], 0.03, kRound);
}

TEST(ReadSlices, PassesNamesWithTheirPlaces) {
  std::vector<std::string> names;
  std::vector<SourcePosition> places;
  parse_slices("0 1\n4\n0 0 0\n1\n0 'a b'\n1 'x%y'\n2 'c\\d.prr'\n  3   'e'\n", "set.slcs", Body::rail,
               [&](const std::string& name, const SourcePosition& where) {
                 names.push_back(name);
                 places.push_back(where);
                 return straight(Body::rail);
               });
  EXPECT_EQ(names, (std::vector<std::string>{"a b", "x%y", "c\\d.prr", "e"}));
  EXPECT_EQ(places[3].to_string(), "set.slcs:8:7");
}

TEST(ReadSlices, TurnsAllSlicesOverOrNone) {
  // the section of one slice lies lower in its middle than at its ends, as within a flat
  const testing::TemporaryFolder folder;
  const std::vector<testing::Point> whole = testing::wheel_points();
  std::vector<testing::Point> flat = whole;
  for (auto& p : flat) p.z -= 5.0 * std::exp(-p.y * p.y / 200.0);
  const auto write = [&](const std::string& name, const std::string& what) { folder.write(name, what); };
  const auto negative = [](std::vector<testing::Point> points) {
    for (auto& p : points) p.z = -p.z;
    return points;
  };
  write("whole.txt", testing::columns(whole));
  write("flat.txt", testing::columns(flat));
  write("whole_up.txt", testing::columns(negative(whole)));
  write("flat_up.txt", testing::columns(negative(flat)));
  EXPECT_EQ(looks_upside_down(folder.path() / "whole.txt", Body::wheel, {}), false);
  EXPECT_EQ(looks_upside_down(folder.path() / "flat.txt", Body::wheel, {}), false);
  // the reference program judges by the ends
  ProfileOptions reference;
  reference.placement = ProfileOptions::Placement::reference;
  EXPECT_EQ(looks_upside_down(folder.path() / "flat.txt", Body::wheel, reference), true);
  for (const std::string end : {"", "_up"}) {
    std::string list = "0 0.1\n5\n0 0 0\n1\n";
    for (int k = 0; k < 5; ++k) list += std::to_string(k) + " '" + (k == 2 ? "flat" : "whole") + end + ".txt'\n";
    write("set.slcw", list);
    const SliceSet set = read_slices(folder.path() / "set.slcw", Body::wheel, {});
    for (std::size_t k = 0; k < 5; ++k)
      for (std::size_t i = 0; i < whole.size(); ++i)
        EXPECT_NEAR(1e3 * set.profiles[k].z[i], k == 2 ? flat[i].z : whole[i].z, 1e-5) << end << k;
  }
}

TEST(ReadSlices, ReadsFeatures) {
  const SliceSet set =
      parse_set(text("0 1", kFour, "3 0 0", "0 0. 10 1e6\n10 -1 0 30\n20 0 12 -1\n30 5 6 40.0000001\n"));
  ASSERT_EQ(set.features.size(), 4u);
  EXPECT_NEAR(set.features[0][1], 0.010, kRound);
  EXPECT_NEAR(set.features[0][2], 0.040, kRound);  // moved to the end of the profile
  EXPECT_TRUE(std::isnan(set.features[1][0]));
  EXPECT_NEAR(set.features[1][2], 0.030, kRound);
  EXPECT_TRUE(std::isnan(set.features[2][2]));
  EXPECT_NEAR(set.features[3][2], 0.040, kRound);
}

TEST(ReadSlices, OneFeatureMeansNone) {
  EXPECT_TRUE(parse_set(text("0 1", kFour, "1 0 0")).features.empty());
  EXPECT_TRUE(parse_set(text("0 1", kFour, "0 0 0")).features.empty());
}

TEST(ReadSlices, ChecksKinksAndAccelerations) {
  const std::string features = "0 0 10 20 30\n10 0 10 20 30\n20 0 10 20 30\n30 0 10 20 30\n";
  EXPECT_EQ(parse_set(text("0 1", kFour, "4 2 1", "1\n2\n1\n" + features)).features.size(), 4u);
  EXPECT_EQ(parse_set(text("0 1", kFour, "4 2 1", "2\n1\n1\n" + features)).kinks, (std::vector<int>{1, 2}));
  EXPECT_TRUE(parse_set(text("0 1", kFour, "4 0 1", "2\n" + features)).kinks.empty());
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", kFour, "4 1 0", "3\n" + features)), "a kink must be a feature from 1 to",
                         9, 1);
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", kFour, "4 0 1", "0\n" + features)), "a acceleration must be", 9, 1);
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", kFour, "0 1 0", "1\n")), "from 1 to NFEAT-2 = -2", 9, 1);
}

TEST(ReadSlices, RefusesBadHeaders) {
  TREADMARK_EXPECT_ERROR(parse_set(""), "the file ends where OFFSET is expected", 0, 0);
  TREADMARK_EXPECT_ERROR(parse_set("0\n"), "the file ends where SCALE is expected", 1, 0);
  TREADMARK_EXPECT_ERROR(parse_set("0 x\n"), "a number is expected, this is 'x'", 1, 3);
  TREADMARK_EXPECT_ERROR(parse_set("0 0\n"), "SCALE must be positive", 1, 3);
  TREADMARK_EXPECT_ERROR(parse_set("0 -1\n"), "SCALE must be positive", 1, 3);
  TREADMARK_EXPECT_ERROR(parse_set("nan 1\n"), "is not finite", 1, 1);
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n3\n"), "the number of slices must be 4 to 1000000, this is 3", 2, 1);
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n1000001\n"), "the number of slices must be", 2, 1);
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n 4.\n"), "a whole number is expected", 2, 2);
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n4\n-1 0 0\n"), "NFEAT must be 0 to", 3, 1);
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n4\n0 0 99999\n"), "NACCEL must be 0 to", 3, 5);
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n4\n0 0 0\n3\n"), "INTPOL must be 1", 4, 1);
}

TEST(ReadSlices, RefusesMissingLines) {
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n100000\n0 0 0\n1\n0 'a'\n1 'b'\n"), "where slice 3 of 100000 is expected", 6,
                         0);
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n4\n0 0 0\n1\n0 'a'\n1\n"), "where the file name of slice 2 is expected", 6, 0);
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", kFour, "2 0 0", "0 0 10\n10 0 10\n")), "the feature line 3 of 4", 10, 0);
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", kFour, "2 0 0", "0 0\n")), "feature 2 of 2 of slice 1", 9, 0);
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", kFour, "4 2 0", "1\n")), "kink 2 of 2", 9, 0);
}

TEST(ReadSlices, RefusesDataLeftOver) {
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", kFour, "0 0 0", "% fine\n  40 'a'\n")), "data after the last record", 10,
                         3);
}

TEST(ReadSlices, RefusesBadNames) {
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n4\n0 0 0\n1\n0 a\n"), "in single quotes is expected, this is 'a'", 5, 3);
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n4\n0 0 0\n1\n0 'a\n"), "is not closed", 5, 3);
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n4\n0 0 0\n1\n0 ''\n"), "is empty", 5, 3);
  TREADMARK_EXPECT_ERROR(parse_set("0 1\n4\n0 0 0\n1\n0 '" + std::string(5000, 'a') + "'\n"), "is longer than", 5, 3);
}

TEST(ReadSlices, RefusesSlicesOutOfOrder) {
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", {"0", "10", "5", "30"})), "slice 3 at 5 must lie more than 0.001 beyond",
                         7, 1);
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", {"0", "0.001", "5", "30"})), "slice 2", 6, 1);
  EXPECT_NO_THROW(parse_set(text("0 1", {"0", "0.0011", "5", "30"})));
  TREADMARK_EXPECT_ERROR(parse_set(text("1e30 1", kFour)), "cannot be told from the one before", 6, 1);
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1e308", {"0", "10", "20", "30"})), "out of range", 6, 1);
}

TEST(ReadSlices, RefusesImplausibleAngles) {
  EXPECT_NO_THROW(parse_set(text("0 1", {"-3.1416", "0", "1", "3.1416"}), Body::wheel));
  EXPECT_NO_THROW(parse_set(text("0 1", {"-3.2", "0", "1", "3.3"}), Body::wheel));
  EXPECT_NO_THROW(parse_set(text("0 1", {"0.1", "0.2", "0.3", "0.4"}), Body::wheel));
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", {"0", "1", "2", "3.5"}), Body::wheel),
                         "must lie in -pi to pi or contain", 8, 1);
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", {"-3.5", "1", "2", "3"}), Body::wheel),
                         "must lie in -pi to pi or contain", 5, 1);
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", {"-4.8", "1", "2", "4"}), Body::wheel), "outside -1.5 pi to 1.5 pi", 5,
                         1);
  TREADMARK_EXPECT_ERROR(parse_set(text("0 1", {"-90", "0", "10", "90"}), Body::wheel), "placed in radians", 5, 1);
}

TEST(ReadSlices, RefusesBadFeatures) {
  const auto with = [](const std::string& line) { return parse_set(text("0 1", kFour, "4 0 0", line + "\n")); };
  TREADMARK_EXPECT_ERROR(with("5 0 10 20 30"), "feature line 1 is for 5, slice 1 is at 0", 9, 1);
  TREADMARK_EXPECT_ERROR(with("0 0 20 10 30"), "feature 3 at 10 mm does not lie beyond", 9, 8);
  TREADMARK_EXPECT_ERROR(with("0 0 10 10 30"), "feature 3 at 10 mm does not lie beyond", 9, 8);
  TREADMARK_EXPECT_ERROR(with("0 0 -1 10 30"), "only leading or trailing", 9, 8);
  TREADMARK_EXPECT_ERROR(with("0 -1 -1 -1 30"), "slice 1 has fewer than two features", 9, 1);
  const std::string rest = "\n10 0 1 2 3\n20 0 1 2 3\n30 0 1 2 3";
  TREADMARK_EXPECT_ERROR(with("0 0 10 41 99" + rest), "feature 3 at 41 mm has no place", 9, 1);
  TREADMARK_EXPECT_ERROR(with("0 0 10 40 99" + rest), "feature 4 at 99 mm has no place", 9, 1);
}

TEST(ReadSlices, ReadsFilesRelativeToItsFolder) {
  const TemporaryFolder folder;
  folder.write("sub/one.txt", columns(testing::rail_points()));
  const auto file =
      folder.write("set.SLCS", "0 1\n4\n0 0 0\n1\n0 'sub/one.txt'\n1 'sub\\one.txt'\n2 './sub/one.txt'\n3 '" +
                                   (folder.path() / "sub/one.txt").string() + "'\n");
  ProfileOptions options;
  options.scale = 0.5;
  options.smoothing.method = SmoothingOptions::Method::weighted_spline;
  const SliceSet set = read_slices(file, Body::rail, options);
  ASSERT_EQ(set.profiles.size(), 4u);
  for (const Profile& p : set.profiles) {
    EXPECT_NEAR(p.y.front(), -0.018, kRound);
    EXPECT_EQ(p.smoothing.method, SmoothingOptions::Method::weighted_spline);
  }
}

TEST(ReadSlices, MissingSliceNamesTheLineAndTheFile) {
  const TemporaryFolder folder;
  folder.write("one.txt", columns(testing::rail_points()));
  const auto file =
      folder.write("set.slcs", "0 1\n4\n0 0 0\n1\n0 'one.txt'\n1 'one.txt'\n2   'two.txt'\n3 'one.txt'\n");
  const Error error = testing::error_thrown_by([&] { (void)read_slices(file, Body::rail, {}); });
  EXPECT_EQ(error.where().to_string(), file.string() + ":7:5");
  EXPECT_NE(error.message().find((folder.path() / "two.txt").string() + "' does not exist"), std::string::npos);
}

TEST(ReadSlices, StrangeNamesAreReportedHarmlessly) {
  const TemporaryFolder folder;
  for (const std::string& name : {std::string("\x1b[31m"), std::string(3000, 'a'), std::string("one.txt/b")}) {
    const auto file = folder.write("set.slcs", "0 1\n4\n0 0 0\n1\n0 '" + name + "'\n1 'a'\n2 'a'\n3 'a'\n");
    const Error error = testing::error_thrown_by([&] { (void)read_slices(file, Body::rail, {}); });
    EXPECT_EQ(error.kind(), ErrorKind::input_data);
    EXPECT_EQ(error.message().find('\x1b'), std::string::npos);
    EXPECT_EQ(error.where().line, 5);
  }
}

TEST(ReadSlices, MissingSetAndWrongBodyAreErrors) {
  const Error missing = testing::error_thrown_by([] {
    (void)read_slices("none.slcs", Body::rail, {}, {"case.inp", 4, 2});
  });
  EXPECT_EQ(missing.kind(), ErrorKind::input_data);
  EXPECT_EQ(std::string(missing.what()).rfind("case.inp:4:2: the slices file 'none.slcs' does not exist", 0), 0u);
  EXPECT_EQ(testing::error_thrown_by([] { (void)read_slices("a.slcs", Body::wheel, {}); }).kind(),
            ErrorKind::configuration);
  EXPECT_EQ(testing::error_thrown_by([] { (void)read_slices("a.SLCW", Body::rail, {}); }).kind(),
            ErrorKind::configuration);
}

TEST(ReadSlices, ASetWithinASetIsAnError) {
  const TemporaryFolder folder;
  const auto file = folder.write("set.slcs", "0 1\n4\n0 0 0\n1\n0 'set.slcs'\n1 'a'\n2 'a'\n3 'a'\n");
  const Error error = testing::error_thrown_by([&] { (void)read_slices(file, Body::rail, {}); });
  EXPECT_NE(error.message().find("is a set of slices"), std::string::npos);
  EXPECT_EQ(error.where().line, 5);
}

}  // namespace
}  // namespace treadmark::io
