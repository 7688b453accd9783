// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/solvers/kalker/brute_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"
#include "treadmark/solvers/kalker/halfspace/gauss_legendre.hpp"

namespace treadmark::kalker::testing {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kAtRest = 1e-14;  // change of a sweep, or a round, over the largest traction

/// Displacement differences by a point load over the pair of bodies, times G (Boussinesq, Cerruti; Johnson 1985, ch.
/// 3).
InfluenceBlock point_load(double x, double y, const CombinedMaterial& m) {
  const double r2 = x * x + y * y, r = std::sqrt(r2), pi = std::numbers::pi;
  InfluenceBlock b;
  b.nn = (1.0 - m.poisson) / (pi * r);
  b.xx = ((1.0 - m.poisson) / r + m.poisson * x * x / (r2 * r)) / pi;
  b.yy = ((1.0 - m.poisson) / r + m.poisson * y * y / (r2 * r)) / pi;
  b.xy = b.yx = m.poisson * x * y / (r2 * r) / pi;
  b.nx = m.difference * x / (pi * r2);
  b.ny = m.difference * y / (pi * r2);
  b.xn = -b.nx;
  b.yn = -b.ny;
  return b;
}

void add(InfluenceBlock& sum, const InfluenceBlock& b, double weight) {
  for (const auto member :
       {&InfluenceBlock::xx, &InfluenceBlock::xy, &InfluenceBlock::xn, &InfluenceBlock::yx, &InfluenceBlock::yy,
        &InfluenceBlock::yn, &InfluenceBlock::nx, &InfluenceBlock::ny, &InfluenceBlock::nn})
    sum.*member += weight * b.*member;
}

/// Over an element, seen from another one's centre: panels of a Gauss rule; seen from its own: rays in all directions,
/// whose length takes the place of the singularity. What is odd vanishes there.
InfluenceBlock by_quadrature(double X, double Y, double dx, double dy, const CombinedMaterial& m) {
  const GaussRule rule = gauss_legendre(kMostGaussNodes);
  InfluenceBlock sum;
  const auto over = [&](double from, double to, int panels, auto function) {
    const double h = (to - from) / panels;
    for (int panel = 0; panel < panels; ++panel)
      for (std::size_t i = 0; i < rule.nodes.size(); ++i)
        function(from + h * (panel + 0.5 + 0.5 * rule.nodes[i]), 0.5 * h * rule.weights[i]);
  };
  constexpr int kPanels = 3;
  if (X != 0.0 || Y != 0.0) {
    over(-0.5 * dx, 0.5 * dx, kPanels, [&](double x, double wx) {
      over(-0.5 * dy, 0.5 * dy, kPanels, [&](double y, double wy) { add(sum, point_load(X - x, Y - y, m), wx * wy); });
    });
    return sum;
  }
  const double corner = std::atan2(dy, dx);
  const auto ray = [&](double angle, double weight) {
    const double c = std::cos(angle), s = std::sin(angle);
    add(sum, point_load(c, s, m), 4.0 * weight * (angle < corner ? 0.5 * dx / c : 0.5 * dy / s));
  };
  over(0.0, corner, kPanels, ray);
  over(corner, 0.5 * std::numbers::pi, kPanels, ray);
  return {.xx = sum.xx, .yy = sum.yy, .nn = sum.nn};
}

/// Displacements [m/Pa] by tractions: 3 n x 3 n, all of x, then of y, then of n; seen `ahead` of the elements.
MatrixXd influence_matrix(const ContactProblem& problem, double ahead, Coefficients coefficients) {
  const Grid2& g = problem.grid;
  const CombinedMaterial m = combine(problem.material);
  const ConstantElements closed(g.dx, g.dy, m.poisson, m.difference);
  const auto n = static_cast<Eigen::Index>(g.size());
  // One block an offset, as the grid is regular.
  const int wide = 2 * g.nx - 1;
  std::vector<InfluenceBlock> by_offset;
  for (int j = 1 - g.ny; j < g.ny; ++j)
    for (int i = 1 - g.nx; i < g.nx; ++i) {
      const double X = i * g.dx + ahead, Y = j * g.dy;
      by_offset.push_back(coefficients == Coefficients::closed_form ? closed.at(X, Y)
                                                                    : by_quadrature(X, Y, g.dx, g.dy, m));
    }
  MatrixXd a(3 * n, 3 * n);
  for (int to = 0; to < n; ++to)
    for (int from = 0; from < n; ++from) {
      const int i = to % g.nx - from % g.nx, j = to / g.nx - from / g.nx;
      const InfluenceBlock& b = by_offset[static_cast<std::size_t>((j + g.ny - 1) * wide + i + g.nx - 1)];
      const std::array<std::array<double, 3>, 3> block{{{b.xx, b.xy, b.xn}, {b.yx, b.yy, b.yn}, {b.nx, b.ny, b.nn}}};
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          a(r * n + to, c * n + from) =
              block[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] / m.shear_modulus;
    }
  return a;
}

/// Pressures p >= 0 with e = h + A p >= 0 and p e = 0; NaN in h: never in contact. Elements that pull are left out and
/// those that overlap are taken in until there are none; from the pressures of some sweeps.
VectorXd pressures(const MatrixXd& a, const VectorXd& h) {
  const Eigen::Index n = h.size();
  VectorXd p = VectorXd::Zero(n);
  const auto sweep = [&] {
    double change = 0.0;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (std::isnan(h[i])) continue;
      const double next = std::max(0.0, p[i] - (h[i] + a.row(i).dot(p)) / a(i, i));
      change = std::max(change, std::abs(next - p[i]));
      p[i] = next;
    }
    return change;
  };
  constexpr int kFirstSweeps = 20, kTries = 60, kMostSweeps = 100'000;
  for (int k = 0; k < kFirstSweeps; ++k) sweep();
  std::vector<char> inside(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) inside[static_cast<std::size_t>(i)] = p[i] > 0.0;
  for (int k = 0; k < kTries; ++k) {
    std::vector<Eigen::Index> at;
    for (Eigen::Index i = 0; i < n; ++i)
      if (inside[static_cast<std::size_t>(i)] != 0) at.push_back(i);
    VectorXd next = VectorXd::Zero(n);
    if (!at.empty()) {
      const MatrixXd of_these = a(at, at);
      const VectorXd depths = -h(at), solved = of_these.llt().solve(depths);
      next(at) = solved;
    }
    const VectorXd e = h + a * next;
    bool same = true;
    for (Eigen::Index i = 0; i < n; ++i) {
      char& in = inside[static_cast<std::size_t>(i)];
      const char wanted = in != 0 ? next[i] >= 0.0 : e[i] < 0.0;  // false for NaN
      same = same && in == wanted;
      in = wanted;
    }
    if (same) return next;
  }
  for (int k = 0; k < kMostSweeps && sweep() > kAtRest * p.maxCoeff();) ++k;
  return p;
}

