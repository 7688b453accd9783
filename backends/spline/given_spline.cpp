// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/given_spline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "treadmark/backends/spline/cubic_pieces.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::spline {
namespace {

using Two = std::array<int, 2>;

// Cells of a level, by s and t.
using CellKeys = std::vector<std::uint64_t>;

std::uint64_t cell_key(int is, int it) {
  return (static_cast<std::uint64_t>(is) << 32) | static_cast<std::uint64_t>(static_cast<std::uint32_t>(it));
}
int cell_s(std::uint64_t key) { return static_cast<int>(key >> 32); }
int cell_t(std::uint64_t key) { return static_cast<int>(key & 0xffffffffu); }

void sort_keys(CellKeys& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

// The interval of the coarser line that holds each of the finer one.
std::vector<int> parents(const KnotLine& finer, const KnotLine& coarser) {
  std::vector<int> out;
  out.reserve(static_cast<std::size_t>(finer.intervals()));
  for (int i = 0; i < finer.intervals(); ++i) out.push_back(coarser.find(0.5 * (finer.from(i) + finer.to(i))));
  return out;
}

bool full_ends(const SplineKnots& k) {
  const auto p = static_cast<std::size_t>(k.degree);
  return k.knots[p] == k.knots.front() && k.knots[k.knots.size() - 1 - p] == k.knots.back();
}

// Where the chords of a section cross, seen along x and at the same x.
std::optional<Vec2> crossing_of(const std::vector<Vec3>& section) {
  const auto rises = [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); };
  const auto falls = [](const Vec3& a, const Vec3& b) { return a.y() > b.y(); };
  // one whose y only rises or falls has no crossing
  if (ranges::is_sorted(section, rises) || ranges::is_sorted(section, falls)) return std::nullopt;
  constexpr double kSameX = 1e-3;     // [m]
  constexpr double kStraight = 1e-9;  // [rad] more than rounding turns
  const auto side = [&](std::size_t a, std::size_t b, std::size_t c) {
    const Vec3 u = section[b] - section[a], v = section[c] - section[a];
    const double area = u.y() * v.z() - u.z() * v.y();
    return std::abs(area) > kStraight * u.norm() * v.norm() ? area : 0.0;
  };
  for (std::size_t k = 0; k + 1 < section.size(); ++k)
    for (std::size_t m = k + 2; m + 1 < section.size(); ++m) {
      if (std::abs(section[k].x() - section[m].x()) > kSameX) continue;
      if (side(k, k + 1, m) * side(k, k + 1, m + 1) < 0.0 && side(m, m + 1, k) * side(m, m + 1, k + 1) < 0.0)
        return Vec2(section[k].y(), section[k].z());
    }
  return std::nullopt;
}

template <class Point>
std::array<std::array<Point, 4>, 4> turned(const std::array<std::array<Point, 4>, 4>& b, bool swapped, bool back_u,
                                           bool back_v) {
  std::array<std::array<Point, 4>, 4> out;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const std::size_t iu = back_u ? 3 - i : i, iv = back_v ? 3 - j : j;
      out[i][j] = swapped ? b[iv][iu] : b[iu][iv];
    }
  return out;
}

}  // namespace

void GivenSpline::refuse(const std::string& what, const std::string& advice) const {
  throw Error(ErrorKind::input_data, fmt::format("{}: {}", name(), what), data_->where, advice);
}

GivenSpline::GivenSpline(const SplineSurface& data) : data_(&data) {
  check(data);
  breaks_ = {data.levels.front()[0].breaks(), data.levels.front()[1].breaks()};
  if (!data.hierarchical) return;
  try {
    thb_ = hierarchy();
  } catch (const Error& e) {
    if (!e.where().file.empty() || data.where.file.empty()) throw;
    throw Error(e.kind(), fmt::format("{}: {}", name(), e.message()), data.where, e.advice());
  }
}

