// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/recording_chainage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::io {

namespace {

constexpr std::string_view kSamplingAdvice = "if the rows are evenly spaced, give irregularities.sampling_m";

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> differences(const std::vector<double>& d) {
  std::vector<double> all(d.size() - 1);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = d[i + 1] - d[i];
  return all;
}

void keep_rows(RecordedRows& rows, const std::vector<bool>& kept) {
  const auto keep = [&](auto& values) {
    std::size_t to = 0;
    for (std::size_t i = 0; i < kept.size(); ++i)
      if (kept[i]) values[to++] = values[i];
    values.resize(to);
  };
  keep(rows.lines);
  keep(rows.distance);
  for (std::vector<double>& signal : rows.signals) keep(signal);
}

/// Few rows without a distance lie evenly between their neighbours; at the ends they go.
void fill_distances(RecordedRows& rows, std::vector<std::string>& notes) {
  constexpr std::size_t kMost = 20;
  std::vector<double>& d = rows.distance;
  std::vector<bool> kept(d.size(), true);
  std::optional<std::size_t> last;
  std::size_t filled = 0;
  for (std::size_t i = 0; i < d.size(); ++i) {
    if (std::isnan(d[i])) {
      kept[i] = false;
      continue;
    }
    if (last && i > *last + 1) {
      if (i - *last > kMost + 1) rows.fail(*last + 1, fmt::format("{} rows have no distance", i - *last - 1));
      for (std::size_t k = *last + 1; k < i; ++k) {
        d[k] = d[*last] + (d[i] - d[*last]) * static_cast<double>(k - *last) / static_cast<double>(i - *last);
        kept[k] = true;
        ++filled;
      }
    }
    last = i;
  }
  if (filled > 0)
    notes.push_back(fmt::format("{}: rows without a distance, put between their neighbours: {}", rows.file, filled));
  keep_rows(rows, kept);
}

/// How far signals are from going on evenly over a step, over what is usual: the error of a straight line from
/// either side.
class Continuity {
 public:
  Continuity(const RecordedRows& rows, const std::vector<bool>& regular) : rows_(rows) {
    for (const std::vector<double>& signal : rows.signals) {
      double sum = 0.0;
      std::size_t count = 0;
      for (std::size_t i = 1; i + 2 < signal.size(); ++i) {
        if (!regular[i - 1] || !regular[i] || !regular[i + 1]) continue;
        const double error = error_at(signal, i);
        if (std::isnan(error)) continue;
        sum += error * error;
        ++count;
      }
      usual_.push_back(count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0);
    }
  }

  /// From row i to i + 1.
  bool goes_on(std::size_t i) const {
    constexpr double kMost = 4.0, kRounding = 1e-9;
    for (std::size_t s = 0; s < usual_.size(); ++s)
      if (error_at(rows_.signals[s], i) > kMost * usual_[s] + kRounding) return false;
    return true;
  }

 private:
  static double error_at(const std::vector<double>& v, std::size_t i) {
    const double before = i > 0 ? std::abs(v[i + 1] - 2.0 * v[i] + v[i - 1]) : 0.0,
                 behind = i + 2 < v.size() ? std::abs(v[i] - 2.0 * v[i + 1] + v[i + 2]) : 0.0;
    return std::max(before, behind);
  }

