// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/mesh/point_heights.hpp"
#include "treadmark/core/kernel.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::mesh {

Evaluated evaluate_hit(const SmoothPatches* smooth, const PlaneView& view, const ProjectedTriangle& triangle,
                       const LineHit& hit, double x, double y, int derivatives) {
  Evaluated e;
  if (smooth && smooth->evaluate(view, triangle, hit, x, y, derivatives, e)) return e;
  e = {};
  e.z = hit.z;
  if (derivatives > 0) {
    const Vec2 slopes = triangle.slopes();
    e.dzdx = slopes.x();
    e.dzdy = slopes.y();
  }
  return e;
}

void PointHeights::put(std::size_t result, double x, double y, const LineHit& hit,
                       const ProjectedTriangle& triangle) const {
  const Evaluated e = evaluate_hit(smooth_, view_, triangle, hit, x, y, results_.slopes ? 1 : 0);
  results_.put(result, e.z, e.dzdx, e.dzdy);
}

void evaluate_again(const PreparedMesh& mesh, const SmoothPatches* smooth, const PlaneView& view,
                    const Results& results, std::size_t result, double x, double y, std::uint32_t triangle) {
  ProjectedTriangle projected;
  projected.load(mesh, view, triangle);
  const LineHit hit = projected.hit(projected.edges(x, y, view.side), Cover::front);
  const Evaluated e = evaluate_hit(smooth, view, projected, hit, x, y, results.slopes ? 1 : 0);
  results.put(result, e.z, e.dzdx, e.dzdy);
}

void PointHeights::add(std::size_t result, double x, double y, const LineHit& hit, const ProjectedTriangle& triangle) {
  if (!smooth_ || hit.beside) return put(result, x, y, hit, triangle);
  if (hit.triangle == last_ && count_ > 0)
    return add(result, x, y, hit.triangle, patches_.data() + (count_ - 1) * kPatchEntries);
  double* patch = patches_.data() + count_ * kPatchEntries;
  if (!smooth_->prepare(fastest_kernel<PatchKernel>(), lines_, hit.triangle, triangle.q[0].data(), patch))
    return put(result, x, y, hit, triangle);
  add(result, x, y, hit.triangle, patch);
}

void PointHeights::add(std::size_t result, double x, double y, std::uint32_t triangle, const double* patch) {
  double* own = patches_.data() + count_ * kPatchEntries;
  if (own != patch) std::copy_n(patch, kPatchEntries, own);
  result_[count_] = result;
  triangle_[count_] = last_ = triangle;
  x_[count_] = x;
  y_[count_] = y;
  if (++count_ == 4) finish();
}

void PointHeights::finish() {
  if (count_ == 0) return;
  for (std::size_t k = count_; k < 4; ++k) {
    std::copy_n(patches_.data(), kPatchEntries, patches_.data() + k * kPatchEntries);
    x_[k] = x_[0];
    y_[k] = y_[0];
  }
  std::array<double, 4> z, dzdx, dzdy;
  fastest_kernel<PatchKernel>().mixed(patches_.data(), lines_.side, x_.data(), y_.data(), z.data(),
                                      results_.slopes ? dzdx.data() : nullptr, dzdy.data());
  for (std::size_t k = 0; k < count_; ++k) {
    if (std::isnan(z[k]))
      evaluate_again(mesh_, smooth_, view_, results_, result_[k], x_[k], y_[k], triangle_[k]);
    else
      results_.put(result_[k], z[k], dzdx[k], dzdy[k]);
  }
  count_ = 0;
}

}  // namespace treadmark::mesh
