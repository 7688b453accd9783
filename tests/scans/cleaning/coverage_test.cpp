// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/coverage.hpp"

#include <gtest/gtest.h>

#include "treadmark/tests/scans/cleaning/band_samples.hpp"

namespace treadmark::scans {
namespace {

using tests::Sample;
constexpr double kSheetLength = 0.5, kSheetWidth = 0.064;
constexpr std::size_t kSheetRows = 500, kSheetColumns = 64;

struct Circle {
  double a, s, diameter;
};

double apart(const Band& band, double a, double b) {
  const double off = a - b;
  return band.closed ? off - band.length() * std::round(off / band.length()) : off;
}

BandPoints with_holes(const Band& band, const std::vector<Circle>& holes) {
  auto samples = tests::scattered(band, kSheetRows, kSheetColumns, 2, 0.0, 1, [](double, double) { return 0.0; });
  std::erase_if(samples, [&](const Sample& p) {
    return std::any_of(holes.begin(), holes.end(), [&](const Circle& h) {
      return std::hypot(apart(band, p.a, h.a), p.s - h.s) < 0.5 * h.diameter;
    });
  });
  return tests::sorted(band, kSheetRows, kSheetColumns, samples);
}

TEST(Coverage, ADenseBandIsWhole) {
  const Band band = tests::straight_band(kSheetLength, kSheetWidth, false);
  const BandPoints points = with_holes(band, {});
  const Coverage c = find_coverage(points, band, {});
  EXPECT_TRUE(c.whole());
  EXPECT_TRUE(c.holes.empty());
  EXPECT_NEAR(c.gap_a, points.cell_a, 1e-12);
  EXPECT_NEAR(c.gap_s, points.cell_s, 1e-12);
  EXPECT_DOUBLE_EQ(c.limit, 10e-3);
  EXPECT_EQ(c.first_column, 0u);
  EXPECT_EQ(c.last_column, kSheetColumns);
  EXPECT_NEAR(c.area, kSheetLength * kSheetWidth, 1e-9);
  EXPECT_EQ(c.hole_area, 0.0);
}

TEST(Coverage, HolesAreFoundAndTheLimitDecides) {
  for (const bool closed : {false, true}) {
    const Band band = tests::straight_band(kSheetLength, kSheetWidth, closed);
    // the widest lies across the seam of the closed band
    const std::vector<Circle> circles{{closed ? 1e-3 : 0.1, 30e-3, 24e-3}, {0.25, 40e-3, 14e-3}, {0.4, 20e-3, 8e-3}};
    const BandPoints points = with_holes(band, circles);
    for (const double limit : {0.0, 5e-3, 16e-3, 40e-3}) {
      const Coverage c = find_coverage(points, band, {.hole_limit = limit});
      ASSERT_EQ(c.holes.size(), circles.size());
      std::size_t open_cells = 0;
      double area = 0.0;
      for (std::size_t k = 0; k < circles.size(); ++k) {
        const Hole& h = c.holes[k];
        EXPECT_NEAR(apart(band, h.a, circles[k].a), 0.0, 2e-3);
        EXPECT_NEAR(h.s, circles[k].s, 2e-3);
        EXPECT_NEAR(h.diameter, circles[k].diameter, 2.1e-3);
        EXPECT_EQ(h.filled, h.diameter <= (limit > 0.0 ? limit : 10e-3));
        EXPECT_EQ(h.filled, circles[k].diameter <= (limit > 0.0 ? limit : 10e-3));
        // cells next to the rim count as covered
        const double r = 0.5 * circles[k].diameter;
        EXPECT_LT(h.area, std::numbers::pi * r * r);
        EXPECT_GT(h.area, std::numbers::pi * (r - 2e-3) * (r - 2e-3));
        area += h.area;
        if (!h.filled) open_cells += static_cast<std::size_t>(std::lround(h.area / (points.cell_a * points.cell_s)));
      }
      EXPECT_NEAR(c.hole_area, area, 1e-12);
      EXPECT_EQ(c.whole(), open_cells == 0);
      EXPECT_EQ(static_cast<std::size_t>(std::count(c.open.begin(), c.open.end(), 1)), open_cells);
      for (std::size_t cell = 0; cell < c.open.size(); ++cell)
        if (c.open[cell] != 0) {
          EXPECT_EQ(points.begin[cell], points.begin[cell + 1]);
        }
    }
  }
}

TEST(Coverage, OutliersCoverNothing) {
  const Band band = tests::straight_band(kSheetLength, kSheetWidth, false);
  BandPoints points = with_holes(band, {});
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (std::hypot(points.a[i] - 0.2, points.s[i] - 30e-3) < 8e-3)
      points.state[i] = i % 2 == 0 ? PointState::outlier : PointState::off_band;
    if (std::hypot(points.a[i] - 0.4, points.s[i] - 30e-3) < 8e-3) points.state[i] = PointState::held_out;
  }
  const Coverage c = find_coverage(points, band, {});
  ASSERT_EQ(c.holes.size(), 1u);
  EXPECT_NEAR(c.holes[0].a, 0.2, 2e-3);
}

TEST(Coverage, DistancesAgreeWithBruteForce) {
  std::size_t all_holes = 0;
  for (const bool closed : {false, true})
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
      constexpr std::size_t kSmallRows = 80, kSmallColumns = 48;
      const Band band = tests::straight_band(80e-3, 36e-3, closed);
      Random random(seed);
      std::vector<Sample> samples;
      std::vector<std::uint8_t> present(kSmallRows * kSmallColumns, 0);
      const double da = 80e-3 / kSmallRows, ds = 36e-3 / kSmallColumns;
      const double part = 0.4 + 0.045 * static_cast<double>(seed);
      for (std::size_t r = 0; r < kSmallRows; ++r)
        for (std::size_t c = 0; c < kSmallColumns; ++c)
          if (random.uniform() < part &&
              std::hypot(static_cast<double>(r % 40) - 2.0, static_cast<double>(c) - 20.0) > 7.0) {
            samples.push_back({da * (static_cast<double>(r) + 0.5), ds * (static_cast<double>(c) + 0.5), 0.0});
            present[r * kSmallColumns + c] = 1;
          }
      const Coverage cover =
          find_coverage(tests::sorted(band, kSmallRows, kSmallColumns, samples), band, {.least_filled = 0.0});
      // as for points that are about as far apart along as across
      if (cover.gap_a > 2.0 * cover.gap_s || cover.gap_s > 2.0 * cover.gap_a) continue;
      std::vector<double> distance(present.size(), 1e9);
      for (std::size_t p = 0; p < present.size(); ++p)
        for (std::size_t q = 0; q < present.size(); ++q) {
          if (present[q] == 0) continue;
          double rows = std::fabs(static_cast<double>(p / kSmallColumns) - static_cast<double>(q / kSmallColumns));
          if (closed) rows = std::min(rows, static_cast<double>(kSmallRows) - rows);
          const double columns = static_cast<double>(p % kSmallColumns) - static_cast<double>(q % kSmallColumns);
          distance[p] = std::min(distance[p], std::hypot(da * rows, ds * columns));
        }
      // regions by repeated union
      const double covered = 1.01 * std::max(std::min(cover.gap_a, cover.gap_s), std::min(da, ds));
      std::vector<std::size_t> region(present.size());
      for (std::size_t p = 0; p < region.size(); ++p) region[p] = p;
      std::vector<std::size_t> bare;
      for (std::size_t p = 0; p < region.size(); ++p)
        if (distance[p] > covered) bare.push_back(p);
      for (bool changed = true; changed;) {
        changed = false;
        for (const std::size_t p : bare)
          for (const std::size_t q : bare) {
            if (region[p] <= region[q]) continue;
            auto rows = std::max(p / kSmallColumns, q / kSmallColumns) - std::min(p / kSmallColumns, q / kSmallColumns);
            if (closed) rows = std::min(rows, kSmallRows - rows);
            const auto columns =
                std::max(p % kSmallColumns, q % kSmallColumns) - std::min(p % kSmallColumns, q % kSmallColumns);
            if (rows > 1 || columns > 1) continue;
            region[p] = region[q];
            changed = true;
          }
      }
      std::vector<double> diameter(present.size(), 0.0), wanted, got;
      std::size_t cells = 0;
      for (std::size_t p = 0; p < region.size(); ++p)
        if (distance[p] > covered) {
          diameter[region[p]] = std::max(diameter[region[p]], 2.0 * distance[p]);
          ++cells;
        }
      for (const double d : diameter)
        if (d > 0.0) wanted.push_back(d);
      std::sort(wanted.rbegin(), wanted.rend());
      for (const Hole& h : cover.holes) got.push_back(h.diameter);
      ASSERT_EQ(got.size(), wanted.size());
      for (std::size_t k = 0; k < got.size(); ++k) EXPECT_NEAR(got[k], wanted[k], 1e-9);
      EXPECT_NEAR(cover.hole_area, da * ds * static_cast<double>(cells), 1e-12);
      all_holes += got.size();
    }
  EXPECT_GT(all_holes, 40u);
}