ThbSpline GivenSpline::hierarchy() const {
  const SplineSurface& data = *data_;
  std::vector<ThbSpace::Level> levels;
  levels.reserve(data.levels.size());
  for (const auto& [s, t] : data.levels) {
    levels.push_back({KnotLine::of_knots(s), KnotLine::of_knots(t)});
    if (!full_ends(s) || !full_ends(t))
      refuse("the first and the last knot of a hierarchical basis must be repeated degree + 1 times",
             "insert the knots that are missing");
  }
  const auto intervals = [&](int level) {
    const ThbSpace::Level& l = levels[static_cast<std::size_t>(level)];
    return Two{l.u.intervals(), l.v.intervals()};
  };
  // memory before any of it is taken
  constexpr double kMostCells = 1 << 30;  // of a level, a bit each
  for (int l = 0; l < static_cast<int>(levels.size()); ++l)
    if (const Two n = intervals(l); static_cast<double>(n[0]) * n[1] > kMostCells)
      refuse(fmt::format("level {} would have {} x {} cells", l, n[0], n[1]),
             "begin with a finer basis, in fewer levels");
  double area = 0.0;
  std::vector<CellKeys> of_level(levels.size());
  const double most_area = 64.0 * static_cast<double>(data.points.size()) + 10'000.0;
  const auto words = [](const SplineBox& b) {
    return fmt::format("the box {} {} {} {} of level {}", b.lower[0], b.lower[1], b.upper[0], b.upper[1], b.level);
  };
  const auto fail_at = [&](int at_line, const std::string& what, const std::string& advice = {}) {
    SourcePosition at = data.where;
    if (at_line > 0) at.line = at_line, at.column = 0;
    throw Error(ErrorKind::input_data, fmt::format("{}: {}", name(), what), at, advice);
  };
  for (const SplineBox& b : data.boxes) {
    if (b.level < 0 || b.level >= static_cast<int>(levels.size()))
      fail_at(b.line, fmt::format("{} is of no level: there are 0 to {}", words(b), levels.size() - 1));
    const Two n = intervals(b.level);
    for (std::size_t d = 0; d < 2; ++d)
      if (b.lower[d] < 0 || b.lower[d] >= b.upper[d] || b.upper[d] > n[d])
        fail_at(b.line, fmt::format("{} does not lie inside its {} x {} cells, or is empty", words(b), n[0], n[1]));
    if (b.level == 0) continue;
    area += static_cast<double>(b.upper[0] - b.lower[0]) * (b.upper[1] - b.lower[1]);
    if (area > most_area)
      fail_at(b.line,
              fmt::format("the boxes up to this one cover more than {:.0f} cells, far more than {} coefficients "
                          "can need",
                          most_area, data.points.size()));
    CellKeys& cells = of_level[static_cast<std::size_t>(b.level)];
    cells.reserve(cells.size() + static_cast<std::size_t>(b.upper[0] - b.lower[0]) *
                                     static_cast<std::size_t>(b.upper[1] - b.lower[1]));
    for (int is = b.lower[0]; is < b.upper[0]; ++is)
      for (int it = b.lower[1]; it < b.upper[1]; ++it) cells.push_back(cell_key(is, it));
  }
  // What is divided to a level must be whole cells of the level before.
  std::vector<CellKeys> divided(levels.size());
  for (int l = static_cast<int>(levels.size()) - 1; l > 0; --l) {
    check_cancelled();
    const auto at = static_cast<std::size_t>(l);
    sort_keys(of_level[at]);
    const std::vector<int> of_s = parents(levels[at].u, levels[at - 1].u),
                           of_t = parents(levels[at].v, levels[at - 1].v);
    std::vector<int> children_s(static_cast<std::size_t>(intervals(l - 1)[0]), 0),
        children_t(static_cast<std::size_t>(intervals(l - 1)[1]), 0);
    for (const int p : of_s) ++children_s[static_cast<std::size_t>(p)];
    for (const int p : of_t) ++children_t[static_cast<std::size_t>(p)];
    CellKeys above;
    above.reserve(of_level[at].size());
    for (const std::uint64_t key : of_level[at])
      above.push_back(
          cell_key(of_s[static_cast<std::size_t>(cell_s(key))], of_t[static_cast<std::size_t>(cell_t(key))]));
    std::sort(above.begin(), above.end());
    for (std::size_t k = 0; k < above.size();) {
      const std::uint64_t parent = above[k];
      std::size_t count = 0;
      while (k < above.size() && above[k] == parent) ++k, ++count;
      const int ps = cell_s(parent), pt = cell_t(parent);
      const auto whole = static_cast<std::size_t>(children_s[static_cast<std::size_t>(ps)]) *
                         static_cast<std::size_t>(children_t[static_cast<std::size_t>(pt)]);
      if (count != whole) {
        int at_line = 0;
        for (const SplineBox& b : data.boxes)
          if (b.level == l && at_line == 0 && of_s[static_cast<std::size_t>(b.lower[0])] <= ps &&
              of_s[static_cast<std::size_t>(b.upper[0]) - 1] >= ps &&
              of_t[static_cast<std::size_t>(b.lower[1])] <= pt && of_t[static_cast<std::size_t>(b.upper[1]) - 1] >= pt)
            at_line = b.line;
        fail_at(at_line,
                fmt::format("boxes of level {} and above cover {} of the {} parts of cell {}, {} of level {}", l, count,
                            whole, ps, pt, l - 1),
                "let boxes end where cells of the level before end");
      }
      divided[at - 1].push_back(parent);
      if (l > 1) of_level[at - 1].push_back(parent);
    }
  }
  ThbSpace space(std::move(levels));
  for (std::size_t l = 0; l + 1 < divided.size(); ++l)
    for (const std::uint64_t key : divided[l]) space.divide_alone({static_cast<int>(l), cell_s(key), cell_t(key)});
  space.settle();
  space.require_support();
  if (space.functions() != data.points.size())
    refuse(
        fmt::format("its basis has {} functions, but it has {} coefficients", space.functions(), data.points.size()));
  // functions are counted along s first here, along t first there
  std::vector<std::size_t> order(space.functions());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
  std::vector<ThbSpace::Function> functions;
  functions.reserve(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) functions.push_back(space.function(k));
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const ThbSpace::Function &fa = functions[a], &fb = functions[b];
    if (fa.level != fb.level) return fa.level < fb.level;
    return fa.v != fb.v ? fa.v < fb.v : fa.u < fb.u;
  });
  std::vector<Vec3> coefficients(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) coefficients[order[k]] = data.points[k];
  if (!data.truncated)
    coefficients = space.coefficients([&](const ThbCell& cell) { return space.piece(cell, coefficients, true); });
  return {std::move(space), std::move(coefficients)};
}

