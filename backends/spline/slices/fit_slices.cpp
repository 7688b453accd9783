// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/backends/spline/slices/fit_slices.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <string>

#include "treadmark/backends/spline/banded.hpp"
#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {

namespace {

constexpr int kLeastSlices = 4;
constexpr double kFullTurn = 2.0 * std::numbers::pi;
// The influence of a slice on an interpolating spline falls by 3.7 per slice.
constexpr std::size_t kWrappedSlices = 16;
// Slices a turn apart, to the digits that files have.
constexpr double kSameAngle = 1e-4;    // [rad]
constexpr double kSameSection = 1e-6;  // [m]
// A gap up to this multiple of the widest step between slices counts as one more step of a full circle.
constexpr double kWidestGap = 1.5;

// The splines over given positions: knots, their polynomials, and the equations of interpolation.
class LineFitter {
 public:
  LineFitter(std::span<const double> positions, bool approximate)
      : n_(static_cast<int>(positions.size())), approximate_(approximate), knots_(extended_knots(positions)) {
    for (int i = 0; i + 1 < n_; ++i) basis_.push_back(basis_powers(knots_, i + 3));
    if (!approximate_) set_up_interpolation();
  }

  const BasisPowers& basis(int span) const { return basis_[static_cast<std::size_t>(span)]; }

  // coefficients: size n + 2.
  void fit(std::span<const double> values, std::span<double> coefficients) const {
    const auto n = static_cast<std::size_t>(n_);
    if (approximate_) {
      std::copy(values.begin(), values.end(), coefficients.begin() + 1);
      coefficients[0] = 2.0 * values[0] - values[1];
      coefficients[n + 1] = 2.0 * values[n - 1] - values[n - 2];
      return;
    }
    // Row order: value 1, not-a-knot, values 2 .. n-1, not-a-knot, value n.
    coefficients[0] = values[0];
    coefficients[1] = 0.0;
    for (std::size_t i = 1; i + 1 < n; ++i) coefficients[i + 1] = values[i];
    coefficients[n] = 0.0;
    coefficients[n + 1] = values[n - 1];
    equations_->solve(coefficients);
  }

 private:
  void set_up_interpolation() {
    equations_.emplace(n_ + 2, 3);
    // Value at position i: the B-splines i .. i + 2 at the start of span i (at its end for the last one).
    const auto set_value = [this](int row, int i) {
      const bool last = i == n_ - 1;
      const BasisPowers& b = basis(last ? i - 1 : i);
      const double t = last ? knots_[static_cast<std::size_t>(i) + 3] - knots_[static_cast<std::size_t>(i) + 2] : 0.0;
      for (int k = 0; k < 3; ++k)
        equations_->at(row, i + k) = power_value(b[static_cast<std::size_t>(last ? k + 1 : k)], t);
    };
    // Equal third derivatives on the spans before and after position i.
    const auto set_not_a_knot = [this](int row, int i) {
      const double before_h =
          std::pow(knots_[static_cast<std::size_t>(i) + 3] - knots_[static_cast<std::size_t>(i) + 2], 3);
      for (int k = 0; k < 4; ++k) {
        equations_->at(row, i - 1 + k) += before_h * basis(i - 1)[static_cast<std::size_t>(k)][3];
        equations_->at(row, i + k) -= before_h * basis(i)[static_cast<std::size_t>(k)][3];
      }
    };
    set_value(0, 0);
    set_not_a_knot(1, 1);
    for (int i = 1; i + 1 < n_; ++i) set_value(i + 1, i);
    set_not_a_knot(n_, n_ - 2);
    set_value(n_ + 1, n_ - 1);
    equations_->factor();
  }

  int n_;
  bool approximate_;
  std::vector<double> knots_;
  std::vector<BasisPowers> basis_;
  std::optional<BandedLu> equations_;
};

// Coefficients across each slice; NaN where a line is missing.
std::vector<std::vector<NetPair>> fit_across(const SampledSlices& sampled) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  std::map<std::size_t, LineFitter> fitters;  // knots are uniform, so only the number of points matters
  for (const SampledSlice& slice : sampled.slices)
    if (const std::size_t n = slice.points.size(); n > 0 && !fitters.contains(n)) {
      std::vector<double> positions(n);
      for (std::size_t i = 0; i < n; ++i) positions[i] = static_cast<double>(i);
      fitters.emplace(n, LineFitter(positions, false));
    }
  std::vector<std::vector<NetPair>> lines(sampled.slices.size());
  parallel_for(lines.size(), [&](std::size_t k) {
    const SampledSlice& slice = sampled.slices[k];
    lines[k].assign(static_cast<std::size_t>(sampled.positions) + 2, NetPair{kNaN, kNaN});
    const std::size_t n = slice.points.size();
    if (n == 0) return;
    const LineFitter& fitter = fitters.at(n);
    std::vector<double> y(n), w(n), cy(n + 2), cw(n + 2);
    for (std::size_t i = 0; i < n; ++i) y[i] = slice.points[i].y, w[i] = slice.points[i].w;
    fitter.fit(y, cy);
    fitter.fit(w, cw);
    for (std::size_t i = 0; i < n + 2; ++i) lines[k][static_cast<std::size_t>(slice.first) + i] = {cy[i], cw[i]};
  });
  return lines;
}

