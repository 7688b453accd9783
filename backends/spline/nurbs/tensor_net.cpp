// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs/tensor_net.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::spline {
namespace {

constexpr int kCubic = 3;

/// Value of the symmetric multiaffine form of a piece at arguments between which and knots it is mixed (Ramshaw 1987).
Quad blossom(std::array<Quad, 4> d, const std::vector<double>& knots, std::size_t first, int degree,
             const std::array<double, 3>& at) {
  const auto p = static_cast<std::size_t>(degree);
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const double low = knots[first + j], high = knots[first + j + p - r + 1];
      const double share = (at[r - 1] - low) / (high - low);
      d[j] = (1.0 - share) * d[j - 1] + share * d[j];
    }
  return d[p];
}

/// Points of cubic pieces that share their ends, of one line of poles.
void append_pieces(const std::vector<Quad>& poles, const std::vector<double>& knots, int degree,
                   const std::vector<double>& breaks, std::vector<Quad>& out) {
  out.clear();
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    const std::size_t first = first_pole(knots, degree, breaks[k]);
    std::array<Quad, 4> d, b;
    for (std::size_t i = 0; i <= static_cast<std::size_t>(degree); ++i) d[i] = poles[first + i];
    for (int i = 0; i <= degree; ++i) {
      std::array<double, 3> at{};
      for (int n = 0; n < degree; ++n) at[static_cast<std::size_t>(n)] = n < degree - i ? breaks[k] : breaks[k + 1];
      b[static_cast<std::size_t>(i)] = blossom(d, knots, first, degree, at);
    }
    if (degree == 1) b = {b[0], (1.0 / 3.0) * (2.0 * b[0] + b[1]), (1.0 / 3.0) * (b[0] + 2.0 * b[1]), b[1]};
    if (degree == 2) b = {b[0], (1.0 / 3.0) * (b[0] + 2.0 * b[1]), (1.0 / 3.0) * (2.0 * b[1] + b[2]), b[2]};
    out.insert(out.end(), b.begin(), b.begin() + (k + 2 == breaks.size() ? 4 : 3));
  }
}

/// Whether the knots make a surface with continuous derivatives.
bool is_smooth(const std::vector<double>& knots, int degree) {
  const auto p = static_cast<std::size_t>(degree);
  for (std::size_t i = p + 1; i + p + 1 < knots.size(); ++i)
    if (i + p - 1 < knots.size() - p - 1 && knots[i + p - 1] <= knots[i] && knots[i] > knots[p]) return false;
  return true;
}

/// Parameters of any kind become the station along the body, about, and metres across.
struct Scales {
  double first_u = 0.0, station = 0.0, u = 1.0, v = 1.0;

  Scales(const TensorSpline& s, const std::vector<double>& at_u, const std::vector<double>& at_v)
      : first_u(at_u.front()) {
    const double middle_u = 0.5 * (at_u.front() + at_u.back()), middle_v = 0.5 * (at_v.front() + at_v.back());
    double length = 0.0, along = 0.0;
    for (std::size_t j = 0; j + 1 < at_v.size(); ++j)
      length += (evaluate(s, middle_u, at_v[j + 1]).p - evaluate(s, middle_u, at_v[j]).p).norm();
    const auto station_at = [&](double t) {
      const Vec3 p = evaluate(s, t, middle_v).p;
      return s.body == Body::wheel ? std::atan2(p.x(), p.z()) : p.x();
    };
    station = station_at(at_u.front());
    double before = station;
    for (std::size_t i = 1; i < at_u.size(); ++i) {
      const double here = station_at(at_u[i]);
      along += s.body == Body::wheel ? wrap_angle(here - before) : here - before;
      before = here;
    }
    if (length > 0.0) v = length / (at_v.back() - at_v.front());
    if (along > 0.0)
      u = along / (at_u.back() - at_u.front());
    else
      station = first_u;
  }
  void apply(std::vector<double>& at_u, std::vector<double>& at_v) const {
    for (double& t : at_u) t = station + (t - first_u) * u;
    for (double& t : at_v) t *= v;
  }
};

