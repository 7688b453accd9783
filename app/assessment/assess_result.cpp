// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/assessment/assess_result.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "treadmark/analysis/damage/fatigue.hpp"
#include "treadmark/analysis/damage/wear.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/histories/channels.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/model/damage/named_laws.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWholeRun = "run";
constexpr const char* kCurvature = "line.curvature_1_m";
constexpr std::pair<const char*, measures::PointMotion> kPointChannels[] = {
    {"ax_m_s2", measures::PointMotion::longitudinal},
    {"ay_m_s2", measures::PointMotion::lateral},
    {"az_m_s2", measures::PointMotion::vertical},
    {"roll_rate_rad_s", measures::PointMotion::roll}};
constexpr double kStepsOfWave = 8.0;  // of the record

/// "ws12_left": 11 and true.
struct WheelPlace {
  std::size_t wheelset = 0;
  bool left = false;
};
std::optional<WheelPlace> wheel_place(const std::string& name) {
  if (!name.starts_with("ws")) return {};
  WheelPlace place;
  const char* const end = name.data() + name.size();
  const auto [rest, error] = from_chars(name.data() + 2, end, place.wheelset);
  const std::string side(rest, end);
  if (error != std::errc() || place.wheelset == 0 || (side != "_left" && side != "_right")) return {};
  --place.wheelset;
  place.left = side == "_left";
  return place;
}

/// Of "car_body.floor.ay_m_s2" what stands before, within and behind the dots; empty: another channel.
std::vector<std::string> parts_of(const std::string& channel) {
  const auto first = channel.find('.'), last = channel.rfind('.');
  if (first == std::string::npos) return {};
  if (first == last) return {channel.substr(0, first), channel.substr(first + 1)};
  return {channel.substr(0, first), channel.substr(first + 1, last - first - 1), channel.substr(last + 1)};
}

/// What a law makes of T gamma, and of the area of contact where it asks for it, at every instant.
std::vector<double> by_law(const NamedLaw& law, const measures::RunSignals& run, const std::vector<double>& t_gamma,
                           const std::vector<double>& area) {
  std::vector<double> out(t_gamma.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : 0, after = std::min(i + 1, out.size() - 1);
    const double speed = (run.place[after] - run.place[before]) / (run.time[after] - run.time[before]);
    const double of_contact = area.empty() ? 1.0 : area[i];  // a law that does not ask for it does not depend on it
    if (const auto* wear = std::get_if<WearLaw>(&law.numbers))
      out[i] = speed > 0.0 && of_contact > 0.0 ? damage::volume_by_distance(*wear, t_gamma[i], of_contact, speed) : 0.0;
    else
      out[i] = damage::passage_damage(std::get<FatigueSettings>(law.numbers), t_gamma[i]);
  }
  return out;
}

double longest_step(const std::vector<double>& time, std::size_t first) {
  double longest = 0.0;
  for (std::size_t i = first + 1; i < time.size(); ++i) longest = std::max(longest, time[i] - time[i - 1]);
  return longest;
}

double usual_step(const std::vector<double>& time, std::size_t first) {
  std::vector<double> steps;
  for (std::size_t i = first + 1; i < time.size(); ++i)
    if (time[i] > time[i - 1]) steps.push_back(time[i] - time[i - 1]);
  return measures::percentile(std::move(steps), 0.5);
}

