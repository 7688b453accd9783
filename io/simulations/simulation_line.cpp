// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/simulations/read_irregularities.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::io {

namespace {

/// What an element of constant curvature has throughout.
struct Constant {
  double curvature = 0.0, cant = 0.0, gauge = 0.0;
};

/// Refuses keys that a kind of element has not.
void refuse_keys_of(const TableReader& table, std::initializer_list<std::string_view> keys, const std::string& kind) {
  for (const std::string_view key : keys)
    if (const CaseValue* value = table.find(key))
      throw Error(ErrorKind::configuration, fmt::format("{} has no place in a {}", table.path_of(key), kind),
                  value->where, kind == "transition" ? "it goes from the element before to the one behind" : "");
}

Constant read_constant(const TableReader& table, const std::string& kind, double gauge) {
  refuse_keys_of(table, {"shape"}, kind);
  Constant constant{0.0, table.number_or("cant_mm", 0.0), table.number_or("gauge_mm", gauge)};
  if (kind == "straight") {
    refuse_keys_of(table, {"radius_m"}, kind);
    return constant;
  }
  const CaseValue& value = table.need("radius_m", "positive to the right, negative to the left");
  const double radius = table.number("radius_m");
  if (!(std::abs(radius) >= kTightestRadius))
    throw Error(
        ErrorKind::configuration,
        fmt::format("{} = {:.6g}: a radius of less than {:g} m", table.path_of("radius_m"), radius, kTightestRadius),
        value.where, "positive to the right, negative to the left");
  constant.curvature = 1.0 / radius;
  if (radius < 0.0) constant.cant = -constant.cant;
  return constant;
}

/// Transitions get their ends from their neighbours, which are read first.
void read_elements(const TableReader& layout, double gauge, TrackLayout& out) {
  std::vector<std::optional<Constant>> constants;
  for (const CaseValue* one : layout.tables("elements")) {
    const TableReader table(one->table(), one->where, layout.path_of("elements"), element_keys());
    const std::string kind = table.text("kind");
    LayoutElement element;
    element.length = table.number("length_m");
    element.where = one->where;
    constants.emplace_back();
    if (kind == "transition") {
      refuse_keys_of(table, {"radius_m", "cant_mm", "gauge_mm"}, kind);
      if (constants.size() > 1 && !constants[constants.size() - 2])
        table.fail("two transitions follow each other", "put a straight or a curve between them");
      if (table.text_or("shape", "clothoid") == "bloss") element.shape = TransitionShape::bloss;
    } else {
      constants.back() = read_constant(table, kind, gauge);
    }
    out.elements.push_back(std::move(element));
  }
  const Constant straight{0.0, 0.0, gauge};
  for (std::size_t i = 0; i < constants.size(); ++i) {
    const Constant from = constants[i] ? *constants[i]
                          : i > 0      ? *constants[i - 1]
                                       : straight,
                   to = constants[i]               ? *constants[i]
                        : i + 1 < constants.size() ? *constants[i + 1]
                                                   : straight;
    LayoutElement& e = out.elements[i];
    e.curvature = {from.curvature, to.curvature};
    e.cant = {from.cant, to.cant};
    e.gauge = {from.gauge, to.gauge};
  }
}

/// Whether all wheelsets stand on one straight or circle at the start.
bool begins_steadily(const SimulationFile& file) {
  const FromTo wheelsets = wheelset_places(file.vehicle);
  const double rear = file.start + wheelsets.from, front = file.start + wheelsets.to;
  double from = 0.0;
  for (const LayoutElement& e : file.layout->elements) {
    const double to = from + e.length;
    const bool constant = e.curvature.from == e.curvature.to && e.cant.from == e.cant.to;
    if (constant && front <= to && (rear >= from || from == 0.0)) return true;
    from = to;
  }
  return false;
}

/// Furthest place of a wheelset on the line [m].
double end_of_run(const SimulationFile& file) {
  return file.start + file.settings.distance + wheelset_places(file.vehicle).to;
}

IrregularitySpectrum read_spectrum(const TableReader& table) {
  using Form = IrregularitySpectrum::Form;
  IrregularitySpectrum s;
  s.where = table.where();
  const std::string form = table.text("form");
  s.form = form == "table" ? Form::table : form == "two_poles" ? Form::two_poles : Form::three_poles;
  if (s.form == Form::table) {
    refuse_keys_of(table, {"amplitude_m_rad", "omega_c_rad_m", "omega_r_rad_m", "omega_s_rad_m"}, "table");
    table.need("wavenumber_rad_m");
    table.need("density_m3_rad");
    s.wavenumber = table.numbers("wavenumber_rad_m");
    s.density = table.numbers("density_m3_rad");
  } else {
    refuse_keys_of(table, {"wavenumber_rad_m", "density_m3_rad"}, "formula");
    if (s.form == Form::two_poles) refuse_keys_of(table, {"omega_s_rad_m"}, "formula with two poles");
    s.amplitude = table.number("amplitude_m_rad");
    s.omega_c = table.number("omega_c_rad_m");
    s.omega_r = table.number_or("omega_r_rad_m", 0.0);
    s.omega_s = table.number_or("omega_s_rad_m", 0.0);
  }
  s.two_sided = table.find("sides") != nullptr && table.integer("sides") == 2;
  return s;
}

void read_spectra(const TableReader& table, SpectralIrregularities& out) {
  out.shortest = table.number_or("shortest_wavelength_m", out.shortest);
  out.longest = table.number_or("longest_wavelength_m", out.longest);
  if (const CaseValue* seed = table.checked_if("seed")) out.seed = static_cast<std::uint64_t>(seed->integer());
  if (table.find("sinusoids_per_third_octave") != nullptr)
    out.sinusoids_per_third_octave = table.integer("sinusoids_per_third_octave");
  for (const CaseValue* one : table.tables("spectra")) {
    const TableReader part(one->table(), one->where, table.path_of("spectra"), spectrum_keys());
    const std::string function = part.text("function");
    const auto index = static_cast<std::size_t>(
        std::find(kIrregularityNames.begin(), kIrregularityNames.end(), function) - kIrregularityNames.begin());
    if (out.spectra.at(index)) part.fail(fmt::format("there are two spectra of the {}", function));
    out.spectra[index] = read_spectrum(part);
  }
}

void read_measured(const TableReader& table, const std::filesystem::path& folder, SimulationFile& out) {
  for (const std::string_view key :
       {"seed", "shortest_wavelength_m", "longest_wavelength_m", "sinusoids_per_third_octave"})
    if (table.find(key) != nullptr) table.exclude("file", key);
  const FileText text = named_text(table, "file", folder);
  IrregularitySpec& spec = *out.irregularities;
  RecordingSettings recording;
  recording.nominal_gauge = table.number_or("nominal_gauge_mm", 0.0);
  recording.track_gauge = out.contact.track.gauge_based ? out.contact.track.gauge_width : out.rail_gauge;
  recording.sampling = table.number_or("sampling_m", 0.0);
  recording.as_stated = table.flag_or("as_stated", false);
  recording.seen_backwards = table.flag_or("seen_backwards", false);
  if (recording.as_stated && recording.sampling > 0.0) table.exclude("as_stated", "sampling_m");
  spec.table = parse_irregularity_text(text.text, text.file.path.string(), &out.notes, recording);
  spec.offset = table.number_or("offset_m", 0.0);
  out.irregularity_file = text.file;
  const double first = spec.table->distance.front() + spec.offset, last = spec.table->distance.back() + spec.offset,
               end = end_of_run(out);
  if (first > end)
    throw Error(ErrorKind::configuration,
                fmt::format("the irregularities of {} begin at {:.10g} m, behind the end of the run at {:.6g} m",
                            text.file.path.filename().string(), first, end),
                table.need("file").where,
                fmt::format("move them by offset_m, to the start of the run by {:.10g}",
                            out.start - spec.table->distance.front()));
  if (last < end)
    throw Error(ErrorKind::configuration,
                fmt::format("the irregularities of {} end at {:.6g} m, the run at {:.6g} m",
                            text.file.path.filename().string(), last, end),
                table.need("file").where, "shorten the run, or move them by offset_m");
}

}  // namespace

