// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/tensor_spline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

using Homogeneous = Eigen::Vector4d;

[[noreturn]] void refuse(const TensorSpline& s, const std::string& what) {
  throw Error(ErrorKind::input_data, fmt::format("the spline surface '{}' {}", s.name, what), {},
              "is the file damaged? export it again");
}

void check_knots(const TensorSpline& s, const std::vector<double>& knots, int degree, const char* name) {
  if (degree < 1 || degree > kHighestDegree)
    refuse(s, fmt::format("has degree {} in {}, which is not from 1 to {}", degree, name, kHighestDegree));
  const auto p = static_cast<std::size_t>(degree);
  if (knots.size() < 2 * (p + 1)) refuse(s, fmt::format("has {} knots in {}, too few", knots.size(), name));
  std::size_t same = 1;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    if (!std::isfinite(knots[i])) refuse(s, fmt::format("has a knot in {} that is not finite", name));
    if (i == 0) continue;
    if (knots[i] < knots[i - 1]) refuse(s, fmt::format("has knots in {} that decrease at {}", name, knots[i]));
    same = knots[i] > knots[i - 1] ? 1 : same + 1;
    const bool inside = knots[i] > knots[p] && knots[i] < knots[knots.size() - 1 - p];
    if (same > p + (inside ? 0 : 1)) refuse(s, fmt::format("breaks apart at {} = {}", name, knots[i]));
  }
  if (!(knots[p] < knots[knots.size() - 1 - p])) refuse(s, fmt::format("has no length in {}", name));
}

/// Values and derivatives of the functions of one direction that are not zero at a parameter.
struct Basis {
  std::size_t first = 0;
  std::array<double, kHighestDegree + 1> value{}, slope{};

  Basis(const std::vector<double>& knots, int degree, double t) {
    const auto p = static_cast<std::size_t>(degree);
    const auto begin = knots.begin() + static_cast<std::ptrdiff_t>(p),
               end = knots.end() - static_cast<std::ptrdiff_t>(p) - 1;
    t = std::clamp(t, *begin, *end);
    auto after = std::upper_bound(begin, end, t);
    if (after == end) after = std::lower_bound(begin, end, *end);  // the last piece that has a length
    const auto k = static_cast<std::size_t>(after - knots.begin()) - 1;
    first = k - p;
    value[0] = 1.0;
    std::array<double, kHighestDegree + 1> lower{};
    for (std::size_t r = 1; r <= p; ++r) {
      if (r == p) lower = value;
      double left = 0.0;
      for (std::size_t j = 0; j < r; ++j) {
        const double high = knots[k + 1 + j], low = knots[k + 1 + j - r], share = value[j] / (high - low);
        value[j] = left + (high - t) * share;
        left = (t - low) * share;
      }
      value[r] = left;
    }
    for (std::size_t j = 0; j <= p; ++j) {
      const auto piece = [&](std::size_t i) { return lower[i] / (knots[k + 1 + i] - knots[k + 1 + i - p]); };
      slope[j] = degree * ((j > 0 ? piece(j - 1) : 0.0) - (j < p ? piece(j) : 0.0));
    }
  }
};

}  // namespace

void check(const TensorSpline& s) {
  check_knots(s, s.knots_u, s.degree_u, "u");
  check_knots(s, s.knots_v, s.degree_v, "v");
  if (s.poles.size() != s.poles_u() * s.poles_v())
    refuse(s, fmt::format("has {} poles, not {} x {} as its knots say", s.poles.size(), s.poles_u(), s.poles_v()));
  if (!s.weights.empty() && s.weights.size() != s.poles.size()) refuse(s, "has other weights than poles");
  for (const Vec3& p : s.poles)
    if (!p.allFinite()) refuse(s, "has a pole that is not finite");
  for (const double w : s.weights)
    if (!(w > 0.0) || !std::isfinite(w)) refuse(s, fmt::format("has a weight of {}, which is not positive", w));
}

