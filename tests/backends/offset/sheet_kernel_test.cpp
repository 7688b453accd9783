// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "treadmark/backends/offset/block_directory.hpp"
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/offset/sheet_field.hpp"
#include "treadmark/backends/offset/sheet_kernel.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/kernel.hpp"

namespace treadmark::testing {
namespace {

using offset::BlockDirectory;
using offset::Interpolation;

constexpr double kPi = std::numbers::pi;

OffsetMap rough_map(bool turn) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(-1e-3f, 1e-3f);
  OffsetMap map{"map", {}, {}};
  map.grid = turn ? Grid2{0.0, -0.03, 2.0 * kPi / 150, 1e-3, 150, 90} : Grid2{-0.05, -0.03, 1e-3, 0.7e-3, 101, 90};
  map.offset.resize(map.grid.size());
  for (float& v : map.offset) v = random() % 5 == 0 ? std::nanf("") : value(random);
  return map;
}

struct Values {
  std::vector<double> u, y, d, d_u, d_y;
  explicit Values(std::size_t n) : u(n), y(n), d(n), d_u(n), d_y(n) {}
};

TEST(SheetKernel, ManyPointsEqualSingleOnes) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (const Body body : {Body::wheel, Body::rail}) {
    const bool wheel = body == Body::wheel;
    const auto offsets = offset::offsets_from_map(rough_map(wheel), body, 0.0).offsets;
    for (const Interpolation kind : {Interpolation::bilinear, Interpolation::quadratic, Interpolation::bicubic}) {
      const auto field = offset::make_sheet_field(offsets, kind);
      Values v(4000);
      for (std::size_t i = 0; i < v.u.size(); ++i) {
        v.u[i] = wheel ? 9.0 * unit(random) : 0.07 * unit(random);  // beyond a turn; beyond the ends
        v.y[i] = 0.05 * unit(random);
      }
      v.u[7] = wheel ? kPi : 0.05, v.u[8] = wheel ? -kPi : -0.05, v.u[9] = wheel ? 2.0 * kPi : 0.0;
      field->evaluate(v.u, v.y, v.d, v.d_u, v.d_y);
      int some = 0;
      for (std::size_t i = 0; i < v.u.size(); ++i) {
        const auto j = field->jet(v.u[i], v.y[i]);
        EXPECT_NEAR(v.d[i], j.value, 1e-14);
        some += j.value != 0.0;
        if (kind == Interpolation::bilinear && i >= 7 && i <= 9) continue;  // kinks, where rounding chooses the side
        // two ways to the same voxel place, which lies up to 1e-15 turns of slopes of a metre per radian apart
        EXPECT_NEAR(v.d_u[i], j.d_u, 1e-11 * (1.0 + std::fabs(j.d_u)));
        EXPECT_NEAR(v.d_y[i], j.d_y, 1e-11 * (1.0 + std::fabs(j.d_y)));
      }
      EXPECT_GT(some, 1000);
    }
  }
}

TEST(SheetKernel, FarAwayAndNowhereThereIsNothing) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const Body body : {Body::wheel, Body::rail}) {
    const auto offsets = offset::offsets_from_map(rough_map(body == Body::wheel), body, 0.0).offsets;
    for (const Interpolation kind : {Interpolation::bilinear, Interpolation::quadratic, Interpolation::bicubic}) {
      const auto field = offset::make_sheet_field(offsets, kind);
      for (const double far : {1e7, -1e7, 1e300, -1e300, inf, -inf, nan}) {
        const double y = 0.0;
        double d = 1.0, d_u = 1.0, d_y = 1.0;
        field->evaluate({&y, 1}, {&far, 1}, {&d, 1}, {&d_u, 1}, {&d_y, 1});
        EXPECT_EQ(d, 0.0);
        EXPECT_EQ(d_u, 0.0);
        EXPECT_EQ(d_y, 0.0);
        EXPECT_EQ(field->jet(y, far).value, 0.0);
        if (body == Body::wheel && std::fabs(far) < 1e10) continue;  // a turn has no end
        field->evaluate({&far, 1}, {&y, 1}, {&d, 1}, {}, {});
        EXPECT_EQ(d, 0.0) << far;
        EXPECT_EQ(field->jet(far, y).value, 0.0) << far;
      }
    }
  }
}

