// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "samples.hpp"
#include "treadmark/io/profiles/judge_profile.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/tests/support/mutation.hpp"

namespace treadmark::io {
namespace {

using testing::columns;
using testing::rail_points;
using testing::wheel_points;

constexpr int kTrials = 1500;  // for each format

/// What these formats stumble over.
const std::vector<std::string> kPieces{"\n", " ", "-", "1e308", "nan", "'", "=", "%", "99999999999", ".begin", ","};

/// Every result is a sound profile or an Error with a message; anything else ends the test.
template <class Read>
void survive(const std::string& valid, Read read) {
  std::mt19937 random(20240607);
  ASSERT_NO_THROW(read(valid));
  int accepted = 0, refused = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const std::string text = testing::with_other_bytes(valid, random, kPieces);
    try {
      read(text);
      ++accepted;
    } catch (const Error& error) {
      EXPECT_FALSE(error.message().empty());
      for (const char c : std::string(error.what())) ASSERT_TRUE(c >= ' ' && c <= '~') << error.what();
      ++refused;
    }
  }
  EXPECT_GT(accepted, kTrials / 100);
  EXPECT_GT(refused, kTrials / 10);
}

void expect_sound(const Profile& p, Body body) {
  ASSERT_GE(p.y.size(), 2u);
  ASSERT_EQ(p.y.size(), p.z.size());
  EXPECT_EQ(p.body, body);
  EXPECT_EQ(p.y.back() > p.y.front(), body == Body::rail);
  double length = 0.0;
  for (std::size_t i = 1; i < p.y.size(); ++i) {
    const double step = std::hypot(p.y[i] - p.y[i - 1], p.z[i] - p.z[i - 1]);
    EXPECT_TRUE(std::isfinite(step));
    length += step;
  }
  for (const auto& [name, value] : judge_profile({p, {}}, {-0.07, 0.46}).facts)
    EXPECT_EQ(value.find("nan"), std::string::npos) << name << ' ' << value;
  EXPECT_GE(length, 0.0049999);
  EXPECT_LE(length, 0.5000001);
}

TEST(MutatedFiles, Simpack) {
  const std::string text = testing::simpack(Body::wheel, wheel_points(), "mirror.y = 0\nshift.z = 0.5\nrotate = 0\n");
  survive(text, [](const std::string& t) {
    expect_sound(testing::parse(t, Body::wheel, {}, ProfileFormat::simpack), Body::wheel);
  });
}

TEST(MutatedFiles, MiniProf) {
  const std::string text = "Program=MiniProf\nColumnDef=X,Y\nXOffset=0.5\nYOffset=-1\n\n" + columns(rail_points());
  survive(text, [](const std::string& t) {
    expect_sound(testing::parse(t, Body::rail, {}, ProfileFormat::miniprof), Body::rail);
  });
}

TEST(MutatedFiles, TwoColumns) {
  survive(columns(rail_points()),
          [](const std::string& t) { expect_sound(testing::parse(t, Body::rail), Body::rail); });
}

TEST(MutatedFiles, MiniProfHeaderOfText) {
  const std::string text = "#MINIWHEELPROF\nCar7.whl\nMINIPROF 2020\nStock.......:\n32.58 37.11 14.71\n(Sd/Sh/qR)\n\n" +
                           columns(wheel_points());
  survive(text, [](const std::string& t) {
    expect_sound(testing::parse(t, Body::wheel, {}, ProfileFormat::miniprof), Body::wheel);
  });
}

TEST(MutatedFiles, MiniProfSections) {
  const std::string text =
      "[FileInfo]\nProgramName=MiniProf\n\n[Profile1Info]\nProgramName=AutoCAD\nColumnDef=X,Y\nXYPoints=65\n\n"
      "[Profile1Points]\n" +
      columns(wheel_points()) + "\n[Profile2Info]\nDiameterTaperline=920\nGauge=1435\n\n[Profile2Points]\n" +
      columns(wheel_points());
  survive(text, [](const std::string& t) {
    expect_sound(testing::parse(t, Body::wheel, {}, ProfileFormat::miniprof), Body::wheel);
  });
}

TEST(MutatedFiles, Csv) {
  std::string text = "\"n\";\"y [mm]\";\"z [mm]\"\r\n";
  int n = 0;
  for (const testing::Point& p : rail_points()) {
    std::string line = std::to_string(++n) + ";\"" + std::to_string(p.y) + "\";" + std::to_string(p.z) + "\r\n";
    std::replace(line.begin(), line.end(), '.', ',');
    text += line;
  }
  survive(text, [](const std::string& t) { expect_sound(testing::parse(t, Body::rail), Body::rail); });
}

TEST(MutatedFiles, Utf16) {
  std::string text = "\xFF\xFE";
  for (const char c : "y,z\n" + columns(rail_points())) {
    text += c == ' ' ? ',' : c;
    text += '\0';
  }
  std::string single;  // one comma between two numbers
  for (std::size_t i = 0; i < text.size(); i += 2)
    if (text[i] != ',' || i < 2 || text[i - 2] != ',') single += text.substr(i, 2);
  survive(single, [](const std::string& t) { expect_sound(testing::parse(t, Body::rail), Body::rail); });
}

TEST(MutatedFiles, Slices) {
  const std::string text =
      "0.0 1.0 OFFSET SCALE\n5 NSLC\n4 1 1\n2\n-2 'a'\n-1 'b'\n0 'c'\n1.0 'd'\n2.5 'e'\n1\n2\n"
      "-2 0 10 20 99\n-1 0 10 20 99\n0 -1 10 20 99\n1.0 0 10 20 -1\n2.5 0 10 20 99\n";
  survive(text, [](const std::string& t) {
    const SliceSet set = parse_slices(t, "sample", Body::wheel, [](const std::string&, const SourcePosition&) {
      return testing::parse(columns(wheel_points()), Body::wheel);
    });
    ASSERT_GE(set.u.size(), 4u);
    ASSERT_EQ(set.profiles.size(), set.u.size());
    for (std::size_t i = 1; i < set.u.size(); ++i) EXPECT_GT(set.u[i], set.u[i - 1]);
    for (const auto& row : set.features) EXPECT_EQ(row.size(), set.features.front().size());
  });
}

}  // namespace
}  // namespace treadmark::io
