// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs_net.hpp"

#include <limits>

#include "treadmark/backends/spline/bspline_basis.hpp"

namespace treadmark::spline {
namespace {

struct Corners {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity()), max = -min;
  void include(const Vec3& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
};

}  // namespace

NurbsNet::NurbsNet(std::vector<double> u_breaks, std::vector<double> v_breaks, std::vector<Quad> points)
    : u_(std::move(u_breaks)), v_(std::move(v_breaks)), stride_(3 * (v_.size() - 1) + 1), points_(std::move(points)) {
  const auto box = [](const Corners& c) { return Box{0.5 * (c.min + c.max), 0.5 * (c.max - c.min)}; };
  Level first{patches_u(), patches_v(), {}};
  for (int iu = 0; iu < first.nu; ++iu)
    for (int iv = 0; iv < first.nv; ++iv) {
      const BezierPatch p = patch(iu, iv);
      Corners corners;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) corners.include(p.point(i, j));
      first.boxes.push_back(box(corners));
    }
  levels_.push_back(std::move(first));
  while (levels_.back().boxes.size() > 1) {
    const Level& below = levels_.back();
    Level above{(below.nu + kFanOut - 1) / kFanOut, (below.nv + kFanOut - 1) / kFanOut, {}};
    for (int iu = 0; iu < above.nu; ++iu)
      for (int iv = 0; iv < above.nv; ++iv) {
        Corners corners;
        for (int ku = kFanOut * iu; ku < std::min(kFanOut * (iu + 1), below.nu); ++ku)
          for (int kv = kFanOut * iv; kv < std::min(kFanOut * (iv + 1), below.nv); ++kv) {
            corners.include(below.at(ku, kv).centre - below.at(ku, kv).half);
            corners.include(below.at(ku, kv).centre + below.at(ku, kv).half);
          }
        above.boxes.push_back(box(corners));
      }
    levels_.push_back(std::move(above));
  }
}

std::size_t NurbsNet::memory_bytes() const {
  std::size_t bytes = points_.capacity() * sizeof(Quad) + (u_.capacity() + v_.capacity()) * sizeof(double);
  for (const Level& level : levels_) bytes += level.boxes.capacity() * sizeof(Box);
  return bytes;
}

BezierPatch NurbsNet::patch(int iu, int iv) const {
  BezierPatch out;
  const Quad* corner = points_.data() + 3 * (static_cast<std::size_t>(iu) * stride_ + static_cast<std::size_t>(iv));
  for (std::size_t i = 0; i < 4; ++i) std::copy_n(corner + i * stride_, 4, out.b[i]);
  return out;
}

BezierPatch NurbsNet::patch(int iu, int iv, const Pose& X) const {
  BezierPatch out = patch(iu, iv);
  for (auto& row : out.b)
    for (Quad& q : row) {
      const double w = q.w();
      const Vec3 p = X.rotation.transpose() * (Vec3(q.x(), q.y(), q.z()) - w * X.origin);
      q = {p.x(), p.y(), p.z(), w};
    }
  return out;
}

Box3 NurbsNet::bounds() const {
  const Box& box = levels_.back().boxes.front();
  return {box.centre - box.half, box.centre + box.half};
}

NurbsNet::Place NurbsNet::find(double u, double v) const {
  const int iu = find_span(u_, u, 0, patches_u() - 1), iv = find_span(v_, v, 0, patches_v() - 1);
  const auto local = [](double x, double low, double high) { return std::clamp((x - low) / (high - low), 0.0, 1.0) - 0.5; };
  return {iu, iv, local(u, u_break(iu), u_break(iu + 1)), local(v, v_break(iv), v_break(iv + 1))};
}

}  // namespace treadmark::spline