TEST(SheetKernel, BothKernelsAgree) {
  if (avx2_kernel<offset::SheetKernel>() == nullptr) GTEST_SKIP() << "this machine runs one kernel only";
  std::mt19937 random(11);
  std::uniform_real_distribution<float> value(-1.0f, 1.0f);
  std::uniform_real_distribution<double> place(-60.0, 150.0);
  std::vector<std::vector<float>> store(6, std::vector<float>(512));
  for (auto& block : store)
    for (float& v : block) v = value(random);
  std::vector<const float*> table;
  for (const auto& block : store) table.push_back(block.data());
  table[2] = nullptr;
  for (const int turn : {0, 21}) {
    const offset::SheetView view{0.1, 3.0, -0.2, 5.0,     0.0,    static_cast<double>(turn), turn, table.data(), 0,
                                 3,   -1,  2,    nullptr, nullptr};
    for (const int degree : {1, 2, 3}) {
      Values a(5000), b(5000);
      for (std::size_t i = 0; i < a.u.size(); ++i)
        b.u[i] = a.u[i] = place(random) / 9.0, b.y[i] = a.y[i] = place(random) / 5.0;
      offset::SheetKernel::generic.of_degree[degree](view, a.u.size(), a.u.data(), a.y.data(), a.d.data(), a.d_u.data(),
                                                     a.d_y.data());
      offset::SheetKernel::avx2->of_degree[degree](view, b.u.size(), b.u.data(), b.y.data(), b.d.data(), b.d_u.data(),
                                                   b.d_y.data());
      int some = 0;
      for (std::size_t i = 0; i < a.u.size(); ++i) {
        ASSERT_NEAR(a.d[i], b.d[i], 1e-13) << degree << ' ' << turn;
        ASSERT_NEAR(a.d_u[i], b.d_u[i], 1e-12);
        ASSERT_NEAR(a.d_y[i], b.d_y[i], 1e-12);
        some += a.d[i] != 0.0;
      }
      EXPECT_GT(some, 500);
    }
  }
}

TEST(SheetKernel, BlocksAreFoundInTablesAndLists) {
  for (const bool scattered : {false, true}) {
    offset::SheetGrid grid;
    std::vector<offset::BlockKey> keys;
    for (int k = 0; k < 40; ++k)
      keys.push_back(scattered ? offset::BlockKey{k * 4001 - 70000, 300 - k * 977}
                               : offset::BlockKey{k % 8 - 3, k / 8});
    for (const offset::BlockKey& key : keys) {
      offset::Block block{};
      block[5] = static_cast<float>(key.bi + 1000003), block[500] = static_cast<float>(key.bj + 1000003);
      grid.insert(key, block, 0.0f);
    }
    const BlockDirectory directory(grid);
    EXPECT_EQ(directory.table() == nullptr, scattered);
    for (const offset::BlockKey& key : keys) {
      EXPECT_EQ(directory.get(key.bi, key.bj), grid.block(key));
      for (int i = -1; i <= 1; ++i)
        EXPECT_EQ(directory.get(key.bi + i, key.bj - 30), grid.block({key.bi + i, key.bj - 30}));
    }
  }
  const offset::SheetGrid nothing;
  EXPECT_EQ(BlockDirectory(nothing).get(0, 0), nullptr);
}

TEST(SheetKernel, StepsOfNothingAreRefused) {
  OffsetMap map = rough_map(false);
  map.grid.dy = 1e-12;
  EXPECT_THROW(offset::offsets_from_map(map, Body::rail, 0.0), Error);
  map.grid.dy = 1e-3, map.grid.dx = 1e-300;
  EXPECT_THROW(offset::offsets_from_map(map, Body::rail, 0.0), Error);
}

}  // namespace
}  // namespace treadmark::testing