GivenSpline::QuadPiece GivenSpline::exact_piece(const KnotLine& s, const KnotLine& t, int is, int it) const {
  const int ps = s.degree(), pt = t.degree();
  const auto stride = static_cast<std::size_t>(s.functions());
  // weights that are all alike are none
  const double unit = data_->weights.empty() ? 1.0 : 1.0 / data_->weights.front();
  std::array<KnotWeights, kMostDegree + 1> ws;
  for (int k = 0; k <= ps; ++k) ws[static_cast<std::size_t>(k)] = s.bernstein(is, k);
  QuadPiece out{}, half{};
  for (int j = 0; j <= pt; ++j)
    for (int i = 0; i <= ps; ++i) {
      const std::size_t at =
          static_cast<std::size_t>(s.function(is, i)) + stride * static_cast<std::size_t>(t.function(it, j));
      const double w = data_->weights.empty() ? 1.0 : unit * data_->weights[at];
      const Vec3 p = w * data_->points[at];
      const Quad point(p.x(), p.y(), p.z(), w);
      for (int k = 0; k <= ps; ++k) {
        Quad& sum = half[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)];
        sum = sum + ws[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] * point;
      }
    }
  for (int l = 0; l <= pt; ++l) {
    const KnotWeights w = t.bernstein(it, l);
    for (int k = 0; k <= ps; ++k)
      for (int j = 0; j <= pt; ++j) {
        Quad& sum = out[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)];
        sum = sum + w[static_cast<std::size_t>(j)] * half[static_cast<std::size_t>(k)][static_cast<std::size_t>(j)];
      }
  }
  raise_to_cubic(out, ps, pt);
  return out;
}