TensorJet evaluate(const TensorSpline& s, double u, double v) {
  const Basis bu(s.knots_u, s.degree_u, u), bv(s.knots_v, s.degree_v, v);
  Homogeneous f = Homogeneous::Zero(), fu = f, fv = f, fuv = f;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(s.degree_u); ++i) {
    Homogeneous row = Homogeneous::Zero(), row_v = row;
    for (std::size_t j = 0; j <= static_cast<std::size_t>(s.degree_v); ++j) {
      const std::size_t k = (bu.first + i) * s.poles_v() + bv.first + j;
      const double w = s.weights.empty() ? 1.0 : s.weights[k];
      const Homogeneous pole(w * s.poles[k].x(), w * s.poles[k].y(), w * s.poles[k].z(), w);
      row += bv.value[j] * pole;
      row_v += bv.slope[j] * pole;
    }
    f += bu.value[i] * row;
    fu += bu.slope[i] * row;
    fv += bu.value[i] * row_v;
    fuv += bu.slope[i] * row_v;
  }
  TensorJet jet;
  const double w = f.w();
  jet.p = f.head<3>() / w;
  jet.pu = (fu.head<3>() - fu.w() * jet.p) / w;
  jet.pv = (fv.head<3>() - fv.w() * jet.p) / w;
  jet.puv = (fuv.head<3>() - fu.w() * jet.pv - fv.w() * jet.pu - fuv.w() * jet.p) / w;
  return jet;
}

std::vector<double> breaks_of(const std::vector<double>& knots, int degree) {
  std::vector<double> breaks;
  breaks.reserve(knots.size());
  const auto p = static_cast<std::size_t>(degree);
  for (std::size_t i = p; i + p < knots.size(); ++i)
    if (breaks.empty() || knots[i] > breaks.back()) breaks.push_back(knots[i]);
  return breaks;
}

std::size_t first_pole(const std::vector<double>& knots, int degree, double from) {
  return Basis(knots, degree, from).first;
}

TensorSpline along_body(TensorSpline s) {
  constexpr int kPlaces = 7;
  const auto place = [](const std::vector<double>& knots, int degree, int i) {
    const double from = knots[static_cast<std::size_t>(degree)],
                 to = knots[knots.size() - 1 - static_cast<std::size_t>(degree)];
    return from + (to - from) * (i + 0.5) / kPlaces;
  };
  double along_u = 0.0, along_v = 0.0, across_u = 0.0, across_v = 0.0;
  for (int i = 0; i < kPlaces; ++i)
    for (int j = 0; j < kPlaces; ++j) {
      const TensorJet at = evaluate(s, place(s.knots_u, s.degree_u, i), place(s.knots_v, s.degree_v, j));
      const Vec3 along =
          s.body == Body::wheel ? Vec3(at.p.z(), 0.0, -at.p.x()).stableNormalized() : Vec3(1.0, 0.0, 0.0);
      along_u += along.dot(at.pu.stableNormalized());
      along_v += along.dot(at.pv.stableNormalized());
      across_u += at.pu.stableNormalized().y();
      across_v += at.pv.stableNormalized().y();
    }
  const auto reorder = [&](const auto& from) {
    const std::size_t nu = s.poles_u(), nv = s.poles_v();
    std::vector<Vec3> poles(s.poles.size());
    std::vector<double> weights(s.weights.size());
    for (std::size_t i = 0; i < nu; ++i)
      for (std::size_t j = 0; j < nv; ++j) {
        const std::size_t to = from(i, j, nu, nv);
        poles[to] = s.poles[i * nv + j];
        if (!weights.empty()) weights[to] = s.weights[i * nv + j];
      }
    s.poles = std::move(poles);
    s.weights = std::move(weights);
  };
  const auto turn = [](std::vector<double>& knots) {
    std::ranges::reverse(knots);
    for (double& t : knots) t = -t;
  };
  if (std::fabs(along_v) > std::fabs(along_u)) {
    reorder([](std::size_t i, std::size_t j, std::size_t nu, std::size_t) { return j * nu + i; });
    std::swap(s.knots_u, s.knots_v);
    std::swap(s.degree_u, s.degree_v);
    std::swap(along_u, along_v);
    std::swap(across_u, across_v);
  }
  if (along_u < 0.0) {
    reorder([](std::size_t i, std::size_t j, std::size_t nu, std::size_t nv) { return (nu - 1 - i) * nv + j; });
    turn(s.knots_u);
  }
  if (across_v < 0.0) {
    reorder([](std::size_t i, std::size_t j, std::size_t, std::size_t nv) { return i * nv + nv - 1 - j; });
    turn(s.knots_v);
  }
  return s;
}

}  // namespace treadmark
