// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <functional>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/app/bench/bench_surfaces.hpp"
#include "treadmark/app/cases/output_files.hpp"
#include "treadmark/app/cases/position_picture.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/interfaces/c/numbers.hpp"
#include "treadmark/interfaces/python/python.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/file_kind.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/results/comparison_json.hpp"
#include "treadmark/io/results/comparison_store.hpp"
#include "treadmark/io/results/comparison_table.hpp"
#include "treadmark/report/pictures/comparison_pictures.hpp"
#include "treadmark/report/pictures/section_picture.hpp"

namespace treadmark::python {
namespace {

using Compared = std::shared_ptr<io::Comparison>;
using Benched = std::shared_ptr<app::BenchReport>;
template <class T>
struct Held {
  std::shared_ptr<T> content;
};

/// Of the cases of a file that have results.
Varied varied_of(const io::CaseFile& file, const io::RunResult& result) {
  std::vector<const io::Case*> cases;
  for (const io::CaseResult& one : result.cases)
    if (const auto found = ranges::find(file.cases, one.number, &io::Case::number); found != file.cases.end())
      cases.push_back(&*found);
  Varied varied;
  if (cases.empty() || cases.size() != result.cases.size()) return varied;
  const auto add = [&](const std::string& name, io::KeyScope scope, const auto& value_of) {
    if (scope != io::KeyScope::any && static_cast<std::size_t>(scope) != 1 + cases.front()->content.index()) return;
    Varied::value_type row{name, {}};
    for (const io::Case* one : cases) {
      if (one->content.index() != cases.front()->content.index()) return;
      row.second.emplace_back(value_of(*one));
    }
    // NaN: the case has no such part. It equals nothing, not even itself.
    const auto differ = [](const auto& a, const auto& b) { return a != b && (a == a || b == b); };
    if (ranges::adjacent_find(row.second, differ) != row.second.end()) varied.push_back(std::move(row));
  };
  for (const c::CaseNumber& number : c::case_numbers())
    if (number.key->get)
      add(number.name, number.key->info.scope, [&](const io::Case& one) { return number.key->get(one) * number.si; });
  for (const io::CaseKey& key : io::case_keys())
    if (!key.get && (key.written || key.text))
      add(key.info.path, key.info.scope,
          [&](const io::Case& one) { return key.written ? key.written(one, {}) : key.text(one); });
  return varied;
}

Run run_cases(const Source& source, const py::object& progress, int threads) {
  Run run;
  with_progress(progress, threads, [&](const Progress& report) {
    run.made_from = std::make_shared<std::pair<io::CaseFile, app::SurfaceStore>>();
    auto& [file, store] = *run.made_from;
    file = cases_of(source);
    run.result = std::make_shared<io::RunResult>(app::run_cases(file, store, report));
    run.result->settings = source.overrides;
    run.notes = file.notes;
    run.notes.insert(run.notes.end(), run.result->doubts.begin(), run.result->doubts.end());
    run.varied = varied_of(file, *run.result);
    return true;
  });
  return run;
}

pictures::Curve curve_of(const std::vector<Vec2>& points) {
  pictures::Curve curve;
  for (const Vec2& p : points) curve.push_back({kMilli * p.x(), -kMilli * p.y()});
  return curve;
}

py::list profiles_to_python(const std::vector<app::CheckedProfile>& profiles) {
  py::list list;
  for (const app::CheckedProfile& profile : profiles) {
    py::list doubts;
    for (const io::ProfileRemark& remark : profile.judgement.remarks)
      doubts.append(py::make_tuple(remark.name, remark.text));
    list.append(py::make_tuple(profile.name, profile.judgement.facts, doubts, profile.judgement.notes));
  }
  return list;
}

/// (number of the case, least gap [m], curve of the rail, of the wheel (y, z) [m], picture)
py::tuple check_cases(const Source& source) {
  struct Found {
    std::size_t count = 0;
    Strings notes;
    std::vector<int> numbers;
    std::vector<app::PositionSection> positions;
    std::vector<app::CheckedProfile> profiles;
  };
  const auto found = std::make_shared<Found>();
  released([&] {
    const io::CaseFile file = cases_of(source);
    found->count = file.cases.size();
    found->notes = file.notes;
    for (const app::CaseGeometry& c : app::check_geometry(file)) {
      found->numbers.push_back(c.given->number);
      found->positions.push_back(app::position_section(std::get<io::WheelRailCase>(c.given->content), c.geometry));
    }
    found->profiles = app::check_profiles(file);
  });
  const py::object owner = owner_of(found);
  const auto points = [&](const std::vector<Vec2>& curve) {
    return view(curve.data(), 'd', {static_cast<py::ssize_t>(curve.size()), 2}, {sizeof(Vec2), sizeof(double)}, owner);
  };
  py::list positions;
  for (std::size_t i = 0; i < found->positions.size(); ++i) {
    const app::PositionSection& section = found->positions[i];
    positions.append(py::make_tuple(found->numbers[i], section.least_gap, points(section.rail), points(section.wheel)));
  }
  return py::make_tuple(found->count, found->notes, profiles_to_python(found->profiles), positions);
}

std::string position_svg(const std::string& title, const std::vector<std::pair<double, double>>& rail,
                         const std::vector<std::pair<double, double>>& wheel) {
  const auto curve = [](const std::vector<std::pair<double, double>>& points) {
    std::vector<Vec2> all;
    all.reserve(points.size());
    for (const auto& [y, z] : points) all.emplace_back(y, z);
    return curve_of(all);
  };
  return pictures::section_svg({title, curve(rail), curve(wheel), {}, ""});
}

py::list check_profile(const std::filesystem::path& file, const std::string& body) {
  std::optional<Body> given;
  if (!body.empty()) given = body == "wheel" ? Body::wheel : Body::rail;
  return profiles_to_python({released([&] { return app::check_profile(file, given); })});
}

std::string kind_of(const Source& source) {
  if (source.text) return "text";
  if (app::is_profile_file(source.file)) return "profile";
  if (io::is_study_file(source.file)) return "study";
  return io::is_simulation_file(source.file) ? "simulation" : "cases";
}

Held<io::Comparison> compare(const Source& source, const Strings& backends, const std::vector<double>& resolutions,
                             const std::string& bodies, const Strings& wheel_backends, const Strings& rail_backends,
                             const py::object& progress, int threads) {
  using Bodies = app::CompareSettings::Bodies;
  app::CompareSettings settings;
  settings.backends = backends;
  settings.wheel_backends = wheel_backends;
  settings.rail_backends = rail_backends;
  if (!resolutions.empty()) settings.resolutions = resolutions;
  settings.bodies = bodies == "wheel"  ? Bodies::wheel
                    : bodies == "rail" ? Bodies::rail
                    : bodies == "both" ? Bodies::both
                                       : Bodies::automatic;
  settings.sample_surfaces = true;
  return with_progress(progress, threads, [&](const Progress& report) {
    auto result = std::make_shared<io::Comparison>(app::compare_cases(cases_of(source), settings, report));
    result->settings = source.overrides;
    return Held<io::Comparison>{std::move(result)};
  });
}

Held<app::BenchReport> bench(const std::optional<Source>& source, const Strings& overrides, const Strings& backends,
                             const std::vector<double>& resolutions, double seconds, const py::object& progress,
                             int threads) {
  app::BenchSettings settings;
  settings.backends = backends;
  settings.seconds_per_measure = seconds;
  if (!resolutions.empty()) settings.resolutions = resolutions;
  return with_progress(progress, threads, [&](const Progress& report) {
    io::CaseFile file = source ? cases_of(*source) : app::bench_case();
    if (!source) io::apply_overrides(file, overrides);
    auto result = std::make_shared<app::BenchReport>(app::bench_surfaces(file, settings, report));
    result->settings = source ? source->overrides : overrides;
    return Held<app::BenchReport>{std::move(result)};
  });
}

}  // namespace

io::CaseFile cases_of(const Source& source) {
  if (source.text) {
    io::CaseFile file = io::parse_case_text(*source.text, source.file, source.overrides);
    app::require_registered(file);
    return file;
  }
  if (io::is_study_file(source.file))
    throw Error(ErrorKind::configuration, "this is a study", {source.file.string(), 0, 0}, "use treadmark.sweep");
  if (io::is_simulation_file(source.file))
    throw Error(ErrorKind::configuration, "this is a simulation", {source.file.string(), 0, 0},
                "use treadmark.simulate");
  return app::read_registered_case(source.file, source.overrides);
}

void add_verbs(py::module_& module) {
  py::class_<Source>(module, "Source")
      .def(py::init(
          [](const std::filesystem::path& file, const std::optional<std::string>& text, const Strings& overrides) {
            return Source{file, text, overrides};
          }))
      .def_property_readonly("kind", kind_of);
  module.def("run", run_cases);
  module.def("check_cases", check_cases);
  module.def("check_profile", check_profile);
  module.def("position_svg", position_svg);
  module.def("compare", compare);
  module.def("bench", bench);

  using Comparison = Held<io::Comparison>;
  py::class_<Comparison>(module, "Comparison")
      .def_static("read_folder",
                  [](const std::filesystem::path& folder) {
                    return with_files(
                        [&] { return Comparison{std::make_shared<io::Comparison>(io::read_comparison(folder))}; });
                  })
      .def("json", [](const Comparison& c) { return io::to_json(*c.content); })
      .def("table", [](const Comparison& c) { return io::comparison_table(*c.content); })
      .def("cases",
           [](const Comparison& c, std::size_t candidate) {
             return to_python(c.content, c.content->candidates.at(candidate).results);
           })
      .def("pressures_svg", [](const Comparison& c) { return pictures::pressures_svg(*c.content); })
      .def("errors_svg", [](const Comparison& c) { return pictures::error_svg(*c.content); })
      .def("costs_svg", [](const Comparison& c) { return pictures::cost_svg(*c.content); })
      .def("write_json",
           [](const Comparison& c, const std::filesystem::path& file) { io::write_json(file, *c.content); })
      .def("write_csv", [](const Comparison& c, const std::filesystem::path& file) { io::write_csv(file, *c.content); })
      .def("write_folder", [](const Comparison& c, const std::filesystem::path& folder) {
        return with_files([&] { return app::write_comparison_folder(folder, *c.content); });
      });
  using Bench = Held<app::BenchReport>;
  py::class_<Bench>(module, "Bench")
      .def_static("read",
                  [](const std::filesystem::path& file) {
                    return Bench{std::make_shared<app::BenchReport>(app::read_bench(file))};
                  })
      .def("json", [](const Bench& b) { return app::bench_json(*b.content); })
      .def("table", [](const Bench& b) { return app::bench_table(*b.content); })
      .def("svg", [](const Bench& b) { return app::bench_svg(*b.content); })
      .def("write_folder",
           [](const Bench& b, const std::filesystem::path& folder) { app::write_bench_folder(folder, *b.content); });
}

}  // namespace treadmark::python