TEST(Coverage, SidesThatAreHardlyCoveredAreLeftOut) {
  const Band band = tests::straight_band(kSheetLength, kSheetWidth, false);
  auto samples = tests::scattered(band, kSheetRows, kSheetColumns, 2, 0.0, 1, [](double, double) { return 0.0; });
  // 6 columns at the left with points along a third of the length, 9 without any at the right
  std::erase_if(samples, [](const Sample& p) { return (p.s < 6e-3 && p.a > kSheetLength / 3) || p.s > 55e-3; });
  const Coverage c = find_coverage(tests::sorted(band, kSheetRows, kSheetColumns, samples), band, {});
  // a column beside a full one counts as covered
  EXPECT_EQ(c.first_column, 5u);
  EXPECT_EQ(c.last_column, kSheetColumns - 8);
  EXPECT_TRUE(c.holes.empty());
  const Coverage lenient =
      find_coverage(tests::sorted(band, kSheetRows, kSheetColumns, samples), band, {.least_filled = 0.2});
  EXPECT_EQ(lenient.first_column, 0u);
  EXPECT_EQ(lenient.last_column, kSheetColumns - 8);
  ASSERT_EQ(lenient.holes.size(), 1u);
  EXPECT_FALSE(lenient.holes[0].filled == (lenient.holes[0].diameter > lenient.limit));
}