GivenSpline::QuadPiece GivenSpline::near_piece(const Breaks& at, std::size_t is, std::size_t it) const {
  const double s[] = {at[0][is], at[0][is + 1]}, t[] = {at[1][it], at[1][it + 1]};
  const Vec2 inside(0.5 * (s[0] + s[1]), 0.5 * (t[0] + t[1]));
  QuadPiece out;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      // position and derivatives of the surface at this corner, as they are inside
      const SplineJet jet = evaluate(*data_, {s[i], t[j]}, inside);
      const double third_s = (i ? s[0] - s[1] : s[1] - s[0]) / 3.0, third_t = (j ? t[0] - t[1] : t[1] - t[0]) / 3.0;
      const auto put = [&](std::size_t a, std::size_t b, const Vec3& p) { out[a][b] = {p.x(), p.y(), p.z(), 1.0}; };
      const std::size_t a = 3 * i, b = 3 * j, a1 = i ? 2 : 1, b1 = j ? 2 : 1;
      put(a, b, jet.p);
      put(a1, b, jet.p + third_s * jet.ps);
      put(a, b1, jet.p + third_t * jet.pt);
      put(a1, b1, jet.p + third_s * jet.ps + third_t * jet.pt + third_s * third_t * jet.pst);
    }
  return out;
}

// Every interval is parted alike.
GivenSpline::Breaks GivenSpline::cubic_breaks(double& off) const {
  const auto halved = [](const std::vector<double>& breaks) {
    std::vector<double> out;
    out.reserve(2 * breaks.size());
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      out.push_back(breaks[i]);
      out.push_back(0.5 * (breaks[i] + breaks[i + 1]));
    }
    out.push_back(breaks.back());
    return out;
  };
  for (Breaks at = breaks_;;) {
    if (at[0].size() * at[1].size() > kMostPatches)
      refuse(fmt::format("cubics within {:g} nm of its degrees would be more than {} patches", 1e9 * kCubicsWithin,
                         kMostPatches),
             "give a part of it, or triangles");
    double off_s = 0.0, off_t = 0.0;
    off = 0.0;
    for (std::size_t i = 0; i + 1 < at[0].size(); ++i, check_cancelled())
      for (std::size_t j = 0; j + 1 < at[1].size(); ++j) {
        const QuadPiece piece = near_piece(at, i, j);
        BezierPatch bezier;
        for (std::size_t a = 0; a < 4; ++a) std::copy(piece[a].begin(), piece[a].end(), bezier.b[a]);
        const PowerPatch patch(bezier);
        const auto off_at = [&](double a, double b) {
          const Quad q = patch.jet(a, b).value;
          const Vec3 p = evaluate(*data_, at[0][i] + (a + 0.5) * (at[0][i + 1] - at[0][i]),
                                  at[1][j] + (b + 0.5) * (at[1][j + 1] - at[1][j]))
                             .p;
          const double distance = (Vec3(q.x(), q.y(), q.z()) - p).norm();
          if (!std::isfinite(distance)) refuse("it is not finite everywhere", "are its weights right?");
          return distance;
        };
        for (const double a : {-0.25, 0.0, 0.25})
          off_s = std::max(off_s, off_at(a, -0.5)), off_t = std::max(off_t, off_at(-0.5, a));
        off = std::max(off, off_at(0.0, 0.0));
      }
    off = std::max({off, off_s, off_t});
    if (off <= kCubicsWithin) return at;
    if (off_s >= off_t || off_s > 0.5 * kCubicsWithin) at[0] = halved(at[0]);
    if (off_t > off_s || off_t > 0.5 * kCubicsWithin) at[1] = halved(at[1]);
  }
}

