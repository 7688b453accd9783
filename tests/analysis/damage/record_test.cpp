// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/damage/record.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/backends/added_offsets.hpp"
#include "treadmark/tests/analysis/damage/cells.hpp"
#include "treadmark/tests/support/error_text.hpp"

namespace treadmark::damage {
namespace {

using ::testing::HasSubstr;

constexpr double kVelocity = 10.0, kHardness = 3e9, kCoefficient = 2e-4, kFriction = 0.3, kSlip = 0.02;
constexpr double kPressure = 0.5e9, kTurn = 2.0 * std::numbers::pi, kRadius = 0.46;

WearLaw archard() {
  WearLaw law;
  law.hardness = kHardness;
  law.k = {kCoefficient};
  return law;
}

WearLaw by_energy(double volume_per_work) {
  WearLaw law;
  law.theory = WearTheory::energy;
  law.volume_per_work = {volume_per_work};
  return law;
}

/// A flat pin: even pressure and slip over nx x ny elements, its middle at (u, y).
PassedPatch pin(Body body, int nx, int ny, double element, double u, double y) {
  PassedPatch patch;
  patch.velocity = kVelocity;
  patch.length = patch.width = element;
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix < nx; ++ix) {
      const double along = (ix - 0.5 * (nx - 1)) * element, low = y + (iy - 0.5 * ny) * element;
      patch.elements.push_back({u + along / (body == Body::wheel ? kRadius : 1.0), low, low + element, kPressure,
                                kFriction * kPressure, kSlip, kFriction * kPressure * kSlip * kVelocity});
    }
  patch.power = patch.elements.front().dissipation * patch.area();
  return patch;
}

/// Archard 1953: a point over which a flat pin of some length slides k p / H deep for every metre of sliding, which is
/// the slip times the length of the pin at every passage.
TEST(AddPatch, FlatPinWearsByTheClosedForm) {
  constexpr int kLong = 20, kWide = 30;
  constexpr double kElement = 0.5e-3, kPassages = 5000.0;
  const double expected = kCoefficient * kPressure * kSlip * kLong * kElement / kHardness * kPassages;
  for (const Body body : {Body::wheel, Body::rail}) {
    const SurfaceCells cells = cells_of(body, kRadius, 1, 0.7e-3, 101);
    SurfaceRecord record(1);
    const double way = kPassages * (body == Body::wheel ? kTurn * kRadius : 1.0);
    add_patch(record, cells, archard(), pin(body, kLong, kWide, kElement, 0.0, 0.0), {}, way / kVelocity, kPassages);
    for (int j = 0; j < cells.ny; ++j) {
      const double inside = 0.5 * kWide * kElement - std::fabs(cells.y(j)) - 0.5 * cells.dy;
      if (inside < 0.0) continue;
      EXPECT_NEAR(depth_of(cells, record.volume.at(0, j), j), expected, 1e-3 * expected) << j;
      EXPECT_NEAR(record.sliding.at(0, j), kPassages * kSlip * kLong * kElement, 1e-9) << j;
      EXPECT_DOUBLE_EQ(record.passages.at(0, j), kPassages);
      EXPECT_DOUBLE_EQ(record.pressure.at(0, j), kPressure);
    }
  }
}

TEST(AddPatch, RemovesVolumeByWorkAndKeepsSums) {
  const double per_work = 1.3e-14, seconds = 7.0;
  for (const int nu : {1, 2890}) {
    const SurfaceCells cells = cells_of(Body::wheel, kRadius, nu, 0.31e-3, 97);
    const PassedPatch patch = pin(Body::wheel, 13, 17, 0.7e-3, 3.1, 1.23e-3);
    SurfaceRecord record(nu);
    add_patch(record, cells, by_energy(per_work), patch, {3.1, 2.9, 3.35}, seconds, 1.0);
    EXPECT_NEAR(record.work.sum(), patch.power * seconds, 1e-12 * patch.power * seconds);
    EXPECT_NEAR(record.volume.sum(), per_work * patch.power * seconds, 1e-6 * per_work * patch.power * seconds);
    EXPECT_NEAR(record.volume_by_law, record.volume.sum(), 1e-12 * record.volume_by_law);
  }
}

/// Stretches of any lengths that make up a turn, with the same patch in each: as one patch all round.
TEST(AddPatch, StretchesOfATurnMakeEvenWear) {
  const SurfaceCells cells = cells_of(Body::wheel, kRadius, 1440, 0.5e-3, 61),
                     round = cells_of(Body::wheel, kRadius, 1, 0.5e-3, 61);
  const double edges[] = {-0.2, -0.003, 0.0007, 0.11, 0.5, 3.0, kTurn - 0.2};
  const double seconds = 1.0;  // of the whole turn
  SurfaceRecord record(cells.nu), expected(1);
  for (int k = 0; k < 6; ++k) {
    const double middle = 0.3 * edges[k] + 0.7 * edges[k + 1];
    add_patch(record, cells, archard(), pin(Body::wheel, 20, 11, 0.5e-3, middle, 0.1e-3),
              {middle, edges[k], edges[k + 1]}, seconds * (edges[k + 1] - edges[k]) / kTurn, 1.0);
  }
  add_patch(expected, round, archard(), pin(Body::wheel, 20, 11, 0.5e-3, 0.0, 0.1e-3), {}, seconds, 1.0);
  ASSERT_EQ(record.volume.rows().size(), 12u);  // 5.5 mm, a fifth of a cell aside
  for (const auto& [j, row] : record.volume.rows())
    for (int i = 0; i < cells.nu; ++i) {
      EXPECT_NEAR(row[static_cast<std::size_t>(i)] * cells.nu, expected.volume.at(0, j),
                  1e-9 * expected.volume.at(0, 30));
      EXPECT_NEAR(record.passages.at(i, j), 1.0, 1e-9);
    }
}

TEST(AddPatch, MirroredPatchesMakeMirroredWear) {
  const SurfaceCells cells = cells_of(Body::rail, kRadius, 1, 0.5e-3, 81);
  SurfaceRecord right(1), left(1);
  add_patch(right, cells, archard(), pin(Body::rail, 5, 8, 0.6e-3, 0.0, 3.3e-3), {}, 1.0, 1.0);
  add_patch(left, cells, archard(), pin(Body::rail, 5, 8, 0.6e-3, 0.0, -3.3e-3), {}, 1.0, 1.0);
  for (int j = 0; j < cells.ny; ++j)
    EXPECT_NEAR(right.volume.at(0, j), left.volume.at(0, cells.ny - 1 - j), 1e-12 * right.volume.sum());
}

TEST(AddPatch, RefusesContactBesideTheSurface) {
  const SurfaceCells cells = cells_of(Body::rail, kRadius, 1, 0.5e-3, 21);
  SurfaceRecord record(1);
  EXPECT_THAT(testing::error_of([&] {
                add_patch(record, cells, archard(), pin(Body::rail, 5, 8, 0.6e-3, 0.0, 30e-3), {}, 1.0, 1.0);
              }),
              HasSubstr("beside the surface"));
}

TEST(Smooth, KeepsSumsAndLeavesEvenValuesAlone) {
  for (const int nu : {1, 200}) {
    const SurfaceCells cells = cells_of(Body::wheel, kRadius, nu, 0.5e-3, 80);
    CellSheet peak(nu), even(nu);
    peak.ref(nu / 3, 20) = 1.0;
    for (int j = 0; j < cells.ny; ++j)
      for (int i = 0; i < nu; ++i) even.ref(i, j) = 2.0;
    smooth(peak, cells, 1.5e-3);
    smooth(even, cells, 1.5e-3);
    EXPECT_NEAR(peak.sum(), 1.0, 1e-12);
    EXPECT_NEAR(even.at(nu / 2, 40), 2.0, 1e-12);
    // in units of the steps, the variance is that of the kernel (but for what its end cuts off)
    double variance = 0.0;
    for (const auto& [j, row] : peak.rows())
      for (const double value : row) variance += value * std::pow((j - 20) * cells.dy, 2);
    EXPECT_NEAR(std::sqrt(variance), 1.5e-3, 0.02e-3);
  }
}

TEST(DepthOf, IsThatOfARing) {
  const SurfaceCells cells = cells_of(Body::wheel, kRadius, 1, 0.5e-3, 5);
  const double depth = 4e-3, outer = kRadius, inner = kRadius - depth;
  const double volume = std::numbers::pi * (outer * outer - inner * inner) * cells.dy;
  EXPECT_NEAR(depth_of(cells, volume, 2), depth, 1e-15);
  EXPECT_THAT(testing::error_of([&] { depth_of(cells, 1.0, 2); }), HasSubstr("more is removed"));
}

/// A rail that is there in some rows only, level.
class Strip final : public Surface {
 public:
  Strip(double low, double high) : low_(low), high_(high) {}
  std::string_view backend() const override { return "strip"; }
  Facing facing() const override { return Facing::up; }
  Box3 bounds() const override { return {{-1.0, -5e-3, 0.0}, {1.0, 5e-3, 0.0}}; }
  std::size_t memory_bytes() const override { return sizeof *this; }

