// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/evolve/run_evolution.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "treadmark/analysis/damage/record.hpp"
#include "treadmark/app/evolve/contact_source.hpp"
#include "treadmark/app/evolve/evolution_vtk.hpp"
#include "treadmark/app/evolve/passed_patches.hpp"
#include "treadmark/app/simulation/file_lock.hpp"
#include "treadmark/app/simulation/study_identity.hpp"
#include "treadmark/app/version.hpp"
#include "treadmark/backends/added_offsets.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/histories/evolution_store.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/results/subsurface_table.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/io/simulations/read_study.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;

constexpr double kSteepest = 0.5;  // slope of the depth across that an update may add [-]
constexpr double kRailEnds = 0.6;  // of offsets on a rail beyond its contacts [m]

/// A body that evolves, with what it was.
struct Evolving {
  io::EvolvingBody input;
  GivenBody given;
  SurfaceCells cells;
  double half_length = 0.0;  ///< of offsets on a rail [m]
  bool measured = false;     ///< a wheel with the numbers of workshops
};

class EvolutionRun {
 public:
  EvolutionRun(const io::EvolutionFile& file, const EvolutionOptions& options, const Progress& progress)
      : file_(file),
        options_(options),
        progress_(progress),
        source_(file.positions.base_is_simulation ? simulated_contacts(file, options.settings) : case_contacts(file)) {
    bodies_.reserve(file.bodies.size());
    for (const io::EvolvingBody& body : file.bodies) bodies_.push_back(prepare(body));
  }

  /// See write_evolution_vtk.
  void write_vtk(const fs::path& folder) const {
    const fs::path out = folder / "vtk";
    fs::create_directories(out);
    std::string entries;
    for (int number = 0; fs::exists(folder / io::generation_file(number)); ++number) {
      const io::Generation g = io::read_generation(folder / io::generation_file(number));
      for (std::size_t b = 0; b < bodies_.size(); ++b) {
        const io::EvolvedBody& body = g.bodies[b];
        const std::string text = evolved_surface_vts(*evolved(bodies_[b], body.record).surface, body);
        if (text.empty()) continue;
        const std::string name = fmt::format("{}_{:04}.vts", body_name(body.body), number);
        write_file(out / name, text);
        entries += io::vtk_entry(g.distance > 0.0 ? 1e-3 * g.distance : g.passages, static_cast<int>(b), name);
      }
    }
    write_file(out / "evolution.pvd", io::vtk_collection(entries));
  }

