// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/compare/result_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "treadmark/io/results/quantities.hpp"

namespace treadmark::app {

namespace {

/// How well a case knows a number, in the unit of its name; 0: it does not say; NaN: nobody knows.
double deviation_of(const io::CaseResult& result, const std::string& number) {
  if (!result.uncertainty) return 0.0;
  for (const io::CaseUncertainty::Number& one : result.uncertainty->numbers)
    if (one.name == number) return one.sigma;
  return 0.0;
}

/// Differences of one kind of item, case or patch, in all its quantities.
template <class T>
class Differences {
 public:
  explicit Differences(ResultDifference& result)
      : result_(result), rows_(io::quantities<T>()), entries_(rows_.size()) {}

  void add(const T& a, const T& b, const io::CaseResult& of_a, const io::CaseResult& of_b, int patch) {
    const int case_number = of_a.number;
    std::string_view meaning;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const io::Quantity<T>& row = rows_[k];
      if (!row.meaning.empty()) meaning = row.meaning;  // rows without one go on with that of the row above
      if (row.key.empty() || row.block == io::Block::timing || row.block == io::Block::refined) continue;
      const bool in_a = known(row, a), in_b = known(row, b);
      if (in_a != in_b)
        result_.unmatched.push_back(fmt::format("case {}{}: only one has {}", case_number,
                                                patch == 0 ? "" : fmt::format(", patch {}", patch), name(row)));
      if (!in_a || !in_b) continue;
      const double x = row.access.get(a), y = row.access.get(b);
      const io::Unit& unit = unit_of(row, a);
      entries_[k].push_back(
          {name(row), meaning, case_number, patch, unit.in_file(x), unit.in_file(y), 0.0, NAN, unit, x, y});
      if (!of_a.uncertainty && !of_b.uncertainty) continue;
      QuantityDifference& entry = entries_[k].back();
      const std::string number = (patch == 0 ? "" : fmt::format("patch_{}.", patch)) + io::name_of(row);
      const double sigma = std::hypot(deviation_of(of_a, number), deviation_of(of_b, number));
      if (sigma > 0.0) entry.sigmas = std::fabs(entry.a - entry.b) / sigma;
    }
  }

  void finish() {
    for (std::vector<QuantityDifference>& all : entries_) {
      constexpr double kLeastShare = 1e-3;
      double largest = 0.0;
      for (const QuantityDifference& e : all) largest = std::max({largest, std::fabs(e.a), std::fabs(e.b)});
      QuantityDifference* worst = nullptr;
      for (QuantityDifference& e : all) {
        const double scale = std::max({std::fabs(e.a), std::fabs(e.b), kLeastShare * largest});
        // Not a number in one of them only is the greatest difference there is.
        if (std::isnan(e.a) != std::isnan(e.b))
          e.relative = HUGE_VAL;
        else if (e.a != e.b && scale > 0.0)
          e.relative = std::fabs(e.a - e.b) / scale;
        if (worst == nullptr || e.relative > worst->relative) worst = &e;
      }
      if (worst != nullptr) result_.quantities.push_back(*worst);
    }
  }

 private:
  static bool known(const io::Quantity<T>& row, const T& item) {
    return io::has_block(item, row.block) && row.has(item);
  }
  static const io::Unit& unit_of(const io::Quantity<io::CaseResult>& row, const io::CaseResult&) { return row.unit; }
  static const io::Unit& unit_of(const io::Quantity<io::PatchResult>& row, const io::PatchResult& patch) {
    return row.unit_in(patch.shift);
  }
  static std::string name(const io::Quantity<T>& row) {
    return row.object.empty() ? std::string(row.key) : fmt::format("{}.{}", row.object, row.key);
  }

  ResultDifference& result_;
  std::span<const io::Quantity<T>> rows_;
  std::vector<std::vector<QuantityDifference>> entries_;
};

}  // namespace

ResultDifference compare_results(const io::RunResult& a, const io::RunResult& b) {
  ResultDifference result;
  std::map<int, const io::CaseResult*> others;
  for (const io::CaseResult& c : b.cases) others[c.number] = &c;
  Differences<io::CaseResult> cases(result);
  Differences<io::PatchResult> patches(result);
  for (const io::CaseResult& one : a.cases) {
    const auto found = others.find(one.number);
    if (found == others.end()) {
      result.unmatched.push_back(fmt::format("case {}: only the first result has it", one.number));
      continue;
    }
    const io::CaseResult& other = *found->second;
    others.erase(found);
    if (one.status != other.status) {
      result.unmatched.push_back(
          fmt::format("case {}: {} and {}", one.number, to_string(one.status), to_string(other.status)));
      continue;
    }
    cases.add(one, other, one, other, 0);
    if (one.patches.size() != other.patches.size())
      result.unmatched.push_back(
          fmt::format("case {}: {} and {} patches", one.number, one.patches.size(), other.patches.size()));
    for (std::size_t i = 0; i < std::min(one.patches.size(), other.patches.size()); ++i)
      patches.add(one.patches[i], other.patches[i], one, other, static_cast<int>(i) + 1);
  }
  for (const auto& [number, c] : others)
    result.unmatched.push_back(fmt::format("case {}: only the second result has it", number));
  cases.finish();
  patches.finish();
  std::stable_sort(result.quantities.begin(), result.quantities.end(),
                   [](const auto& x, const auto& y) { return x.relative > y.relative; });
  return result;
}

bool agree(const ResultDifference& difference, double tolerance) {
  return difference.unmatched.empty() &&
         std::all_of(difference.quantities.begin(), difference.quantities.end(),
                     [tolerance](const QuantityDifference& q) { return q.relative <= tolerance; });
}

}  // namespace treadmark::app
