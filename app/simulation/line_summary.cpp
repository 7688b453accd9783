// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/line_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/solvers/vehicle/curving.hpp"

namespace treadmark::app {
namespace {

using Lines = std::vector<std::string>;

constexpr double kPerDegree = 180.0 / kPi;

/// Longitudinal level and alignment of EN 13848-1 are judged in these ranges of wavelength [m].
struct WaveRange {
  const char* name;
  double shortest, longest;
};
constexpr WaveRange kRanges[] = {{"D1 (3 to 25 m)", 3.0, 25.0}, {"D2 (25 to 70 m)", 25.0, 70.0}};

std::string curve_text(const LayoutElement& e, double from, double base, const io::SimulationSettings& s) {
  vehicle::CurvingVehicle any;  // accelerations and deficiency are the same for all
  any.mass = any.centre_height = 1.0;
  any.base = base;
  const double side = e.curvature.from > 0.0 ? 1.0 : -1.0;
  const vehicle::Curving c =
      vehicle::curving(any, {s.speed, s.gravity, {e.curvature.from, 0.0, 0.0}, {e.cant.from, 0.0, 0.0}});
  return fmt::format(
      "layout: {:.6g} to {:.6g} m: radius {:.6g} m to the {}, cant {:.6g} mm, gauge {:.6g} mm; at {:.6g} m/s cant "
      "deficiency {:.4g} mm, lateral acceleration {:.3g} m/s2",
      from, from + e.length, 1.0 / std::abs(e.curvature.from), side > 0.0 ? "right" : "left",
      side * e.cant.from * kMilli, e.gauge.from * kMilli, s.speed, side * c.cant_deficiency * kMilli,
      side * c.lateral_acceleration);
}

void add_layout(const io::SimulationFile& file, Lines& lines) {
  const vehicle::TrackPath path(*file.layout);
  const vehicle::PathPoint end = path.at(path.length());
  lines.push_back(
      fmt::format("layout: {:.6g} m in {} element{}, ends at x = {:.3f} m, y = {:.3f} m, heading {:.3f} deg; "
                  "the vehicle starts at {:.6g} m and runs {:.6g} m",
                  path.length(), file.layout->elements.size(), file.layout->elements.size() == 1 ? "" : "s",
                  end.origin_L.x(), end.origin_L.y(), end.heading * kPerDegree, file.start, file.settings.distance));
  double from = 0.0;
  for (const LayoutElement& e : file.layout->elements) {
    if (e.curvature.from == e.curvature.to && e.curvature.from != 0.0)
      lines.push_back(curve_text(e, from, file.layout->cant_base, file.settings));
    from += e.length;
  }
  if (const double step = path.largest_curvature_step(); step > 0.0)
    lines.push_back(
        fmt::format("layout: the curvature steps by up to 1/({:.6g} m) where elements meet; simulations round "
                    "that over {:g} m",
                    1.0 / step, 2.0 * kRounding));
}

void add_table(const io::SimulationFile& file, const IrregularityTable& table, Lines& lines) {
  const double offset = file.irregularities->offset;
  lines.push_back(fmt::format("irregularities: {}: {} places from {:.6g} to {:.6g} m",
                              file.irregularity_file ? file.irregularity_file->path.filename().string() : "a table",
                              table.distance.size(), table.distance.front() + offset, table.distance.back() + offset));
  for (std::size_t f = 0; f < table.values.size(); ++f) {
    if (table.values[f].empty()) continue;
    const auto [low, high] = std::minmax_element(table.values[f].begin(), table.values[f].end());
    const double factor = file.irregularities->factor[f] * kMilli;
    lines.push_back(fmt::format("irregularities: {} from {:.4g} to {:.4g} mm", kIrregularityNames[f],
                                std::min(*low * factor, *high * factor), std::max(*low * factor, *high * factor)));
  }
}

void add_spectra(const IrregularitySpec& spec, Lines& lines) {
  const SpectralIrregularities& s = spec.spectral;
  lines.push_back(fmt::format("irregularities: made from spectra with seed {}, wavelengths of {:.6g} to {:.6g} m",
                              s.seed, s.shortest, s.longest));
  for (std::size_t f = 0; f < s.spectra.size(); ++f) {
    if (!s.spectra[f]) continue;
    std::string text;
    for (const WaveRange& range : kRanges) {
      const double shortest = std::max(range.shortest, s.shortest), longest = std::min(range.longest, s.longest);
      if (shortest < longest)
        text += fmt::format(", {:.3g} mm in {}",
                            std::abs(spec.factor[f]) * std::sqrt(variance(*s.spectra[f], shortest, longest)) * kMilli,
                            range.name);
    }
    const double whole = std::abs(spec.factor[f]) * std::sqrt(variance(*s.spectra[f], s.shortest, s.longest)) * kMilli;
    lines.push_back(
        fmt::format("irregularities: {} with a standard deviation of {:.3g} mm{}", kIrregularityNames[f], whole, text));
  }
}

}  // namespace

std::vector<std::string> line_summary(const io::SimulationFile& file) {
  Lines lines;
  if (file.layout) add_layout(file, lines);
  if (file.irregularities) {
    const IrregularitySpec& spec = *file.irregularities;
    if (spec.table)
      add_table(file, *spec.table, lines);
    else
      add_spectra(spec, lines);
    lines.push_back(fmt::format("irregularities: they grow from {:.6g} m over {:.6g} m", spec.begin, spec.wind_up));
  }
  return lines;
}

bool has_line(const io::SimulationFile& file) {
  return file.layout || file.irregularities || !file.torques.empty() || !file.forces.empty() ||
         !file.spring_motions.empty() || !file.rail_shifts.empty() || file.settings.profile.time.size() > 1;
}

std::shared_ptr<const vehicle::LineEffects> build_line(const io::SimulationFile& file, const vehicle::Multibody& system,
                                                       bool irregularities) {
  if (!has_line(file)) return nullptr;
  vehicle::LineSetup setup;
  setup.start = file.start;
  setup.gauge_at_rest = file.rail_gauge;
  setup.gravity = file.settings.gravity;
  setup.speed = file.settings.profile;
  setup.free_run = file.free_run;
  setup.torques = file.torques;
  setup.forces = file.forces;
  setup.spring_motions = file.spring_motions;
  setup.rail_shifts = file.rail_shifts;
  if (file.layout) {
    setup.path = std::make_shared<const vehicle::TrackPath>(rounded(*file.layout, kRounding));
    setup.base = file.layout->cant_base;
  }
  if (file.irregularities && irregularities)
    setup.irregularities = std::make_shared<const vehicle::Irregularities>(
        *file.irregularities,
        file.start + file.settings.distance + io::wheelset_places(file.vehicle).to + 2.0 * kRounding);
  return std::make_shared<const vehicle::LineEffects>(system, std::move(setup));
}

}  // namespace treadmark::app
