// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/io/tables/text_of.hpp"

namespace treadmark::app {
namespace {

std::string range_shown(const Limit& limit) {
  if (limit.min && limit.max) return fmt::format("{:g} ... {:g}", *limit.min, *limit.max);
  return limit.min ? fmt::format(">= {:g}", *limit.min) : fmt::format("<= {:g}", *limit.max);
}

template <class Numbers>
std::string numbers_table(const MeasuredFile& file, const Numbers& numbers) {
  std::string text;
  std::vector<std::string> not_measured;
  for (const auto& row : number_rows(numbers)) {
    const auto limit = std::find_if(file.limits.begin(), file.limits.end(),
                                    [&](const LimitResult& l) { return l.limit.key == row.key; });
    if (!row.known(numbers)) {
      not_measured.push_back(fmt::format("  {}: {}{}\n", row.label, row.access.reason(numbers),
                                         limit == file.limits.end() ? "" : " (a limit asks for it)"));
      continue;
    }
    text += fmt::format("  {:<34}{:>10} {:<4}", row.label, io::bare_text(numbers, row), row.unit.name);
    const double uncertainty = row.uncertainty_in_file(numbers);
    text += std::isnan(uncertainty) ? std::string(12, ' ') : fmt::format(" +- {:<8.2g}", uncertainty);
    if (limit != file.limits.end())
      text += fmt::format(" {:<14}{}{}", range_shown(limit->limit), word_of(limit->verdict), how_sure(*limit));
    while (text.back() == ' ') text.pop_back();
    text += '\n';
  }
  if (!not_measured.empty()) {
    text += "not measured\n";
    for (const std::string& line : not_measured) text += line;
  }
  return text;
}

}  // namespace

std::string measure_text(const MeasuredFile& file, const MeasureRequest& request) {
  std::string text =
      fmt::format("{} ({}{})\n", file.file, file.kind, request.nominal.empty() ? "" : ", against " + request.nominal);
  text += std::visit([&](const auto& numbers) { return numbers_table(file, numbers); }, file.numbers);
  if (const auto* wheel = std::get_if<WheelNumbers>(&file.numbers)) {
    if (!wheel->reprofiled_to.empty()) text += fmt::format("mildest re-profiling: to {}\n", wheel->reprofiled_to);
    if (!wheel->back_seen) text += "the flange back is not in the section: y = 0 of the file is the tape line\n";
  } else {
    text +=
        fmt::format("aligned with the nominal section: {}\n", name_of(std::get<RailNumbers>(file.numbers).alignment));
  }
  if (file.revolution) {
    for (const measures::RoundFlat& f : file.revolution->flats)
      text += fmt::format("flat at {:.2f} degrees: {:.1f} mm long, {:.3f} mm deep (a chord of this depth: {:.1f} mm)\n",
                          f.theta * 57.29577951308232, 1e3 * f.length.value, 1e3 * f.depth.value, 1e3 * f.chord_length);
    std::vector<measures::RoundOrder> orders = file.revolution->orders;
    std::sort(orders.begin(), orders.end(), [](const auto& a, const auto& b) { return a.amplitude > b.amplitude; });
    constexpr std::size_t kShown = 5;
    for (std::size_t i = 0; i < std::min(kShown, orders.size()); ++i)
      text += fmt::format("order {:>2}: {:.4f} mm, {:.1f} dB re 1 um, wavelength {:.0f} mm\n", orders[i].order,
                          1e3 * orders[i].amplitude, orders[i].level, 1e3 * orders[i].wavelength);
  }
  if (file.roughness) {
    text += fmt::format("roughness over {:.2f} m in {} segments\n{:>12}{:>12}{:>12}\n", file.roughness->length,
                        file.roughness->segments, "band mm", "dB", "limit dB");
    for (const measures::RoughnessBand& band : file.roughness->bands)
      if (!std::isnan(band.level))
        text += fmt::format("{:>12g}{:>12.1f}{:>12}{}{}\n", 1e3 * band.wavelength, band.level,
                            std::isnan(band.limit) ? "-" : fmt::format("{:.1f}", band.limit),
                            band.level > band.limit ? "  over" : "",
                            band.level < band.floor + 3.0 ? "  (noise of the scan)" : "");
  }
  for (const auto& [name, value] : file.said) text += fmt::format("the file says: {}: {}\n", name, value);
  return text;
}

}  // namespace treadmark::app