 private:
  void do_heights(const PlaneGrid&, const HeightsOut&) const override {}
  void do_heights_at(const Pose&, std::span<const Vec2> points, const HeightsOut& out) const override {
    for (std::size_t i = 0; i < points.size(); ++i)
      out.z[i] = points[i].y() > low_ && points[i].y() < high_ ? 0.0 : std::nan("");
  }
  void do_locate(const Pose&, std::span<const Vec2>, std::span<SurfacePoint>) const override {}
  HeightBounds do_height_bounds(const Pose&, const Rectangle&) const override { return {}; }

  double low_, high_;
};

TEST(MakeCells, NeedTwoRowsWithASurface) {
  CellSettings settings;
  settings.dy = 1e-3;
  const auto refused = [&](double low, double high) {
    return testing::error_of([&] { make_cells(Strip(low, high), Body::rail, kRadius, settings); });
  };
  EXPECT_EQ(refused(-0.5e-3, 1.5e-3), "");
  EXPECT_THAT(refused(-0.5e-3, 0.5e-3), HasSubstr("there is no surface to evolve"));
  EXPECT_THAT(refused(0.1e-3, 0.9e-3), HasSubstr("there is no surface to evolve"));
  const SurfaceCells cells = make_cells(Strip(-0.5e-3, 1.5e-3), Body::rail, kRadius, settings);
  for (int j = 0; j < cells.ny; ++j)
    EXPECT_EQ(cells.exists(j), cells.y(j) > -0.5e-3 && cells.y(j) < 1.5e-3) << cells.y(j);
}

/// Even depth all over a wheel keeps its profile: the section lies deeper by it.
TEST(OffsetsOf, EvenWearKeepsTheProfile) {
  SurfaceSpec spec;
  spec.body = Body::wheel;
  spec.nominal_radius = kRadius;
  spec.shape = StandardProfile{"S1002"};
  const NaturalSurface natural = create_natural(spec);
  const SurfaceCells cells = make_cells(*natural.surface, Body::wheel, kRadius, {});
  const double depth = 0.3e-3;
  CellSheet volume(1);
  for (int j = 0; j < cells.ny; ++j) {
    const double r = cells.radius[static_cast<std::size_t>(j)];
    if (std::isfinite(r)) volume.ref(0, j) = std::numbers::pi * (r * r - (r - depth) * (r - depth)) * cells.dy;
  }
  EXPECT_NEAR(depth_extent(cells, volume).depth, depth, 1e-12);
  const NaturalSurface worn = add_offsets(natural, offsets_of(cells, volume, 0.5, "even wear"));
  EXPECT_TRUE(worn.constant_profile());
  for (const double theta : {0.0, 0.7})
    for (double y = -30e-3; y <= 40e-3; y += 1.7e-3) {
      const Pose turned{Vec3::Zero(), Eigen::AngleAxisd(theta, Vec3::UnitY()).toRotationMatrix()};
      const double before = height_at(*natural.surface, turned, {0.0, y}),
                   after = height_at(*worn.surface, turned, {0.0, y});
      EXPECT_NEAR(before - after, depth, 1e-8) << theta << ' ' << y;
    }
}

}  // namespace
}  // namespace treadmark::damage
