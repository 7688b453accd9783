// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/assessment/assessment_outputs.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/evolve/run_evolution.hpp"
#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/app/simulation/line_summary.hpp"
#include "treadmark/app/simulation/run_study.hpp"
#include "treadmark/app/simulation/simulation_outputs.hpp"
#include "treadmark/app/simulation/study_figures.hpp"
#include "treadmark/app/stability/response_run.hpp"
#include "treadmark/app/stability/stability_run.hpp"
#include "treadmark/app/track/track_run.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/interfaces/python/python.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/histories/evolution_store.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/histories/study_store.hpp"
#include "treadmark/io/simulations/read_evolution.hpp"
#include "treadmark/io/simulations/read_limits.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/report/pictures/histories/history_svg.hpp"

namespace treadmark::python {
namespace {

io::SimulationFile simulation_of(const Source& source) {
  if (source.text) return io::parse_simulation_text(*source.text, source.file, source.overrides);
  if (io::is_study_file(source.file))
    throw Error(ErrorKind::configuration, "this is a study of several simulations", {source.file.string(), 0, 0},
                "use treadmark.sweep");
  return io::read_simulation_file(source.file, source.overrides);
}

struct Simulated {
  std::shared_ptr<const io::SimulationResult> result;
  std::string json;
  std::optional<app::AssessedRun> assessed = {};
};

/// modes_only: static equilibrium and modes, without integration.
Simulated simulate(const Source& source, bool modes_only, const py::object& progress, int threads) {
  return with_progress(progress, threads, [&](const Progress& report) {
    const io::SimulationFile file = simulation_of(source);
    app::SurfaceStore store;
    app::SimulationOptions options;
    options.settings = source.overrides;
    app::SimulationTimes times;
    auto result = std::make_shared<const io::SimulationResult>(
        modes_only ? app::static_results(file, store, options)
                   : app::run_simulation(file, store, options, report, &times));
    std::optional<app::AssessedRun> assessed;
    if (!modes_only) assessed = app::assess_own(result, file.assessment);
    const std::string json = app::to_json(*result, times, assessed ? &*assessed : nullptr);
    return Simulated{result, json, std::move(assessed)};
  });
}

py::list named_values(const std::vector<io::NamedValue>& values) {
  py::list list;
  for (const io::NamedValue& v : values) list.append(py::make_tuple(v.name, v.value, v.unit, v.description));
  return list;
}

/// Rows as dictionaries in SI, by the names that stores have.
template <class Row>
py::list records_of(const std::vector<Row>& rows) {
  py::list list;
  for (const Row& row : rows) {
    py::dict record;
    for (const Column<Row>& column : columns<Row>()) {
      const py::str name{std::string(column.stored)};
      if (column.access.word != nullptr)
        record[name] = column.access.word(row);
      else
        record[name] = column.access.get(row);
    }
    list.append(record);
  }
  return list;
}

py::dict content_of(const Simulated& simulated) {
  const io::SimulationResult& r = *simulated.result;
  const py::object owner = owner_of(simulated.result);
  py::list columns;
  for (const io::HistoryColumn& c : r.columns) columns.append(py::make_tuple(c.name, c.unit, c.description));
  py::dict d;
  d["title"] = r.title;
  d["status"] = r.status;
  d["message"] = r.message;
  d["version"] = r.version;
  d["input_file"] = r.input_file;
  d["settings"] = r.settings;
  d["swept"] = r.swept;
  d["columns"] = columns;
  d["values"] =
      view(r.values, 'd', {static_cast<py::ssize_t>(r.rows()), static_cast<py::ssize_t>(r.columns.size())}, owner);
  d["events"] = records_of(r.events);
  d["summary"] = named_values(r.summary);
  d["statics"] = named_values(r.statics);
  d["modes"] = records_of(r.modes);
  d["snapshots"] = to_python(simulated.result, r.snapshots.cases);
  d["snapshot_times"] = r.snapshot_times;
  return d;
}

Simulated read_simulation(const std::filesystem::path& file) {
  return with_files([&] {
    io::SimulationResult result = io::read_simulation(file);
    io::SnapshotSeries series = io::read_snapshots(file);
    result.snapshots = std::move(series.run);
    result.snapshot_times = std::move(series.times);
    result.snapshot_scenes = std::move(series.scenes);
    return Simulated{std::make_shared<const io::SimulationResult>(std::move(result)), {}, {}};
  });
}

/// Forces of the columns over time.
std::string history_svg(const Simulated& simulated, const std::string& x, const Strings& y, const std::string& title) {
  pictures::HistoryChart chart;
  chart.title = title;
  chart.x = {x, x};
  for (const std::string& column : y) chart.y.push_back({column, column});
  const pictures::HistoryRun run{simulated.result.get(), "", ""};
  return pictures::history_svg({&run, 1}, chart);
}

py::dict study_to_python(const io::StudyResult& study) {
  py::list runs;
  for (const io::SimulationRun& run : study.runs)
    runs.append(py::make_tuple(run.number, run.label, run.status, run.message, run.swept, named_values(run.summary),
                               run.store.string()));
  py::dict d;
  d["title"] = study.title;
  d["version"] = study.version;
  d["input_file"] = study.input_file;
  d["settings"] = study.settings;
  d["runs"] = runs;
  return d;
}

/// runs: numbers of the first and the last that are solved, one share of several; none: all. (0, 0) solves none.
py::dict sweep(const Source& source, const std::filesystem::path& folder, bool resume, const py::object& progress,
               int threads, const std::optional<std::pair<int, int>>& runs) {
  require_part("hdf5", "folders of studies");
  app::StudyOutcome outcome = with_progress(progress, threads, [&](const Progress& report) {
    require_file(source.file, "study file", ErrorKind::configuration);
    if (!io::is_study_file(source.file))
      throw Error(ErrorKind::configuration, "this is not a study: it has no table [study]",
                  {source.file.string(), 0, 0}, "use treadmark.simulate for one simulation");
    app::StudyOptions wanted;
    const bool none = runs && runs->second == 0;
    if (runs && !none) wanted.share = {runs->first, runs->second};
    const io::StudyFile study = io::read_study_file(source.file, source.overrides, wanted.share);
    wanted.folder = folder;
    wanted.settings = source.overrides;
    wanted.must_exist = resume;
    if (runs) wanted.cache = io::ContentCache::from_environment();  // other processes are at work too
    wanted.workers = none ? 0 : std::min(thread_count(), std::max(1, static_cast<int>(study.runs.size())));
    app::StudyOutcome done = app::run_study(study, wanted, report);
    const std::lock_guard lock(file_mutex());
    if (done.complete && wanted.share.whole()) app::write_study_folder(study, wanted, done.study);
    return done;
  });
  py::dict d = study_to_python(outcome.study);
  d["complete"] = outcome.complete;
  d["runs_total"] = outcome.runs_total;
  return d;
}

/// What a verb found out about a vehicle or a track.
template <class Result>
struct Found {
  std::shared_ptr<const Result> result;
};
using FoundTrack = Found<app::TrackResult>;
using FoundEvolution = Found<io::EvolutionResult>;
using FoundResponse = Found<app::ResponseRun>;
using FoundStability = Found<app::StabilityRun>;
struct AssessedRuns {
  std::vector<app::AssessedRun> runs;
  Strings channels;  ///< drawn over the distance
};
using FoundAssessment = Found<AssessedRuns>;

/// Its class: texts for programs and people, and the folder of the verb.
template <class Result, class Json, class Csv, class Summary, class Write>
py::class_<Found<Result>> found_class(py::module_& module, const char* name, Json json, Csv csv, Summary summary,
                                      Write write) {
  return py::class_<Found<Result>>(module, name)
      .def("json", [=](const Found<Result>& f) { return json(*f.result); })
      .def("csv", [=](const Found<Result>& f) { return csv(*f.result); })
      .def("summary", [=](const Found<Result>& f) { return summary(*f.result); })
      .def("write_folder", [=](const Found<Result>& f, const std::filesystem::path& folder) {
        with_files([&] { write(folder, *f.result); });
      });
}

FoundTrack track(const std::filesystem::path& file, const Strings& overrides, const std::pair<double, double>& range,
                 int count, int layers) {
  return with_progress(py::none(), 1, [&](const Progress& report) {
    const CancellationScope scope(report.stop);
    app::TrackRequest request;
    request.file = file;
    request.overrides = overrides;
    std::tie(request.from, request.to) = range;
    request.count = count;
    request.layers = layers;
    return FoundTrack{std::make_shared<const app::TrackResult>(app::run_track(request))};
  });
}

FoundEvolution evolve(const std::filesystem::path& file, const Strings& overrides, const std::filesystem::path& folder,
                      bool resume, const py::object& progress, int threads) {
  return with_progress(progress, threads, [&](const Progress& report) {
    for (const char* part : {"hdf5", "openvdb"}) require_part(part, "evolutions");
    const io::EvolutionFile read = io::read_evolution_file(file, overrides);
    auto result =
        std::make_shared<const io::EvolutionResult>(app::run_evolution(read, {folder, resume, overrides}, report));
    app::write_evolution_folder(folder, *result);
    return FoundEvolution{std::move(result)};
  });
}

FoundStability stability(const std::filesystem::path& file, const Strings& overrides,
                         const std::pair<double, double>& range, int count, double tolerance, double shown,
                         int threads) {
  return with_progress(py::none(), threads, [&](const Progress& report) {
    app::StabilityRequest request;
    request.file = file;
    request.overrides = overrides;
    std::tie(request.from, request.to) = range;
    request.count = count;
    request.tolerance = tolerance;
    request.shown = shown;
    return FoundStability{std::make_shared<const app::StabilityRun>(app::run_stability(request, report))};
  });
}

FoundResponse response(const std::filesystem::path& file, const Strings& overrides,
                       const std::pair<double, double>& range, int count, const Strings& inputs,
                       const Strings& channels, bool iso_3095, int threads) {
  return with_progress(py::none(), threads, [&](const Progress& report) {
    app::ResponseRequest request;
    request.file = file;
    request.overrides = overrides;
    std::tie(request.from, request.to) = range;
    request.count = count;
    request.inputs = inputs;
    request.channels = channels;
    request.iso_3095 = iso_3095;
    request.cache = io::ContentCache::from_environment();
    return FoundResponse{std::make_shared<const app::ResponseRun>(app::run_response(request, report))};
  });
}

/// Place of a word in a list of words. Errors: Error(configuration).
std::size_t place_of(const std::string& word, std::span<const std::string_view> words) {
  const auto found = ranges::find(words, word);
  if (found == words.end())
    throw Error(ErrorKind::configuration, fmt::format("'{}' is none of: {}", word, fmt::join(words, ", ")));
  return static_cast<std::size_t>(found - words.begin());
}

using SectionTuple = std::tuple<std::string, double, double, std::string>;  // name, from, to, kind

FoundAssessment assess(const Strings& results, const std::string& vehicle, double from,
                       const std::vector<SectionTuple>& sections, const Strings& spectra, const Strings& laws,
                       const Strings& channels, const std::string& limits) {
  return with_files([&] {
    AssessmentRequest request;
    request.vehicle = static_cast<VehicleKind>(place_of(vehicle, kVehicleKinds));
    request.from = from;
    request.spectra = spectra;
    request.laws = laws;
    if (!limits.empty()) request.limits = io::read_limits_file(limits);
    for (const auto& [name, begin, end, kind] : sections)
      request.sections.push_back({name, begin, end, static_cast<SectionKind>(place_of(kind, kSectionKinds))});
    AssessedRuns found{app::assess_files(results, request, channels), channels};
    if (channels.empty()) found.channels = app::usual_channels(*found.runs.front().result);
    return FoundAssessment{std::make_shared<const AssessedRuns>(std::move(found))};
  });
}

/// How many runs or simulations there are, and notes.
std::pair<std::size_t, Strings> check_simulation(const Source& source, bool study) {
  return released([&] {
    app::SurfaceStore surfaces;
    Strings notes;
    std::size_t count = 1;
    if (!study) {
      const io::SimulationFile file = simulation_of(source);
      app::check_vehicle(file, surfaces);
      notes = file.notes;
      for (std::string& text : app::line_summary(file)) notes.push_back(std::move(text));
    } else {
      const io::StudyFile file = io::read_study_file(source.file, source.overrides);
      app::check_study_figures(file);
      count = file.runs.size();
      notes = file.notes;
      for (const io::StudyRun& run : file.runs) {
        const auto base = io::read_study_run(file, run);
        if (const auto* simulation = std::get_if<io::SimulationFile>(&base))
          app::check_vehicle(*simulation, surfaces);
        else
          app::check_geometry(std::get<io::CaseFile>(base));
      }
    }
    return std::pair(count, notes);
  });
}

}  // namespace

void add_simulations(py::module_& module) {
  py::class_<Simulated>(module, "Simulated")
      .def_static("read", read_simulation)
      .def("content", [](const Simulated& s) { return content_of(s); })
      .def("json", [](const Simulated& s) { return s.json.empty() ? app::to_json(*s.result, {}) : s.json; })
      .def("summary", [](const Simulated& s) { return app::summary_text(*s.result); })
      .def("svg", history_svg)
      .def("write_folder", [](const Simulated& s, const std::filesystem::path& folder) {
        with_files([&] {
          std::filesystem::create_directories(folder);
          if (s.assessed) app::write_assessment_folder(folder, std::span(&*s.assessed, 1), {});
          app::write_simulation_folder(folder, *s.result);
        });
      });
  found_class<app::TrackResult>(module, "Track", app::track_json, app::track_csv, app::track_table,
                                app::write_track_folder)
      .def("svg", [](const FoundTrack& t) { return app::track_svg(*t.result); });
  found_class<app::StabilityRun>(module, "Stability", app::stability_json, app::stability_csv, app::stability_table,
                                 app::write_stability_folder)
      .def("svg", [](const FoundStability& t) { return app::stability_svg(*t.result); });
  found_class<app::ResponseRun>(module, "Response", app::response_json, app::response_csv, app::response_table,
                                app::write_response_folder)
      .def("svg", [](const FoundResponse& r) { return app::response_svg(*r.result); })
      .def("modes_svg", [](const FoundResponse& r) { return app::modes_svg(*r.result); });
  found_class<AssessedRuns>(
      module, "Assessment", [](const AssessedRuns& a) { return app::assessment_json(a.runs); },
      [](const AssessedRuns& a) { return app::assessment_csv(a.runs); },
      [](const AssessedRuns& a) { return app::assessment_text(a.runs); },
      [](const std::filesystem::path& folder, const AssessedRuns& a) {
        app::write_assessment_folder(folder, a.runs, a.channels);
      });
  py::class_<FoundEvolution>(module, "Evolution")
      .def("json", [](const FoundEvolution& e) { return app::evolution_json(*e.result); })
      .def("csv", [](const FoundEvolution& e) { return io::evolution_csv(*e.result); })
      .def("summary", [](const FoundEvolution& e) { return app::evolution_table(*e.result); });
  module.def("evolve", evolve);
  module.def("track", track);
  module.def("stability", stability);
  module.def("response", response);
  module.def("assess", assess);
  module.def("simulate", simulate);
  module.def("sweep", sweep);
  module.def("read_sweep", [](const std::filesystem::path& file) {
    return study_to_python(with_files([&] { return io::read_study_head(file); }));
  });
  module.def("check_simulation", check_simulation);
}

}  // namespace treadmark::python