GivenSpline::Layout GivenSpline::layout(Body body) const {
  const bool wheel = body == Body::wheel;
  struct Walk {
    double along = 0.0, length = 0.0, radius = 0.0;  // x [m] or angle [rad]; [m]
    double first = 0.0;
  };
  const auto middle = [&](int direction) {
    const std::vector<double>& k = breaks(direction);
    const std::size_t i = (k.size() - 1) / 2;
    return 0.5 * (k[i] + k[i + 1]);
  };
  const auto walk = [&](int direction) {
    const std::vector<double>& k = breaks(direction);
    // few intervals may turn by half a circle each
    const int steps = std::clamp(static_cast<int>(256 / k.size()), 2, 8);
    const double other = middle(1 - direction);
    const auto at = [&](double x) { return direction == 0 ? point(x, other) : point(other, x); };
    Walk out;
    Vec3 before = at(k.front());
    out.first = wheel ? std::atan2(before.x(), before.z()) : before.x();
    std::size_t count = 0;
    for (std::size_t i = 0; i + 1 < k.size(); ++i)
      for (int step = 1; step <= steps; ++step, ++count) {
        const Vec3 p = at(step == steps ? k[i + 1] : k[i] + (k[i + 1] - k[i]) * step / steps);
        out.along += wheel ? std::remainder(std::atan2(p.x(), p.z()) - std::atan2(before.x(), before.z()),
                                            2.0 * std::numbers::pi)
                           : p.x() - before.x();
        out.length += (p - before).norm();
        out.radius += std::hypot(p.x(), p.z());
        before = p;
      }
    out.radius = wheel ? out.radius / static_cast<double>(count) : 1.0;
    return out;
  };
  const Walk walks[2] = {walk(0), walk(1)};
  const auto share = [](const Walk& w) { return w.length > 0.0 ? std::abs(w.along) * w.radius / w.length : 0.0; };
  for (const Walk& w : walks)
    if (!(w.length > 0.0) || !std::isfinite(w.length)) refuse("it has no extent: all of a line is one point");
  Layout out;
  out.swapped = share(walks[1]) > share(walks[0]);
  const Walk &u = walks[out.swapped ? 1 : 0], &v = walks[out.swapped ? 0 : 1];
  constexpr double kLeastShare = 0.1;
  const char* axes = "x forward, y to the right, z down; the axle of a wheel is the y axis: is it placed so?";
  if (share(u) < kLeastShare)
    refuse(wheel ? "neither of its parameters runs round the axle" : "neither of its parameters runs along the track",
           axes);
  if (wheel && std::abs(u.along) > 2.0 * std::numbers::pi * (1.0 + 1e-9))
    refuse("it goes round the axle more than once");
  out.back_u = u.along < 0.0;
  out.u_from = out.back_u ? u.first + u.along : u.first;
  out.u_to = out.u_from + std::abs(u.along);
  out.v_to = v.length;
  // the area seen from the contact side, positive where u x v points there
  double seen = 0.0, all = 0.0, volume = 0.0, highest = -HUGE_VAL, lowest = HUGE_VAL;
  const auto places = [&](int direction, int steps) {
    const std::vector<double>& k = breaks(direction);
    constexpr std::size_t kMostIntervals = 200;
    std::vector<double> at;
    const std::size_t stride = (k.size() - 2) / kMostIntervals + 1;
    at.reserve(static_cast<std::size_t>(steps) * k.size() + 1);
    for (std::size_t i = 0; i + 1 < k.size(); i += stride) {
      const double to = k[std::min(i + stride, k.size() - 1)];
      for (int step = 0; step < steps; ++step) at.push_back(k[i] + (to - k[i]) * step / steps);
    }
    at.push_back(k.back());
    return at;
  };
  const auto row_at = [&](double at_u, const std::vector<double>& at_v) {
    std::vector<Vec3> row;
    row.reserve(at_v.size());
    for (const double at : at_v) row.push_back(out.swapped ? point(at, at_u) : point(at_u, at));
    return row;
  };
  const int of_u = out.swapped ? 1 : 0, of_v = 1 - of_u;
  const std::vector<double> at_u = places(of_u, 2), at_v = places(of_v, 2);
  std::vector<Vec3> row = row_at(at_u.front(), at_v);
  for (std::size_t i = 1; i < at_u.size(); ++i) {
    std::vector<Vec3> next = row_at(at_u[i], at_v);
    for (std::size_t j = 0; j + 1 < at_v.size(); ++j) {
      const Vec3 area = 0.5 * (next[j + 1] - row[j]).cross(row[j + 1] - next[j]);
      const Vec3 middle_of = 0.25 * (row[j] + row[j + 1] + next[j] + next[j + 1]);
      const Vec3 outwards =
          wheel ? Vec3(Vec3(middle_of.x(), 0.0, middle_of.z()).stableNormalized()) : Vec3(Vec3::UnitZ());
      const double height = wheel ? std::hypot(middle_of.x(), middle_of.z()) : -middle_of.z();
      seen += area.dot(outwards);
      volume += height * area.dot(outwards);
      all += area.norm();
      highest = std::max(highest, height), lowest = std::min(lowest, height);
    }
    row = std::move(next);
  }
  require_area(all);
  constexpr double kEdgeOn = 1e-3;
  // of a tube as much is seen from behind as from the front
  if (!(std::abs(seen) > kEdgeOn * all)) seen = volume / std::max(highest - lowest, kEdgeOn);
  if (!(std::abs(seen) > kEdgeOn * all)) refuse("it is seen edge-on from the contact side, or not at all", axes);
  out.back_v = (out.back_u ? -seen : seen) < 0.0;
  // sections by chords, two at least of every interval
  constexpr std::size_t kLeastSections = 64;
  const std::vector<double> along_section =
      places(of_v, std::clamp(static_cast<int>(256 / breaks(of_v).size()), 2, 64));
  for (const double at : places(of_u, std::max(2, static_cast<int>(kLeastSections / breaks(of_u).size())))) {
    check_cancelled();
    std::vector<Vec3> section = row_at(at, along_section);
    for (Vec3& p : section)
      if (wheel) p = Vec3(0.0, p.y(), std::hypot(p.x(), p.z()));
    if (const auto crossing = crossing_of(section))
      refuse(fmt::format("a section crosses itself near y = {:.6g}, {} = {:.6g} mm", 1e3 * crossing->x(),
                         wheel ? "radius" : "z", 1e3 * crossing->y()),
             "are its coefficients in the right order?");
  }
  return out;
}

