// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/thb/thb_fit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCholesky>

#include "treadmark/backends/spline/nurbs/nurbs_surface.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"

namespace treadmark::spline {
namespace {

constexpr int kCoarsest = 64;         // points to the longest interval of level 0
constexpr double kSmoothing = 1e-10;  // weight of second differences against the points of a cell

double median(std::vector<double>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Places of points in one direction, and breaks among them, as numbers of points: knots lie at points, and the outer
/// intervals have two at least, so that the finest spline interpolates them (not-a-knot ends).
struct Line {
  std::vector<double> at;
  double period;  ///< 0: open
  int least;      ///< points in the shortest interval: quadratic splines cannot go through points at all their knots

  bool closed() const { return period > 0.0; }
  int last() const { return static_cast<int>(at.size()) - (closed() ? 0 : 1); }
  double place(int i) const {
    return i < static_cast<int>(at.size()) ? at[static_cast<std::size_t>(i)] : at.front() + period;
  }
  /// Where an interval is halved; 0: it is not.
  int half(int from, int to) const {
    const bool outer = !closed() && (from == 0 || to == last());
    return to - from >= 2 * std::max(least, outer ? 2 : 1) ? (from + to) / 2 : 0;
  }
  KnotLine knots(int degree, const std::vector<int>& breaks) const {
    std::vector<double> places;
    for (const int b : breaks) places.push_back(place(b));
    return closed() ? KnotLine::periodic(degree, places) : KnotLine::open(degree, places);
  }
};

/// Values of the Bernstein polynomials of an interval at a place.
KnotWeights bernstein_values(int degree, double from, double to, double at) {
  const double arguments[kMostDegree] = {at, at, at};
  return bernstein_blossom(degree, arguments, from, to);
}

using Small = std::array<KnotWeights, kMostDegree + 1>;

/// Products of second differences of Bernstein coefficients.
Small second_differences(int degree) {
  Small out{};
  const double d[3] = {1.0, -2.0, 1.0};
  for (std::size_t k = 0; k + 1 < static_cast<std::size_t>(degree); ++k)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) out[k + i][k + j] += d[i] * d[j];
  return out;
}

class Solver {
 public:
  void begin(std::size_t unknowns) {
    rhs_.setZero(static_cast<Eigen::Index>(unknowns), 3);
    entries_.clear();
  }
  void add(std::size_t i, std::size_t j, double value) {
    entries_.emplace_back(static_cast<int>(std::max(i, j)), static_cast<int>(std::min(i, j)), value);
  }
  void add(std::size_t i, const Vec3& value) { rhs_.row(static_cast<Eigen::Index>(i)) += value.transpose(); }
  /// For bands.
  std::vector<Vec3> solve() { return solution(Eigen::SimplicialLDLT<Matrix>(matrix())); }
  /// For what is well conditioned, as bases of B-splines are, to some digits of the greatest number.
  std::vector<Vec3> iterate() {
    constexpr double kDigits = 1e-7;
    Eigen::ConjugateGradient<Matrix, Eigen::Lower> steps;
    steps.setTolerance(kDigits);
    steps.setMaxIterations(500);
    const Matrix m = matrix();
    steps.compute(m);
    return solution(steps);
  }

 private:
  using Matrix = Eigen::SparseMatrix<double>;