/// The traction in the disc for which the slip r + d q of one element is zero or opposes it.
std::array<double, 2> in_disc(const std::array<double, 2>& r, const std::array<double, 2>& d, double bound) {
  const auto at = [&](double l) { return std::array<double, 2>{-r[0] / (d[0] + l), -r[1] / (d[1] + l)}; };
  const auto length_of = [](const std::array<double, 2>& q) { return std::sqrt(q[0] * q[0] + q[1] * q[1]); };
  std::array<double, 2> q = at(0.0);
  double length = length_of(q);
  if (!(length > bound)) return q;
  // q = -r / (d + l) of length bound, l > 0: the length falls as l grows, and its inverse is nearly straight and
  // concave, so that Newton's steps from the left stay there; halving where rounding leads them astray.
  double l = 0.0, low = 0.0, high = length_of(r) / bound;
  for (int k = 0; k < 200 && high - low > 1e-16 * high; ++k) {
    (length > bound ? low : high) = l;
    const double slope = (q[0] * q[0] / (d[0] + l) + q[1] * q[1] / (d[1] + l)) / (length * length * length);
    double next = l + (1.0 / bound - 1.0 / length) / slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool at_rest = std::abs(next - l) <= 1e-16 * (d[0] + next);
    l = next;
    q = at(l);
    length = length_of(q);
    if (at_rest) break;
  }
  return {q[0] * bound / length, q[1] * bound / length};
}

