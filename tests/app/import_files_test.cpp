// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "treadmark/app/import/write_outputs.hpp"
#include "treadmark/app/surfaces/written_surface.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/shared_data.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::run_program;
namespace fs = std::filesystem;

class ImportFiles : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (input.folder() / name).string(); }

  treadmark::testing::ProgramResult import(std::vector<std::string> more) const {
    more.insert(more.begin(), "import");
    return run_program(more);
  }

  /// All that lies in the folder.
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& entry : fs::recursive_directory_iterator(input.folder()))
      out.push_back(fs::relative(entry.path(), input.folder()).string());
    std::sort(out.begin(), out.end());
    return out;
  }

  treadmark::testing::SampleInput input;
};

/// Points at random on a rail's head, this far apart on average [mm]: top of radius 300, corners of 13, sides, and the
/// faces below 37.5 mm as far as `depth` lets them be seen.
void write_head(const fs::path& file, double depth, double spacing, double length) {
  std::vector<Vec2> outline;
  constexpr double kTop = 300.0, kCorner = 13.0, kHalfTop = 22.0, kEnd = 1.52;
  for (double y = 0.0; y < kHalfTop; y += 0.1) outline.emplace_back(y, kTop - std::sqrt(kTop * kTop - y * y));
  const double start = std::asin(kHalfTop / kTop);
  const Vec2 middle = Vec2(kHalfTop, kTop - std::sqrt(kTop * kTop - kHalfTop * kHalfTop)) +
                      kCorner * Vec2(-std::sin(start), std::cos(start));
  for (double a = start; a < kEnd; a += 0.01) outline.push_back(middle + kCorner * Vec2(std::sin(a), -std::cos(a)));
  const Vec2 side = outline.back();
  for (double z = side.y(); z < 37.5; z += 0.1) outline.emplace_back(side.x() + 0.05 * (z - side.y()), z);
  const Vec2 below = outline.back();
  for (double t = 0.1; t < 20.0; t += 0.1) outline.emplace_back(below.x() - t, below.y() + t / 2.75);
  std::erase_if(outline, [&](const Vec2& p) { return p.y() > depth; });
  std::vector<double> at{0.0};
  for (std::size_t k = 1; k < outline.size(); ++k) at.push_back(at.back() + (outline[k] - outline[k - 1]).norm());
  Random random(3);
  std::ofstream out(file);
  const auto count = static_cast<int>(2.0 * at.back() * length / (spacing * spacing));
  for (int i = 0; i < count; ++i) {
    const double s = random.uniform() * at.back();
    const auto k = static_cast<std::size_t>(std::upper_bound(at.begin() + 1, at.end() - 1, s) - at.begin());
    const Vec2 p = outline[k - 1] + (s - at[k - 1]) / (at[k] - at[k - 1]) * (outline[k] - outline[k - 1]);
    const double x = random.uniform() * length;
    out << x << ' ' << (random.uniform() < 0.5 ? -p.x() : p.x()) << ' ' << -p.y() << '\n';
  }
}

TEST_F(ImportFiles, ASparseHeadIsARailHoweverDeepItWasCut) {
  for (const double depth : {36.0, 41.0}) {
    write_head(path("head.xyz"), depth, 2.9, 500.0);
    const auto r = import({path("head.xyz"), "-o", path("head.slcs")});
    EXPECT_EQ(r.status, 0) << depth << ": " << r.err;
  }
}

TEST_F(ImportFiles, PointsThatStandForNoDataAreCounted) {
  write_head(path("head.xyz"), 30.0, 1.5, 200.0);
  std::ifstream in(path("head.xyz"));
  std::ofstream out(path("lost.xyz"));
  int lost = 0, number = 0;
  for (double x = 0.0, y = 0.0, z = 0.0; in >> x >> y >> z; ++number) {
    const bool gone = number % 20 == 7;
    lost += gone ? 1 : 0;
    out << x << ' ' << y << ' ' << (gone ? -9999.0 : z) << '\n';
  }
  out.close();
  const auto r = import({path("lost.xyz"), "-o", path("lost.slcs")});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("no data"));
  EXPECT_THAT(r.out, HasSubstr(std::to_string(lost)));
  EXPECT_THAT(r.out, HasSubstr("z = -9999"));
}

TEST_F(ImportFiles, CoordinatesOfAMapAreNoRailUnlessTheUnitIsSaid) {
  write_head(path("head.xyz"), 30.0, 1.5, 200.0);
  std::ifstream in(path("head.xyz"));
  std::ofstream out(path("far.xyz"));
  out.precision(12);
  for (double x = 0.0, y = 0.0, z = 0.0; in >> x >> y >> z;)
    out << x + 637012.0 << ' ' << y + 849028.0 << ' ' << z << '\n';
  out.close();
  const auto r = import({path("far.xyz"), "-o", path("far.slcs")});
  EXPECT_EQ(r.status, 3);
  EXPECT_THAT(r.err, HasSubstr("are these coordinates of a map?"));
  EXPECT_FALSE(fs::exists(path("far.slcs")));
  const auto said = import({path("far.xyz"), "-o", path("far.slcs"), "--unit", "mm"});
  EXPECT_EQ(said.status, 0) << said.err;
}

