// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/derivative_table.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::io {

std::string derivatives_csv(const RunResult& run) {
  std::vector<std::string> keys;
  bool any = false;
  for (const CaseResult& c : run.cases) {
    if (!c.derivatives) continue;
    any = true;
    for (const CaseDerivatives::Parameter& p : c.derivatives->parameters)
      if (ranges::find(keys, p.key) == keys.end()) keys.push_back(p.key);
  }
  if (!any) return {};
  std::string out = "case,number";
  for (const std::string& key : keys) out += ',' + csv_cell(key);
  out += '\n';
  for (const CaseResult& c : run.cases) {
    if (!c.derivatives) continue;
    const auto& parameters = c.derivatives->parameters;
    for (const CaseDerivatives::Number& number : c.derivatives->numbers) {
      out += fmt::format("{},{}", c.number, csv_cell(number.name));
      for (const std::string& key : keys) {
        const auto here = ranges::find(parameters, key, &CaseDerivatives::Parameter::key);
        out += ',';
        if (here == parameters.end()) continue;
        const double by = number.by[static_cast<std::size_t>(here - parameters.begin())];
        if (std::isfinite(by)) out += csv_cell(by, treadmark::Digits::twelve);
      }
      out += '\n';
    }
  }
  return out;
}

std::string derivatives_text(const CaseDerivatives& derivatives) {
  constexpr std::size_t kWidest = 100;
  constexpr int kName = 30, kGap = 2, kNumber = 11;
  std::string out = "  derivatives by what is given, in the units of both names\n";
  if (!derivatives.message.empty()) return out + "    none: " + derivatives.message + '\n';
  // as many keys beside each other as fit
  const auto& parameters = derivatives.parameters;
  const auto has = [&](std::size_t k) { return parameters[k].left_out.empty(); };
  for (std::size_t first = 0; first < parameters.size();) {
    std::vector<std::size_t> shown;
    std::string heading = fmt::format("    {:<{}}", "", kName);
    for (; first < parameters.size(); ++first) {
      if (!has(first)) continue;
      const int width = std::max(kNumber, static_cast<int>(parameters[first].key.size())) + kGap;
      if (!shown.empty() && heading.size() + static_cast<std::size_t>(width) > kWidest) break;
      heading += fmt::format("{:>{}}", parameters[first].key, width);
      shown.push_back(first);
    }
    if (shown.empty()) break;
    out += heading + '\n';
    for (const CaseDerivatives::Number& number : derivatives.numbers) {
      out += fmt::format("    {:<{}}", number.name, kName);
      for (const std::size_t k : shown)
        out += fmt::format("{:>{}.5g}", number.by[k],
                           std::max(kNumber, static_cast<int>(parameters[k].key.size())) + kGap);
      out += '\n';
    }
  }
  for (const CaseDerivatives::Parameter& p : parameters) {
    if (!p.left_out.empty()) out += fmt::format("    left out: by {}: {}\n", p.key, p.left_out);
    if (p.left_out.empty() && p.of_surfaces) out += fmt::format("    by {}: from differences of surfaces\n", p.key);
  }
  if (!derivatives.without.empty())
    out += fmt::format("    without derivatives: {}\n", fmt::join(derivatives.without, ", "));
  return out;
}

}  // namespace treadmark::io