NurbsNet GivenSpline::tensor_net(const Layout& layout, double& off) const {
  const auto& [knots_s, knots_t] = data_->levels.front();
  const bool exact = knots_s.degree <= kMostDegree && knots_t.degree <= kMostDegree;
  const Breaks at = exact ? breaks_ : cubic_breaks(off);
  std::optional<KnotLine> s, t;
  if (exact) s = KnotLine::of_knots(knots_s), t = KnotLine::of_knots(knots_t);
  const auto piece = [&](std::size_t is, std::size_t it) {
    return exact ? exact_piece(*s, *t, static_cast<int>(is), static_cast<int>(it)) : near_piece(at, is, it);
  };
  const auto mapped = [&](const std::vector<double>& k, bool back, double low, double high) {
    std::vector<double> out;
    out.reserve(k.size());
    for (std::size_t i = 0; i < k.size(); ++i) {
      const double x = back ? k[k.size() - 1 - i] : k[i];
      const double done = (back ? k.back() - x : x - k.front()) / (k.back() - k.front());
      out.push_back(low + (high - low) * done);
      if (i > 0 && !(out[i] > out[i - 1])) refuse("two different knots are too near each other");
    }
    return out;
  };
  std::vector<double> u = mapped(at[layout.swapped ? 1 : 0], layout.back_u, layout.u_from, layout.u_to),
                      v = mapped(at[layout.swapped ? 0 : 1], layout.back_v, 0.0, layout.v_to);
  const auto nu = u.size() - 1, nv = v.size() - 1;
  const auto oriented = [&](std::size_t iu, std::size_t iv) {
    const std::size_t ku = layout.back_u ? nu - 1 - iu : iu, kv = layout.back_v ? nv - 1 - iv : iv;
    return turned(piece(layout.swapped ? kv : ku, layout.swapped ? ku : kv), layout.swapped, layout.back_u,
                  layout.back_v);
  };
  const bool rational = exact && std::any_of(data_->weights.begin(), data_->weights.end(),
                                             [&](double w) { return w != data_->weights.front(); });
  if (rational || !knots_s.smooth() || !knots_t.smooth()) {
    const std::size_t stride = 3 * nv + 1;
    std::vector<Quad> points((3 * nu + 1) * stride);
    for (std::size_t iu = 0; iu < nu; ++iu, check_cancelled())
      for (std::size_t iv = 0; iv < nv; ++iv) {
        const QuadPiece b = oriented(iu, iv);
        for (std::size_t i = 0; i < 4; ++i)
          for (std::size_t j = 0; j < 4; ++j) points[(3 * iu + i) * stride + 3 * iv + j] = b[i][j];
      }
    return NurbsNet(std::move(u), std::move(v), std::move(points));
  }
  // corners are evaluated faster
  std::vector<NurbsNet::Corner> corners((nu + 1) * (nv + 1));
  const auto position = [](const Quad& q) { return Vec3(q.x(), q.y(), q.z()); };
  for (std::size_t iu = 0; iu < nu; ++iu, check_cancelled())
    for (std::size_t iv = 0; iv < nv; ++iv) {
      const QuadPiece b = oriented(iu, iv);
      const double size_u = u[iu + 1] - u[iu], size_v = v[iv + 1] - v[iv];
      for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 2; ++j) {
          // neighbours tell the same of a corner that they share
          if ((i == 1 && iu + 1 < nu) || (j == 1 && iv + 1 < nv)) continue;
          const std::size_t a = 3 * i, c = 3 * j, a1 = i ? 2 : 1, c1 = j ? 2 : 1;
          const double su = (i ? -3.0 : 3.0) / size_u, sv = (j ? -3.0 : 3.0) / size_v;
          corners[(iu + i) * (nv + 1) + iv + j] = {position(b[a][c]), su * position(b[a1][c] - b[a][c]),
                                                   sv * position(b[a][c1] - b[a][c]),
                                                   su * sv * position(b[a1][c1] - b[a1][c] - b[a][c1] + b[a][c])};
        }
    }
  return NurbsNet(std::move(u), std::move(v), std::move(corners));
}

