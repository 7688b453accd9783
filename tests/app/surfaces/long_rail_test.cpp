// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Rails of many slices, which are read about the places that are asked for: the same surface as all slices at once.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "treadmark/app/surfaces/named_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/profiles/read_slices.hpp"
#include "treadmark/io/profiles/write_slices.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

/// A head that waves along and is worn here and there.
SliceSet waving(std::size_t count) {
  SliceSet out;
  out.body = Body::rail;
  out.name = "waves";
  constexpr double kApart = 10e-3, kRadius = 0.2;
  for (std::size_t i = 0; i < count; ++i) {
    out.u.push_back(kApart * static_cast<double>(i));
    Profile& profile = out.profiles.emplace_back();
    profile.body = Body::rail;
    for (int k = -20; k <= 20; ++k) {
      const double y = 1.5e-3 * k, x = out.u.back();
      profile.y.push_back(y);
      profile.z.push_back(y * y / (2.0 * kRadius) + 1e-4 * std::sin(40.0 * x) * std::cos(50.0 * y) +
                          1e-5 * std::sin(211.0 * x));
    }
  }
  return out;
}

TEST(LongRails, AreWhatAllSlicesAtOnceAre) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "long.slcs";
  constexpr std::size_t kCount = 4500;
  io::write_slices(file, waving(kCount));
  const NaturalSurface rail = named_surface(file, {});
  constexpr std::size_t kLittle = 10'000;  // [bytes]
  EXPECT_LT(rail.surface->memory_bytes(), kLittle) << "nothing was asked for yet";
  SurfaceSpec spec;
  spec.body = Body::rail;
  spec.shape = io::read_slices(file, Body::rail, {});
  const NaturalSurface whole = create_natural(spec);
  constexpr double kSame = 1e-10;  // [m]
  for (double x = 0.003; x < 44.98; x += 0.0371)
    for (const double y : {-25e-3, -3.3e-3, 0.0, 14.1e-3}) {
      const double here = height_at(*rail.surface, Pose{}, {x, y});
      EXPECT_NEAR(here, height_at(*whole.surface, Pose{}, {x, y}), kSame) << x << ' ' << y;
    }
  // where stretches meet, from both sides
  for (double x = 4.0; x < 44.0; x += 4.0)
    EXPECT_NEAR(height_at(*rail.surface, Pose{}, {x - 1e-9, 5e-3}), height_at(*rail.surface, Pose{}, {x + 1e-9, 5e-3}),
                kSame);
  const Box3 box = rail.surface->bounds();
  EXPECT_EQ(box.min.x(), 0.0);
  EXPECT_NEAR(box.max.x(), 44.99, 1e-9);
}

TEST(LongRails, OfDamagedSlicesAreRefused) {
  const testing::TemporaryFolder folder;
  const auto file = folder.path() / "long.slcs";
  io::write_slices(file, waving(4100));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    if (entry.is_directory()) std::ofstream(entry.path() / "slice_02000.txt", std::ios::app) << "32 5\n";
  EXPECT_THROW(named_surface(file, {}), Error);
}

}  // namespace
}  // namespace treadmark::app