  Matrix matrix() {
    Matrix out(rhs_.rows(), rhs_.rows());
    out.setFromTriplets(entries_.begin(), entries_.end());
    std::vector<Eigen::Triplet<double>>().swap(entries_);
    check_cancelled();
    return out;
  }
  template <class Method>
  std::vector<Vec3> solution(const Method& method) const {
    const bool possible = method.info() == Eigen::Success;
    const Eigen::Matrix<double, Eigen::Dynamic, 3> x = possible ? method.solve(rhs_).eval() : rhs_;
    if (!possible || !x.allFinite())
      throw Error(ErrorKind::numerical, "the equations of a hierarchical spline are singular", {},
                  "take a larger resolution");
    std::vector<Vec3> out;
    for (Eigen::Index i = 0; i < x.rows(); ++i) out.emplace_back(x.row(i).transpose());
    return out;
  }

  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::Matrix<double, Eigen::Dynamic, 3> rhs_;
};

/// What remains of a cell, and whether it is too much.
struct Remainder {
  double sum = 0.0, most = 0.0;
  std::size_t points = 0;
  void add(const Vec3& left) {
    const double square = left.squaredNorm();
    sum += square;
    most = std::max(most, square);
    ++points;
  }
  bool too_much(double noise, double allowed) const {
    if (points == 0 || most < allowed * allowed) return false;
    const auto n = static_cast<double>(points);
    constexpr double kSignificant = 3.0;  // standard deviations of a sum of squares
    return sum / n > noise * noise * (1.0 + kSignificant * std::sqrt(2.0 / n)) + 0.25 * allowed * allowed;
  }
};

/// Breaks that a line through points needs, neighbours differing by no more than a factor of about two.
std::vector<int> breaks_for(const Line& line, const std::vector<Vec3>& points, double noise,
                            const ThbFitSettings& settings) {
  const int n = line.last(), first = std::max(std::min(n, 4), n / kCoarsest);
  std::vector<int> breaks;
  for (int i = 0; i <= first; ++i) breaks.push_back(static_cast<int>(static_cast<long>(i) * n / first));
  const int p = settings.degree;
  const Small bend = second_differences(p);
  for (;;) {
    const KnotLine knots = line.knots(p, breaks);
    const int intervals = knots.intervals();
    Solver solver;
    solver.begin(static_cast<std::size_t>(knots.functions()));
    const auto each_point = [&](int i, const auto& use) {
      const int end = breaks[static_cast<std::size_t>(i) + 1] + (!line.closed() && i + 1 == intervals ? 1 : 0);
      for (int k = breaks[static_cast<std::size_t>(i)]; k < end; ++k)
        use(points[static_cast<std::size_t>(k)], bernstein_values(p, knots.from(i), knots.to(i), line.place(k)));
    };
    const auto function = [&](int i, int k) { return static_cast<std::size_t>(knots.function(i, k)); };
    for (int i = 0; i < intervals; ++i) {
      Small moments{};
      std::array<Vec3, 4> sums;
      sums.fill(Vec3::Zero());
      double count = 0.0;
      each_point(i, [&](const Vec3& point, const KnotWeights& b) {
        ++count;
        for (std::size_t k = 0; k < 4; ++k) {
          sums[k] += b[k] * point;
          for (std::size_t m = 0; m < 4; ++m) moments[k][m] += b[k] * b[m];
        }
      });
      for (std::size_t k = 0; k < 4; ++k)
        for (std::size_t m = 0; m < 4; ++m) moments[k][m] += kSmoothing * (1.0 + count) * bend[k][m];
      std::array<KnotWeights, 4> to{};
      for (int k = 0; k <= p; ++k) to[static_cast<std::size_t>(k)] = knots.bernstein(i, k);
      for (int a = 0; a <= p; ++a) {
        Vec3 right = Vec3::Zero();
        const auto fa = static_cast<std::size_t>(a);
        for (std::size_t k = 0; k < 4; ++k) right += to[k][fa] * sums[k];
        solver.add(function(i, a), right);
        for (int b = 0; b <= p; ++b) {
          if (function(i, b) > function(i, a)) continue;
          double sum = 0.0;
          for (std::size_t k = 0; k < 4; ++k)
            for (std::size_t m = 0; m < 4; ++m) sum += to[k][fa] * moments[k][m] * to[m][static_cast<std::size_t>(b)];
          solver.add(function(i, a), function(i, b), sum);
        }
      }
    }
    const std::vector<Vec3> x = solver.solve();

    std::vector<char> halve(static_cast<std::size_t>(intervals), 0);
    for (int i = 0; i < intervals; ++i) {
      std::array<Vec3, 4> b;
      b.fill(Vec3::Zero());
      for (int k = 0; k <= p; ++k) {
        const KnotWeights w = knots.bernstein(i, k);
        for (int m = 0; m <= p; ++m)
          b[static_cast<std::size_t>(k)] += w[static_cast<std::size_t>(m)] * x[function(i, m)];
      }
      Remainder left;
      each_point(i, [&](const Vec3& point, const KnotWeights& w) {
        left.add(point - (w[0] * b[0] + w[1] * b[1] + w[2] * b[2] + w[3] * b[3]));
      });
      if (!left.too_much(noise, settings.tolerance)) continue;
      // with its neighbours, so that new functions have room
      for (int k = i - 1; k <= i + 1; ++k) {
        const int at = line.closed() ? (k + intervals) % intervals : k;
        if (at >= 0 && at < intervals) halve[static_cast<std::size_t>(at)] = 1;
      }
    }
    std::vector<int> next{0};
    for (int i = 0; i < intervals; ++i) {
      const int from = breaks[static_cast<std::size_t>(i)], to = breaks[static_cast<std::size_t>(i) + 1];
      const int middle = halve[static_cast<std::size_t>(i)] ? line.half(from, to) : 0;
      if (middle > 0) next.push_back(middle);
      next.push_back(to);
    }
    if (next.size() == breaks.size()) return breaks;
    breaks = std::move(next);
  }
}

class Fit {
 public:
  Fit(const sampling::PointGrid& points, const ThbFitSettings& settings)
      : points_(points),
        settings_(settings),
        u_{points.u, points.closed ? 2.0 * std::numbers::pi : 0.0, 4 - settings.degree},
        v_{chord_lengths(points), 0.0, 4 - settings.degree} {
    if (points.body == Body::wheel) {
      std::vector<double> radii(points.h);
      radius_ = median(radii);
    }
    noise_ = estimated_noise();
  }

