// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "treadmark/app/evolve/contact_source.hpp"
#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/app/simulation/run_simulation.hpp"
#include "treadmark/app/simulation/study_identity.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

/// A number of the summary of a simulation, and how that of several positions follows from theirs.
struct SummaryRow {
  const char *key, *name, *unit, *meaning;
  double scale;
  double (*both)(double, double);
};
double more(double a, double b) { return std::max(a, b); }
double less(double a, double b) { return std::min(a, b); }
double sum(double a, double b) { return a + b; }
constexpr SummaryRow kSummaryRows[] = {
    {"q_max_N", "q_max_N", "N", "largest vertical force of a simulation", 1.0, more},
    {"q_min_N", "q_min_N", "N", "least vertical force of a simulation", 1.0, less},
    {"pmax_Pa", "simulated_pmax_MPa", "MPa", "largest pressure at all instants", 1e-6, more},
    {"contact_lost", "contact_lost", "1", "how often a wheel lost contact", 1.0, sum},
    {"doubtful_steps", "doubtful_steps", "1", "steps of simulations with a warning about the contact", 1.0, sum}};

double summary_value(const io::SimulationResult& result, std::string_view name) {
  const auto row = ranges::find(result.summary, name, &io::NamedValue::name);
  return row == result.summary.end() ? 0.0 : row->value;
}

class SimulatedContacts : public ContactSource {
 public:
  SimulatedContacts(const io::EvolutionFile& file, const std::vector<std::string>& settings)
      : file_(file), settings_(settings) {
    for (const io::StudyRun& run : file.positions.runs) {
      runs_.push_back(std::get<io::SimulationFile>(io::read_study_run(file.positions, run)));
      check(runs_.back());
    }
  }

  GivenBody given(const io::EvolvingBody& input) override {
    SurfaceStore store;
    return input.body == Body::wheel ? given_wheel(store, input) : given_rail(store, input);
  }

