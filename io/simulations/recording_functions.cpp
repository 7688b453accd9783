// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/recording_functions.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/line_scanner.hpp"

namespace treadmark::io::recording {

namespace {

/// How alike two functions change from row to row, -1 to 1; nothing where one of them hardly changes.
std::optional<double> likeness(const std::vector<double>& a, const std::vector<double>& b) {
  double aa = 0.0, bb = 0.0, ab = 0.0;
  for (std::size_t i = 1; i < a.size(); ++i) {
    const double da = a[i] - a[i - 1], db = b[i] - b[i - 1];
    aa += da * da;
    bb += db * db;
    ab += da * db;
  }
  constexpr double kResolution = 1e-5;  // of recordings [m]
  const double least = kResolution * kResolution * static_cast<double>(a.size());
  if (aa < least || bb < least) return std::nullopt;
  return ab / std::sqrt(aa * bb);
}

/// Puts together what a recording holds of a function.
class Functions {
 public:
  Functions(const RecordedRows& rows, std::span<const Column> columns, std::vector<std::string>& notes)
      : rows_(rows), signals_(columns), notes_(notes), name_(rows.file) {}

  IrregularityTable functions(bool seen_backwards) {
    IrregularityTable table;
    table.distance = rows_.distance;
    std::vector<double> cross = signal(Recorded::cross_level, 0);
    if (cross.empty()) cross = signal(Recorded::cant, 0);
    constexpr double kCanted = 0.03;  // more is the cant of a curve
    if (!cross.empty())
      if (const double most = std::abs(*ranges::max_element(cross, {}, [](double v) { return std::abs(v); }));
          most > kCanted)
        notes_.push_back(
            fmt::format("{}: the cross level reaches {:.4g} mm: it seems to hold the cant of curves, which "
                        "[layout] must not have again",
                        name_, most * kMilli));
    const std::optional<double> level = join(Recorded::level, std::move(cross), table),
                                sides = join(Recorded::alignment, signal(Recorded::gauge, 0), table);
    const bool exchanged = level && sides && *level < 0.0 && *sides < 0.0;
    tell_agreement(0, level, exchanged);
    tell_agreement(2, sides, exchanged);
    if (seen_backwards)
      for (const std::size_t turned : {1u, 2u})
        for (double& value : table.values[turned]) value = -value;
    return table;
  }

 private:
  /// The column of a quantity, bands of wavelengths added; empty: there is none.
  std::vector<double> signal(Recorded what, int rail) {
    std::vector<double> sum;
    std::string bands;
    int count = 0;
    for (std::size_t s = 0; s < signals_.size(); ++s) {
      if (signals_[s].meaning.what != what || signals_[s].meaning.rail != rail) continue;
      if (count++ == 0)
        sum = rows_.signals[s];
      else
        ranges::transform(sum, rows_.signals[s], sum.begin(), std::plus<>());
      bands += (bands.empty() ? "" : " + ") + profiles::printable(signals_[s].name);
    }
    if (count > 1)
      notes_.push_back(fmt::format("{}: {} are bands of wavelengths that follow each other: added", name_, bands));
    return sum;
  }

  /// Function of the track and difference of the rails, from what is there. Returns how the difference agrees.
  std::optional<double> join(Recorded what, std::vector<double> difference, IrregularityTable& table) {
    const std::size_t index = what == Recorded::level ? 0 : 2;
    const std::vector<double> track = signal(what, 0), left = signal(what, -1), right = signal(what, 1);
    table.values[index] = track;
    table.values[index + 1] = std::move(difference);
    if (left.empty() || right.empty()) return std::nullopt;
    std::vector<double> mean(left.size()), apart(left.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
      mean[i] = 0.5 * (left[i] + right[i]);
      apart[i] = right[i] - left[i];
    }
    constexpr double kAlike = 0.9;
    if (track.empty())
      table.values[index] = mean;
    else if (const auto like = likeness(track, mean); like && *like < kAlike)
      notes_.push_back(
          fmt::format("{}: warning: {} of the track is not the mean of its rails (correlation {:.2f}); the "
                      "column of the track is used",
                      name_, kIrregularityNames[index], *like));
    if (!table.values[index + 1].empty()) return likeness(table.values[index + 1], apart);
    table.values[index + 1] = apart;
    return std::nullopt;
  }

  void tell_agreement(std::size_t index, std::optional<double> like, bool exchanged) {
    if (!like) return;
    constexpr double kAlike = 0.5;
    const std::string_view rails = kIrregularityNames[index], other = kIrregularityNames[index + 1];
    if (*like > kAlike)
      notes_.push_back(
          fmt::format("{}: {} stands beside {} of both rails and agrees with them (correlation {:.2f}): the "
                      "mean of the rails and the column of {} are used",
                      name_, other, rails, *like, other));
    else if (*like < -kAlike && exchanged)
      notes_.push_back(
          fmt::format("{}: left and right seem to be exchanged in {}: {} has the other sign (correlation "
                      "{:.2f}); the mean of the rails and the column of {} are used",
                      name_, rails, other, *like, other));
    else if (*like < -kAlike)
      notes_.push_back(fmt::format(
          "{}: warning: {} and {} have opposite signs (correlation {:.2f} of right less left rail with {}): "
          "compare a known "
          "place and give {}_factor = -1{}",
          name_, rails, other, *like, other, rails,
          index == 0 ? fmt::format(" or {}_factor = -1", other) : std::string()));
    else
      notes_.push_back(
          fmt::format("{}: warning: {} does not follow from {} of both rails (correlation {:.2f}); the mean of "
                      "the rails and the column of {} are used",
                      name_, other, rails, *like, other));
  }

  const RecordedRows& rows_;
  std::span<const Column> signals_;
  std::vector<std::string>& notes_;
  const std::string& name_;
};

}  // namespace

IrregularityTable functions_of(const RecordedRows& rows, std::span<const Column> columns, bool seen_backwards,
                               std::vector<std::string>& notes) {
  return Functions(rows, columns, notes).functions(seen_backwards);
}

}  // namespace treadmark::io::recording
