// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/app/measure/measure_files.hpp"

namespace treadmark::app {
namespace {

std::string shown(double value) {
  return std::isnan(value) ? "-" : fmt::format("{:.3f}", std::round(1e3 * value) / 1e3 + 0.0);  // no "-0.000"
}

/// What follows a key's last "_".
std::string unit_shown(std::string_view key) {
  const std::string_view unit = key.substr(key.rfind('_') + 1);
  return unit == "mm2" ? "mm2" : unit == "percent" ? "%" : unit == "db" ? "dB" : std::string(unit);
}

std::string range_shown(const Limit& limit) {
  if (limit.min && limit.max) return fmt::format("{:g} ... {:g}", *limit.min, *limit.max);
  return limit.min ? fmt::format(">= {:g}", *limit.min) : fmt::format("<= {:g}", *limit.max);
}

template <class Numbers>
std::string numbers_table(const MeasuredFile& file, const Numbers& numbers) {
  std::string text;
  std::vector<std::string> not_measured;
  for (const auto& row : number_rows(numbers)) {
    const measures::Measure& m = numbers.*row.at;
    const auto limit = std::find_if(file.limits.begin(), file.limits.end(),
                                    [&](const LimitResult& l) { return l.limit.key == row.key; });
    if (!m.known()) {
      not_measured.push_back(
          fmt::format("  {}: {}{}\n", row.label, m.reason, limit == file.limits.end() ? "" : " (a limit asks for it)"));
      continue;
    }
    text += fmt::format("  {:<34}{:>10} {:<4}", row.label, shown(m.value / row.unit), unit_shown(row.key));
    text += std::isnan(m.uncertainty) ? std::string(12, ' ') : fmt::format(" +- {:<8.2g}", m.uncertainty / row.unit);
    if (limit != file.limits.end())
      text += fmt::format(" {:<14}{}{}", range_shown(limit->limit), word_of(limit->verdict),
                          limit->sure ? "" : ", nearer than its uncertainty");
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