NurbsNet exact_net(const TensorSpline& s, std::vector<double> u, std::vector<double> v, const Scales& scales) {
  const std::size_t nu = s.poles_u(), nv = s.poles_v();
  std::vector<Quad> line, pieces, across;
  std::size_t rows = 0;
  for (std::size_t i = 0; i < nu; ++i, ++rows) {
    line.clear();
    line.reserve(nv);
    for (std::size_t j = 0; j < nv; ++j) {
      const double w = s.weights.empty() ? 1.0 : s.weights[i * nv + j];
      const Vec3 p = w * s.poles[i * nv + j];
      line.emplace_back(p.x(), p.y(), p.z(), w);
    }
    append_pieces(line, s.knots_v, s.degree_v, v, pieces);
    across.insert(across.end(), pieces.begin(), pieces.end());
  }
  const std::size_t columns = across.size() / rows, lines = 3 * (u.size() - 1) + 1;
  std::vector<Quad> points(lines * columns);
  for (std::size_t j = 0; j < columns; ++j, check_cancelled()) {
    line.resize(nu);
    for (std::size_t i = 0; i < nu; ++i) line[i] = across[i * columns + j];
    append_pieces(line, s.knots_u, s.degree_u, u, pieces);
    for (std::size_t i = 0; i < lines; ++i) points[i * columns + j] = pieces[i];
  }
  scales.apply(u, v);
  const bool plain = std::ranges::all_of(s.weights, [&](double w) { return w == s.weights.front(); });
  if (!plain || !is_smooth(s.knots_u, s.degree_u) || !is_smooth(s.knots_v, s.degree_v))
    return NurbsNet(std::move(u), std::move(v), std::move(points));
  // polynomial and smooth: corners are evaluated faster
  std::vector<NurbsNet::Corner> corners(u.size() * v.size());
  const double weight = s.weights.empty() ? 1.0 : s.weights.front();
  for (std::size_t i = 0; i < u.size(); ++i)
    for (std::size_t j = 0; j < v.size(); ++j) {
      const bool last_u = i + 1 == u.size(), last_v = j + 1 == v.size();
      const auto at = [&](std::size_t a, std::size_t b) {
        const Quad& q = points[(3 * i + (last_u ? a - 1 : a)) * columns + 3 * j + (last_v ? b - 1 : b)];
        return Vec3(Vec3(q.x(), q.y(), q.z()) / weight);
      };
      // one before the end, or one after
      const std::size_t here_u = last_u ? 1 : 0, here_v = last_v ? 1 : 0;
      const double per_u = 3.0 / (last_u ? u[i] - u[i - 1] : u[i + 1] - u[i]),
                   per_v = 3.0 / (last_v ? v[j] - v[j - 1] : v[j + 1] - v[j]);
      NurbsNet::Corner& c = corners[i * v.size() + j];
      c.p = at(here_u, here_v);
      c.p_u = per_u * (at(1, here_v) - at(0, here_v));
      c.p_v = per_v * (at(here_u, 1) - at(here_u, 0));
      c.p_uv = (per_u * per_v) * (at(1, 1) - at(1, 0) - at(0, 1) + at(0, 0));
    }
  return NurbsNet(std::move(u), std::move(v), std::move(corners));
}

/// Patches with position and derivatives of the surface at their corners, each piece parted alike.
NurbsNet near_net(const TensorSpline& s, const std::vector<double>& u, const std::vector<double>& v,
                  const Scales& scales) {
  std::vector<NurbsNet::Corner> corners;
  corners.reserve(u.size() * v.size());
  for (const double a : u) {
    check_cancelled();
    for (const double b : v) {
      const TensorJet at = evaluate(s, a, b);
      corners.push_back({at.p, at.pu / scales.u, at.pv / scales.v, at.puv / (scales.u * scales.v)});
    }
  }
  std::vector<double> own_u = u, own_v = v;
  scales.apply(own_u, own_v);
  return NurbsNet(std::move(own_u), std::move(own_v), std::move(corners));
}

std::vector<double> halved(const std::vector<double>& breaks) {
  std::vector<double> out;
  out.reserve(2 * breaks.size());
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    out.push_back(breaks[i]);
    out.push_back(0.5 * (breaks[i] + breaks[i + 1]));
  }
  out.push_back(breaks.back());
  return out;
}

Vec3 middle_of(const NurbsNet& net, int iu, int iv, double s, double t) {
  const PowerPatch patch(net.patch(iu, iv));
  const Quad at = patch.jet(s, t).value;
  return {at.x(), at.y(), at.z()};
}

}  // namespace

NurbsNet net_of(const TensorSpline& s, double& deviation) {
  check(s);
  std::vector<double> u = breaks_of(s.knots_u, s.degree_u), v = breaks_of(s.knots_v, s.degree_v);
  const Scales scales(s, halved(halved(u)), halved(halved(v)));
  const auto require_room = [&] {
    if (u.size() * v.size() > kMostPatches)
      throw Error(ErrorKind::input_data,
                  fmt::format("the spline surface '{}' needs more than {} patches", s.name, kMostPatches), {},
                  "give a part of it, or triangles");
  };
  require_room();
  const double wanted = std::exchange(deviation, 0.0);
  if (s.degree_u <= kCubic && s.degree_v <= kCubic) return exact_net(s, std::move(u), std::move(v), scales);
  constexpr double kInside[] = {-0.25, 0.0, 0.25};
  for (;;) {
    require_room();
    NurbsNet net = near_net(s, u, v, scales);
    double off_u = 0.0, off_v = 0.0;
    for (std::size_t i = 0; i + 1 < u.size(); ++i)
      for (std::size_t j = 0; j + 1 < v.size(); ++j) {
        const auto off = [&](double a, double b) {
          const Vec3 exact = evaluate(s, u[i] + (a + 0.5) * (u[i + 1] - u[i]), v[j] + (b + 0.5) * (v[j + 1] - v[j])).p;
          return (middle_of(net, static_cast<int>(i), static_cast<int>(j), a, b) - exact).norm();
        };
        for (const double a : kInside) off_u = std::max(off_u, off(a, -0.5)), off_v = std::max(off_v, off(-0.5, a));
        deviation = std::max(deviation, off(0.0, 0.0));
      }
    deviation = std::max({deviation, off_u, off_v});
    if (deviation <= wanted) return net;
    deviation = 0.0;
    if (off_u >= off_v || off_u > 0.5 * wanted) u = halved(u);
    if (off_v > off_u || off_v > 0.5 * wanted) v = halved(v);
  }
}