/// Tractions within mu p whose slip w + A q vanishes or opposes them, from element to element, against the direction of
/// rolling. False: they do not come to rest.
bool tractions(const MatrixXd& a, const VectorXd& w, const VectorXd& bound, bool last_first, VectorXd& q) {
  const Eigen::Index n = bound.size();
  // Both components of the elements in contact, in the order of the sweep.
  std::vector<Eigen::Index> at;
  for (Eigen::Index step = 0; step < n; ++step) {
    const Eigen::Index i = last_first ? n - 1 - step : step;
    if (bound[i] > 0.0) at.insert(at.end(), {i, n + i});
  }
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> inside = a(at, at);
  const VectorXd rigid = w(at);
  VectorXd now = q(at);
  constexpr int kMostSweeps = 20'000;
  const double scale = bound.maxCoeff();
  bool rests = false;
  for (int k = 0; k < kMostSweeps && !rests; ++k) {
    double change = 0.0;
    for (Eigen::Index i = 0; i < now.size(); i += 2) {
      const std::array<double, 2> d{inside(i, i), inside(i + 1, i + 1)};
      const std::array<double, 2> r{rigid[i] + inside.row(i).dot(now) - d[0] * now[i],
                                    rigid[i + 1] + inside.row(i + 1).dot(now) - d[1] * now[i + 1]};
      const std::array<double, 2> next = in_disc(r, d, bound[at[static_cast<std::size_t>(i)]]);
      change = std::max({change, std::abs(next[0] - now[i]), std::abs(next[1] - now[i + 1])});
      now[i] = next[0];
      now[i + 1] = next[1];
    }
    rests = change <= kAtRest * scale;
  }
  q.setZero();
  q(at) = now;
  return rests;
}

}  // namespace

BruteSolution solve_by_force(const ContactProblem& problem, double approach, Coefficients coefficients) {
  const Grid2& g = problem.grid;
  const auto n = static_cast<Eigen::Index>(g.size());
  const bool frictionless = problem.regime == Regime::frictionless, steady = problem.regime == Regime::steady;
  const double direction = std::cos(problem.rolling.chi) > 0.0 ? 1.0 : -1.0;
  const double distance = problem.regime == Regime::shift ? 1.0 : steady ? g.dx : problem.rolling.step;
  const double ahead = problem.regime == Regime::shift ? 0.0 : direction * distance;
  const MatrixXd total = influence_matrix(problem, 0.0, coefficients);
  // The slip of a step is what displacements change by: from none, or from those that the same place has in steady
  // rolling.
  const MatrixXd change = steady ? MatrixXd(total - influence_matrix(problem, ahead, coefficients)) : total;
  const MatrixXd normal = total.bottomRightCorner(n, n), tangential = change.topLeftCorner(2 * n, 2 * n);

  VectorXd h(n), w(2 * n);
  for (int i = 0; i < n; ++i) {
    const double x = g.x(i % g.nx) - problem.creepage.spin_x + problem.rolling.spin_offset_factor * ahead;
    const double y = g.y(i / g.nx) - problem.creepage.spin_y;
    h[i] = problem.gap[static_cast<std::size_t>(i)] - approach;
    w[i] = distance * (problem.creepage.xi - problem.creepage.phi * y);
    w[n + i] = distance * (problem.creepage.eta + problem.creepage.phi * x);
  }
  BruteSolution out;
  VectorXd p = pressures(normal, h), q = VectorXd::Zero(2 * n);
  const bool coupled = total.topRightCorner(2 * n, n).cwiseAbs().maxCoeff() > 0.0;
  constexpr int kMostRounds = 100;
  for (int round = 0; round < kMostRounds && !out.found && !frictionless; ++round) {
    const VectorXd before_p = p, before_q = q;
    if (coupled && round > 0) p = pressures(normal, h + total.bottomLeftCorner(n, 2 * n) * q);
    const VectorXd slip = w + change.topRightCorner(2 * n, n) * p;
    if (!tractions(tangential, slip, problem.friction.kinetic * p, direction > 0.0, q)) break;
    const double moved = std::max((p - before_p).cwiseAbs().maxCoeff(), (q - before_q).cwiseAbs().maxCoeff());
    constexpr double kSettled = 1e-12;
    out.found = !coupled || (round > 0 && moved <= kSettled * p.maxCoeff());
  }
  out.found = out.found || frictionless;
  out.pressure = p;
  out.traction_x = q.head(n);
  out.traction_y = q.tail(n);
  return out;
}

}  // namespace treadmark::kalker::testing