FromTo wheelset_places(const VehicleModel& vehicle) {
  FromTo places{kInfinity, -kInfinity};
  for (const WheelsetSpec& wheelset : vehicle.wheelsets)
    for (const BodySpec& body : vehicle.bodies) {
      if (body.name != wheelset.body) continue;
      places.from = std::min(places.from, body.position.x());
      places.to = std::max(places.to, body.position.x());
    }
  return places;
}

void read_layout(const TableReader& layout, SimulationFile& out) {
  TrackLayout line;
  line.where = layout.where();
  line.cant_base = layout.number_or("cant_base_mm", line.cant_base);
  if (layout.text_or("cant_about", "centre") == "low_rail") line.cant_axis = CantAxis::low_rail;
  constexpr double kStandardGauge = 1.435;
  const Track& track = out.contact.track;
  const double gauge = layout.number_or("gauge_mm", track.gauge_based ? track.gauge_width : kStandardGauge);
  out.rail_gauge = track.gauge_based ? track.gauge_width : gauge;
  read_elements(layout, gauge, line);
  check(line);
  out.start = layout.number_or("start_m", 0.0);
  out.layout = std::move(line);
  if (const double end = end_of_run(out), length = out.layout->length(); end > length)
    layout.fail(fmt::format("the line is {:.6g} m long, the run ends at {:.6g} m", length, end),
                "shorten the run (simulation.distance_m), or put a longer element at the end of the line");
  if (!begins_steadily(out))
    out.notes.emplace_back(
        "layout: the vehicle starts where the line changes; it begins in the balance of forces that it "
        "would have if it stayed there");
  const LayoutElement& first = out.layout->elements.front();
  if (out.start + wheelset_places(out.vehicle).from < 0.0 && first.curvature.from != first.curvature.to)
    layout.fail("the vehicle stands on the beginning of the line, which is a transition",
                "put a straight before it, or give layout.start_m");
}

void read_irregularities(const TableReader& table, const std::filesystem::path& folder, SimulationFile& out) {
  IrregularitySpec& spec = out.irregularities.emplace();
  spec.where = table.where();
  table.exclude("file", "spectra");
  spec.wind_up = table.number_or("wind_up_m", spec.wind_up);
  for (std::size_t i = 0; i < spec.factor.size(); ++i)
    spec.factor[i] = table.number_or(fmt::format("{}_factor", kIrregularityNames[i]), 1.0);
  spec.begin = out.start + wheelset_places(out.vehicle).to;
  if (table.find("file") != nullptr) {
    read_measured(table, folder, out);
    spec.begin = std::max(spec.begin, spec.table->distance.front() + spec.offset);
  } else {
    refuse_keys_of(table, {"offset_m", "nominal_gauge_mm", "sampling_m", "as_stated", "seen_backwards"}, "spectrum");
    read_spectra(table, spec.spectral);
    if (table.tables("spectra").empty())
      table.fail("there are neither measured irregularities nor spectra",
                 "give irregularities.file or "
                 "[[irregularities.spectra]]");
  }
  spec.begin = table.number_or("begin_m", spec.begin);
  check(spec);
}

}  // namespace treadmark::io