NurbsNet GivenSpline::hierarchical_net(const Layout& layout) const {
  const ThbSpline& spline = *thb_;
  const std::vector<double>&ks = breaks(0), &kt = breaks(1);
  const auto share = [](const std::vector<double>& k, double x) { return (x - k.front()) / (k.back() - k.front()); };
  return listed_net(spline.space.cells().size(), [&](std::size_t k) {
    const CubicPiece given = cubic_piece(spline, spline.space.cells()[k]);
    const ThbRange& r = given.range;
    double u0 = layout.swapped ? share(kt, r.v0) : share(ks, r.u0),
           u1 = layout.swapped ? share(kt, r.v1) : share(ks, r.u1),
           v0 = layout.swapped ? share(ks, r.u0) : share(kt, r.v0),
           v1 = layout.swapped ? share(ks, r.u1) : share(kt, r.v1);
    if (layout.back_u) u0 = 1.0 - u0, u1 = 1.0 - u1, std::swap(u0, u1);
    if (layout.back_v) v0 = 1.0 - v0, v1 = 1.0 - v1, std::swap(v0, v1);
    const double length = layout.u_to - layout.u_from;
    CubicPiece out;
    out.range = {layout.u_from + length * u0, layout.u_from + length * u1, layout.v_to * v0, layout.v_to * v1};
    if (!(out.range.u0 < out.range.u1) || !(out.range.v0 < out.range.v1))
      refuse("two different knots are too near each other");
    out.b = turned(given.b, layout.swapped, layout.back_u, layout.back_v);
    return out;
  });
}