TensorSpline tensor_spline_of(const NurbsNet& net, Body body) {
  const auto nu = static_cast<std::size_t>(net.patches_u()), nv = static_cast<std::size_t>(net.patches_v());
  const auto line_of = [](std::size_t n, const auto& at) {
    std::vector<double> breaks;
    breaks.reserve(n + 1);
    for (std::size_t i = 0; i < n; ++i) breaks.push_back(at(i).first);
    breaks.push_back(at(n - 1).second);
    return breaks;
  };
  const std::vector<double> u = line_of(nu, [&](std::size_t i) {
    const NurbsNet::Range r = net.range(static_cast<int>(i), 0);
    return std::pair{r.u0, r.u1};
  });
  const std::vector<double> v = line_of(nv, [&](std::size_t j) {
    const NurbsNet::Range r = net.range(0, static_cast<int>(j));
    return std::pair{r.v0, r.v1};
  });
  const auto knots_of = [](const std::vector<double>& breaks) {
    std::vector<double> knots(kCubic, breaks.front());
    knots.insert(knots.end(), breaks.begin(), breaks.end());
    knots.insert(knots.end(), kCubic, breaks.back());
    return knots;
  };
  /// Poles of a line of which values and slopes at the breaks are known, twice continuously differentiable.
  const auto poles_of = [](const std::vector<double>& breaks, const std::vector<double>& knots, const auto& value,
                           const auto& slope, const auto& put) {
    const std::size_t n = breaks.size() - 1;
    for (std::size_t i = 0; i < n + kCubic; ++i) {
      // the piece that begins at the middle one of its three knots, or before it: the shorter one reaches less far
      const std::size_t middle = i == 0 ? 0 : std::min(i - 1, n);
      std::size_t k = std::min(middle, n - 1);
      if (middle > 0 && middle < n && breaks[middle + 1] - breaks[middle] < breaks[middle] - breaks[middle - 1])
        k = middle - 1;
      const double from = breaks[k], step = breaks[k + 1] - from;
      const Vec3 b0 = value(k), b3 = value(k + 1), b1 = b0 + (step / 3.0) * slope(k),
                 b2 = b3 - (step / 3.0) * slope(k + 1);
      const double x = (knots[i + 1] - from) / step, y = (knots[i + 2] - from) / step, z = (knots[i + 3] - from) / step;
      const auto mix = [](double t, const Vec3& a, const Vec3& b) { return Vec3(a + t * (b - a)); };
      const Vec3 c0 = mix(x, b0, b1), c1 = mix(x, b1, b2), c2 = mix(x, b2, b3);
      put(i, mix(z, mix(y, c0, c1), mix(y, c1, c2)));
    }
  };
  TensorSpline out;
  out.body = body;
  out.knots_u = knots_of(u), out.knots_v = knots_of(v);
  const std::size_t mu = nu + kCubic, mv = nv + kCubic;
  // corner (i, j) of the grid: position and derivatives
  const auto corner = [&](std::size_t i, std::size_t j, int first) {
    const std::size_t iu = std::min(i, nu - 1), iv = std::min(j, nv - 1);
    const PatchCorners c = net.corners(static_cast<int>(iu), static_cast<int>(iv));
    return Vec3(Eigen::Map<const Vec3>(c.corner[i - iu][j - iv] + first));
  };
  std::vector<Vec3> values((nu + 1) * mv), slopes((nu + 1) * mv);
  for (std::size_t i = 0; i <= nu; ++i, check_cancelled()) {
    const auto across = [&](int value, int slope, std::vector<Vec3>& into) {
      poles_of(
          v, out.knots_v, [&](std::size_t j) { return corner(i, j, value); },
          [&](std::size_t j) { return corner(i, j, slope); },
          [&](std::size_t j, const Vec3& p) { into[i * mv + j] = p; });
    };
    across(0, 6, values);
    across(3, 9, slopes);
  }
  out.poles.resize(mu * mv);
  for (std::size_t j = 0; j < mv; ++j)
    poles_of(
        u, out.knots_u, [&](std::size_t i) { return values[i * mv + j]; },
        [&](std::size_t i) { return slopes[i * mv + j]; },
        [&](std::size_t i, const Vec3& p) { out.poles[i * mv + j] = p; });
  return out;
}

}  // namespace treadmark::spline