  PassedContacts solve(const std::vector<NaturalSurface>& surfaces, const Progress& progress) override {
    PassedContacts out;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      const io::SimulationFile& run = runs_[k];
      SurfaceStore store;
      for (std::size_t b = 0; b < surfaces.size(); ++b) {
        const bool wheel = file_.bodies[b].body == Body::wheel;
        store.put(wheel ? run.contact.wheel : run.rail(first_passing(run)->side), file_.bodies[b].body,
                  wheel ? radius_of(run) : 0.0, std::make_shared<const NaturalSurface>(surfaces[b]));
      }
      SimulationOptions options;
      options.settings = settings_;
      options.swept = swept_of(file_.positions, file_.positions.runs[k]);
      options.tables = &tables_;
      Progress inner;
      inner.stop = progress.stop;
      io::SimulationResult result = run_simulation(runs_[k], store, options, inner);
      if (result.status == "interrupted") throw Cancelled();
      if (result.status != "complete")
        throw Error(ErrorKind::numerical,
                    fmt::format("position {}: {}: {}", position_label(file_, file_.positions.runs[k]), result.status,
                                result.message));
      take(out, k, result, store);
      out.simulations.push_back(std::move(result));
    }
    for (const SummaryRow& row : kSummaryRows) {
      double all = summary_value(out.simulations.front(), row.key);
      for (const io::SimulationResult& s : out.simulations) {
        if (&s != out.simulations.data()) all = row.both(all, summary_value(s, row.key));
      }
      out.numbers.push_back({row.name, row.unit, row.meaning, row.scale * all});
    }
    out.run.cases_total = static_cast<int>(out.run.cases.size());
    return out;
  }

 private:
  GivenBody given_wheel(SurfaceStore& store, const io::EvolvingBody& input) const {
    GivenBody body;
    body.radius = radius_of(runs_.front());
    body.surface = natural_of(store, runs_.front(), true);
    for (const io::SimulationFile& run : runs_) {
      if (const auto other = ranges::find_if(
              run.wheels, [&](const auto& w) { return passes(w) && run.wheel_radius(w.wheelset) != radius_of(run); });
          other != run.wheels.end())
        throw Error(ErrorKind::configuration,
                    fmt::format("wheels of {:.6g} mm and of {:.6g} mm evolve, which are no single surface",
                                1e3 * radius_of(run), 1e3 * run.wheel_radius(other->wheelset)),
                    run.contact.wheel.where, "let wheels of one radius evolve: the others with defects = false");
      if (natural_of(store, run, true) != body.surface || radius_of(run) != body.radius)
        throw Error(ErrorKind::configuration, "the positions have different wheels, which evolve",
                    run.contact.wheel.where, "what evolves is one surface; vary the other body");
      if (!ranges::all_of(run.wheels, [&](const auto& wheel) { return passes(wheel); }) &&
          natural_of(store, run, false) == body.surface)
        throw Error(ErrorKind::configuration, "the wheel that evolves is that of the other wheels too", input.where,
                    "give it a defect of its own, or let all wheels evolve (contact = \"full\")");
      check_vehicle(run, store);
    }
    return body;
  }

  /// The rail below the wheels that pass, of all positions.
  GivenBody given_rail(SurfaceStore& store, const io::EvolvingBody& input) const {
    GivenBody body;
    body.x_min = std::numeric_limits<double>::max(), body.x_max = -body.x_min;
    for (const io::SimulationFile& run : runs_) {
      for (const io::WheelContactInput& wheel : run.wheels) {
        const io::SurfaceSource& source = run.rail(wheel.side);
        if (passes(wheel)) {
          const auto rail = natural_of(store, source, Body::rail, 0.0);
          if (body.surface == nullptr) body.surface = rail;
          if (rail != body.surface)
            throw Error(ErrorKind::configuration,
                        "wheels with full contact pass over different rails, of which one evolves", source.where,
                        "let only wheels of one side have full contact, or give both sides one rail");
          const double begin = rail_place(run, wheel.wheelset);
          body.x_min = std::min(body.x_min, begin);
          body.x_max = std::max(body.x_max, begin + run.settings.distance);
        }
      }
      for (const io::WheelContactInput& wheel : run.wheels) {
        io::SurfaceSource sound = run.rail(wheel.side);
        sound.defects = {};
        if ((wheel.model != io::ContactModelInput::full || wheel.changes_over()) &&
            natural_of(store, sound, Body::rail, 0.0) == body.surface)
          throw Error(ErrorKind::configuration, "the rail that evolves is also used by tables of contact", input.where,
                      "give every wheel contact = \"full\", or the other side a rail of its own");
      }
      check_vehicle(run, store);
    }
    return body;
  }

  /// What an evolution asks of a simulation.
  void check(const io::SimulationFile& run) const {
    const SourcePosition where{run.path.string()};
    const auto first = ranges::find(run.wheels, io::ContactModelInput::full, &io::WheelContactInput::model);
    if (first == run.wheels.end() || !passes(*first))
      throw Error(ErrorKind::configuration, "the first wheel with full contact must be one that evolves", where,
                  "give it contact = \"full\", and leave defects = false to the others");
    const bool local_wheel = wheel_evolves() && file_.bodies.front().local;
    if (run.fields.pitch.empty() && (local_wheel || run.fields.position.empty()))
      throw Error(ErrorKind::configuration,
                  fmt::format("the simulation keeps no contacts that could change the {}",
                              body_name(file_.bodies.front().body)),
                  where,
                  local_wheel ? "name the angles of the places in [simulation.fields] pitch_deg"
                              : "name instants in [simulation.fields]: pitch_deg or position_m");
    if (local_wheel && run.settings.distance > 2.0 * kPi * radius_of(run))
      throw Error(ErrorKind::configuration, "the wheel makes more than one turn: its places would count twice", where,
                  "let the simulation end within one turn (simulation.distance_m)");
  }

  bool wheel_evolves() const { return file_.bodies.front().body == Body::wheel; }

  /// Whether the contacts of a wheel count: it evolves, or the rail below it.
  bool passes(const io::WheelContactInput& wheel) const {
    return wheel.model == io::ContactModelInput::full && (wheel.defects || !wheel_evolves());
  }
  std::vector<io::WheelContactInput>::const_iterator first_passing(const io::SimulationFile& run) const {
    return ranges::find_if(run.wheels, [this](const auto& wheel) { return passes(wheel); });
  }

  /// Nominal one of the wheels that pass first [m].
  double radius_of(const io::SimulationFile& run) const { return run.wheel_radius(first_passing(run)->wheelset); }

  static std::shared_ptr<const NaturalSurface> natural_of(SurfaceStore& store, io::SurfaceSource source, Body body,
                                                          double radius) {
    source.backend.clear();
    source.resolution = 0.0;
    return store.get(source, body, radius, {}).natural;
  }

  /// Of the wheels that evolve, or of the others as if they had that radius.
  std::shared_ptr<const NaturalSurface> natural_of(SurfaceStore& store, const io::SimulationFile& run,
                                                   bool evolving) const {
    io::WheelContactInput wheel;
    wheel.defects = evolving;
    return natural_of(store, wheel_source(run, wheel), Body::wheel, radius_of(run));
  }

  /// The instants of the wheels that evolve: those of a wheel share its weight.
  void take(PassedContacts& out, std::size_t k, const io::SimulationResult& result, SurfaceStore& store) const {
    const io::SimulationFile& run = runs_[k];
    const auto wheels = ranges::count_if(run.wheels, [this](const auto& w) { return passes(w); });
    for (std::size_t wheel = 0; wheel < run.wheels.size(); ++wheel) {
      if (!passes(run.wheels[wheel])) continue;
      const std::size_t first = out.passed.size();
      const double weight = file_.weights[k] / static_cast<double>(wheels);
      io::WheelRailCase input = contact_input(run, run.wheels[wheel]);
      meet_rail(out.rails, input, store.get(run.rail(run.wheels[wheel].side), Body::rail, 0.0, {}).natural->surface,
                weight);
      for (std::size_t i = 0; i < result.snapshots.cases.size(); ++i) {
        if (result.snapshot_scenes[i].wheel != wheel) continue;
        const io::CaseResult& c = result.snapshots.cases[i];
        if (c.status != Status::ok && c.status != Status::no_contact)
          throw Error(ErrorKind::numerical, fmt::format("{}: {}", to_string(c.status), c.message));
        input.state.position.x = c.s, input.state.position.pitch = c.pitch;
        out.run.cases.push_back(c);
        out.run.cases.back().wheel_surface.clear();  // the simulation keeps the surfaces that it sampled
        out.run.cases.back().rail_surface.clear();
        PassedCase& passed = out.passed.emplace_back();
        passed.given.number = out.run.cases.back().number = static_cast<int>(out.run.cases.size());
        passed.given.content = input;
        passed.given.where = {run.path.string()};
        passed.label = position_label(file_, file_.positions.runs[k]);
        passed.run = file_.positions.runs[k].number;
        passed.number = static_cast<int>(out.passed.size() - first);
        passed.weight = weight;
      }
      const std::size_t count = out.passed.size() - first;
      for (std::size_t i = first; i < out.passed.size(); ++i) out.passed[i].beside = static_cast<int>(count);
      place_along_bodies(file_, out.passed, first, count);
    }
  }

  const io::EvolutionFile& file_;
  const std::vector<std::string>& settings_;
  std::vector<io::SimulationFile> runs_;
  ContactTables tables_;
};

}  // namespace

std::unique_ptr<ContactSource> simulated_contacts(const io::EvolutionFile& file,
                                                  const std::vector<std::string>& settings) {
  return std::make_unique<SimulatedContacts>(file, settings);
}

}  // namespace treadmark::app