  ThbFit run() {
    std::vector<int> breaks_u, breaks_v;
    coarsest(breaks_u, breaks_v);
    std::vector<ThbSpace::Level> levels;
    levels_breaks(breaks_u, breaks_v, levels);
    ThbSpace space(std::move(levels));
    space.settle();
    std::vector<Vec3> coefficients(space.functions(), Vec3::Zero());
    improve(space, coefficients);  // and once more below, free of the smoothing of the whole shape
    for (;;) {
      improve(space, coefficients);
      std::size_t left = 0;
      double most = 0.0;
      ThbSpace finer = space;
      const bool changed = mark(space, coefficients, finer, left, most);
      if (!changed) return {{std::move(space), std::move(coefficients)}, noise_, most, left};
      finer.settle();
      coefficients = space.refined(coefficients, finer);
      space = std::move(finer);
    }
  }

 private:
  Vec3 point(std::size_t i, std::size_t j) const { return points_.point(i, j); }

  /// From fourth differences (their standard deviation is sqrt(70) times that of independent noise), along the quieter
  /// direction: of clean points it is next to nothing.
  double estimated_noise() const {
    constexpr double kMad = 0.6744897501960817;  // median of the size of a normal number
    const std::size_t nu = points_.u.size(), nv = points_.y.size();
    const auto of = [&](std::size_t step_u, std::size_t step_v) {
      std::vector<double> sizes;
      const std::size_t skip = std::max<std::size_t>(1, nu * nv / 1'000'000);
      for (std::size_t i = 0; i + 4 * step_u < nu; ++i)
        for (std::size_t j = i % skip; j + 4 * step_v < nv; j += skip) {
          const auto h = [&](std::size_t k) { return points_.h[points_.index(i + k * step_u, j + k * step_v)]; };
          sizes.push_back(std::abs(h(0) - 4.0 * h(1) + 6.0 * h(2) - 4.0 * h(3) + h(4)));
        }
      return median(sizes) / (kMad * std::sqrt(70.0));
    };
    return std::min(of(1, 0), of(0, 1));
  }