  const RecordedRows& rows_;
  std::vector<double> usual_;
};

bool same_values(const RecordedRows& rows, std::size_t a, std::size_t b) {
  return ranges::all_of(rows.signals, [&](const std::vector<double>& s) { return s[a] == s[b]; });
}

/// Rows from `from` on that record again what rows before it did; 0: they do not.
std::size_t rows_recorded_again(const RecordedRows& rows, const std::vector<double>& d, std::size_t from, double step) {
  constexpr double kSame = 0.2;  // of the signal's own variation
  constexpr std::size_t kLeast = 4;
  const auto back = to_whole<std::size_t>(std::round((d[from - 1] - d[from]) / step)) + 1;
  if (back < kLeast || back > from || from + back > d.size()) return 0;
  for (const std::vector<double>& s : rows.signals) {
    double apart = 0.0, mean = 0.0, square = 0.0;
    for (std::size_t k = 0; k < back; ++k) {
      const double once = s[from - back + k], again = s[from + k];
      if (std::isnan(once) || std::isnan(again)) continue;
      apart += (again - once) * (again - once);
      mean += once / static_cast<double>(back);
      square += once * once;
    }
    const double own = square - static_cast<double>(back) * mean * mean;
    if (apart > kSame * kSame * own + 1e-12) return 0;
  }
  return back;
}

/// Numbers of jumps for one note each.
struct Jumps {
  int breaks = 0, gaps = 0, twice = 0;
  double first_break = 0.0, first_by = 0.0, widest_gap = 0.0, widest_at = 0.0;
};

void tell(const RecordedRows& rows, const Jumps& jumps, double step, std::vector<std::string>& notes) {
  if (jumps.breaks > 0)
    notes.push_back(
        fmt::format("{}: the chainage jumps {} time{}, first by {:.6g} m at {:.10g} m, while the signals go on: a "
                    "broken chain; rows are counted on by {:.6g} m",
                    rows.file, jumps.breaks, jumps.breaks == 1 ? "" : "s", jumps.first_by, jumps.first_break, step));
  if (jumps.gaps > 0)
    notes.push_back(
        fmt::format("{}: rows are missing in {} place{}, at most over {:.6g} m at {:.10g} m: bridged by a "
                    "smooth curve",
                    rows.file, jumps.gaps, jumps.gaps == 1 ? "" : "s", jumps.widest_gap, jumps.widest_at));
  if (jumps.twice > 0) notes.push_back(fmt::format("{}: rows recorded twice, left out: {}", rows.file, jumps.twice));
}

/// Of rows that are evenly spaced but for some places.
void count_over_jumps(RecordedRows& rows, double step, std::vector<std::string>& notes) {
  constexpr double kShort = 0.5, kLong = 1.5;  // of a step: a jump
  const std::vector<double> stated = rows.distance, by = differences(stated);
  std::vector<bool> regular(by.size());
  for (std::size_t i = 0; i < by.size(); ++i) regular[i] = by[i] >= kShort * step && by[i] <= kLong * step;
  if (ranges::find(regular, false) == regular.end()) return;
  const Continuity continuity(rows, regular);
  std::vector<bool> kept(stated.size(), true);
  Jumps jumps;
  double shift = 0.0;
  for (std::size_t i = 0; i < by.size(); ++i) {
    const std::size_t next = i + 1;
    if (!regular[i]) {
      if (by[i] == 0.0 && same_values(rows, i, next)) {
        kept[next] = false;
        ++jumps.twice;
      } else if (continuity.goes_on(i)) {
        shift += step - by[i];
        if (jumps.breaks++ == 0) jumps.first_break = stated[next], jumps.first_by = by[i];
      } else if (by[i] > 0.0) {
        if (by[i] > kLongestBridge)
          rows.fail(
              next,
              fmt::format("rows are missing over {:.6g} m, from {:.10g} to {:.10g} m", by[i], stated[i], stated[next]),
              fmt::format("cut the file there; {}", kSamplingAdvice));
        ++jumps.gaps;
        if (by[i] > jumps.widest_gap) jumps.widest_gap = by[i], jumps.widest_at = stated[i];
      } else if (const std::size_t again = rows_recorded_again(rows, stated, next, step); again > 0) {
        for (std::size_t k = 0; k < again; ++k) kept[next + k] = false;
        jumps.twice += static_cast<int>(again);
        i += again - 1;
        continue;
      } else {
        rows.fail(next,
                  fmt::format("the distance goes from {:.10g} to {:.10g} m, it must increase", stated[i], stated[next]),
                  std::string(kSamplingAdvice));
      }
    }
    rows.distance[next] = stated[next] + shift;
  }
  keep_rows(rows, kept);
  tell(rows, jumps, step, notes);
}

/// The step of which the distances are roundings to multiples of a quantum; 0: they are none.
double even_step(const std::vector<double>& d, double quantum, double& first) {
  const auto n = static_cast<double>(d.size());
  double sum = 0.0, moment = 0.0;
  const double middle = 0.5 * (n - 1.0);
  for (std::size_t i = 0; i < d.size(); ++i) {
    sum += d[i] - d.front();
    moment += (d[i] - d.front()) * (static_cast<double>(i) - middle);
  }
  double step = moment / (n * (n * n - 1.0) / 12.0);
  constexpr double kFine = 1e3;  // steps are meant to be whole millimetres
  if (const double whole = std::round(step * kFine) / kFine; std::abs(step - whole) * n < quantum) step = whole;
  first = d.front() + sum / n - middle * step;
  constexpr double kRounded = 0.8;  // rounding up or down, and that of the first one
  for (std::size_t i = 0; i < d.size(); ++i)
    if (std::abs(d[i] - first - static_cast<double>(i) * step) > kRounded * quantum) return 0.0;
  return step;
}

/// The decimal place in which the distances are written [m].
double written_to(const std::vector<double>& d) {
  constexpr double kDigits = 1e-6;
  for (double quantum = 1.0; quantum > 1e-4; quantum *= 0.1)
    if (ranges::all_of(d, [&](double x) { return std::abs(x / quantum - std::round(x / quantum)) < kDigits; }))
      return quantum;
  return 0.0;
}

}  // namespace

void RecordedRows::fail(std::size_t row, const std::string& message, const std::string& advice) const {
  throw Error(ErrorKind::input_data, message, {file, row < lines.size() ? lines[row] : 0, 1}, advice);
}

