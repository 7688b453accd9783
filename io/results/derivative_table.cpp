// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/derivative_table.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
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

std::string dominant_source(const CaseUncertainty& uncertainty, const CaseUncertainty::Number& number) {
  std::size_t most = number.shares.size();
  for (std::size_t k = 0; k < number.shares.size(); ++k)
    if (std::isfinite(number.shares[k]) && (most == number.shares.size() || number.shares[k] > number.shares[most]))
      most = k;
  return most == number.shares.size()
             ? std::string()
             : fmt::format("{:.0f} % {}", 100.0 * number.shares[most], uncertainty.sources[most].name);
}

std::string uncertainty_text(const CaseUncertainty& uncertainty) {
  constexpr int kName = 30;
  std::string out = "  uncertainty, one standard deviation, with its largest source\n";
  if (!uncertainty.message.empty()) return out + "    none: " + uncertainty.message + '\n';
  for (const CaseUncertainty::Number& n : uncertainty.numbers) {
    if (!(n.sigma > 0.0)) continue;
    // two digits of the deviation, and the value to the same place
    const int place = to_whole<int>(std::floor(std::log10(n.sigma))) - 1;
    const double unit = std::pow(10.0, place);
    const auto to_place = [&](double value) {
      return fmt::format("{:.{}f}", unit * std::round(value / unit), std::clamp(-place, 0, 12));
    };
    out += fmt::format("    {:<{}} = {} +- {}  {}{}\n", n.name, kName, to_place(n.value), to_place(n.sigma),
                       dominant_source(uncertainty, n), n.sampled ? " (sampled)" : "");
  }
  if (uncertainty.checked > 0) out += fmt::format("    by derivatives, held to {} solutions\n", uncertainty.checked);
  if (uncertainty.samples > 1)
    out += fmt::format("    sampled from {} solutions, deviations to +-{:.0f} %: {}\n", uncertainty.samples,
                       100.0 / std::sqrt(2.0 * (uncertainty.samples - 1)), uncertainty.why);
  if (uncertainty.others > 0)
    out += fmt::format("    {} of them have another number of patches, or none: numbers of patches are without them\n",
                       uncertainty.others);
  return out;
}

}  // namespace treadmark::io