  /// Breaks of level 0: those of the median section, and of the median of what lies beside it along u.
  void coarsest(std::vector<int>& breaks_u, std::vector<int>& breaks_v) const {
    const std::size_t nu = points_.u.size(), nv = points_.y.size();
    std::vector<double> column, section(nv);
    std::vector<Vec3> across, along;
    for (std::size_t j = 0; j < nv; ++j) {
      column.clear();
      for (std::size_t i = 0; i < nu; ++i) column.push_back(points_.h[points_.index(i, j)]);
      section[j] = median(column);
      double y = points_.y[j];
      if (!points_.own_y.empty()) {
        column.clear();
        for (std::size_t i = 0; i < nu; ++i) column.push_back(points_.own_y[points_.index(i, j)]);
        y = median(column);
      }
      across.emplace_back(0.0, y, section[j]);
    }
    for (std::size_t i = 0; i < nu; ++i) {
      column.clear();
      for (std::size_t j = 0; j < nv; ++j) column.push_back(points_.h[points_.index(i, j)] - section[j]);
      const double beside = median(column), u = points_.u[i];
      if (points_.body == Body::wheel)
        along.push_back((radius_ + beside) * Vec3(std::sin(u), 0.0, std::cos(u)));
      else
        along.emplace_back(u, 0.0, beside);
    }
    constexpr double kOfMedian = 1.2533141373155001;  // its noise over that of a mean
    breaks_v = breaks_for(v_, across, noise_ * kOfMedian / std::sqrt(static_cast<double>(nu)), settings_);
    breaks_u = breaks_for(u_, along, noise_ * kOfMedian / std::sqrt(static_cast<double>(nv)), settings_);
  }

  // Level by level the longest intervals are halved, down to single points.
  void levels_breaks(const std::vector<int>& breaks_u, const std::vector<int>& breaks_v,
                     std::vector<ThbSpace::Level>& levels) {
    u_breaks_ = {breaks_u};
    v_breaks_ = {breaks_v};
    const auto longest = [](const std::vector<int>& breaks) {
      int most = 0;
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i) most = std::max(most, breaks[i + 1] - breaks[i]);
      return most;
    };
    const auto halved = [](const Line& line, const std::vector<int>& breaks, int limit) {
      std::vector<int> out{0};
      for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
        const int middle = breaks[i + 1] - breaks[i] > limit ? line.half(breaks[i], breaks[i + 1]) : 0;
        if (middle > 0) out.push_back(middle);
        out.push_back(breaks[i + 1]);
      }
      return out;
    };
    for (int limit = std::max(longest(breaks_u), longest(breaks_v)) / 2; limit >= 1; limit /= 2) {
      auto next_u = halved(u_, u_breaks_.back(), limit), next_v = halved(v_, v_breaks_.back(), limit);
      if (next_u.size() == u_breaks_.back().size() && next_v.size() == v_breaks_.back().size()) continue;
      u_breaks_.push_back(std::move(next_u));
      v_breaks_.push_back(std::move(next_v));
    }
    for (std::size_t l = 0; l < u_breaks_.size(); ++l)
      levels.push_back({u_.knots(settings_.degree, u_breaks_[l]), v_.knots(settings_.degree, v_breaks_[l])});
  }

  struct Block {
    std::size_t i0, i1, j0, j1;
  };
  /// Points of a cell: those on its lower borders belong to it.
  Block points_of(const ThbCell& cell) const {
    const auto l = static_cast<std::size_t>(cell.level);
    const auto end = [](const Line& line, const std::vector<int>& breaks, int k) {
      const int to = breaks[static_cast<std::size_t>(k) + 1];
      return static_cast<std::size_t>(to + (!line.closed() && to == line.last() ? 1 : 0));
    };
    return {static_cast<std::size_t>(u_breaks_[l][static_cast<std::size_t>(cell.iu)]), end(u_, u_breaks_[l], cell.iu),
            static_cast<std::size_t>(v_breaks_[l][static_cast<std::size_t>(cell.iv)]), end(v_, v_breaks_[l], cell.iv)};
  }