void add_spectra(AssessedRun& run) {
  const io::SimulationResult& result = *run.result;
  const std::vector<double> time = io::column_values(result, io::column_index(result, "t_s"));
  const std::vector<double> place = io::column_values(result, io::column_index(result, "x_m"));
  const auto first = static_cast<std::size_t>(ranges::lower_bound(place, run.request.from) - place.begin());
  for (const std::size_t column : io::fitting_columns(result.columns, run.request.spectra)) {
    const std::string name = io::channel_name(result.columns[column]);
    const double usual = usual_step(time, first), longest = longest_step(time, first);
    constexpr double kFewest = 16.0;
    if (!(usual > 0.0) || (time.back() - time[first]) / usual < kFewest) {
      run.doubts.push_back(fmt::format("{}: too few instants for a spectrum", name));
      continue;
    }
    const std::vector<double> values = io::column_values(result, column);
    if (!ranges::all_of(values, [](double v) { return std::isfinite(v); })) {
      run.doubts.push_back(fmt::format("{}: it has no spectrum, not all of its values are numbers", name));
      continue;
    }
    const measures::EvenSignal even =
        measures::even_samples(std::span(time).subspan(first), std::span(values).subspan(first), usual);
    constexpr std::size_t kLongest = 1 << 16, kShort = 64;
    const std::size_t quarter = even.values.size() / 4;
    ChannelSpectrum spectrum{name, result.columns[column].unit, {}, {}};
    spectrum.density = measures::power_spectrum(even, 1.0 / (kStepsOfWave * longest),
                                                quarter < kShort ? 0 : std::min(quarter, kLongest));
    spectrum.bands = measures::third_octave_bands(spectrum.density);
    if (spectrum.bands.empty())
      run.doubts.push_back(
          fmt::format("{}: the record is too short, or its steps of up to {:.3g} s are too long, for "
                      "one-third octaves",
                      name, longest));
    run.spectra.push_back(std::move(spectrum));
  }
}

/// Results of older versions do not have all of them.
double static_or(const io::SimulationResult& result, const char* name, double otherwise) {
  const auto found = ranges::find(result.statics, name, &io::NamedValue::name);
  return found == result.statics.end() ? otherwise : found->value;
}

/// Means over the time in a section, sides of curves alike. NaN without a line, or where the record has no instant.
double cant_deficiency_in(const io::SimulationResult& result, const AssessmentSection& section) {
  const double base = static_or(result, kCantBaseName, 1.5), gravity = static_or(result, kGravityName, 9.81);
  const auto column = [&](const char* name) {
    return ranges::find(result.columns, name, &io::HistoryColumn::name) - result.columns.begin();
  };
  const auto place = column("x_m"), time = column("t_s"), speed = column("line.speed_m_s"),
             curvature = column(kCurvature), cant = column("line.cant_m");
  if (std::max({place, time, speed, curvature, cant}) == static_cast<std::ptrdiff_t>(result.columns.size()))
    return measures::kUnknown;
  const auto value = [&](std::size_t row, std::ptrdiff_t c) {
    return result.values[row * result.columns.size() + static_cast<std::size_t>(c)];
  };
  double sum = 0.0, duration = 0.0;
  for (std::size_t row = 1; row < result.rows(); ++row) {
    if (value(row, place) < section.from || value(row, place) > section.to) continue;
    const double v = value(row, speed), step = value(row, time) - value(row - 1, time);
    sum += step * (base / gravity * v * v * value(row, curvature) - value(row, cant));
    duration += step;
  }
  return duration > 0.0 ? std::fabs(sum) / duration : measures::kUnknown;
}

void add_doubts(AssessedRun& run) {
  if (run.result->status != "complete")
    run.doubts.push_back(fmt::format("the run is {}: it is assessed as far as it goes", run.result->status));
  for (const std::string& name : run.request.laws)
    if (const NamedLaw& law = *law_named(name); !law.verified)
      run.doubts.push_back(fmt::format("the law {} is unverified: {}", name, law.source));
  if (run.request.limits && !run.request.limits->verified)
    run.doubts.push_back(fmt::format("the limits of {} are unverified", run.request.limits->edition));
  const auto by_radius = [](const RunningLimit& l) { return l.to_radius || l.by_curvature != 0.0; };
  for (const AssessmentSection& section : run.request.sections)
    if (section.kind == SectionKind::curve && ranges::any_of(run.limits().limits, by_radius) &&
        ranges::find(run.result->columns, kCurvature, &io::HistoryColumn::name) == run.result->columns.end())
      run.doubts.push_back(fmt::format("section {}: the history has no {}, limits by radius are those of a straight",
                                       section.name, kCurvature));
  if (ranges::any_of(run.cant_deficiency, [](double d) { return std::isfinite(d); }) &&
      ranges::find(run.result->statics, kCantBaseName, &io::NamedValue::name) == run.result->statics.end())
    run.doubts.push_back(
        "cant deficiencies are those of a base of 1.5 m and of 9.81 m/s2: the result of an older version says neither");
  std::map<measures::AssessedStatus, std::pair<std::size_t, std::string>> counts;
  for (const measures::Assessed& one : run.quantities)
    if (one.status != measures::AssessedStatus::ok) {
      auto& [count, example] = counts[one.status];
      if (count++ == 0) example = fmt::format("{} of {} in {}", one.quantity, one.place, one.section);
    }
  for (const auto& [status, found] : counts)
    run.doubts.push_back(fmt::format("{} of {} quantities have no value: {} ({}); the first is {}", found.first,
                                     run.quantities.size(), measures::reason_of(status), measures::name_of(status),
                                     found.second));
}