// Slices in the order in which they are fitted: as given, or with copies a turn away at both ends.
struct Arrangement {
  std::vector<double> u;
  std::vector<std::size_t> slice;
  bool closed = false;
  std::size_t copies = 0;  // at each end
};

bool same_section(const Profile& a, const Profile& b) {
  const auto same = [](double p, double q) { return std::abs(p - q) <= kSameSection; };
  return ranges::equal(a.y, b.y, same) && ranges::equal(a.z, b.z, same);
}

// Whether the last slice is the first one again, a turn later.
bool ends_where_it_begins(const SliceSet& slices) {
  return std::abs(slices.u.back() - slices.u.front() - kFullTurn) <= kSameAngle && slices.u.size() > kLeastSlices &&
         same_section(slices.profiles.front(), slices.profiles.back());
}

Arrangement arrange(const SliceSet& slices) {
  const bool repeated = slices.body == Body::wheel && !slices.open_seam && ends_where_it_begins(slices);
  const std::size_t n = slices.u.size() - (repeated ? 1 : 0);
  Arrangement all{slices.u, std::vector<std::size_t>(n), false, 0};
  for (std::size_t i = 0; i < n; ++i) all.slice[i] = i;
  if (slices.body == Body::rail || slices.open_seam) return all;
  double widest = 0.0;
  for (std::size_t i = 0; i + 1 < n; ++i) widest = std::max(widest, slices.u[i + 1] - slices.u[i]);
  const double gap = kFullTurn - (slices.u[n - 1] - slices.u.front());
  all.closed = repeated || (gap > 0.0 && gap <= kWidestGap * widest);
  if (!all.closed) return all;

  const std::size_t copies = std::min(n, kWrappedSlices);
  Arrangement closed{{}, {}, true, copies};
  const auto add = [&](std::size_t i, double turn) {
    closed.u.push_back(slices.u[i] + turn);
    closed.slice.push_back(i);
  };
  for (std::size_t i = n - copies; i < n; ++i) add(i, -kFullTurn);
  for (std::size_t i = 0; i < n; ++i) add(i, 0.0);
  for (std::size_t i = 0; i < copies; ++i) add(i, kFullTurn);
  return closed;
}

// Where the spans of the net come from: index of the fitted interval, or -1 / -2 for the constant ends.
struct SpanPlan {
  std::vector<double> starts;
  std::vector<int> interval;
  double end = 0.0;
};
constexpr int kBeforeFirst = -1, kAfterLast = -2;

SpanPlan plan_spans(const SliceSet& slices, const Arrangement& all) {
  SpanPlan plan;
  if (all.closed) {
    const std::size_t copies = all.copies, n = all.u.size() - 2 * copies;
    for (std::size_t i = 0; i < n; ++i) {
      plan.starts.push_back(slices.u[i]);
      plan.interval.push_back(static_cast<int>(copies + i));
    }
    plan.end = slices.u.front() + kFullTurn;
    return plan;
  }
  // The constant ends of a rail go on for ever, whatever their nominal length.
  double begin = all.u.front() - 1.0;
  plan.end = all.u.back() + 1.0;
  if (slices.body == Body::wheel) {
    // Angles are taken into one turn; about zero unless the slices lie otherwise.
    const double middle = 0.5 * (all.u.front() + all.u.back());
    const bool about_zero = (all.u.front() >= -std::numbers::pi && all.u.back() <= std::numbers::pi) ||
                            (all.u.front() <= -std::numbers::pi && all.u.back() >= std::numbers::pi);
    begin = (about_zero ? 0.0 : middle) - std::numbers::pi;
    plan.end = begin + kFullTurn;
  }
  if (begin < all.u.front()) {
    plan.starts.push_back(begin);
    plan.interval.push_back(kBeforeFirst);
  }
  for (std::size_t i = 0; i + 1 < all.u.size(); ++i) {
    if (all.u[i + 1] <= begin || all.u[i] >= plan.end) continue;
    plan.starts.push_back(all.u[i]);
    plan.interval.push_back(static_cast<int>(i));
  }
  if (all.u.back() < plan.end) {
    plan.starts.push_back(all.u.back());
    plan.interval.push_back(kAfterLast);
  }
  return plan;
}

