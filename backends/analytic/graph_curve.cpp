// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/graph_curve.hpp"

#include <limits>

namespace treadmark::analytic {

PolynomialGraph PolynomialGraph::from_powers(double x_min, double x_max, const std::vector<double>& coefficients) {
  PolynomialGraph p;
  p.x_min = x_min;
  p.x_max = x_max;
  p.middle = 0.5 * (x_min + x_max);
  p.half = 0.5 * (x_max - x_min);
  std::vector<long double> b(coefficients.begin(), coefficients.end());
  const std::size_t n = b.size();
  const auto shift = static_cast<long double>(p.middle);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = n - 1; j > i; --j) b[j - 1] += shift * b[j];
  long double scale = 1.0L;
  for (std::size_t i = 0; i < n; ++i) {
    p.c[i] = static_cast<double>(b[i] * scale);
    scale *= static_cast<long double>(p.half);
  }
  return p;
}

double PolynomialGraph::height_and_slope(double x, double& slope) const {
  const double t = (x - middle) / half;
  double h = c[kTerms - 1], d = 0.0;
  for (int i = kTerms - 2; i >= 0; --i) {
    d = d * t + h;
    h = h * t + c[i];
  }
  slope = d / half;
  return h;
}

Jet PolynomialGraph::jet(double x) const {
  const double t = (x - middle) / half;
  double h = c[kTerms - 1], d = 0.0, dd = 0.0;
  for (int i = kTerms - 2; i >= 0; --i) {
    dd = dd * t + d;
    d = d * t + h;
    h = h * t + c[i];
  }
  return {h, d / half, 2.0 * dd / (half * half)};
}

CurveRange PolynomialGraph::range(double a, double b) const {
  // Taylor form about the middle of [a, b]: |terms| bound what the first one leaves out.
  const double t = (0.5 * (a + b) - middle) / half, r = 0.5 * (b - a) / half;
  double q[kTerms];
  for (int i = 0; i < kTerms; ++i) q[i] = c[i];
  for (int i = 0; i < kTerms; ++i)
    for (int j = kTerms - 1; j > i; --j) q[j - 1] += t * q[j];
  double h_rest = 0.0, d_rest = 0.0, power = 1.0;
  for (int i = 1; i < kTerms; ++i) {
    if (i > 1) d_rest += i * std::fabs(q[i]) * power;
    power *= r;
    h_rest += std::fabs(q[i]) * power;
  }
  return {q[0] - h_rest, q[0] + h_rest, (q[1] - d_rest) / half, (q[1] + d_rest) / half};
}

void GraphCurve::append(const ArcGraph& arc) {
  starts_.push_back(arc.x_min);
  ends_.push_back(arc.x_max);
  entries_.push_back({static_cast<int>(arcs_.size()), -1});
  arcs_.push_back(arc);
}

void GraphCurve::append(const PolynomialGraph& polynomial) {
  starts_.push_back(polynomial.x_min);
  ends_.push_back(polynomial.x_max);
  entries_.push_back({-1, static_cast<int>(polynomials_.size())});
  polynomials_.push_back(polynomial);
}

Jet GraphCurve::jet(double y, int piece) const {
  const Entry& e = entries_[static_cast<std::size_t>(piece)];
  return e.polynomial < 0 ? arcs_[static_cast<std::size_t>(e.arc)].jet(y)
                          : polynomials_[static_cast<std::size_t>(e.polynomial)].jet(y);
}

PieceLanes GraphCurve::lanes(int piece) const {
  const Entry& e = entries_[static_cast<std::size_t>(piece)];
  PieceLanes lanes{};
  lanes.y_low = piece_start(piece);
  lanes.y_high = piece_end(piece);
  lanes.arc = e.polynomial < 0;
  if (lanes.arc) {
    const ArcGraph& a = arcs_[static_cast<std::size_t>(e.arc)];
    lanes.x0 = a.x0, lanes.h0 = a.h0, lanes.s0 = a.s0, lanes.c0 = a.c0, lanes.k = a.k;
  } else {
    static_assert(PieceLanes::kTerms == PolynomialGraph::kTerms);
    const PolynomialGraph& p = polynomials_[static_cast<std::size_t>(e.polynomial)];
    lanes.x0 = p.middle, lanes.half = p.half;
    std::copy(std::begin(p.c), std::end(p.c), lanes.c);
  }
  return lanes;
}

Chord GraphCurve::chord(double a, double b, int piece) const {
  const Entry& e = entries_[static_cast<std::size_t>(piece)];
  if (e.polynomial < 0) {
    const ArcGraph& arc = arcs_[static_cast<std::size_t>(e.arc)];
    Chord c{a, arc.height(a), b, arc.height(b), 0.0};
    c.off = sagitta(arc.k, std::hypot(b - a, c.h_b - c.h_a));
    return c;
  }
  const PolynomialGraph& p = polynomials_[static_cast<std::size_t>(e.polynomial)];
  double slope = 0.0;
  Chord c{a, p.height_and_slope(a, slope), b, p.height_and_slope(b, slope), 0.0};
  // a curve with slopes in an interval leaves its chord by at most a quarter of its width times the length
  const CurveRange range = p.range(a, b);
  c.off = 0.25 * (range.dh_max - range.dh_min) * (b - a);
  return c;
}

std::vector<Chord> GraphCurve::chords() const {
  constexpr double kShortest = 1e-5;  // [m]
  constexpr int kFirstParts = 4;      // arcs of less than half a circle
  std::vector<Chord> all;
  const auto divide = [&](const auto& self, double a, double b, int piece) -> void {
    const Chord c = chord(a, b, piece);
    if (c.off <= kChordOff || b - a < kShortest) return all.push_back(c);
    const double middle = 0.5 * (a + b);
    self(self, a, middle, piece);
    self(self, middle, b, piece);
  };
  for (int i = 0; i < piece_count(); ++i) {
    const double start = piece_start(i), width = piece_end(i) - start;
    for (int k = 0; k < kFirstParts; ++k)
      divide(divide, start + width * k / kFirstParts,
             k + 1 < kFirstParts ? start + width * (k + 1) / kFirstParts : piece_end(i), i);
  }
  return all;
}

CurveRange GraphCurve::range(double a, double b) const {
  a = std::max(a, y_min());
  b = std::min(b, y_max());
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  CurveRange all{kInfinity, -kInfinity, kInfinity, -kInfinity};
  for (int i = find(a, 0); i < piece_count() && (piece_start(i) <= b); ++i) {
    const double from = std::max(a, piece_start(i)), to = std::max(from, std::min(b, piece_end(i)));
    const Entry& e = entries_[static_cast<std::size_t>(i)];
    CurveRange one;
    if (e.polynomial >= 0) {
      one = polynomials_[static_cast<std::size_t>(e.polynomial)].range(from, to);
    } else {
      const ArcGraph& arc = arcs_[static_cast<std::size_t>(e.arc)];
      arc.range(from, to, one.h_min, one.h_max);
      const double d1 = arc.jet(from).dh, d2 = arc.jet(to).dh;  // the slope of an arc is monotone
      one.dh_min = std::min(d1, d2);
      one.dh_max = std::max(d1, d2);
    }
    all.h_min = std::min(all.h_min, one.h_min);
    all.h_max = std::max(all.h_max, one.h_max);
    all.dh_min = std::min(all.dh_min, one.dh_min);
    all.dh_max = std::max(all.dh_max, one.dh_max);
  }
  return all;
}

}  // namespace treadmark::analytic