fs::path store_of(const std::string& name) {
  std::error_code unknown;
  if (!fs::is_directory(name, unknown)) return name;
  for (const char* file : {"simulation.h5", "unfinished.h5"})
    if (fs::exists(fs::path(name) / file, unknown)) return fs::path(name) / file;
  throw Error(ErrorKind::input_data, "the folder holds no results of a simulation", {name},
              "give folders that treadmark simulate wrote with -o");
}

/// The folders' own names, or all of their paths where some are equal.
std::vector<std::string> names_of(const std::vector<std::string>& results) {
  std::vector<std::string> names;
  for (const std::string& one : results) {
    fs::path path = fs::path(one).lexically_normal();
    if (!path.has_filename()) path = path.parent_path();
    if (path.extension() == ".h5" && path.has_parent_path()) path = path.parent_path();
    names.push_back(path.filename().string());
  }
  std::vector<std::string> sorted = names;
  ranges::sort(sorted);
  return ranges::adjacent_find(sorted) == sorted.end() ? names : results;
}

}  // namespace

bool has_level(const std::string& unit) { return unit == "m/s2"; }

double acceleration_level(double rms) {
  constexpr double kReference = 1e-6;  // [m/s2]
  return 20.0 * std::log10(rms / kReference);
}

measures::RunSignals signals_of(const io::SimulationResult& result, const std::vector<std::string>& laws) {
  for (const char* name : {"t_s", "x_m"})
    if (ranges::find(result.columns, name, &io::HistoryColumn::name) == result.columns.end())
      throw Error(ErrorKind::input_data, fmt::format("the history has no column {}", name), {},
                  "only simulations of vehicles can be assessed");
  measures::RunSignals run;
  const auto values = [&](std::size_t column) { return io::column_values(result, column); };
  run.time = values(io::column_index(result, "t_s"));
  run.place = values(io::column_index(result, "x_m"));
  std::map<std::string, std::map<std::string, std::size_t>> wheels;  // by name, by quantity: the column
  std::vector<std::string> order;
  std::set<std::string> told;  // laws
  for (std::size_t i = 0; i < result.columns.size(); ++i) {
    const std::vector<std::string> parts = parts_of(io::channel_name(result.columns[i]));
    if (parts.size() == 2 && wheel_place(parts[0])) {
      if (!wheels.contains(parts[0])) order.push_back(parts[0]);
      wheels[parts[0]][parts[1]] = i;
    }
    const auto kind = parts.size() == 3 ? ranges::find(kPointKinds, parts[0]) : kPointKinds.end();
    if (kind == kPointKinds.end()) continue;
    for (const auto& [channel, motion] : kPointChannels)
      if (parts[2] == channel)
        run.points.push_back({parts[1], static_cast<PointKind>(kind - kPointKinds.begin()), motion, values(i)});
  }
  const auto curvature = ranges::find(result.columns, kCurvature, &io::HistoryColumn::name);
  if (curvature != result.columns.end())
    run.curvature = values(static_cast<std::size_t>(curvature - result.columns.begin()));
  for (const std::string& name : order) {
    const auto& of = wheels[name];
    if (!of.contains("Q_N") || !of.contains("Y_N")) continue;
    const WheelPlace place = *wheel_place(name);
    measures::WheelSignal wheel{name, place.left, place.wheelset, values(of.at("Q_N")), values(of.at("Y_N")), {}};
    if (of.contains("Tgamma_N")) wheel.wear = values(of.at("Tgamma_N"));
    for (const std::string& one : laws) {
      const NamedLaw& law = *law_named(one);
      const bool by_area = law.is(WearTheory::t_gamma) || law.is(WearTheory::energy);
      if (!of.contains("Tgamma_N") || (by_area && !of.contains("area_m2"))) continue;
      const std::vector<double> area = by_area ? values(of.at("area_m2")) : std::vector<double>();
      wheel.laws[*told.insert(one).first] = by_law(law, run, wheel.wear, area);
    }
    run.wheels.push_back(std::move(wheel));
    while (run.wheelsets.size() <= place.wheelset) {
      const std::size_t number = run.wheelsets.size() + 1;
      measures::WheelsetSignal set{fmt::format("ws{}", number), measures::kUnknown};
      const std::string load = fmt::format("wheelset{}.load_N", number);
      for (const io::NamedValue& one : result.statics)
        if (one.name == load) set.load = one.value;
      run.wheelsets.push_back(std::move(set));
    }
  }
  for (const std::string& name : laws)
    if (!told.contains(name))
      throw Error(ErrorKind::configuration, fmt::format("no wheel has the channels that the law {} needs", name), {},
                  "it needs Q_N, Y_N and Tgamma_N, laws by area also area_m2, which wheels with full contact have");
  return run;
}

