// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/compare/compare_cases.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/detection/detector.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/results/summary.hpp"

namespace treadmark::app {
namespace {

using Clock = std::chrono::steady_clock;
using Bodies = CompareSettings::Bodies;

/// How wheel and rail are represented; no value = as given.
struct Choice {
  std::string name;
  double resolution = 0.0;
  std::optional<std::string> wheel, rail;
  std::string detector{};  ///< empty: as given
};

void require_known(const std::vector<std::string>& backends) {
  for (const std::string& name : backends) require_backend(name);
}

/// Which bodies of the file are compared.
struct Compared {
  bool wheel = false, rail = false;
};

Compared compared_bodies(const NaturalSurface& wheel, const NaturalSurface& rail, const CompareSettings& settings) {
  if (settings.bodies == Bodies::wheel) return {true, false};
  if (settings.bodies == Bodies::rail) return {false, true};
  const Compared varying{!wheel.constant_profile(), !rail.constant_profile()};
  if (settings.bodies == Bodies::both || (!varying.wheel && !varying.rail)) return {true, true};
  return varying;
}

std::vector<Choice> choices(const NaturalSurface& wheel, const NaturalSurface& rail, const CompareSettings& settings) {
  std::vector<Choice> all;
  if (!settings.detectors.empty()) {
    for (const std::string& name : settings.detectors) all.push_back({name, 0.0, {}, {}, name});
    return all;
  }
  if (!settings.wheel_backends.empty() || !settings.rail_backends.empty()) {
    const std::vector<std::string> as_given{""};
    for (const std::string& w : settings.wheel_backends.empty() ? as_given : settings.wheel_backends)
      for (const std::string& r : settings.rail_backends.empty() ? as_given : settings.rail_backends)
        for (const double resolution : settings.resolutions)
          all.push_back({fmt::format("{}+{}", w.empty() ? "given" : w, r.empty() ? "given" : r), resolution, w, r});
    return all;
  }
  const Compared compared = compared_bodies(wheel, rail, settings);
  std::vector<const NaturalSurface*> surfaces;
  if (compared.wheel) surfaces.push_back(&wheel);
  if (compared.rail) surfaces.push_back(&rail);
  for (const auto& [name, resolution] : backend_choices(settings.backends, settings.resolutions, surfaces)) {
    const std::optional<std::string> chosen = name;
    all.push_back({name, resolution, compared.wheel ? chosen : std::nullopt, compared.rail ? chosen : std::nullopt});
  }
  return all;
}

io::CaseFile with(io::CaseFile file, const Choice& choice) {
  for (io::Case& c : file.cases) {
    auto* input = std::get_if<io::WheelRailCase>(&c.content);
    if (input == nullptr) continue;
    const auto apply = [&](io::SurfaceSource& source, const std::optional<std::string>& backend) {
      source.backend = backend.value_or("");
      const bool sampled = !source.backend.empty() && backend_of(source.backend).resample;
      source.resolution = sampled ? choice.resolution : 0.0;
    };
    if (!choice.detector.empty()) {
      input->discretisation.detector = choice.detector;
      continue;
    }
    apply(input->wheel, choice.wheel);
    apply(input->rail, choice.rail);
  }
  return file;
}

bool elements_chosen(const io::CaseFile& file) {
  return ranges::any_of(file.cases, [](const io::Case& c) {
    const auto* input = std::get_if<io::WheelRailCase>(&c.content);
    return input != nullptr && (input->discretisation.choose_dx || input->discretisation.choose_ds);
  });
}

/// Every case on the elements that its smallest patch got: representations are not told apart by elements.
io::CaseFile on_elements_of(const io::RunResult& run, io::CaseFile file) {
  for (std::size_t i = 0; i < std::min(file.cases.size(), run.cases.size()); ++i) {
    auto* input = std::get_if<io::WheelRailCase>(&file.cases[i].content);
    if (input == nullptr || run.cases[i].patches.empty()) continue;
    io::DiscretisationInput& d = input->discretisation;
    const auto settle = [&](bool& chosen, double& side, double Grid2::*of) {
      if (!std::exchange(chosen, false)) return;
      side = kInfinity;
      for (const io::PatchResult& patch : run.cases[i].patches) side = std::min(side, patch.fields.grid.*of);
    };
    settle(d.choose_dx, d.dx, &Grid2::dx);
    settle(d.choose_ds, d.ds, &Grid2::dy);
  }
  return file;
}

const io::PatchResult* main_patch(const io::CaseResult& result) {
  const io::PatchResult* main = nullptr;
  for (const io::PatchResult& patch : result.patches)
    if (main == nullptr || patch.fn > main->fn) main = &patch;
  return main;
}

io::ComparisonRow row_of(const io::CaseResult& result) {
  io::ComparisonRow row;
  row.case_number = result.number;
  row.status = result.status;
  row.message = io::words(result);
  row.patches = static_cast<int>(result.patches.size());
  row.search_s = result.search_s;
  row.distance_s = result.distance_s;
  if (const io::PatchResult* p = main_patch(result)) {
    row.pmax = p->pmax;
    row.fn = p->fn;
    row.fx = p->fx;
    row.fs = p->fs;
    row.x_tr = p->x_tr;
    row.y_tr = p->y_tr;
    row.approach = p->approach;
    row.ncon = p->ncon;
    row.area = p->ncon * p->fields.grid.cell_area();
  }
  return row;
}

/// Standard deviation of the largest pressure of the main patch [Pa]; NaN: not known.
double pmax_deviation(const io::CaseResult& result) {
  if (!result.uncertainty) return kNaN;
  const std::string name = fmt::format("patch_{}.pmax_MPa", 1 + (main_patch(result) - result.patches.data()));
  for (const io::CaseUncertainty::Number& number : result.uncertainty->numbers)
    if (number.name == name) return number.sigma > 0.0 ? number.sigma / kMega : kNaN;
  return kNaN;
}

double relative(double value, double truth) { return truth == 0.0 ? 0.0 : (value - truth) / truth; }

/// Whether the largest pressure of the main patch grows with smaller elements: no error of a representation.
bool without_limit(const io::CaseResult& result) {
  const int number = 1 + static_cast<int>(main_patch(result) - result.patches.data());
  return ranges::any_of(result.remarks,
                        [number](const Remark& r) { return r.kind == RemarkKind::edge_pressure && r.patch == number; });
}

void compare(io::ComparisonRow& row, const io::CaseResult& result, const io::ComparisonRow& truth,
             const io::CaseResult& true_result) {
  const bool solved = result.status == Status::ok || result.status == Status::not_converged;
  row.comparable = solved && row.patches > 0 && truth.patches > 0;
  if (!row.comparable) return;
  row.pmax_error = without_limit(true_result) ? kNaN : relative(row.pmax, truth.pmax);
  row.pmax_sigmas = (row.pmax - truth.pmax) / pmax_deviation(true_result);
  row.mean_pressure_error = relative(row.fn / row.area, truth.fn / truth.area);
  row.area_error = relative(row.area, truth.area);
  row.approach_error = relative(row.approach, truth.approach);
  row.position_error = std::hypot(row.x_tr - truth.x_tr, row.y_tr - truth.y_tr);
  row.force_error = (result.force_tr - true_result.force_tr).norm() / true_result.force_tr.norm();
}

io::RepresentedBody body_of(const std::vector<io::SurfaceUse>& uses, std::string_view body) {
  io::RepresentedBody out;
  for (const io::SurfaceUse& use : uses) {
    if (use.body != body) continue;
    if (out.backend.empty()) {
      out = {use.backend, use.resolution, use.build_seconds, use.memory_bytes, use.fit, use.note};
      continue;
    }
    // one a case: the worst of them
    out.build_seconds += use.build_seconds;
    if (use.fit.height_max > out.difference.height_max) out.difference = use.fit, out.note = use.note;
  }
  return out;
}

void add_note(std::string& note, const std::string& more) { note += (note.empty() || more.empty() ? "" : "; ") + more; }

io::ComparisonCandidate candidate_of(const Choice& choice, const io::RunResult& run,
                                     const io::ComparisonCandidate* truth) {
  io::ComparisonCandidate c;
  c.name = choice.name;
  c.wheel = body_of(run.surfaces, "wheel");
  c.rail = body_of(run.surfaces, "rail");
  c.resolution = choice.resolution;
  c.results = run.cases;
  for (const io::CaseResult& result : run.cases) c.rows.push_back(row_of(result));
  if (truth == nullptr) return c;
  for (std::size_t i = 0; i < std::min(c.rows.size(), truth->rows.size()); ++i)
    compare(c.rows[i], c.results[i], truth->rows[i], truth->results[i]);
  return c;
}

}  // namespace

io::Comparison compare_cases(const io::CaseFile& file, const CompareSettings& settings, const Progress& progress) {
  const auto start = Clock::now();
  const io::WheelRailCase* first = first_wheelrail_case(file);
  if (first == nullptr)
    throw Error(ErrorKind::configuration, "there is no case of a wheel on a rail to be compared", {file.path.string()});
  require_known(settings.backends);
  require_known(settings.wheel_backends);
  require_known(settings.rail_backends);
  for (const std::string& name : settings.detectors) detection::detector_of(name);
  for (const double resolution : settings.resolutions)
    if (!(resolution > 0.0) || !std::isfinite(resolution))
      throw Error(ErrorKind::configuration, "resolutions must be positive");

  SurfaceStore store;
  const SampledRegions regions = sampled_regions(file);
  const auto natural = [&](io::SurfaceSource source, Body body, const Region& region) -> const NaturalSurface& {
    source.backend.clear();
    source.resolution = 0.0;
    return *store.get(source, body, profile_radius(*first, body), region).natural;
  };
  const NaturalSurface& wheel = natural(first->wheel, Body::wheel, regions.wheel);
  const NaturalSurface& rail = natural(first->rail, Body::rail, regions.rail);

  io::Comparison out;
  out.truth = wheel.surface->backend() == rail.surface->backend()
                  ? std::string(wheel.surface->backend())
                  : fmt::format("wheel {}, rail {}", wheel.surface->backend(), rail.surface->backend());
  std::vector<Choice> wanted = choices(wheel, rail, settings);
  wanted.insert(wanted.begin(), Choice{out.truth, 0.0, {}, {}});
  const auto is_truth = [&](const Choice& c) {
    return c.detector.empty() && c.resolution == 0.0 &&
           c.wheel.value_or(std::string(wheel.surface->backend())) == wheel.surface->backend() &&
           c.rail.value_or(std::string(rail.surface->backend())) == rail.surface->backend();
  };
  wanted.erase(std::remove_if(wanted.begin() + 1, wanted.end(), is_truth), wanted.end());

  // of combinations each surface comes up again
  const bool come_up_again = !settings.wheel_backends.empty() || !settings.rail_backends.empty();
  const std::size_t total = wanted.size() * file.cases.size();
  std::size_t done = 0;
  Progress silent;
  silent.stop = progress.stop;
  const io::CaseFile cases =
      elements_chosen(file)
          ? on_elements_of(run_cases(without_error_bars(with(file, wanted.front())), store, silent), file)
          : file;
  for (const Choice& choice : wanted) {
    if (progress.stop_requested()) {
      out.complete = false;
      break;
    }
    const bool is_first = out.candidates.empty();
    const std::string name =
        choice.resolution > 0.0 ? fmt::format("{} {:g} mm", choice.name, 1e3 * choice.resolution) : choice.name;
    Progress inner = progress;
    if (progress.report)
      inner.report = [&](std::size_t finished, std::size_t, const std::string& what) {
        progress.report(done + finished, total, fmt::format("{}, {}", name, what));
      };
    std::string wheel_breaks, rail_breaks;
    try {
      const io::CaseFile represented = with(cases, choice);
      const io::WheelRailCase& one = *first_wheelrail_case(represented);
      const SampledRegions about = regions_of(one, regions);
      if (choice.detector.empty()) {
        const CancellationScope scope(progress.stop);  // not of what follows: what is solved is kept
        wheel_breaks = conformance::broken_promise(seen_body(one, store, Body::wheel, about.wheel));
        rail_breaks = conformance::broken_promise(seen_body(one, store, Body::rail, about.rail));
      }
      // error bars are those of the reference
      const io::RunResult run = run_cases(is_first ? represented : without_error_bars(represented), store, inner);
      if (!run.complete) {
        out.complete = false;
        break;
      }
      out.candidates.push_back(candidate_of(choice, run, is_first ? nullptr : &out.candidates.front()));
      if (is_first) {
        out.version = run.version;
        out.git = run.git;
        out.threads = run.threads;
        for (io::ComparisonRow& row : out.candidates.front().rows) row.comparable = row.patches > 0;
        if (settings.sample_surfaces) {
          io::ComparisonCandidate& truth = out.candidates.front();
          truth.surfaces = sample_surfaces(truth.results, used_bodies(represented, truth.results, store));
        }
      }
    } catch (const Cancelled&) {
      out.complete = false;
      break;
    } catch (const Error& e) {
      if (is_first) throw;
      io::ComparisonCandidate failed;
      failed.name = choice.name;
      failed.resolution = choice.resolution;
      failed.failure = e.what();
      out.candidates.push_back(std::move(failed));
    }
    add_note(out.candidates.back().wheel.note, wheel_breaks);
    add_note(out.candidates.back().rail.note, rail_breaks);
    done += file.cases.size();
    if (!come_up_again) store.forget_sampled();
  }
  out.title = file.title;
  out.input_file = file.path.string();
  out.input_sha256 = file.sha256;
  out.inputs = io::inputs_of(file.cases, file.path.parent_path());
  out.geometry_sha256 = store.hashes();
  out.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return out;
}

}  // namespace treadmark::app