  io::EvolutionResult run() {
    io::EvolutionResult result = head();
    result.generations = io::read_evolution_folder(options_.folder).generations;
    try {
      const CancellationScope scope(progress_.stop);
      evolve(result);
    } catch (const Cancelled&) {
      result.status = "interrupted";
      result.message = "stopped; the same command goes on";
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::numerical || result.generations.empty()) throw;
      result.status = "failed";
      result.message = e.what();
    }
    return result;
  }

 private:
  using Records = std::vector<SurfaceRecord>;

  io::EvolutionResult head() const {
    io::EvolutionResult result;
    result.version = version();
    result.git = git_revision();
    result.input_file = file_.positions.path.filename().string();
    result.input_sha256 = file_.positions.sha256;
    result.inputs = io::inputs_of(file_.positions);
    result.title = file_.positions.title;
    result.settings = options_.settings;
    for (const io::EvolvingBody& body : file_.bodies)
      for (const auto& [unverified, source] :
           {std::pair(body.law.unverified, body.law.source), {body.fatigue.unverified, body.fatigue.source}})
        if (unverified)
          result.remarks.push_back(
              {RemarkKind::unverified_law, 0, fmt::format("law of the {}: {}", body_name(body.body), source)});
    return result;
  }

  Evolving prepare(const io::EvolvingBody& input) {
    Evolving body;
    body.input = input;
    body.given = source_->given(input);
    const GivenBody& given = body.given;
    body.half_length = std::max(-given.x_min, given.x_max) + kRailEnds;
    damage::CellSettings cells{!input.local, input.du, input.dy, given.x_min - kRailEnds, given.x_max + kRailEnds};
    if (input.body == Body::rail && !input.local && !given.surface->constant_profile())
      throw Error(ErrorKind::configuration, "the rail changes along the track", input.where,
                  "let it evolve with along = \"local\"");
    body.cells = damage::make_cells(*given.surface->surface, input.body, given.radius, cells);
    body.measured = input.body == Body::wheel && !input.local && is_measurable(*given.surface->surface, given.radius);
    return body;
  }

  OffsetMap map_of(const Evolving& body, const SurfaceRecord& record) const {
    return damage::offsets_of(body.cells, record.volume, body.half_length, body_name(body.input.body));
  }

  NaturalSurface evolved(const Evolving& body, const SurfaceRecord& record) const {
    if (record.volume.rows().empty()) return *body.given.surface;
    return add_offsets(*body.given.surface, map_of(body, record));
  }

  /// Surfaces as records leave them, by body, and the contacts over them.
  struct Solved {
    std::vector<NaturalSurface> surfaces;
    PassedContacts contacts;
    std::vector<std::vector<std::vector<damage::PassedPatch>>> patches;  ///< by body and case
  };

  Solved solve(const Records& records) {
    Solved solved;
    solved.surfaces.reserve(bodies_.size());
    for (std::size_t b = 0; b < bodies_.size(); ++b) solved.surfaces.push_back(evolved(bodies_[b], records[b]));
    solved.contacts = source_->solve(solved.surfaces, progress_);
    for (const Evolving& body : bodies_) {
      auto& of_body = solved.patches.emplace_back();
      for (std::size_t i = 0; i < solved.contacts.passed.size(); ++i)
        of_body.push_back(passed_patches(solved.contacts.passed[i].given, solved.contacts.run.cases[i], body.input.body,
                                         body.input.fatigue));
    }
    return solved;
  }

  /// Whether a case is the last one of its wheel in its position.
  static bool ends_position(const std::vector<PassedCase>& passed, std::size_t i) {
    return i + 1 == passed.size() || passed[i + 1].run != passed[i].run || passed[i + 1].number <= passed[i].number;
  }

  static SurfaceRecord empty_record(const Evolving& body) {
    return SurfaceRecord(body.cells.nu, body.input.fatigue.depths.size(), body.input.flow.depths.size());
  }

  io::EvolvedFatigue fatigue_of(const FatigueSettings& known,
                                const std::vector<std::vector<damage::PassedPatch>>& cases) const {
    io::EvolvedFatigue out{known, {}};
    if (known.measures.empty()) return out;
    for (const auto& patches : cases) {
      ContactFatigue& all = out.contacts.emplace_back();
      for (const damage::PassedPatch& patch : patches) {
        if (&patch == patches.data()) all = patch.fatigue;
        for (const Column<ContactFatigue>& number : columns<ContactFatigue>())
          number.access.put(all, std::max(number.access.get(all), number.access.get(patch.fatigue)));
      }
    }
    return out;
  }

  /// What the whole amount would do at this speed, the volumes smoothed, to bodies that have endured their records.
  Records rates_of(Solved& solved, const std::vector<io::EvolvedBody>& present) const {
    const std::vector<io::CaseResult>& cases = solved.contacts.run.cases;
    Records rates;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const Evolving& body = bodies_[b];
      SurfaceRecord rate = empty_record(body);
      damage::MaterialFlow flow(body.cells, body.input.flow, present[b].record);
      for (std::size_t i = 0; i < cases.size(); ++i) {
        const PassedCase& place = solved.contacts.passed[i];
        const damage::Stretch& stretch = place.stretch[b];
        const bool wheel = body.input.body == Body::wheel;
        const double speed = std::fabs(cases[i].vs), turns = std::fabs(cases[i].vpitch) / (2.0 * kPi);
        if (!(speed > 0.0) || !(turns > 0.0))
          throw Error(ErrorKind::configuration, "the wheelset of a case of an evolution must move and turn",
                      place.given.where, "give wheelset.velocity_m_s and wheelset.vpitch_rad_s");
        // time for which the contacts of this case run, all in all, and passages over a point
        double seconds = body.input.amount / speed * place.weight, count = seconds * (wheel ? turns : speed);
        const double passages = body.input.local ? count : count / place.beside;
        if (!body.input.local) {
          seconds /= place.beside;
          count /= place.beside;
        } else {
          seconds *= (stretch.end - stretch.begin) / (wheel ? 2.0 * kPi : 1.0);
        }
        auto& patches = solved.patches[b][i];
        add_stresses(patches, place.given, cases[i], body.input.body, body.input.fatigue);
        for (const damage::PassedPatch& patch : patches)
          damage::add_patch(rate, body.cells, body.input.law, patch, stretch, seconds, count);
        if (body.input.flow.theory == FlowTheory::none) continue;
        for (std::size_t k = 0; k < patches.size(); ++k)
          flow.meet(passed_shears(place.given, cases[i], k, body.input.body, body.input.flow),
                    {patches[k].length, patches[k].width}, stretch);
        // the places of a body that differs along are met in one passage
        if (!body.input.local || ends_position(solved.contacts.passed, i)) flow.end_passage(rate, passages);
      }
      flow.displace(rate);
      damage::smooth(rate.volume, body.cells, body.input.smoothing);
      rates.push_back(std::move(rate));
    }
    return rates;
  }

  /// Takes the records over: there is one copy of each generation.
  io::Generation generation_of(const Solved& solved, Records&& records) const {
    io::Generation g;
    g.numbers = solved.contacts.numbers;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const Evolving& body = bodies_[b];
      io::EvolvedBody& out = g.bodies.emplace_back();
      out.body = body.input.body;
      out.law = kWearTheories[static_cast<std::size_t>(body.input.law.theory)].word;
      out.source = body.input.law.source;
      out.cells = body.cells;
      out.fatigue = fatigue_of(body.input.fatigue, solved.patches[b]);
      const damage::DepthExtent extent = damage::depth_extent(body.cells, records[b].volume);
      out.record = std::move(records[b]);
      if (body.input.flow.theory != FlowTheory::none)
        out.flow = {std::string(flow_row(body.input.flow.theory).word), body.input.flow.source, body.input.flow.depths,
                    extent.raised};
      out.max_depth = extent.depth;
      out.max_slope = extent.slope;
      std::vector<Vec2> points;
      points.reserve(static_cast<std::size_t>(body.cells.ny));
      for (int j = 0; j < body.cells.ny; ++j) points.emplace_back(0.0, body.cells.y(j));
      out.z.resize(points.size());
      solved.surfaces[b].surface->heights_at(Pose{}, points, {out.z, {}, {}});
      for (double& z : out.z) z -= body.input.body == Body::wheel ? body.given.radius : 0.0;
      if (body.measured)
        out.numbers = wheel_numbers(*solved.surfaces[b].surface, body.given.radius, solved.contacts.rails);
    }
    for (std::size_t i = 0; i < solved.contacts.passed.size(); ++i) {
      const io::CaseResult& c = solved.contacts.run.cases[i];
      const PassedCase& place = solved.contacts.passed[i];
      io::EvolvedCase& out = g.cases.emplace_back();
      out.run = place.run;
      out.number = place.number;
      out.label = place.label;
      out.status = to_string(c.status);
      out.weight = place.weight / place.beside;
      out.patches = static_cast<int>(c.patches.size());
      out.remarks = static_cast<int>(c.remarks.size());
      out.doubts = static_cast<int>(ranges::count_if(c.remarks, [](const Remark& r) { return r.grave(); }));
      for (const io::PatchResult& p : c.patches) {
        out.fn += p.fn, out.fx += p.fx, out.fs += p.fs;
        out.pmax = std::max(out.pmax, p.pmax);
        if (p.velocity > 0.0) out.t_gamma += std::max(0.0, -p.frictional_power) / p.velocity;
      }
    }
    return g;
  }

  void write(io::Generation& g, const PassedContacts& contacts) const {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      const Evolving& body = bodies_[b];
      const SurfaceRecord& record = g.bodies[b].record;
      if (record.volume.rows().empty()) continue;
      g.bodies[b].surface_file = fmt::format("{}_{:04}.vdb", body_name(body.input.body), g.number);
      Representation wanted{"offset", std::min(body.cells.dy, body.input.du), {}};
      if (body.input.body == Body::rail)
        wanted.region.u_min = -body.half_length, wanted.region.u_max = body.half_length;
      write_added_offsets(options_.folder / g.bodies[b].surface_file, *body.given.surface, map_of(body, record), wanted,
                          fmt::format("{}, generation {}", file_.positions.title, g.number));
    }
    if (file_.fields_every > 0 && g.number % file_.fields_every == 0) {
      for (std::size_t k = 0; k < contacts.simulations.size(); ++k)
        io::write_simulation(options_.folder / io::simulation_file(g.number, k, contacts.simulations.size()),
                             contacts.simulations[k]);
      io::RunResult run = contacts.run;
      run.threads = 0, run.seconds = 0.0;  // equal results give equal bytes
      for (io::CaseResult& c : run.cases) c.seconds = c.search_s = c.distance_s = c.normal_s = c.tangential_s = 0.0;
      run.settings = options_.settings;
      io::write_hdf5(options_.folder / io::contacts_file(g.number), run);
    }
    io::write_generation(options_.folder / io::generation_file(g.number), g);
  }

  void report(const io::Generation& g) const {
    constexpr std::size_t kParts = 1000;
    if (progress_.report)
      progress_.report(to_whole<std::size_t>(std::round(kParts * g.progress)), kParts,
                       fmt::format("generation {}", g.number));
  }

  /// Of every case; of every position where contacts are instants of simulations, which come at other moments.
  std::map<int, double> pressures(const io::Generation& g) const {
    std::map<int, double> out;
    int number = 0;
    for (const io::EvolvedCase& c : g.cases) {
      double& largest = out[file_.positions.base_is_simulation ? c.run : number++];
      largest = std::max(largest, c.pmax);
    }
    return out;
  }

  double pressure_change(const io::Generation& before, const io::Generation& after) const {
    double change = 0.0;
    const std::map<int, double> now = pressures(after);
    for (const auto& [key, pressure] : pressures(before))
      change = std::max(change, std::fabs(now.at(key) / pressure - 1.0));
    return change;
  }

  void check_update(const Evolving& body, const SurfaceRecord& update) const {
    const damage::DepthExtent extent = damage::depth_extent(body.cells, update.volume);
    if (const double slope = std::max(extent.slope, extent.slope_along); slope > kSteepest)
      throw Error(ErrorKind::numerical,
                  fmt::format("an update of the {} changes {:.3g} mm with slopes of {:.2g}: the surface would fold",
                              body_name(body.input.body), 1e3 * extent.change(), slope),
                  body.input.where, "allow less depth an update (more updates), or smooth more");
  }

  /// The largest share of the whole that keeps to the depth of an update.
  double step_by_depth(const Records& rates) const {
    double depth = 0.0;
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      // the depth of a whole amount may be more than there is: in small parts it is even
      constexpr double kPart = 1e-6;
      SurfaceRecord part = empty_record(bodies_[b]);
      damage::add_times(part, rates[b], kPart);
      depth = std::max(depth, damage::depth_extent(bodies_[b].cells, part.volume).change() / kPart);
    }
    return depth > 0.0 ? file_.max_depth / depth : 1.0;
  }

  void evolve(io::EvolutionResult& result) {
    if (!result.generations.empty()) {
      report(result.generations.back());
      if (result.generations.back().progress >= 1.0) return;
    }
    Records start;
    for (std::size_t b = 0; b < bodies_.size(); ++b)
      start.push_back(result.generations.empty() ? empty_record(bodies_[b])
                                                 : result.generations.back().bodies[b].record);
    Solved solved = solve(start);
    if (result.generations.empty()) {
      io::Generation first = generation_of(solved, std::move(start));
      first.next_step = file_.updates > 0 ? 1.0 / file_.updates : 1.0;
      write(first, solved.contacts);
      result.generations.push_back(std::move(first));
    }
    start = {};
    while (result.generations.back().progress < 1.0) {
      advance(result, solved);
      report(result.generations.back());
    }
  }

  void advance(io::EvolutionResult& result, Solved& present) {
    const io::Generation& now = result.generations.back();
    const Records rates = rates_of(present, now.bodies);
    const bool adaptive = file_.updates == 0;
    const double rest = 1.0 - now.progress;
    double step = adaptive ? std::min({now.next_step, std::max(step_by_depth(rates), file_.smallest_step), rest})
                           : std::min(1.0 / file_.updates, rest);
    for (int refused = 0;; ++refused) {
      Records trial;
      for (std::size_t b = 0; b < bodies_.size(); ++b) {
        SurfaceRecord update = empty_record(bodies_[b]);
        damage::add_times(update, rates[b], step);
        check_update(bodies_[b], update);
        trial.push_back(now.bodies[b].record);
        damage::add_times(trial.back(), update, 1.0);
      }
      Solved solved = solve(trial);
      io::Generation next = generation_of(solved, std::move(trial));
      next.pressure_change = pressure_change(now, next);
      const bool kept = next.pressure_change <= file_.max_pressure_change;
      if (adaptive && !kept && step > file_.smallest_step) {
        step = std::max(0.5 * step, file_.smallest_step);
        continue;
      }
      constexpr double kNearlyAll = 1.0 - 1e-12;
      next.number = now.number + 1;
      next.step = step;
      next.refused = refused;
      next.limits_kept = !adaptive || kept;
      next.progress = now.progress + step >= kNearlyAll ? 1.0 : now.progress + step;
      next.next_step = step * std::min(2.0, 0.9 * file_.max_pressure_change / std::max(next.pressure_change, 1e-12));
      if (!adaptive) next.next_step = 1.0 / file_.updates;
      next.next_step = std::max(next.next_step, file_.smallest_step);
      for (const Evolving& body : bodies_)
        (body.input.body == Body::wheel ? next.distance : next.passages) = next.progress * body.input.amount;
      write(next, solved.contacts);
      present = std::move(solved);
      io::forget_records(result.generations.back());  // generation_0001.h5 and its like have them
      result.generations.push_back(std::move(next));
      return;
    }
  }

  const io::EvolutionFile& file_;
  const EvolutionOptions& options_;
  const Progress& progress_;
  std::unique_ptr<ContactSource> source_;
  std::vector<Evolving> bodies_;
};