void check(const SliceSet& slices) {
  const std::size_t n = slices.u.size();
  const auto fail = [&slices](const std::string& problem) {
    return Error(ErrorKind::input_data, "the slices of '" + slices.name + "' " + problem);
  };
  if (n < kLeastSlices) throw fail("are " + std::to_string(n) + ", at least 4 are needed");
  if (slices.profiles.size() != n) throw fail("need one profile for every position");
  for (std::size_t i = 0; i < n; ++i)
    if (!std::isfinite(slices.u[i]) || (i > 0 && !(slices.u[i] > slices.u[i - 1])))
      throw fail("must have strictly increasing positions, see number " + std::to_string(i + 1));
  if (slices.body == Body::wheel && slices.u.back() - slices.u.front() > 1.5 * kFullTurn)
    throw fail("cover more than one and a half turns of the wheel");
}

// lines: coefficients of each slice, one for every line of the net.
SliceNet fit_along(const SliceSet& slices, const std::vector<std::vector<NetPair>>& lines, int positions,
                   SliceNet::Across across) {
  const Arrangement all = arrange(slices);
  const SpanPlan plan = plan_spans(slices, all);
  SliceNet net(plan.starts, plan.end, slices.body == Body::wheel, positions, across);

  net.hold_ends(plan.interval.front() == kBeforeFirst, plan.interval.back() == kAfterLast);

  // Along every coefficient line, each run of slices that have it is a spline of its own.
  using Run = std::pair<std::size_t, std::size_t>;  // first and last slice
  const std::size_t n = all.u.size();
  std::map<Run, LineFitter> fitters;
  std::vector<std::vector<Run>> runs(static_cast<std::size_t>(net.lines()));
  for (std::size_t j = 0; j < runs.size(); ++j) {
    check_cancelled();
    const auto missing = [&](std::size_t i) { return std::isnan(lines[all.slice[i]][j].y); };
    for (std::size_t first = 0; first < n;) {
      if (missing(first)) {
        ++first;
        continue;
      }
      std::size_t last = first;
      while (last + 1 < n && !missing(last + 1)) ++last;
      const std::size_t count = last - first + 1;
      if (count < kLeastSlices)
        throw Error(ErrorKind::input_data, "a part of '" + slices.name + "' exists in only " + std::to_string(count) +
                                               " successive slices near number " +
                                               std::to_string(all.slice[first] + 1) + ", at least 4 are needed");
      if (!fitters.contains({first, last}))
        fitters.emplace(Run(first, last), LineFitter(std::span(all.u).subspan(first, count), slices.approximate_u));
      runs[j].emplace_back(first, last);
      first = last + 1;
    }
  }
  parallel_for(runs.size(), [&](std::size_t j) {
    std::vector<SliceNet::LineCubic> interval(n - 1, SliceNet::LineCubic{});
    std::vector<bool> present(n - 1, false);
    for (const Run& run : runs[j]) {
      const LineFitter& fitter = fitters.at(run);
      const std::size_t first = run.first, count = run.second - run.first + 1;
      std::vector<double> y(count), w(count), cy(count + 2), cw(count + 2);
      for (std::size_t i = 0; i < count; ++i) {
        y[i] = lines[all.slice[first + i]][j].y;
        w[i] = lines[all.slice[first + i]][j].w;
      }
      fitter.fit(y, cy);
      fitter.fit(w, cw);
      for (std::size_t i = 0; i + 1 < count; ++i) {
        const BasisPowers& basis = fitter.basis(static_cast<int>(i));
        present[first + i] = true;
        for (std::size_t b = 0; b < 4; ++b)
          for (std::size_t k = 0; k < 4; ++k)
            interval[first + i].power[k] = interval[first + i].power[k] + basis[b][k] * NetPair{cy[i + b], cw[i + b]};
      }
    }

    for (int span = 0; span < net.spans(); ++span) {
      const int source = plan.interval[static_cast<std::size_t>(span)];
      const std::size_t i = source >= 0 ? static_cast<std::size_t>(source) : source == kBeforeFirst ? 0 : n - 2;
      if (!present[i]) continue;
      if (source >= 0) {
        net.set_line(span, static_cast<int>(j), interval[i]);
        continue;
      }
      const double t = source == kBeforeFirst ? 0.0 : all.u[n - 1] - all.u[n - 2];
      const NetPair* p = interval[i].power;
      SliceNet::LineCubic constant;
      constant.power[0] = p[0] + t * (p[1] + t * (p[2] + t * p[3]));
      net.set_line(span, static_cast<int>(j), constant);
    }
  });
  return net;
}

}  // namespace

