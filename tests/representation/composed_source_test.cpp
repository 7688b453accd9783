// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/profiles/write_slices.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

// What a case file says about rails of parts, crossings and rollers arrives as surfaces.

namespace treadmark::testing {
namespace {

const std::string kWheel = "wheel.shape.standard = \"S1002\"\nwheelset.vertical_force_N = 1e5\n";

io::SurfaceSource rail_of(const std::string& text) {
  return std::get<io::WheelRailCase>(io::parse_case_text(kWheel + text, "study.toml", {}).cases.at(0).content).rail;
}

const std::string kCrossing = R"([[rail.parts]]
standard = "60E1"
crossing = "nose"
crossing_x_mm = 200
y_mm = -40
[[rail.parts]]
standard = "60E1"
crossing = "wing"
crossing_x_mm = 50
y_mm = 30
z_mm = 1
backend = "mesh"
resolution_mm = 2
)";

TEST(ComposedSource, PartsBecomeOneBody) {
  const NaturalSurface rail = app::read_surface(rail_of(kCrossing), Body::rail, 0.0);
  EXPECT_NEAR(height_at(*rail.surface, {}, {0.0, 0.03}), 1e-3, 1e-6);
  EXPECT_NEAR(height_at(*rail.surface, {}, {0.3, -0.04}), 0.0, 1e-6);
  EXPECT_NEAR(height_at(*rail.surface, {}, {0.1, -0.04}), 0.01, 1e-6) << "100 mm before the nose levels off";
  EXPECT_NEAR(height_at(*rail.surface, {}, {0.25, 0.05}), 1e-3, 1e-6) << "200 mm after the wing begins to move";
  EXPECT_FALSE(rail.constant_profile());
}

TEST(ComposedSource, EveryRepresentationFollowsAWing) {
  const NaturalSurface wing =
      app::read_surface(rail_of("rail.shape.standard = \"60E1\"\nrail.shape.crossing = \"wing\"\n"), Body::rail, 0.0);
  Region region;
  region.u_min = -0.02;
  region.u_max = 0.28;
  for (const std::string backend : {"spline", "nurbs", "thb", "chords", "mesh"}) {
    const RepresentedSurface sampled = represent(wing, {backend, 1e-3, region});
    const SurfaceDifference off = fit_error(wing, sampled);
    // chords: h^2/(8 r) = 10 um on the arc of r = 13 mm, at most
    EXPECT_LT(off.height_rms, backend == "chords" ? 6e-6 : 0.6e-6) << backend;
    EXPECT_LT(off.missing, off.points / 100) << backend;
    EXPECT_GT(off.points, 1000u) << backend;
  }
}

TEST(ComposedSource, TheStoreKeepsPartsRollersAndCrossingsApart) {
  app::SurfaceStore store;
  Region region;
  region.u_min = -0.02;
  region.u_max = 0.02;
  io::SurfaceSource crossing = rail_of(kCrossing);
  const app::StoredSurface& first = store.get(crossing, Body::rail, 0.0, region);
  EXPECT_EQ(first.represented.surface->backend(), "mesh+spline");
  EXPECT_EQ(&store.get(crossing, Body::rail, 0.0, region), &first);
  crossing.parts[0].offset.y() += 1e-3;
  EXPECT_NE(&store.get(crossing, Body::rail, 0.0, region), &first);

  const io::SurfaceSource plain = rail_of("rail.shape.standard = \"60E1\"\n");
  const app::StoredSurface& rail = store.get(plain, Body::rail, 0.0, region);
  const app::StoredSurface& roller = store.get(plain, Body::rail, 0.5, region);
  EXPECT_TRUE(rail.constant_profile());
  EXPECT_FALSE(roller.constant_profile());
  EXPECT_NEAR(height_at(*roller.represented.surface, {}, {0.1, 0.0}), 0.5 - std::sqrt(0.25 - 0.01), 1e-12);
  const io::SurfaceSource nose = rail_of("rail.shape.standard = \"60E1\"\nrail.shape.crossing = \"nose\"\n");
  const app::StoredSurface& rising = store.get(nose, Body::rail, 0.0, region);
  EXPECT_NEAR(height_at(*rising.represented.surface, {}, {-0.2, 0.0}), 0.02, 1e-6);
  EXPECT_EQ(store.uses().size(), 5u);
}

TEST(ComposedSource, KinksAndSeamsComeFromFiles) {
  const TemporaryFolder scratch;
  const std::filesystem::path& folder = scratch.path();
  const NaturalSurface wheel = create_natural(
      {Body::wheel, 0.46, StandardProfile{"S1002"}, {.polygonizations = {{{{1, 0.5e-3, 0.5}}, 0.0, 0.0}}}});
  SliceSet slices = to_slices(wheel, {"", 20e-3, {}});
  slices.u.pop_back();
  slices.profiles.pop_back();
  io::write_slices(folder / "wheel.slcw", slices);
  io::SurfaceSource source;
  source.geometry = io::GeometryFile{folder / "wheel.slcw", {}, false};
  const auto jump = [&](const NaturalSurface& surface) {
    // slopes round the wheel just before and after the first slice
    const auto slope = [&](double theta) {
      double z = 0.0, dzdx = 0.0;
      surface.surface->heights({{Vec3::Zero(), rotation_y(theta)}, {0.0, 0.0, 1.0, 1.0, 1, 1}},
                               {{&z, 1}, {&dzdx, 1}, {}});
      return dzdx;
    };
    return std::fabs(slope(slices.u.front() - 1e-7) - slope(slices.u.front() + 1e-7));
  };
  const double smooth = jump(app::read_surface(source, Body::wheel, 0.46));
  std::get<io::GeometryFile>(source.geometry).open_seam = true;
  const double open = jump(app::read_surface(source, Body::wheel, 0.46));
  EXPECT_LT(smooth, 1e-7);
  EXPECT_GT(open, 1e-4) << "of 0.5 mm/460 mm";
}

}  // namespace
}  // namespace treadmark::testing