/// Holds the folder for this evolution, which must be the one that is there.
void identify(const io::EvolutionFile& file, const EvolutionOptions& options) {
  std::string identity = study_identity(file.positions) + fmt::format("evolution {}\n", file.positions.sha256);
  for (const std::string& setting : options.settings) identity += fmt::format("  set {}\n", setting);
  const fs::path marker = options.folder / io::kEvolutionIdentity;
  if (!fs::exists(marker)) {
    write_file(marker, identity);
    return;
  }
  if (io::profiles::read_text(marker, "evolution", {}) != identity)
    throw Error(ErrorKind::configuration, "the folder holds another evolution, or one of another build of Treadmark",
                {options.folder.string()}, "choose another folder, or remove this one");
}

}  // namespace

void write_evolution_vtk(const io::EvolutionFile& file, const fs::path& folder) {
  EvolutionRun(file, {}, {}).write_vtk(folder);
}

void check_evolution(const io::EvolutionFile& file) { EvolutionRun(file, {}, {}); }

io::EvolutionResult run_evolution(const io::EvolutionFile& file, const EvolutionOptions& options,
                                  const Progress& progress) {
  if (options.must_exist && !fs::exists(options.folder / io::kEvolutionIdentity))
    throw Error(ErrorKind::configuration, "there is no evolution to go on with", {options.folder.string()},
                "leave --resume out to begin one");
  EvolutionRun run(file, options, progress);
  const FileLock lock = claim_folder(options.folder);
  identify(file, options);
  return run.run();
}

}  // namespace treadmark::app