  /// Calls use(left, values of Bernstein polynomials along u, along v) for the points of a cell.
  template <class Use>
  void each_left(const ThbSpace& space, const ThbCell& cell, const ThbPiece& piece, const Use& use) const {
    const int p = settings_.degree;
    const Block block = points_of(cell);
    const ThbRange r = space.range(cell);
    std::vector<KnotWeights> across;
    for (std::size_t j = block.j0; j < block.j1; ++j)
      across.push_back(bernstein_values(p, r.v0, r.v1, v_.place(static_cast<int>(j))));
    for (std::size_t i = block.i0; i < block.i1; ++i) {
      const KnotWeights along = bernstein_values(p, r.u0, r.u1, u_.place(static_cast<int>(i)));
      std::array<Vec3, 4> row;
      for (std::size_t j = 0; j < 4; ++j)
        row[j] = along[0] * piece[0][j] + along[1] * piece[1][j] + along[2] * piece[2][j] + along[3] * piece[3][j];
      for (std::size_t j = block.j0; j < block.j1; ++j) {
        const KnotWeights& b = across[j - block.j0];
        use(Vec3(point(i, j) - (b[0] * row[0] + b[1] * row[1] + b[2] * row[2] + b[3] * row[3])), along, b);
      }
    }
  }

  /// Adds the spline that is nearest to what is left.
  void improve(const ThbSpace& space, std::vector<Vec3>& coefficients) const {
    struct Equations {
      std::vector<ThbSpace::Column> columns;
      std::vector<double> products;  // lower triangle, row by row
      std::vector<Vec3> right;
    };
    constexpr std::size_t kChunk = 4096;
    const Small bend = second_differences(settings_.degree);
    const auto p = static_cast<std::size_t>(settings_.degree);
    Solver solver;
    solver.begin(space.functions());
    std::vector<Equations> chunk;
    const auto& cells = space.cells();
    for (std::size_t begin = 0; begin < cells.size(); begin += kChunk) {
      chunk.assign(std::min(kChunk, cells.size() - begin), {});
      parallel_for(chunk.size(), [&](std::size_t k) {
        const ThbCell& cell = cells[begin + k];
        Equations& out = chunk[k];
        Small of_u{}, of_v{};
        ThbPiece sums;
        for (auto& row : sums) row.fill(Vec3::Zero());
        const Block block = points_of(cell);
        const ThbRange r = space.range(cell);
        const auto moments = [&](Small& m, const Line& line, std::size_t from, std::size_t to, double low,
                                 double high) {
          for (std::size_t i = from; i < to; ++i) {
            const KnotWeights b = bernstein_values(settings_.degree, low, high, line.place(static_cast<int>(i)));
            for (std::size_t a = 0; a < 4; ++a)
              for (std::size_t c = 0; c < 4; ++c) m[a][c] += b[a] * b[c];
          }
        };
        moments(of_u, u_, block.i0, block.i1, r.u0, r.u1);
        moments(of_v, v_, block.j0, block.j1, r.v0, r.v1);
        each_left(space, cell, space.piece(cell, coefficients),
                  [&](const Vec3& left, const KnotWeights& along, const KnotWeights& across) {
                    for (std::size_t i = 0; i < 4; ++i)
                      for (std::size_t j = 0; j < 4; ++j) sums[i][j] += (along[i] * across[j]) * left;
                  });
        const double count = static_cast<double>((block.i1 - block.i0) * (block.j1 - block.j0));
        const double smooth = kSmoothing * (1.0 + count);
        out.columns = space.columns(cell);
        std::vector<std::array<double, 16>> turned(out.columns.size());
        for (std::size_t a = 0; a < out.columns.size(); ++a) {
          const auto& c = out.columns[a].b;
          // M_u C M_v + smooth (S_u C + C S_v)
          double half[4][4] = {}, bent[4][4] = {};
          Vec3 right = Vec3::Zero();
          for (std::size_t i = 0; i <= p; ++i)
            for (std::size_t j = 0; j <= p; ++j) {
              right += c[(p + 1) * i + j] * sums[i][j];
              for (std::size_t k2 = 0; k2 <= p; ++k2) {
                half[i][j] += of_u[i][k2] * c[(p + 1) * k2 + j];
                bent[i][j] += bend[i][k2] * c[(p + 1) * k2 + j] + bend[j][k2] * c[(p + 1) * i + k2];
              }
            }
          out.right.push_back(right);
          for (std::size_t i = 0; i <= p; ++i)
            for (std::size_t j = 0; j <= p; ++j) {
              double sum = smooth * bent[i][j];
              for (std::size_t k2 = 0; k2 <= p; ++k2) sum += half[i][k2] * of_v[k2][j];
              turned[a][(p + 1) * i + j] = sum;
            }
          for (std::size_t b = 0; b <= a; ++b) {
            double sum = 0.0;
            for (std::size_t k2 = 0; k2 < (p + 1) * (p + 1); ++k2) sum += turned[a][k2] * out.columns[b].b[k2];
            out.products.push_back(sum);
          }
        }
      });
      for (const Equations& e : chunk) {
        std::size_t k = 0;
        for (std::size_t a = 0; a < e.columns.size(); ++a) {
          solver.add(e.columns[a].function, e.right[a]);
          for (std::size_t b = 0; b <= a; ++b)
            solver.add(e.columns[a].function, e.columns[b].function, e.products[k++]);
        }
      }
    }
    const std::vector<Vec3> more = solver.iterate();
    for (std::size_t k = 0; k < more.size(); ++k) coefficients[k] += more[k];
  }