void check_assessable(const io::SimulationFile& file, const std::vector<io::HistoryColumn>& columns, double max_step,
                      double max_travel) {
  if (!file.assessment) return;
  const AssessmentRequest& request = *file.assessment;
  io::fitting_columns(columns, request.spectra, {file.path.string()});
  check(request);
  io::SimulationResult empty;
  empty.columns = columns;
  const double longest = measures::longest_record_step(signals_of(empty, request.laws));
  const SpeedProfile& profile = file.settings.profile;
  std::vector<AssessmentSection> sections = request.sections;
  if (sections.empty()) sections.push_back({kWholeRun, request.from, file.settings.distance});
  double slowest = HUGE_VAL;
  for (const AssessmentSection& section : sections) {
    const double begin = time_at(profile, section.from), end = time_at(profile, section.to);
    slowest = std::min(slowest, travel_at(profile, end).speed);
    for (const double t : profile.time)
      slowest = std::min(slowest, travel_at(profile, std::clamp(t, begin, end)).speed);
  }
  // a line is written at the first step behind a multiple of `every`
  const double most = std::max(0.0, slowest * longest - std::min(slowest * max_step, max_travel));
  constexpr double kSlack = 1e-9, kTenth = 1e-4;  // of a millimetre [m]
  if (file.settings.output_every <= most * (1.0 + kSlack)) return;
  throw Error(ErrorKind::configuration,
              fmt::format("simulation.output_every_mm is too coarse for [assessment]: at {:.4g} m/s its filters need a "
                          "line every {:.3g} ms",
                          slowest, 1e3 * longest),
              {file.path.string()},
              fmt::format("give at most {:.6g}, 0 for every step, shorter steps (max_step_us) or no [assessment]",
                          0.1 * std::floor(most / kTenth * (1.0 + kSlack))));
}

void check(const AssessmentRequest& request) {
  if (request.limits) {
    std::vector<std::string> known;
    for (const measures::QuantityInfo& info : measures::assessed_quantities()) known.emplace_back(info.key);
    for (const RunningLimit& limit : request.limits->limits)
      if (ranges::find(known, limit.quantity) == known.end())
        throw Error(ErrorKind::configuration, fmt::format("quantity '{}' is not assessed", limit.quantity), limit.where,
                    advice_on_name(limit.quantity, known));
  }
  std::set<std::string> names;
  for (const AssessmentSection& section : request.sections) {
    if (section.name.empty() || !names.insert(section.name).second)
      throw Error(ErrorKind::configuration, section.name.empty()
                                                ? "a section has no name"
                                                : fmt::format("two sections have the name {}", section.name));
    if (!(section.to > section.from) || !std::isfinite(section.to - section.from))
      throw Error(ErrorKind::configuration,
                  fmt::format("section {} from {:.6g} to {:.6g} m is none", section.name, section.from, section.to));
  }
  std::vector<std::string> answered;
  for (const NamedLaw& law : named_laws())
    if (!law.is(WearTheory::archard)) answered.emplace_back(law.name);
  std::set<std::string> asked;
  for (const std::string& name : request.laws) {
    const NamedLaw* law = law_named(name);
    if (law == nullptr)
      throw Error(ErrorKind::configuration, fmt::format("law '{}' is not known", name), {},
                  advice_on_name(name, answered));
    if (!asked.insert(name).second)
      throw Error(ErrorKind::configuration, fmt::format("law '{}' is asked for twice", name));
    if (law->is(WearTheory::archard))
      throw Error(ErrorKind::configuration,
                  fmt::format("law '{}' needs elements of contact: no history has them", name), {},
                  "use it in treadmark evolve");
  }
}

