// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs/nurbs_leaf.hpp"

namespace treadmark::spline {

ControlBox::ControlBox(const BezierPatch& part) {
  if (!part.rational) weight = {1.0, 1.0};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const Vec3 p = part.point(i, j);
      x.include({p.x(), p.x()});
      y.include({p.y(), p.y()});
      z.include({p.z(), p.z()});
      if (part.rational) weight.include({part.b[i][j].w(), part.b[i][j].w()});
    }
}

NurbsLeaf::NurbsLeaf(const BezierPatch& part, const ControlBox& box) : power_(part), box_(box) {
  using namespace nurbs_limits;
  const Quad &c = power_.c[0][0], &cs = power_.c[1][0], &ct = power_.c[0][1];
  const double inverse_w = 1.0 / c.w();
  middle_x_ = c.x() * inverse_w, middle_y_ = c.y() * inverse_w;
  const double x_s = cs.x() - middle_x_ * cs.w(), x_t = ct.x() - middle_x_ * ct.w();
  const double y_s = cs.y() - middle_y_ * cs.w(), y_t = ct.y() - middle_y_ * ct.w();
  const double inverse = 1.0 / (x_s * y_t - x_t * y_s);
  a_[0] = y_t * inverse, a_[1] = -x_t * inverse, a_[2] = -y_s * inverse, a_[3] = x_s * inverse;

  // G at the point in the middle; other points of the box change it by W.
  double gs[4][4], gt[4][4];
  s_ = t_ = Interval::none();
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const Quad& q = part.b[i][j];
      const double gx = q.x() - middle_x_ * q.w(), gy = q.y() - middle_y_ * q.w();
      gs[i][j] = a_[0] * gx + a_[1] * gy;
      gt[i][j] = a_[2] * gx + a_[3] * gy;
      s_.include({gs[i][j], gs[i][j]});
      t_.include({gt[i][j], gt[i][j]});
    }
  s_ = {s_.low - kRounding, s_.high + kRounding};
  t_ = {t_.low - kRounding, t_.high + kRounding};

  // Entries of E from differences of control points.
  double e[4] = {0.0, 0.0, 0.0, 0.0}, change_w_u = 0.0, change_w_v = 0.0;
  const auto widen = [](double& most, double x) { most = std::max(most, std::abs(x)); };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      if (i < 3) {
        widen(e[0], 3.0 * (gs[i + 1][j] - gs[i][j]) - 1.0);
        widen(e[2], 3.0 * (gt[i + 1][j] - gt[i][j]));
        if (part.rational) widen(change_w_u, 3.0 * (part.b[i + 1][j].w() - part.b[i][j].w()));
      }
      if (j < 3) {
        widen(e[1], 3.0 * (gs[i][j + 1] - gs[i][j]));
        widen(e[3], 3.0 * (gt[i][j + 1] - gt[i][j]) - 1.0);
        if (part.rational) widen(change_w_v, 3.0 * (part.b[i][j + 1].w() - part.b[i][j].w()));
      }
    }
  // Only lines that meet the part count, and for those q = A (p - middle) lies in the range of A G / W.
  const double reach_s = s_.width() / box.weight.low, reach_t = t_.width() / box.weight.low;
  const double change_w = std::max(change_w_u, change_w_v);
  e[0] += change_w * reach_s, e[1] += change_w * reach_s, e[2] += change_w * reach_t, e[3] += change_w * reach_t;
  upright_ = !std::isfinite(s_.width()) || !std::isfinite(t_.width());
  regular_ = !upright_ && e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3] < kContraction * kContraction;
  if (regular_) return;
  double bend_u = 0.0, bend_v = 0.0;
  for (const auto* g : {&gs, &gt})
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 2; ++j) {
        widen(bend_u, (*g)[j][i] - 2.0 * (*g)[j + 1][i] + (*g)[j + 2][i]);
        widen(bend_v, (*g)[i][j] - 2.0 * (*g)[i][j + 1] + (*g)[i][j + 2]);
      }
  // weights that change along a direction disturb as much as bends do
  const double reach = part.rational && !upright_ ? std::max(reach_s, reach_t) : 0.0;
  bends_along_u_ = 3.0 * bend_u + change_w_u * reach > 3.0 * bend_v + change_w_v * reach;
}