TEST_F(ImportFiles, WhatFailsLeavesNothingBehind) {
  TREADMARK_NEEDS("cgal");
  TREADMARK_NEEDS("openvdb");
  write_head(path("head.xyz"), 30.0, 1.5, 200.0);
  const std::vector<std::string> before = names();
  // the triangles are made before it turns out that there is nothing to lay offsets over
  const auto r = import({path("head.xyz"), "--body", "rail", "-o", path("a.ply"), "-o", path("a.slcs"), "-o",
                         path("new/a.vdb"), "--nominal", "none", "--set", "fit.base=nominal"});
  EXPECT_EQ(r.status, 2);
  EXPECT_THAT(r.err, HasSubstr("a.vdb: there is no nominal profile to lay offsets over"));
  EXPECT_EQ(names(), before);
}

TEST_F(ImportFiles, OutputsGetTheirNamesTogether) {
  const auto write = [](const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  };
  const auto text_of = [](const fs::path& file) {
    std::ifstream in(file);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string index = "  0.0 'a.slcs-0123456789ab/slice_00001.txt'", slice = "slice_00001.txt";
  write(path("a.slcs-ffffffffffff/" + slice), "old");
  const std::vector<std::string> before = names();
  {
    StagedOutputs staged;
    write(staged.place(path("a.slcs")), "index");
  }
  EXPECT_EQ(names(), before);
  {
    StagedOutputs staged;
    const fs::path place = staged.place(path("a.slcs"));
    EXPECT_EQ(place.filename(), "a.slcs");
    write(place, index);
    write(place.parent_path() / "a.slcs-0123456789ab" / slice, "new");
    write(staged.place(path("b.ply")), "ply");
    EXPECT_FALSE(fs::exists(path("a.slcs")));
    staged.commit();
  }
  EXPECT_EQ(text_of(path("a.slcs")), index);
  EXPECT_EQ(text_of(path("a.slcs-0123456789ab/" + slice)), "new");
  EXPECT_FALSE(fs::exists(path("a.slcs-ffffffffffff"))) << "those of the surface that is replaced";
  EXPECT_EQ(text_of(path("b.ply")), "ply");
}

/// Scans of others that are no wheel or rail, or no part of one that can be placed: what `import` says of them.
TEST_F(ImportFiles, ScansOfOthersAreRefusedForWhatTheyAre) {
  TREADMARK_REQUIRE_SHARED();
  struct Real {
    const char *file, *body, *words;
  };
  for (const Real& real :
       {Real{"las/1_4_w_evlr.las", "rail", "those of a map: the file names the coordinate system NAD83"},
        Real{"las/test1_4.las", "rail", "those of a map"},
        Real{"las/bad_vlr_count.las", "rail", "WGS 84 / UTM zone 17N"},
        Real{"las/simple1_3.las", "rail", "those of a map"}, Real{"las/lots_of_vlr.las", "rail", "those of a map"},
        Real{"las/no-points.las", "rail", "longitudes and latitudes"},
        Real{"las/extrabytes.las", "rail", "extrabytes.las: "},
        Real{"las/gps-time-nan.las", "rail", "1 points are too few"},
        Real{"las/plane.laz", "rail", "laszip -i plane.laz -o plane.las"},
        Real{"points/autzen-utm.pcd", "rail", "autzen-utm.pcd: "},
        Real{"points/utm17_comma.pcd", "rail", "10 points are too few"},
        Real{"points/rail.pcd", "rail", "is it the right object, body and unit?"},
        Real{"points/ColouredCubeFloat.e57", "wheel", "ColouredCubeFloat.e57: "},
        Real{"points/result_ball.ply", "wheel", "is that of no wheel in any unit"},
        Real{"points/axle_tof.ply", "wheel", "do not form a surface"}}) {
    if (!has_part("expat") && std::string(real.file).ends_with(".e57")) continue;
    const std::vector<std::string> before = names();
    const auto r = import({(*shared / "data/real" / real.file).string(), "--body", real.body, "-o", path("x.ply")});
    EXPECT_EQ(r.status, 3) << real.file << ": " << r.err << r.out;
    EXPECT_THAT(r.err, HasSubstr(real.words)) << real.file;
    EXPECT_EQ(names(), before) << real.file;
  }
}

/// Failures of whatever comes after reading: few points, which get past one step after the other.
TEST_F(ImportFiles, FailuresNameTheScan) {
  input.write("rail.toml",
              "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\nwheelset.vertical_force_N = 1e5\n");
  for (const char* points : {"50", "100", "400", "700", "1000"}) {
    const std::string scan = path("few.ply");
    const auto made =
        run_program({"scan", path("rail.toml"), "--body", "rail", "-o", scan, "--points", points, "--range-mm=-60,60"});
    ASSERT_EQ(made.status, 0) << made.err;
    const auto r = import({scan, "-o", path("x.slcs"), "--quiet"});
    EXPECT_EQ(r.status, 3) << points << r.err;
    EXPECT_THAT(r.err, HasSubstr("treadmark: " + scan + ": ")) << points;
  }
}

}  // namespace
}  // namespace treadmark::app