AssessedRun assess_result(std::string name, std::shared_ptr<const io::SimulationResult> result,
                          const AssessmentRequest& request) {
  check(request);
  AssessedRun run{std::move(name), std::move(result), request, {}, {}, {}, {}};
  const measures::RunSignals signals = signals_of(*run.result, request.laws);
  if (signals.time.size() < 2)
    throw Error(ErrorKind::input_data, fmt::format("{}: the history has fewer than two instants", run.name));
  const double begin = signals.place.front(), end = signals.place.back();
  const auto outside = [&](const std::string& what) {
    throw Error(ErrorKind::configuration,
                fmt::format("{} does not lie within the run of {}, {:.6g} to {:.6g} m", what, run.name, begin, end));
  };
  constexpr double kSlack = 1e-3;  // [m]
  for (const AssessmentSection& section : request.sections)
    if (run.result->status == "complete" && (section.from < begin - kSlack || section.to > end + kSlack))
      outside(fmt::format("section {} from {:.6g} to {:.6g} m", section.name, section.from, section.to));
  if (!(request.from < end) && run.result->status == "complete")
    outside(fmt::format("the beginning of the assessment, {:.6g} m,", request.from));
  if (run.request.sections.empty())
    run.request.sections.push_back({kWholeRun, std::max(request.from, begin), end, SectionKind::straight});
  run.quantities = measures::assess_run(signals, run.request.sections, request.vehicle, run.limits());
  for (const AssessmentSection& section : run.request.sections)
    run.cant_deficiency.push_back(cant_deficiency_in(*run.result, section));
  add_doubts(run);
  if (!request.spectra.empty() && request.from < end) add_spectra(run);
  return run;
}

std::vector<measures::Estimate> estimates_of(std::span<const AssessedRun> runs) {
  std::vector<measures::SectionValue> values;
  for (const AssessedRun& run : runs)
    for (const measures::Assessed& one : run.quantities) {
      const auto section = static_cast<std::size_t>(
          ranges::find(run.request.sections, one.section, &AssessmentSection::name) - run.request.sections.begin());
      values.push_back({one, run.request.sections[section].kind, run.cant_deficiency[section]});
    }
  return measures::estimates_of(values);
}

std::vector<AssessedRun> assess_files(const std::vector<std::string>& results, const AssessmentRequest& request,
                                      const std::vector<std::string>& channels) {
  require_part("hdf5", "results of simulations");
  check(request);
  std::vector<AssessedRun> runs;
  const std::vector<std::string> names = names_of(results);
  for (std::size_t i = 0; i < names.size(); ++i) {
    auto result = std::make_shared<io::SimulationResult>(io::read_simulation(store_of(results[i])));
    io::fitting_columns(result->columns, channels);  // refused before anything is computed
    runs.push_back(assess_result(names[i], std::move(result), request));
  }
  return runs;
}

std::optional<AssessedRun> assess_own(std::shared_ptr<const io::SimulationResult> result,
                                      const std::optional<AssessmentRequest>& request) {
  if (!request || result->rows() < 2) return {};
  std::string name = result->title.empty() ? result->input_file : result->title;
  return assess_result(std::move(name), std::move(result), *request);
}

}  // namespace treadmark::app
