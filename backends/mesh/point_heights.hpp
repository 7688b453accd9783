// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>

#include "treadmark/backends/mesh/patch.hpp"
#include "treadmark/backends/mesh/smooth_patches.hpp"
#include "treadmark/core/surface.hpp"

namespace treadmark::mesh {

/// Writes what is wanted of a point.
struct Results {
  const HeightsOut& out;
  bool slopes;

  explicit Results(const HeightsOut& o) : out(o), slopes(!o.dzdx.empty() || !o.dzdy.empty()) {}

  void put(std::size_t i, double z, double dzdx, double dzdy) const {
    if (!out.z.empty()) out.z[i] = z;
    if (!out.dzdx.empty()) out.dzdx[i] = dzdx;
    if (!out.dzdy.empty()) out.dzdy[i] = dzdy;
  }
  void miss(std::size_t i) const {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    put(i, kNaN, kNaN, kNaN);
  }
};

/// Height, and derivatives if wanted, at a front hit: of the smooth surface, or of the facet where that counts (smooth
/// == nullptr).
Evaluated evaluate_hit(const SmoothPatches* smooth, const PlaneView& view, const ProjectedTriangle& triangle,
                       const LineHit& hit, double x, double y, int derivatives);

/// Heights at points of any triangles, four at a time. One object a thread; finish() writes the last ones.
class PointHeights {
 public:
  PointHeights(const PreparedMesh& mesh, const SmoothPatches* smooth, const PlaneView& view, const PlaneLines& lines,
               const Results& results)
      : mesh_(mesh), smooth_(smooth), view_(view), lines_(lines), results_(results) {}

  /// hit.cover is front.
  void add(std::size_t result, double x, double y, const LineHit& hit, const ProjectedTriangle& triangle);
  /// The same of a patch that was prepared, not beside a rim.
  void add(std::size_t result, double x, double y, std::uint32_t triangle, const double* patch);
  void finish();

 private:
  void put(std::size_t result, double x, double y, const LineHit& hit, const ProjectedTriangle& triangle) const;

  const PreparedMesh& mesh_;
  const SmoothPatches* smooth_;
  const PlaneView& view_;
  const PlaneLines& lines_;
  const Results& results_;
  std::uint32_t last_ = kNone;  ///< triangle of the last patch
  std::size_t count_ = 0;
  std::array<std::size_t, 4> result_;
  std::array<std::uint32_t, 4> triangle_;
  std::array<double, 4> x_, y_;
  std::array<double, 4 * kPatchEntries> patches_;
};

/// The point again in double precision and one at a time, for what kernels leave out.
void evaluate_again(const PreparedMesh& mesh, const SmoothPatches* smooth, const PlaneView& view,
                    const Results& results, std::size_t result, double x, double y, std::uint32_t triangle);

}  // namespace treadmark::mesh