TEST(Coverage, GapsBetweenScanLinesAreNoHoles) {
  for (const bool closed : {false, true}) {
    const Band band = tests::straight_band(kSheetLength, kSheetWidth, closed);
    constexpr double kApart = 12.5e-3;
    std::vector<Sample> samples;
    for (int line = 0; line < 40; ++line)
      for (int k = 0; k < 256; ++k) samples.push_back({kApart * (line + 0.5), kSheetWidth * (k + 0.5) / 256, 0.0});
    const Coverage lines = find_coverage(tests::sorted(band, kSheetRows, kSheetColumns, samples), band, {});
    EXPECT_NEAR(lines.gap_a, kApart, 1.1e-3);
    EXPECT_NEAR(lines.gap_s, 1e-3, 1e-9);
    EXPECT_NEAR(lines.limit, 2.0 * lines.gap_a, 1e-12);
    EXPECT_TRUE(lines.holes.empty());
    // six lines are missing over 50 mm
    std::erase_if(samples,
                  [](const Sample& p) { return std::fabs(p.a - 0.25) < 3 * kApart && p.s > 7e-3 && p.s < 57e-3; });
    const Coverage hole = find_coverage(tests::sorted(band, kSheetRows, kSheetColumns, samples), band, {});
    EXPECT_NEAR(hole.gap_a, kApart, 1.1e-3);
    ASSERT_EQ(hole.holes.size(), 1u);
    EXPECT_NEAR(hole.holes[0].a, 0.25, 2.0 * kApart);
    EXPECT_NEAR(hole.holes[0].s, 32e-3, 2e-3);
    // as wide as points are missing across; open
    EXPECT_NEAR(hole.holes[0].diameter, 50e-3, 3e-3);
    EXPECT_FALSE(hole.holes[0].filled);
    // up to one line's distance on both sides counts as covered
    EXPECT_NEAR(hole.holes[0].area, 5 * kApart * 48e-3, 0.1 * 5 * kApart * 48e-3);
  }
}

TEST(Coverage, AHoleAllAcrossIsNotUsual) {
  for (const bool closed : {false, true}) {
    const Band band = tests::straight_band(kSheetLength, kSheetWidth, closed);
    auto samples = tests::scattered(band, kSheetRows, kSheetColumns, 2, 0.0, 1, [](double, double) { return 0.0; });
    std::erase_if(samples, [](const Sample& p) { return p.a > 0.2 && p.a < 0.275; });  // 15 %
    const Coverage c = find_coverage(tests::sorted(band, kSheetRows, kSheetColumns, samples), band, {});
    EXPECT_NEAR(c.gap_a, 1e-3, 1e-9);
    ASSERT_EQ(c.holes.size(), 1u);
    EXPECT_NEAR(c.holes[0].diameter, 75e-3, 2.1e-3);
    EXPECT_FALSE(c.holes[0].filled);
    EXPECT_NEAR(c.hole_area, 75e-3 * kSheetWidth, 3e-3 * kSheetWidth);
  }
}

}  // namespace
}  // namespace treadmark::scans