void GivenSpline::require_area(double area) const {
  // bounds keep cells of some mm: their number follows the size, whatever the file says
  constexpr double kMostArea = 20.0;  // [m2] 130 m of a rail
  if (!(area < kMostArea))
    refuse(fmt::format("it covers {:.3g} m2, more than {:g}", area, kMostArea),
           "is its unit right (scale_to_mm of .xml), and no coefficient astray?");
}

void GivenSpline::require_sound(const NurbsNet& net) const {
  double area = 0.0, along = 0.0, across = 0.0;
  for (int iu = 0; iu < net.patches_u(); ++iu, check_cancelled())
    for (int iv = 0; iv < net.patches_v(); ++iv) {
      const BezierPatch p = net.patch(iu, iv);
      const Vec3 a = p.point(0, 0), b = p.point(3, 0), c = p.point(0, 3), d = p.point(3, 3);
      const double u = std::max((b - a).norm(), (d - c).norm()), v = std::max((c - a).norm(), (d - b).norm());
      area += u * v;
      if (iv == net.patches_v() / 2) along += u;
      if (iu == net.patches_u() / 2) across += v;
    }
  if (!net.is_list()) area = std::max(area, along * across);
  require_area(area);
  const auto normals_agree = [&](const PowerPatch& patch, int steps, double least, Vec3& worst) {
    std::vector<Vec3> normals;
    normals.reserve(static_cast<std::size_t>(steps + 1) * static_cast<std::size_t>(steps + 1));
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; j <= steps; ++j) {
        const PowerPatch::Jet at =
            patch.jet(static_cast<double>(i) / steps - 0.5, static_cast<double>(j) / steps - 0.5);
        const double w = at.value.w();
        const Vec3 p(at.value.x() / w, at.value.y() / w, at.value.z() / w);
        const auto tangent = [&](const Quad& q) { return Vec3(Vec3(q.x(), q.y(), q.z()) - q.w() * p); };
        const Vec3 n = tangent(at.by_s).cross(tangent(at.by_t));
        worst = p;
        normals.push_back(n.stableNormalized());
        if (!(normals.back().squaredNorm() > 0.5)) return false;
        const std::size_t k = normals.size() - 1, row = static_cast<std::size_t>(steps) + 1;
        if (j > 0 && normals[k].dot(normals[k - 1]) <= least) return false;
        if (i > 0 && normals[k].dot(normals[k - row]) <= least) return false;
      }
    return true;
  };
  constexpr int kFewSteps = 2, kManySteps = 12;
  constexpr double kClearly = 0.5;
  for (int iu = 0; iu < net.patches_u(); ++iu, check_cancelled())
    for (int iv = 0; iv < net.patches_v(); ++iv) {
      const PowerPatch patch(net.patch(iu, iv));
      Vec3 worst = Vec3::Zero();
      if (normals_agree(patch, kFewSteps, kClearly, worst) || normals_agree(patch, kManySteps, 0.0, worst)) continue;
      refuse(fmt::format("the surface folds back on itself or has no normal near x = {:.6g}, y = {:.6g}, z = {:.6g} mm",
                         1e3 * worst.x(), 1e3 * worst.y(), 1e3 * worst.z()),
             "are its coefficients in the right order?");
    }
}

NurbsNet GivenSpline::net(Body body, double* off) const {
  const Layout l = layout(body);
  double own_off = 0.0;
  NurbsNet out = hierarchical() ? hierarchical_net(l) : tensor_net(l, own_off);
  require_sound(out);
  if (off != nullptr) *off = own_off;
  return out;
}

}  // namespace treadmark::spline