std::vector<double> line_coefficients(std::span<const double> positions, std::span<const double> values,
                                      bool approximate) {
  std::vector<double> coefficients(values.size() + 2);
  LineFitter(positions, approximate).fit(values, coefficients);
  return coefficients;
}

SliceNet fit_slices(const SliceSet& slices) {
  check(slices);
  const SampledSlices sampled = sample_slices(slices);
  return fit_along(slices, fit_across(sampled), sampled.positions, SliceNet::Across::cubic);
}

SliceNet join_straight(const SliceSet& stations, const std::vector<std::vector<NetPair>>& points) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  check(stations);
  std::vector<std::vector<NetPair>> lines;
  lines.reserve(points.size());
  for (const std::vector<NetPair>& station : points) {
    auto& line = lines.emplace_back(1, NetPair{kNaN, kNaN});
    line.insert(line.end(), station.begin(), station.end());
    line.push_back({kNaN, kNaN});
  }
  return fit_along(stations, lines, static_cast<int>(points.front().size()), SliceNet::Across::straight);
}

namespace {

constexpr double kPositionSpacing = 0.5e-3;  // [m]
constexpr double kLengthSlack = 1e-9;        // [m]
constexpr int kLeastPositions = 4;

Error bad_slice(const SliceSet& slices, std::size_t i, const std::string& problem) {
  return Error(ErrorKind::input_data, "slice " + std::to_string(i + 1) + " of '" + slices.name + "' " + problem);
}

// Features of a slice, measured from its first point; without features the whole slice is one part.
std::vector<double> features_of(const SliceSet& slices, std::size_t i, double length) {
  if (slices.features.empty()) return {0.0, length};
  std::vector<double> features = slices.features[i];
  if (features.size() < 2) throw bad_slice(slices, i, "needs at least two features or none");
  if (!std::isnan(features.back())) features.back() = std::min(features.back(), length);
  bool present = false, ended = false;
  double previous = 0.0;
  for (const double s : features) {
    if (std::isnan(s)) {
      ended = present;
      continue;
    }
    if (ended)
      throw bad_slice(slices, i, "lacks a feature in the middle; only leading or trailing ones may be missing");
    if (present && !(s > previous)) throw bad_slice(slices, i, "has features that do not increase");
    if (s < 0.0 || s > length + kLengthSlack) throw bad_slice(slices, i, "has a feature beyond its end");
    previous = s;
    present = true;
  }
  return features;
}

}  // namespace

SampledSlices sample_slices(const SliceSet& slices) {
  const std::size_t count = slices.profiles.size();
  if (!slices.features.empty() && slices.features.size() != count)
    throw Error(ErrorKind::input_data, "'" + slices.name + "' has features for another number of slices");
  std::vector<ProfileSpline> splines;
  std::vector<std::vector<double>> features;
  for (std::size_t i = 0; i < count; ++i) {
    check_cancelled();
    splines.push_back(fit_profile(slices.profiles[i]));
    features.push_back(features_of(slices, i, splines.back().end() - splines.back().begin()));
    if (features.back().size() != features.front().size()) throw bad_slice(slices, i, "has another number of features");
  }

  // Equally many intervals in every slice, for the longest one.
  const std::size_t parts = features.front().size() - 1;
  std::vector<int> intervals(parts, 0);
  SampledSlices sampled;
  sampled.positions = 1;
  for (std::size_t p = 0; p < parts; ++p) {
    double longest = 0.0;
    for (const auto& f : features)
      if (f[p + 1] > f[p]) longest = std::max(longest, f[p + 1] - f[p]);  // false where one of them is missing
    intervals[p] = slices.across > kLeastPositions && slices.features.empty()
                       ? slices.across - 1
                       : 1 + to_whole<int>((longest + kLengthSlack) / kPositionSpacing);
    sampled.positions += intervals[p];
  }

  for (std::size_t i = 0; i < count; ++i) {
    check_cancelled();
    SampledSlice slice;
    int position = 0;
    for (std::size_t p = 0; p < parts; position += intervals[p], ++p) {
      const double from = features[i][p], to = features[i][p + 1];
      if (std::isnan(from) || std::isnan(to)) continue;
      if (slice.points.empty()) slice.first = position;
      for (int k = slice.points.empty() ? 0 : 1; k <= intervals[p]; ++k) {
        const Vec2 point = splines[i].position(splines[i].begin() + from + (to - from) * k / intervals[p]);
        slice.points.push_back({point.x(), point.y()});
      }
    }
    if (!slice.points.empty() && static_cast<int>(slice.points.size()) < kLeastPositions)
      throw bad_slice(slices, i, "is too short for a spline across");
    sampled.slices.push_back(std::move(slice));
  }
  return sampled;
}

}  // namespace treadmark::spline