  /// Divides cells with too much left, and their neighbours, so that new functions have room.
  bool mark(const ThbSpace& space, const std::vector<Vec3>& coefficients, ThbSpace& finer, std::size_t& unresolved,
            double& most) const {
    const auto& cells = space.cells();
    std::vector<char> too_much(cells.size(), 0);
    std::vector<double> most_of(cells.size(), 0.0);
    parallel_for(cells.size(), [&](std::size_t k) {
      Remainder left;
      each_left(space, cells[k], space.piece(cells[k], coefficients),
                [&](const Vec3& d, const KnotWeights&, const KnotWeights&) { left.add(d); });
      too_much[k] = left.too_much(noise_, settings_.tolerance) ? 1 : 0;
      most_of[k] = std::sqrt(left.most);
    });
    bool changed = false;
    for (std::size_t k = 0; k < cells.size(); ++k) {
      most = std::max(most, most_of[k]);
      if (!too_much[k]) continue;
      const ThbCell& cell = cells[k];
      if (cell.level + 1 == space.levels()) {
        ++unresolved;
        continue;
      }
      changed = true;
      const KnotLine &u = space.u(cell.level), &v = space.v(cell.level);
      for (int du = -1; du <= 1; ++du)
        for (int dv = -1; dv <= 1; ++dv) {
          ThbCell near{cell.level, cell.iu + du, cell.iv + dv};
          if (u.closed()) near.iu = (near.iu + u.intervals()) % u.intervals();
          if (near.iu < 0 || near.iv < 0 || near.iu >= u.intervals() || near.iv >= v.intervals()) continue;
          if (!finer.exists(near)) finer.divide(finer.parent(near));
          finer.divide(near);
        }
    }
    return changed;
  }

  const sampling::PointGrid& points_;
  ThbFitSettings settings_;
  Line u_, v_;
  double radius_ = 1.0;
  double noise_ = 0.0;
  std::vector<std::vector<int>> u_breaks_, v_breaks_;  // by level
};

}  // namespace

ThbFit fit_thb(const sampling::PointGrid& points, const ThbFitSettings& settings) {
  if (settings.degree != 2 && settings.degree != 3)
    throw Error(ErrorKind::configuration, "hierarchical splines are fitted with degree 2 or 3");
  check_points(points);
  return Fit(points, settings).run();
}

}  // namespace treadmark::spline