PatchPowers NurbsLeaf::powers() const {
  PatchPowers out;
  out.rational = box_.weight.low != 1.0 || box_.weight.high != 1.0;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const Quad& q = power_.c[i][j];
      const int k = 4 * i + j;
      out.x[k] = q.x(), out.y[k] = q.y(), out.z[k] = q.z(), out.w[k] = q.w();
    }
  const double w = power_.c[0][0].w();
  for (int k = 0; k < 4; ++k) out.a[k] = a_[k] * w;
  out.middle[0] = middle_x_, out.middle[1] = middle_y_;
  constexpr int kSecond[3][2] = {{2, 0}, {1, 1}, {0, 2}};
  for (int k = 0; k < 3; ++k) {
    const Quad& q = power_.c[kSecond[k][0]][kSecond[k][1]];
    const double x = q.x() - middle_x_ * q.w(), y = q.y() - middle_y_ * q.w();
    out.bend[k] = a_[0] * x + a_[1] * y;
    out.bend[3 + k] = a_[2] * x + a_[3] * y;
  }
  // q W lies in the range of A G, see meets().
  const auto reach = [&](const Interval& range, double* to) {
    to[0] = w * std::min(range.low / box_.weight.low, range.low / box_.weight.high);
    to[1] = w * std::max(range.high / box_.weight.low, range.high / box_.weight.high);
  };
  reach(s_, out.reach);
  reach(t_, out.reach + 2);
  out.range[0] = box_.x.low, out.range[1] = box_.x.high, out.range[2] = box_.y.low, out.range[3] = box_.y.high;
  return out;
}

/// Evaluates at root.s, root.t; returns the residual [m] and the step that removes it.
inline double NurbsLeaf::newton_step(double x, double y, LeafRoot& root, double& ds, double& dt) const {
  const PowerPatch::Jet at = power_.jet(root.s, root.t);
  const double w = 1.0 / at.value.w();
  const double px = at.value.x() * w, py = at.value.y() * w, pz = at.value.z() * w;
  const double x_s = (at.by_s.x() - px * at.by_s.w()) * w, x_t = (at.by_t.x() - px * at.by_t.w()) * w;
  const double y_s = (at.by_s.y() - py * at.by_s.w()) * w, y_t = (at.by_t.y() - py * at.by_t.w()) * w;
  const double z_s = (at.by_s.z() - pz * at.by_s.w()) * w, z_t = (at.by_t.z() - pz * at.by_t.w()) * w;
  const double inverse = 1.0 / (x_s * y_t - x_t * y_s), miss_x = x - px, miss_y = y - py;
  root.s_x = y_t * inverse, root.s_y = -x_t * inverse, root.t_x = -y_s * inverse, root.t_y = x_s * inverse;
  root.dzdx = z_s * root.s_x + z_t * root.t_x;
  root.dzdy = z_s * root.s_y + z_t * root.t_y;
  root.z = pz + root.dzdx * miss_x + root.dzdy * miss_y;
  ds = root.s_x * miss_x + root.s_y * miss_y;
  dt = root.t_x * miss_x + root.t_y * miss_y;
  return std::max(std::abs(miss_x), std::abs(miss_y));
}

bool NurbsLeaf::solve(double x, double y, double s, double t, bool exact, LeafRoot& root) const {
  using namespace nurbs_limits;
  constexpr int kSteps = 8;
  root.s = std::clamp(s, -kBorder, kBorder);
  root.t = std::clamp(t, -kBorder, kBorder);
  for (int i = 0; i < kSteps; ++i) {
    double ds, dt;
    const double residual = newton_step(x, y, root, ds, dt);
    const double limit = exact ? kExact : kNear;
    if (residual * (1.0 + root.dzdx * root.dzdx + root.dzdy * root.dzdy) <= limit) {
      root.s += ds;
      root.t += dt;
      return std::abs(root.s) <= kBorder && std::abs(root.t) <= kBorder;
    }
    const double next_s = std::clamp(root.s + ds, -kFurthest, kFurthest),
                 next_t = std::clamp(root.t + dt, -kFurthest, kFurthest);
    if (next_s == root.s && next_t == root.t) break;  // at rounding, or held at the limit
    root.s = next_s;
    root.t = next_t;
  }
  return contract(x, y, root);
}

/// From the middle by the contraction, kept in the square: it finds the solution if there is one in the leaf.
bool NurbsLeaf::contract(double x, double y, LeafRoot& root) const {
  constexpr int kSteps = 200;
  using nurbs_limits::kBorder;
  constexpr double kSettled = 1e-14, kOnLine = 1e-9;
  root.s = root.t = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const Quad n = power_.jet(root.s, root.t).value;
    const double gx = n.x() - x * n.w(), gy = n.y() - y * n.w();
    const double s = std::clamp(root.s - (a_[0] * gx + a_[1] * gy), -kBorder, kBorder);
    const double t = std::clamp(root.t - (a_[2] * gx + a_[3] * gy), -kBorder, kBorder);
    const double change = std::max(std::abs(s - root.s), std::abs(t - root.t));
    root.s = s;
    root.t = t;
    if (change < kSettled) break;
  }
  double ds, dt;
  const double residual = newton_step(x, y, root, ds, dt);
  return residual <= kOnLine && std::abs(root.s + ds) <= kBorder && std::abs(root.t + dt) <= kBorder;
}

}  // namespace treadmark::spline