void put_in_order(RecordedRows& rows, double sampling, std::vector<std::string>& notes) {
  fill_distances(rows, notes);
  std::vector<double>& d = rows.distance;
  if (d.size() < 2) return;
  std::vector<double> by = differences(d);
  const auto falling = ranges::count_if(by, [](double x) { return x < 0.0; }),
             rising = ranges::count_if(by, [](double x) { return x > 0.0; });
  constexpr std::ptrdiff_t kMore = 10;
  if (falling > 1 && (falling > kMore * rising || (falling > rising && d.back() < d.front()))) {
    ranges::reverse(d);
    ranges::reverse(rows.lines);
    for (std::vector<double>& signal : rows.signals) ranges::reverse(signal);
    by = differences(d);
    notes.push_back(fmt::format(
        "{}: the distances fall: the order of the rows is reversed; left, right and signs are taken as seen along "
        "rising distances (irregularities.seen_backwards = true: as seen along falling ones)",
        rows.file));
  }
  if (sampling > 0.0) {
    for (std::size_t i = 1; i < d.size(); ++i) d[i] = d.front() + sampling * static_cast<double>(i);
    return;
  }
  constexpr std::size_t kFew = 20;  // rows in which nothing is even but by chance
  constexpr double kAlmostAll = 0.8, kNear = 0.1, kMany = 0.2;
  const double share = 1.0 / static_cast<double>(by.size()),
               equal = share * static_cast<double>(ranges::count(by, 0.0)), step = median_of(by),
               regular = share * static_cast<double>(ranges::count_if(
                                     by, [&](double x) { return std::abs(x - step) <= kNear * std::abs(step); }));
  const bool enough = d.size() >= kFew;
  if (enough && step > 0.0 && regular >= kAlmostAll) return count_over_jumps(rows, step, notes);
  if (enough && ranges::all_of(by, [](double x) { return x >= 0.0; })) {
    std::vector<double> steps = by;
    std::erase(steps, 0.0);
    const double quantum = steps.empty() ? 0.0 : equal >= kMany ? *ranges::min_element(steps) : written_to(d);
    double first = 0.0;
    if (const double even = quantum > 0.0 ? even_step(d, quantum, first) : 0.0; even > 0.0) {
      for (std::size_t i = 0; i < d.size(); ++i) d[i] = first + even * static_cast<double>(i);
      notes.push_back(fmt::format("{}: the distances are written to {:.3g} m: rows are taken as evenly {:.6g} m apart",
                                  rows.file, quantum, even));
      return;
    }
  }
  for (std::size_t i = 0; i < by.size(); ++i)
    if (!(by[i] > 0.0))
      rows.fail(i + 1, fmt::format("the distance goes from {:.10g} to {:.10g} m, it must increase", d[i], d[i + 1]),
                std::string(kSamplingAdvice));
}

void fill_empty_cells(RecordedRows& rows, std::span<const std::string> names, std::vector<std::string>& notes) {
  const std::size_t n = rows.distance.size();
  const auto empty = [&](std::size_t i) {
    return ranges::any_of(rows.signals, [i](const std::vector<double>& s) { return std::isnan(s[i]); });
  };
  std::size_t from = 0, to = n;
  while (from < to && empty(from)) ++from;
  while (to > from && empty(to - 1)) --to;
  if (to - from < n) {
    notes.push_back(fmt::format("{}: rows without all values at the ends, left out: {}", rows.file, n - (to - from)));
    std::vector<bool> kept(n, false);
    std::fill(kept.begin() + static_cast<std::ptrdiff_t>(from), kept.begin() + static_cast<std::ptrdiff_t>(to), true);
    keep_rows(rows, kept);
  }
  const std::vector<double>& x = rows.distance;
  std::size_t filled = 0;
  double widest = 0.0;
  for (std::size_t s = 0; s < rows.signals.size(); ++s) {
    std::vector<double>& v = rows.signals[s];
    for (std::size_t i = 0; i < v.size(); ++i) {
      if (!std::isnan(v[i])) continue;
      const std::size_t a = i - 1;  // the first row has all values
      std::size_t b = i;
      while (std::isnan(v[b])) ++b;  // and so has the last one
      const double way = x[b] - x[a];
      if (way > kLongestBridge)
        rows.fail(
            i, fmt::format("{} has no value over {:.6g} m, from {:.10g} to {:.10g} m", names[s], way, x[a], x[b]),
            fmt::format("at most {:g} m are bridged: leave the column out, or cut the file there", kLongestBridge));
      const double first = a > 0 && !std::isnan(v[a - 1]) ? (v[a] - v[a - 1]) / (x[a] - x[a - 1]) : 0.0,
                   last = b + 1 < v.size() && !std::isnan(v[b + 1]) ? (v[b + 1] - v[b]) / (x[b + 1] - x[b]) : 0.0;
      for (std::size_t k = i; k < b; ++k) {
        const double t = (x[k] - x[a]) / way, u = 1.0 - t;
        v[k] = v[a] * u * u * (1.0 + 2.0 * t) + v[b] * t * t * (1.0 + 2.0 * u) + way * t * u * (u * first - t * last);
        ++filled;
      }
      widest = std::max(widest, way);
      i = b;
    }
  }
  if (filled > 0)
    notes.push_back(fmt::format("{}: cells without a value, bridged by smooth curves: {}, the longest way {:.4g} m",
                                rows.file, filled, widest));
}

}  // namespace treadmark::io
