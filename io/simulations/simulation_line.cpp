// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/simulations/line_keys.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"

namespace treadmark::io {

namespace {

constexpr double kStandardGauge = 1.435;  // [m]

/// What an element of constant curvature has throughout.
struct Constant {
  double curvature = 0.0, cant = 0.0, gauge = 0.0;
};

/// Refuses keys that a kind of element has not.
template <class Root, class... Members>
void refuse_members(const TableOf<Root>& table, std::string_view kind, Members... members) {
  const auto refuse_one = [&](auto member) {
    if (table.find(member) != nullptr)
      table.refuse(member, fmt::format("{} has no place in a {}", table.path_of(member), kind),
                   kind == "transition" ? "it goes from the element before to the one behind" : "");
  };
  (refuse_one(members), ...);
}

Constant constant_of(const TableOf<ElementInput>& table, const ElementInput& element, double gauge) {
  using E = ElementInput;
  const std::string_view kind = kElementKinds.at(static_cast<std::size_t>(element.kind));
  refuse_members(table, kind, &E::shape);
  Constant constant{0.0, element.cant, element.gauge.value_or(gauge)};
  if (element.kind == E::Kind::straight) {
    refuse_members(table, kind, &E::radius);
    return constant;
  }
  table.need(&E::radius);
  const double radius = element.radius;
  if (!(std::abs(radius) >= kTightestRadius))
    table.refuse(
        &E::radius,
        fmt::format("{} = {:.6g}: a radius of less than {:g} m", table.path_of(&E::radius), radius, kTightestRadius),
        "positive to the right, negative to the left");
  constant.curvature = 1.0 / radius;
  if (radius < 0.0) constant.cant = -constant.cant;
  return constant;
}

/// Transitions get their ends from their neighbours, which are read first.
void read_elements(const TableOf<LayoutInput>& layout, double gauge, TrackLayout& out) {
  using E = ElementInput;
  std::vector<std::optional<Constant>> constants;
  const auto list = [](const LayoutInput& l) -> auto& { return l.line.elements; };
  for (const CaseValue* one : layout.tables(list)) {
    const TableOf table(*one, layout.path_of(list), element_keys());
    const E given = table.read();
    LayoutElement element;
    element.length = given.length;
    element.where = one->where;
    constants.emplace_back();
    if (given.kind == E::Kind::transition) {
      refuse_members(table, "transition", &E::radius, &E::cant, &E::gauge);
      if (constants.size() > 1 && !constants[constants.size() - 2])
        table.fail("two transitions follow each other", "put a straight or a curve between them");
      element.shape = given.shape;
    } else {
      constants.back() = constant_of(table, given, gauge);
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

IrregularitySpectrum checked_spectrum(const TableOf<SpectrumInput>& table, IrregularitySpectrum s) {
  using S = IrregularitySpectrum;
  const auto wavenumber = of_spectrum(&S::wavenumber), density = of_spectrum(&S::density);
  const auto amplitude = of_spectrum(&S::amplitude), omega_c = of_spectrum(&S::omega_c),
             omega_r = of_spectrum(&S::omega_r), omega_s = of_spectrum(&S::omega_s);
  s.where = table.where();
  if (s.form == S::Form::table) {
    refuse_members(table, "table", amplitude, omega_c, omega_r, omega_s);
    table.need(wavenumber);
    table.need(density);
  } else {
    refuse_members(table, "formula", wavenumber, density);
    if (s.form == S::Form::two_poles) refuse_members(table, "formula with two poles", omega_s);
    table.need(amplitude);
    table.need(omega_c);
  }
  return s;
}

/// Members of [irregularities].
const auto kMeasuredFile = [](auto& i) -> auto& { return i.spec.table; };
const auto kOffset = [](auto& i) -> auto& { return i.spec.offset; };
const auto kSpectra = [](auto& i) -> auto& { return i.spec.spectral.spectra; };
template <class Value>
auto of_recording(Value RecordingSettings::*member) {
  return [member](auto& i) -> auto& { return i.recording.*member; };
}
template <class Value>
auto of_spectral(Value SpectralIrregularities::*member) {
  return [member](auto& i) -> auto& { return i.spec.spectral.*member; };
}

void read_spectra(const TableOf<IrregularityInput>& table, SpectralIrregularities& out) {
  for (const CaseValue* one : table.tables(kSpectra)) {
    const TableOf part(*one, table.path_of(kSpectra), spectrum_keys());
    const SpectrumInput given = part.read();
    const auto index = static_cast<std::size_t>(given.function);
    if (out.spectra.at(index)) part.fail(fmt::format("there are two spectra of the {}", kIrregularityNames[index]));
    out.spectra[index] = checked_spectrum(part, given.spectrum);
  }
}

void read_measured(const TableOf<IrregularityInput>& table, const std::filesystem::path& folder,
                   RecordingSettings recording, SimulationFile& out) {
  using S = SpectralIrregularities;
  const auto exclude = [&](auto... members) { (table.exclude(kMeasuredFile, members), ...); };
  exclude(of_spectral(&S::seed), of_spectral(&S::shortest), of_spectral(&S::longest),
          of_spectral(&S::sinusoids_per_third_octave));
  const FileText text = named_text(table, table.key(kMeasuredFile), folder);
  IrregularitySpec& spec = *out.irregularities;
  recording.track_gauge = out.contact.track.gauge_based ? out.contact.track.gauge_width : out.rail_gauge;
  if (recording.as_stated && recording.sampling > 0.0)
    table.exclude(of_recording(&RecordingSettings::as_stated), of_recording(&RecordingSettings::sampling));
  spec.table = parse_irregularity_text(text.text, text.file.path.string(), &out.notes, recording);
  out.irregularity_file = text.file;
  const double first = spec.table->distance.front() + spec.offset, last = spec.table->distance.back() + spec.offset,
               end = end_of_run(out);
  if (first > end)
    table.refuse(kMeasuredFile,
                 fmt::format("the irregularities of {} begin at {:.10g} m, behind the end of the run at {:.6g} m",
                             text.file.path.filename().string(), first, end),
                 fmt::format("move them by offset_m, to the start of the run by {:.10g}",
                             out.start - spec.table->distance.front()));
  if (last < end)
    table.refuse(kMeasuredFile,
                 fmt::format("the irregularities of {} end at {:.6g} m, the run at {:.6g} m",
                             text.file.path.filename().string(), last, end),
                 "shorten the run, or move them by offset_m");
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

TrackLayout read_track_layout(const std::filesystem::path& file) {
  const CaseTable document = parse_toml(read_text(file), file.string());
  const auto entry =
      std::find_if(document.begin(), document.end(), [](const CaseEntry& e) { return e.key == "layout"; });
  if (entry == document.end() || !entry->value.is_table())
    throw Error(ErrorKind::configuration, "[layout] is missing, this is no line of a track",
                entry == document.end() ? SourcePosition{file.string(), 1, 1} : entry->value.where,
                "see docs/layout.md");
  const TableOf<LayoutInput> layout(entry->value, "layout", layout_keys());
  LayoutInput given = layout.read();
  given.line.where = layout.where();
  read_elements(layout, given.gauge.value_or(kStandardGauge), given.line);
  check(given.line);
  return std::move(given.line);
}

void read_layout(const TableOf<LayoutInput>& layout, SimulationFile& out) {
  LayoutInput given = layout.read();
  TrackLayout& line = given.line;
  line.where = layout.where();
  const Track& track = out.contact.track;
  const double gauge = given.gauge.value_or(track.gauge_based ? track.gauge_width : kStandardGauge);
  out.rail_gauge = track.gauge_based ? track.gauge_width : gauge;
  read_elements(layout, gauge, line);
  check(line);
  out.start = given.start;
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

void read_irregularities(const TableOf<IrregularityInput>& table, const std::filesystem::path& folder,
                         SimulationFile& out) {
  table.exclude(kMeasuredFile, kSpectra);
  IrregularityInput given = table.read();
  IrregularitySpec& spec = out.irregularities.emplace(std::move(given.spec));
  spec.where = table.where();
  spec.begin = out.start + wheelset_places(out.vehicle).to;
  if (table.find(kMeasuredFile) != nullptr) {
    read_measured(table, folder, given.recording, out);
    spec.begin = std::max(spec.begin, spec.table->distance.front() + spec.offset);
  } else {
    using R = RecordingSettings;
    refuse_members(table, "spectrum", kOffset, of_recording(&R::nominal_gauge), of_recording(&R::sampling),
                   of_recording(&R::as_stated), of_recording(&R::seen_backwards));
    read_spectra(table, spec.spectral);
    if (table.tables(kSpectra).empty())
      table.fail("there are neither measured irregularities nor spectra",
                 "give irregularities.file or "
                 "[[irregularities.spectra]]");
  }
  spec.begin = given.begin.value_or(spec.begin);
  check(spec);
}

}  // namespace treadmark::io
