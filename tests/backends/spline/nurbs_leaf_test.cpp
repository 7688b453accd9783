// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs/nurbs_leaf.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace treadmark::spline {
namespace {

/// A bent patch over 0..2 mm by 0..3 mm, leaning and with uneven speed along u; exact as polynomials by their polar
/// forms (Farin 2002): x = 2 u + 0.2 u^2, y = 3 v + 0.1 u, z = u v + 0.5 v^3 [mm].
BezierPatch bent() {
  BezierPatch patch;
  patch.rational = false;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const double u = i / 3.0, v = j / 3.0, u2 = i < 2 ? 0.0 : i < 3 ? 1.0 / 3.0 : 1.0, v3 = j < 3 ? 0.0 : 1.0;
      patch.b[i][j] = Quad(1e-3 * (2.0 * u + 0.2 * u2), 1e-3 * (3.0 * v + 0.1 * u), 1e-3 * (u * v + 0.5 * v3), 1.0);
    }
  return patch;
}
Vec3 on_bent(double u, double v) {
  return 1e-3 * Vec3(2.0 * u + 0.2 * u * u, 3.0 * v + 0.1 * u, u * v + 0.5 * v * v * v);
}

TEST(NurbsLeaf, SolvesWithinItsFourBordersAndNotBeyondAnyOfThem) {
  const BezierPatch patch = bent();
  const NurbsLeaf leaf(patch, ControlBox(patch));
  ASSERT_TRUE(leaf.regular());
  const auto solve = [&](double u, double v, bool exact, double from, LeafRoot& root) {
    const Vec3 p = on_bent(u, v);
    return leaf.solve(p.x(), p.y(), from * (u - 0.5), from * (v - 0.5), exact, root);
  };
  for (const bool exact : {true, false})
    for (const double from : {1.0, 0.0})  // of a good guess and of none
      for (const double along : {0.07, 0.5, 0.93})
        for (const double beyond : {-1e-2, -1e-6, 1e-6, 1e-3, 0.1}) {
          const bool inside = beyond < 0.0;
          for (const Vec2& p :
               {Vec2(-beyond, along), Vec2(1.0 + beyond, along), Vec2(along, -beyond), Vec2(along, 1.0 + beyond)}) {
            LeafRoot root;
            ASSERT_EQ(solve(p.x(), p.y(), exact, from, root), inside) << p.transpose() << ' ' << exact << ' ' << from;
            if (!inside) continue;
            EXPECT_NEAR(root.s, p.x() - 0.5, exact ? 1e-12 : 1e-5);
            EXPECT_NEAR(root.t, p.y() - 0.5, exact ? 1e-12 : 1e-5);
            EXPECT_NEAR(root.z, on_bent(p.x(), p.y()).z(), 1e-15);
          }
        }
}

}  // namespace
}  // namespace treadmark::spline
