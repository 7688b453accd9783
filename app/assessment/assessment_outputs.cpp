// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/assessment/assessment_outputs.hpp"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "treadmark/app/version.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/histories/channels.hpp"
#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/io/tables/csv_of.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/read_json.hpp"
#include "treadmark/report/pictures/chart.hpp"
#include "treadmark/report/pictures/histories/history_svg.hpp"

namespace treadmark {
namespace {

using A = measures::Assessed;
using access::of;
using access::word;
using unit::kOne;

constexpr FileUnit kOwn{""};  // that of the quantity

constexpr Column<A> kAssessed[] = {
    {"section", kOne, "", of<&A::section>(), "", kInTable, "section"},
    {"place", kOne, "", of<&A::place>(), "", kInTable, "place"},
    {"quantity", kOne, "", of<&A::quantity>(), "", kInTable, "quantity"},
    {"status", kOne, "", word(+[](const A& a) { return std::string(name_of(a.status)); }), "", kInTable, "status"},
    {"samples", kOne, "", of<&A::samples>(), "", kInTable, "samples"},
    {"min", kOwn, "", of<&A::least>(), "", kInTable, "min"},
    {"p0_15", kOwn, "", of<&A::low>(), "", kInTable, "0.15 %"},
    {"p50", kOwn, "", of<&A::middle>(), "", kInTable, "50 %"},
    {"p99_85", kOwn, "", of<&A::high>(), "", kInTable, "99.85 %"},
    {"max", kOwn, "", of<&A::most>(), "", kInTable, "max"},
    {"mean", kOwn, "", of<&A::mean>(), "", kInTable, "mean"},
    {"rms", kOwn, "", of<&A::rms>(), "", kInTable, "rms"},
    {"value", kOwn, "", of<&A::value>(), "that is compared with the limit", kInTable, "value"},
    {"limit", kOwn, "", of<&A::limit>(), "", kInTable, "limit"},
    {"share", kOne, "", {[](const A& a) { return a.share(); }}, "of the limit", kInTable, "share"}};

using E = measures::Estimate;

constexpr Column<E> kEstimates[] = {
    {"quantity", kOne, "", of<&E::quantity>(), "", kInTable, "quantity"},
    {"kind", kOne, "", word(+[](const E& e) { return std::string(kSectionKinds[static_cast<std::size_t>(e.kind)]); }),
     "", kInTable, "kind"},
    {"place", kOne, "", of<&E::place>(), "", kInTable, "place"},
    {"unit", kOne, "", word(+[](const E& e) { return std::string(measures::quantity_info(e.quantity).unit); }), "",
     kInTable, "unit"},
    {"sections", kOne, "", of<&E::sections>(), "", kInTable, "sections"},
    {"mean", kOwn, "", of<&E::mean>(), "", kInTable, "mean"},
    {"deviation", kOwn, "", of<&E::deviation>(), "standard deviation", kInTable, "deviation"},
    {"factor", kOne, "", of<&E::factor>(), "of the deviation", kInTable, "k"},
    {"largest", kOwn, "", of<&E::largest>(), "mean + k deviation", kInTable, "largest"},
    {"limit", kOwn, "", of<&E::limit>(), "", kInTable, "limit"},
    {"share", kOne, "", {[](const E& e) { return e.share(); }}, "of the limit", kInTable, "share"},
    {"slope_by_cant_deficiency", kOwn, "", of<&E::slope>(), "by m of cant deficiency", kInTable, "slope"},
    {"cant_deficiency_m", unit::kM, "", of<&E::reference>(), "at which the bound holds", kInTable, "cant deficiency"},
    {"bound", kOwn, "", of<&E::bound>(), "99 % of further sections lie below it", kInTable, "bound"}};

using L = RunningLimit;
constexpr std::string_view kAny = "any";

/// A condition that need not be there, by the words of its enumerators.
template <auto Member, const auto& Words>
constexpr Access<L> condition() {
  Access<L> access =
      word(+[](const L& l) { return std::string(l.*Member ? Words[static_cast<std::size_t>(*(l.*Member))] : kAny); });
  access.put_word = [](L& l, const std::string& given) {
    for (std::size_t i = 0; i < Words.size(); ++i)
      if (given == Words[i]) (l.*Member).emplace(static_cast<typename access::ValueOf<Member>::value_type>(i));
  };
  return access;
}

constexpr Column<L> kLimits[] = {
    {"quantity", kOne, "", of<&L::quantity>(), "", kInTable, "quantity"},
    {"vehicle", kOne, "", condition<&L::vehicle, kVehicleKinds>(), "", kInTable, "vehicle"},
    {"section", kOne, "", condition<&L::section, kSectionKinds>(), "", kInTable, "section"},
    {"from_radius_m", unit::kM, "", of<&L::from_radius>(), "", kInTable, "from R"},
    {"to_radius_m", unit::kM, "", of<&L::to_radius>(), "", kInTable, "to R"},
    {"above_speed_m_s", FileUnit{"m/s"}, "", of<&L::above_speed>(), "", kInTable, "above"},
    {"value", kOwn, "", of<&L::constant>(), "", kInTable, "value"},
    {"by_load", kOwn, "", of<&L::by_load>(), "times 2 Q0 in N", kInTable, "by load"},
    {"by_curvature", kOwn, "", of<&L::by_curvature>(), "over the radius in m", kInTable, "by curvature"}};

/// Those that stand behind unit and status in CSV.
bool is_number(const Column<A>& column) { return column.access.word == nullptr && !column.access.whole; }

}  // namespace

template <>
std::span<const Column<measures::Assessed>> columns() {
  return kAssessed;
}
template <>
std::span<const Column<measures::Estimate>> columns() {
  return kEstimates;
}
template <>
std::span<const Column<RunningLimit>> columns() {
  return kLimits;
}

namespace app {
namespace {

using io::Json;
using measures::Assessed;
using measures::AssessedStatus;

/// Forces in kN, wear in mm3/km.
std::pair<double, std::string> shown_value(double value, const std::string& unit) {
  constexpr double kKiloNewton = 1e-3;
  if (unit == "N") return {value * kKiloNewton, "kN"};
  if (unit == "m3/m") return {1e12 * value, "mm3/km"};
  return {value, unit == "1" ? "" : unit};
}

}  // namespace

std::string limits_text(const RunningLimits& limits) {
  return fmt::format("{}{}", limits.edition, limits.verified ? "" : ", not verified against its text");
}

const Assessed* worst_of(const AssessedRun& run, const std::string& section, const std::string& quantity) {
  const Assessed* worst = nullptr;
  const auto badness = [](const Assessed& a) { return std::isfinite(a.limit) ? a.share() : std::fabs(a.value); };
  for (const Assessed& one : run.quantities)
    if (one.section == section && one.quantity == quantity && one.status == AssessedStatus::ok &&
        (worst == nullptr || badness(one) > badness(*worst)))
      worst = &one;
  return worst;
}

std::string assessment_text(std::span<const AssessedRun> runs) {
  std::string text;
  for (const AssessedRun& run : runs) {
    const bool named = run.result->title == run.name;
    text += run.name + (named ? "" : ": " + run.result->title) + '\n';
    text += fmt::format("  limits: {}\n", limits_text(run.limits()));
    for (const AssessmentSection& section : run.request.sections) {
      text += fmt::format("  {}, {:.6g} to {:.6g} m, {}\n", section.name, section.from, section.to,
                          kSectionKinds[static_cast<std::size_t>(section.kind)]);
      for (const measures::QuantityInfo& info : measures::assessed_quantities()) {
        const Assessed* worst = worst_of(run, section.name, info.key);
        if (worst == nullptr) continue;
        const auto [value, unit] = shown_value(worst->value, info.unit);
        text += fmt::format("    {:<14} {:>10.4g} {:<6} {:<16} {}\n", info.key, value, unit, worst->place,
                            std::isfinite(worst->limit)
                                ? fmt::format("limit {:.4g}, {:.0f} %{}", shown_value(worst->limit, info.unit).first,
                                              100.0 * worst->share(), worst->share() > 1.0 ? ", exceeded" : "")
                                : std::string(info.value));
      }
    }
    for (const std::string& doubt : run.doubts) text += fmt::format("  warning: {}\n", doubt);
  }
  // Of each quantity with a limit the place that comes nearest to it.
  std::map<std::pair<std::string, SectionKind>, measures::Estimate> nearest;
  for (const measures::Estimate& e : estimates_of(runs))
    if (auto& one = nearest[{e.quantity, e.kind}]; std::isfinite(e.limit) && !(one.share() >= e.share())) one = e;
  for (const auto& [key, e] : nearest) {
    if (e.sections == 0) continue;
    const std::string unit = measures::quantity_info(e.quantity).unit;
    text += fmt::format("  over {} sections, {}: {} of {}, mean + {:g} deviations {:.4g} {}, {:.0f} % of its limit\n",
                        e.sections, kSectionKinds[static_cast<std::size_t>(e.kind)], e.quantity, e.place, e.factor,
                        shown_value(e.largest, unit).first, shown_value(e.largest, unit).second, 100.0 * e.share());
  }
  return text;
}

std::string estimates_csv(std::span<const AssessedRun> runs) { return io::csv_of(estimates_of(runs), Digits::all); }

std::string assessment_csv(std::span<const AssessedRun> runs) {
  std::string text = "run,section,from_m,to_m,kind,place,quantity,unit,status,samples";
  for (const Column<Assessed>& column : kAssessed)
    if (is_number(column)) text += fmt::format(",{}", column.key);
  text += '\n';
  for (const AssessedRun& run : runs)
    for (const Assessed& one : run.quantities) {
      const auto section = ranges::find(run.request.sections, one.section, &AssessmentSection::name);
      text += fmt::format("{},{},{},{},{},{},{},{},{},{}", io::csv_cell(run.name), io::csv_cell(one.section),
                          io::csv_number(section->from), io::csv_number(section->to),
                          kSectionKinds[static_cast<std::size_t>(section->kind)], io::csv_cell(one.place), one.quantity,
                          measures::quantity_info(one.quantity).unit, measures::name_of(one.status), one.samples);
      for (const Column<Assessed>& column : kAssessed)
        if (is_number(column)) text += ',' + io::csv_cell(column.access.get(one), Digits::all);
      text += '\n';
    }
  return text;
}

std::string spectra_csv(std::span<const AssessedRun> runs) {
  std::string text = "run,channel,kind,frequency_Hz,low_Hz,high_Hz,value,unit,level_dB\n";
  for (const AssessedRun& run : runs)
    for (const ChannelSpectrum& spectrum : run.spectra) {
      const std::string head = io::csv_cell(run.name) + ',' + io::csv_cell(spectrum.channel);
      for (const measures::FrequencyBand& band : spectrum.bands)
        text +=
            fmt::format("{},third_octave,{},{},{},{},{},{}\n", head, io::csv_number(band.nominal),
                        io::csv_number(band.low), io::csv_number(band.high), io::csv_number(band.rms), spectrum.unit,
                        has_level(spectrum.unit) ? io::csv_cell(acceleration_level(band.rms), Digits::all) : "");
      for (std::size_t k = 1; k < spectrum.density.density.size(); ++k) {
        const double frequency = spectrum.density.line * static_cast<double>(k);
        if (frequency > spectrum.density.highest) break;
        text += fmt::format("{},density,{},,,{},({})^2/Hz,\n", head, io::csv_number(frequency),
                            io::csv_number(spectrum.density.density[k]), spectrum.unit);
      }
    }
  return text;
}

std::string assessment_json(std::span<const AssessedRun> runs) {
  Json out;
  out["treadmark"] = {{"version", version()}, {"git", git_revision()}};
  Json& quantities = out["quantities"] = Json::object();
  for (const measures::QuantityInfo& info : measures::assessed_quantities())
    quantities[info.key] = {
        {"unit", info.unit}, {"meaning", info.meaning}, {"value", info.value}, {"source", info.source}};
  out["runs"] = Json::array();
  for (const AssessedRun& run : runs) {
    Json one;
    one["name"] = run.name;
    one["title"] = run.result->title;
    one["input"] = {{"file", run.result->input_file}, {"sha256", run.result->input_sha256}};
    one["vehicle"] = kVehicleKinds[static_cast<std::size_t>(run.request.vehicle)];
    one["from_m"] = io::number(run.request.from);
    one["channels"] = run.request.spectra;
    one["laws"] = run.request.laws;
    one["limits"] = {{"edition", run.limits().edition},
                     {"verified", run.limits().verified},
                     {"usual", !run.request.limits},
                     {"limits", io::json_of(run.limits().limits, Digits::all)}};
    one["sections"] = Json::array();
    for (const AssessmentSection& section : run.request.sections)
      one["sections"].push_back({{"name", section.name},
                                 {"from_m", io::number(section.from)},
                                 {"to_m", io::number(section.to)},
                                 {"kind", kSectionKinds[static_cast<std::size_t>(section.kind)]}});
    one["assessed"] = io::json_of(run.quantities);
    one["spectra"] = Json::array();
    for (const ChannelSpectrum& s : run.spectra) {
      Json bands = Json::array();
      for (const measures::FrequencyBand& band : s.bands)
        bands.push_back({{"frequency_Hz", band.nominal},
                         {"rms", io::number(band.rms)},
                         {"level_dB", has_level(s.unit) ? io::number(acceleration_level(band.rms)) : nullptr}});
      one["spectra"].push_back({{"channel", s.channel},
                                {"unit", s.unit},
                                {"segments", s.density.segments},
                                {"line_Hz", io::number(s.density.line)},
                                {"highest_Hz", io::number(s.density.highest)},
                                {"third_octaves", std::move(bands)}});
    }
    one["doubts"] = run.doubts;
    out["runs"].push_back(std::move(one));
  }
  out["estimates"] = io::json_of(estimates_of(runs));
  return io::dumped(out, 2) + '\n';
}

AssessmentRequest request_in(const std::filesystem::path& json) {
  const io::JsonTree file = io::read_json_file(json);
  const std::vector<io::JsonTree> runs = file.at("runs").items();
  if (runs.size() != 1) file.refuse("it is not the assessment of one run");
  const io::JsonTree& run = runs.front();
  AssessmentRequest request;
  request.vehicle = static_cast<VehicleKind>(run.at("vehicle").one_of({kVehicleKinds.begin(), kVehicleKinds.end()}));
  request.from = run.number("from_m");
  request.spectra = run.at("channels").texts();
  if (run.has("laws")) request.laws = run.at("laws").texts();
  if (run.has("limits") && !run.at("limits").at("usual").flag()) {
    const io::JsonTree given = run.at("limits");
    RunningLimits& limits = request.limits.emplace();
    limits.edition = given.text("edition");
    limits.verified = given.at("verified").flag();
    const auto words_of = [](const auto& enumerators) {
      std::vector<std::string_view> words{kAny};
      words.insert(words.end(), enumerators.begin(), enumerators.end());
      return words;
    };
    for (const io::JsonTree& one : given.at("limits").items()) {
      one.at("vehicle").one_of(words_of(kVehicleKinds));
      one.at("section").one_of(words_of(kSectionKinds));
      io::read_json(one, limits.limits.emplace_back());
    }
  }
  for (const io::JsonTree& one : run.at("sections").items())
    request.sections.push_back(
        {one.text("name"), one.number("from_m"), one.number("to_m"),
         static_cast<SectionKind>(one.at("kind").one_of({kSectionKinds.begin(), kSectionKinds.end()}))});
  return request;
}

std::string spectra_svg(std::span<const AssessedRun> runs) {
  pictures::ChartSheet sheet;
  sheet.title = "one-third octaves";
  sheet.width = 620.0;
  sheet.gap_y = 66.0;
  sheet.top = 58.0;
  sheet.legend = pictures::ChartSheet::Legend::each;
  std::vector<std::string> units;  // a chart each
  for (const AssessedRun& run : runs)
    for (const ChannelSpectrum& s : run.spectra)
      if (!s.bands.empty() && ranges::find(units, s.unit) == units.end()) units.push_back(s.unit);
  for (const std::string& unit : units) {
    pictures::Chart chart;
    chart.x_label = "frequency [Hz]";
    chart.x_scale = pictures::AxisScale::log;
    chart.y_label = has_level(unit) ? "level [dB re 1e-6 m/s2]" : fmt::format("root mean square [{}]", unit);
    if (!has_level(unit)) chart.y_scale = pictures::AxisScale::log;
    int style = 0;
    for (const AssessedRun& run : runs)
      for (const ChannelSpectrum& s : run.spectra) {
        if (s.unit != unit) continue;
        pictures::ChartSeries line;
        line.name = runs.size() > 1 ? run.name + ", " + s.channel : s.channel;
        line.style = style++;
        for (const measures::FrequencyBand& band : s.bands)
          line.points.push_back(
              {std::sqrt(band.low * band.high), has_level(unit) ? acceleration_level(band.rms) : band.rms, 3.0});
        chart.series.push_back(std::move(line));
      }
    if (chart.series.size() == 1) chart.title = chart.series.front().name;
    sheet.charts.push_back(std::move(chart));
  }
  return pictures::draw_sheet(sheet);
}

std::vector<std::string> usual_channels(const io::SimulationResult& result) {
  constexpr std::size_t kMost = 4;
  std::vector<std::string> names;
  for (const char* ending : {".Q_N", ".Y_N"})
    for (const io::HistoryColumn& column : result.columns)
      if (const std::string name = io::channel_name(column); name.ends_with(ending) && names.size() < kMost)
        names.push_back(name);
  return names;
}

void write_assessment_folder(const std::filesystem::path& folder, std::span<const AssessedRun> runs,
                             std::span<const std::string> channels) {
  OutputFolder output(folder, OutputFolder::Old::kept);
  write_file(output.path() / "assessment.csv", assessment_csv(runs));
  if (!estimates_of(runs).empty()) write_file(output.path() / "estimates.csv", estimates_csv(runs));
  bool spectra = false, bands = false;
  for (const AssessedRun& run : runs)
    for (const ChannelSpectrum& s : run.spectra) spectra = true, bands = bands || !s.bands.empty();
  if (spectra) write_file(output.path() / "spectra.csv", spectra_csv(runs));
  if (bands) write_file(output.path() / "spectra.svg", spectra_svg(runs));
  // Runs may call a channel differently: that of the watched wheel has no prefix.
  std::vector<io::SimulationResult> drawn;
  pictures::HistoryChart chart;
  chart.x = {"x_m", "x [m]"};
  for (const AssessedRun& run : runs) {
    const io::SimulationResult& result = *run.result;
    io::SimulationResult part;
    std::vector<std::size_t> kept{io::column_index(result, "x_m")};
    for (const std::size_t column : io::fitting_columns(result.columns, channels))
      if (column != kept.front()) kept.push_back(column);
    for (const std::size_t column : kept) {
      part.columns.push_back(result.columns[column]);
      part.columns.back().name = io::channel_name(result.columns[column]);
    }
    for (std::size_t row = 0; row < result.rows(); ++row)
      for (const std::size_t column : kept) part.values.push_back(result.values[row * result.columns.size() + column]);
    drawn.push_back(std::move(part));
  }
  for (std::size_t c = 1; c < drawn.front().columns.size(); ++c) {
    const io::HistoryColumn& column = drawn.front().columns[c];
    const auto in_all = [&](const io::SimulationResult& one) {
      return ranges::find(one.columns, column.name, &io::HistoryColumn::name) != one.columns.end();
    };
    if (!ranges::all_of(drawn, in_all)) continue;
    const bool force = column.unit == "N";
    const std::string name = force ? column.name.substr(0, column.name.rfind('_')) + " [kN]" : column.name;
    chart.y.push_back({column.name, name, force ? 1e-3 : 1.0});
  }
  if (!chart.y.empty()) {
    std::vector<pictures::HistoryRun> over_each_other;
    for (std::size_t i = 0; i < runs.size(); ++i) over_each_other.push_back({&drawn[i], runs[i].name});
    write_file(output.path() / "runs.svg", pictures::history_svg(over_each_other, chart));
    write_file(output.path() / "runs.csv", pictures::history_chart_csv(over_each_other, chart));
  }
  write_file(output.path() / "assessment.json", assessment_json(runs));
  output.move_into("assessment.json");
}

}  // namespace app
}  // namespace treadmark
