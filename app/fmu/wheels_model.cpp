// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/app/fmu/model.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/results/quantities.hpp"
#include "treadmark/solvers/wheelrail/pair_state.hpp"

namespace treadmark::fmi {
namespace {

using wheelrail::Problem;
using Kind = Variable::Kind;

constexpr std::uint32_t kPatches = 4;  ///< of which there are outputs

/// A number of a Problem that comes from outside. place: null where this problem has no such number.
struct GivenRow {
  const char *name, *unit;
  double change;  ///< for differences: well above what the solvers leave undecided, well below what bends the curves
  const char* description;
  double* (*place)(Problem&);
  Kind kind = Kind::input;
};

constexpr double kMetre = 1e-6, kRadian = 1e-6, kMetrePerSecond = 1e-4, kRadianPerSecond = 2e-4, kNewton = 1.0;

/// Of the wheelset: all its wheels share them.
constexpr GivenRow kWheelsetRows[] = {
    {"wheelset.s", "m", kMetre, "position along the track", [](Problem& p) { return &p.state.position.x; }},
    {"wheelset.y", "m", kMetre, "lateral position", [](Problem& p) { return &p.state.position.y; }},
    {"wheelset.z", "m", kMetre, "vertical position, positive down; 0: the nominal circle touches the track plane",
     [](Problem& p) { return p.vertical_force ? nullptr : &p.state.position.z; }},
    {"wheelset.roll", "rad", kRadian, "roll angle", [](Problem& p) { return &p.state.position.roll; }},
    {"wheelset.yaw", "rad", kRadian, "yaw angle", [](Problem& p) { return &p.state.position.yaw; }},
    {"wheelset.pitch", "rad", kRadian, "pitch angle", [](Problem& p) { return &p.state.position.pitch; }},
    {"wheelset.velocity", "m/s", kMetrePerSecond, "velocity along the track",
     [](Problem& p) { return &p.state.velocity.x; }},
    {"wheelset.vy", "m/s", kMetrePerSecond, "lateral velocity", [](Problem& p) { return &p.state.velocity.y; }},
    {"wheelset.vz", "m/s", kMetrePerSecond, "vertical velocity", [](Problem& p) { return &p.state.velocity.z; }},
    {"wheelset.vroll", "rad/s", kRadianPerSecond, "roll rate", [](Problem& p) { return &p.state.velocity.roll; }},
    {"wheelset.vyaw", "rad/s", kRadianPerSecond, "yaw rate", [](Problem& p) { return &p.state.velocity.yaw; }},
    {"wheelset.vpitch", "rad/s", kRadianPerSecond, "pitch rate; rolling forward it is negative",
     [](Problem& p) { return p.longitudinal_force ? nullptr : &p.state.velocity.pitch; }},
    {"track.curvature", "1/m", 1e-6, "curvature of the track", [](Problem& p) { return &p.track.curvature; }},
};

/// Of each wheel and its rail.
constexpr GivenRow kWheelRows[] = {
    {"vertical_force", "N", kNewton, "vertical force on the rail",
     [](Problem& p) { return p.vertical_force ? &*p.vertical_force : nullptr; }},
    {"longitudinal_force", "N", kNewton, "longitudinal force on the rail, wheelset axes",
     [](Problem& p) { return p.longitudinal_force ? &*p.longitudinal_force : nullptr; }},
    {"wheel.dx", "m", kMetre, "deviation of this wheel of a flexible wheelset",
     [](Problem& p) { return &p.state.wheel_offset.x; }},
    {"wheel.dy", "m", kMetre, "lateral deviation", [](Problem& p) { return &p.state.wheel_offset.y; }},
    {"wheel.dz", "m", kMetre, "vertical deviation", [](Problem& p) { return &p.state.wheel_offset.z; }},
    {"wheel.droll", "rad", kRadian, "deviation of roll", [](Problem& p) { return &p.state.wheel_offset.roll; }},
    {"wheel.dyaw", "rad", kRadian, "deviation of yaw", [](Problem& p) { return &p.state.wheel_offset.yaw; }},
    {"wheel.dpitch", "rad", kRadian, "deviation of pitch", [](Problem& p) { return &p.state.wheel_offset.pitch; }},
    {"wheel.vx", "m/s", kMetrePerSecond, "rate of the deviation", [](Problem& p) { return &p.state.wheel_velocity.x; }},
    {"wheel.vy", "m/s", kMetrePerSecond, "rate of the lateral deviation",
     [](Problem& p) { return &p.state.wheel_velocity.y; }},
    {"wheel.vz", "m/s", kMetrePerSecond, "rate of the vertical deviation",
     [](Problem& p) { return &p.state.wheel_velocity.z; }},
    {"wheel.vroll", "rad/s", kRadianPerSecond, "rate of the deviation of roll",
     [](Problem& p) { return &p.state.wheel_velocity.roll; }},
    {"wheel.vyaw", "rad/s", kRadianPerSecond, "rate of the deviation of yaw",
     [](Problem& p) { return &p.state.wheel_velocity.yaw; }},
    {"wheel.vpitch", "rad/s", kRadianPerSecond, "rate of the deviation of pitch",
     [](Problem& p) { return &p.state.wheel_velocity.pitch; }},
    {"rail.dy", "m", kMetre, "lateral displacement of the rail", [](Problem& p) { return &p.track.dy; }},
    {"rail.dz", "m", kMetre, "vertical displacement of the rail", [](Problem& p) { return &p.track.dz; }},
    {"rail.roll", "rad", kRadian, "roll of the rail", [](Problem& p) { return &p.track.roll; }},
    {"rail.vy", "m/s", kMetrePerSecond, "lateral velocity of the rail", [](Problem& p) { return &p.track.vy; }},
    {"rail.vz", "m/s", kMetrePerSecond, "vertical velocity of the rail", [](Problem& p) { return &p.track.vz; }},
    {"rail.vroll", "rad/s", kRadianPerSecond, "roll rate of the rail", [](Problem& p) { return &p.track.vroll; }},
    {"rail.force_y", "N", kNewton, "further lateral force on a rail on springs",
     [](Problem& p) { return p.rail_springs ? &p.rail_springs->force_y : nullptr; }},
    {"rail.force_z", "N", kNewton, "further vertical force on a rail on springs",
     [](Problem& p) { return p.rail_springs ? &p.rail_springs->force_z : nullptr; }},
    {"roller.pitch_rate", "rad/s", kRadianPerSecond, "pitch rate of the roller",
     [](Problem& p) { return p.roller ? &p.roller->pitch_rate : nullptr; }},
    {"discretisation.dx", "m", 0.0, "length of the elements", [](Problem& p) { return &p.discretisation.dx; },
     Kind::parameter},
    {"discretisation.ds", "m", 0.0, "width of the elements", [](Problem& p) { return &p.discretisation.ds; },
     Kind::parameter},
};

constexpr GivenRow kFrictionRow = {"friction.coefficient",
                                   "1",
                                   0.0,
                                   "coefficient of friction (at great slip velocities)",
                                   [](Problem& p) { return &p.friction.kinetic; },
                                   Kind::tunable};

/// An output of a wheel.
struct FoundRow {
  const char *name, *unit, *description;
  void (*get)(const wheelrail::PairSolution& s, double* out);
  std::uint32_t size = 0;
  bool integer = false;
};

void put(const Vec3& vector, double* out) { std::copy_n(vector.data(), 3, out); }

double sum_over_patches(const wheelrail::PairSolution& s, double kalker::ContactSolution::*member) {
  double sum = 0.0;
  for (const wheelrail::PatchSolution& patch : s.patches) sum += patch.contact.*member;
  return sum;
}

constexpr FoundRow kFoundRows[] = {
    {"force_on_rail", "N", "force on the rail, track axes",
     [](const wheelrail::PairSolution& s, double* out) { put(s.load.track.force, out); }, 3},
    {"moment_on_rail", "N.m", "its moment about the origin of the rail's profile, track axes",
     [](const wheelrail::PairSolution& s, double* out) { put(s.load.track.moment, out); }, 3},
    {"z", "m", "vertical position of the wheelset, given or found",
     [](const wheelrail::PairSolution& s, double* out) { *out = s.z; }},
    {"pitch_rate", "rad/s", "pitch rate of the wheelset, given or found",
     [](const wheelrail::PairSolution& s, double* out) { *out = s.pitch_rate; }},
    {"rail_deflection_y", "m", "of a rail on springs",
     [](const wheelrail::PairSolution& s, double* out) { *out = s.rail_deflection_y; }},
    {"rail_deflection_z", "m", "of a rail on springs",
     [](const wheelrail::PairSolution& s, double* out) { *out = s.rail_deflection_z; }},
    {"least_gap", "m", "least distance from rail to wheel along z of the track, negative: greatest penetration",
     [](const wheelrail::PairSolution& s, double* out) { *out = s.least_gap; }},
    {"elastic_energy", "J", "stored in the contacts",
     [](const wheelrail::PairSolution& s, double* out) {
       *out = sum_over_patches(s, &kalker::ContactSolution::elastic_energy);
     }},
    {"friction", "W", "power that friction dissipates",
     [](const wheelrail::PairSolution& s, double* out) {
       *out = 0.0 - sum_over_patches(s, &kalker::ContactSolution::frictional_power);
     }},
    {"patches", "1", "number of contact patches, also of those beyond the arrays",
     [](const wheelrail::PairSolution& s, double* out) { *out = static_cast<double>(s.patches.size()); }, 0, true},
    {"status", "1", "0: contact, 1: no contact",
     [](const wheelrail::PairSolution& s, double* out) { *out = static_cast<double>(s.status); }, 0, true},
    {"doubts", "1", "number of warnings about the contact: where it is not 0, numbers may be wrong",
     [](const wheelrail::PairSolution& s, double* out) {
       *out = static_cast<double>(ranges::count_if(s.remarks, &Remark::grave));
     },
     0, true},
};

/// Outputs of patches: keys of result files, by their names in an FMU.
struct PatchRow {
  const char *key, *name;
};
constexpr PatchRow kPatchRows[] = {{"x_tr_mm", "x"},     {"y_tr_mm", "y"},
                                   {"z_tr_mm", "z"},     {"angle_rad", "angle"},
                                   {"xi", "xi"},         {"eta", "eta"},
                                   {"phi", "phi"},       {"fn_N", "fn"},
                                   {"fx_N", "fx"},       {"fs_N", "fs"},
                                   {"mn_Nmm", "mn"},     {"approach_mm", "approach"},
                                   {"pmax_MPa", "pmax"}, {"slip_share", "slip_share"}};

const io::Quantity<io::PatchResult>& quantity(std::string_view key) {
  const auto rows = io::quantities<io::PatchResult>();
  return *ranges::find(rows, key, &io::Quantity<io::PatchResult>::key);
}

std::string fmi_unit(std::string_view si) {
  std::string unit(si);
  ranges::replace(unit, ' ', '.');
  return unit;
}

/// A variable and the place of its value in the problem of a wheel.
struct Bound {
  std::uint32_t reference;
  std::size_t wheel;
  double* (*place)(Problem&);
};

struct Wheel {
  io::WheelRailCase given;
  wheelrail::Geometry geometry;
  Problem problem;
  std::unique_ptr<wheelrail::Pair> pair;
  std::shared_ptr<const wheelrail::Pair::State> before;  ///< the last solution
  std::uint32_t found = 0, area = 0;                     ///< first of its outputs
};

class WheelsModel final : public Model {
 public:
  explicit WheelsModel(const std::filesystem::path& resources) {
    const io::CaseFile file = io::read_any_case(resources / kCaseFile);
    for (const io::Case& c : file.cases) open(c);
    if (wheels_.empty() || wheels_.size() > 2)
      throw Error(ErrorKind::configuration, "an FMU holds one wheel on a rail, or the two of a wheelset",
                  {file.path.string(), 1, 1});
    for (const GivenRow& row : kWheelsetRows) add_given(row, -1);
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      for (const GivenRow& row : kWheelRows) add_given(row, static_cast<int>(i));
      if (wheels_[i].given.friction_variation.kind == io::FrictionVariation::Kind::none)
        add_given(kFrictionRow, static_cast<int>(i));
    }
    add_found();
    use_start_values();
  }

  Report start(double) override { return solve(values_, 0.0, false, true); }

  Report step(double from, double to) override {
    const double rolled = std::abs(values_[speed_]) * (to - from);
    return solve(values_, rolled, true, true);
  }

  /// In transient rolling that of one element.
  double usual_step() const override {
    double step = Model::usual_step();
    for (const Wheel& wheel : wheels_)
      if (const double speed = std::abs(wheel.problem.state.velocity.x);
          wheel.problem.regime == Regime::transient && speed > 0.0)
        step = std::min(step, wheel.problem.discretisation.dx / speed);
    return io::rounded(step);
  }

  bool differentiable() const override { return true; }

  std::vector<double> derivative(std::span<const std::uint32_t> outputs, std::span<const std::uint32_t> inputs,
                                 std::span<const double> seed) override {
    std::vector<double> sum(outputs.size(), 0.0);
    // The step along the seed whose greatest part is a whole change of its input.
    double largest = 0.0;
    for (std::size_t i = 0; i < inputs.size(); ++i)
      largest = std::max(largest, std::abs(seed[i]) / variables_.of(inputs[i])->change);
    if (largest == 0.0) return sum;
    const double h = 1.0 / largest;
    for (const double sign : {1.0, -1.0}) {
      std::vector<double> values = values_;
      for (std::size_t i = 0; i < inputs.size(); ++i) values[inputs[i]] += sign * h * seed[i];
      if (const Report report = solve(values, rolled_, continued_, false); report.status != Status::ok)
        throw Error(ErrorKind::numerical, "no derivative: beside this state " + report.message);
      for (std::size_t k = 0; k < outputs.size(); ++k) sum[k] += sign * values[outputs[k]] / (2.0 * h);
    }
    return sum;
  }

 protected:
  void reset_state() override {
    started_ = continued_ = false;
    rolled_ = 0.0;
    for (Wheel& wheel : wheels_) {
      wheel.pair->reset();
      wheel.before = wheel.pair->save();
    }
  }

  void save_state(ByteWriter& out) const override {
    out.put(started_);
    out.put(continued_);
    out.put(rolled_);
    for (const Wheel& wheel : wheels_) {
      write(wheel.before, out);
      write(wheel.pair->save(), out);
    }
  }

  void restore_state(ByteReader& in) override {
    const bool started = in.get<bool>(), continued = in.get<bool>();
    const double rolled = in.get<double>();
    std::vector<std::shared_ptr<const wheelrail::Pair::State>> states;
    for (std::size_t i = 0; i < 2 * wheels_.size(); ++i) states.push_back(wheelrail::read_state(in));
    if (!std::isfinite(rolled)) refuse_saved_state("a distance is not finite");
    started_ = started, continued_ = continued, rolled_ = rolled;
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      wheels_[i].before = states[2 * i];
      wheels_[i].pair->restore(states[2 * i + 1]);
    }
  }

 private:
  void open(const io::Case& c) {
    const auto* given = std::get_if<io::WheelRailCase>(&c.content);
    if (given == nullptr)
      throw Error(ErrorKind::configuration, "an FMU holds wheels on rails, this case is a single patch", c.where);
    if (given->regime == Regime::shift)
      throw Error(ErrorKind::configuration, "a shift has no time, it cannot be an FMU", c.where,
                  "choose case.regime = \"steady\" or \"transient\"");
    if (!wheels_.empty() && wheels_.front().given.side == given->side)
      throw Error(ErrorKind::configuration, "the wheels of a wheelset stand on different sides", c.where,
                  "give one case with case.side = \"left\"");
    Wheel wheel;
    wheel.given = *given;
    wheel.given.subsurface = {};
    // Forces of instants that follow each other must not jump from one size of elements to another.
    wheel.given.discretisation.choose_dx = wheel.given.discretisation.choose_ds = false;
    const auto surface = [&](const io::SurfaceSource& source, Body body) -> const app::StoredSurface& {
      return store_.get(source, body, app::profile_radius(*given, body), Region{});
    };
    const app::StoredSurface &rail = surface(given->rail, Body::rail), &round = surface(given->wheel, Body::wheel);
    wheel.geometry = {rail.represented.surface, round.represented.surface, rail.constant_profile() && !given->roller,
                      round.constant_profile()};
    wheel.problem = app::to_problem(wheel.given, wheel.geometry.round_wheel);
    wheel.pair = std::make_unique<wheelrail::Pair>(wheel.geometry);
    wheel.before = wheel.pair->save();
    wheels_.push_back(std::move(wheel));
  }

  std::string prefix(std::size_t wheel) const {
    if (wheels_.size() == 1) return {};
    return wheels_[wheel].given.side == Side::left ? "left." : "right.";
  }

  /// wheel -1: of all of them.
  void add_given(const GivenRow& row, int wheel) {
    std::vector<Bound> bound;
    double start = 0.0;
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      if (wheel >= 0 && i != static_cast<std::size_t>(wheel)) continue;
      double* place = row.place(wheels_[i].problem);
      if (place == nullptr) continue;
      if (bound.empty()) start = *place;
      bound.push_back({0, i, row.place});
    }
    if (bound.empty()) return;
    Variable variable;
    variable.name = (wheel < 0 ? std::string() : prefix(static_cast<std::size_t>(wheel))) + row.name;
    variable.unit = row.unit;
    variable.description = row.description;
    variable.kind = row.kind;
    variable.start = start;
    variable.change = row.change;
    variable.wheel = wheel;
    const std::uint32_t reference = variables_.add(std::move(variable));
    if (std::string_view(row.name) == "wheelset.velocity") speed_ = reference;
    if (std::string_view(row.name) == "wheelset.s") place_ = reference;
    for (Bound& one : bound) {
      one.reference = reference;
      bound_.push_back(one);
    }
  }

  std::uint32_t add_output(std::string name, std::string unit, std::string description, std::uint32_t size, int wheel,
                           bool integer = false) {
    Variable variable;
    variable.name = std::move(name);
    variable.unit = std::move(unit);
    variable.description = std::move(description);
    variable.size = size;
    variable.wheel = wheel;
    variable.integer = integer;
    return variables_.add(std::move(variable));
  }

  void add_found() {
    on_wheelset_ = add_output("force_on_wheelset", "N", "sum of the forces on the wheelset, track axes", 3, -1);
    add_output("moment_on_wheelset", "N.m", "their moment about the middle of the axle, track axes", 3, -1);
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const int number = static_cast<int>(i);
      const std::string before = prefix(i);
      wheels_[i].found = static_cast<std::uint32_t>(variables_.scalars());
      for (const FoundRow& row : kFoundRows)
        add_output(before + row.name, row.unit, row.description, row.size, number, row.integer);
      for (const PatchRow& row : kPatchRows) {
        const auto& known = quantity(row.key);
        add_output(fmt::format("{}patch.{}", before, row.name), fmi_unit(known.unit.si),
                   known.meaning.empty() ? std::string("as before") : std::string(known.meaning), kPatches, number);
      }
      wheels_[i].area = add_output(before + "patch.area", "m2", "area in contact", kPatches, number);
    }
  }

  Problem problem_of(std::size_t wheel, const std::vector<double>& values, double rolled, bool on) const {
    Problem p = wheels_[wheel].problem;
    for (const Bound& bound : bound_)
      if (bound.wheel == wheel) *bound.place(p) = values[bound.reference];
    const io::WheelRailCase& given = wheels_[wheel].given;
    if (given.friction_variation.kind == io::FrictionVariation::Kind::along_track)
      p.friction = friction_at(given.friction_variation.positions, given.friction_variation.laws, values[place_],
                               given.friction);
    const bool remembers = p.regime == Regime::transient || p.damping;
    if (remembers && on && rolled > 0.0) {
      p.history = HistoryUse::keep_going;
      p.discretisation.dq_relative = rolled / p.discretisation.dx;
    } else {
      p.history = HistoryUse::start;
      if (p.regime == Regime::transient) p.regime = Regime::steady;
    }
    return p;
  }

  /// A wheel that carries nothing: just above where it would touch its rail.
  static wheelrail::PairSolution solve_unloaded(wheelrail::Pair& pair, Problem problem) {
    constexpr double kFarAbove = 0.02, kClearance = 1e-9;  // [m]
    problem.vertical_force.reset();
    problem.longitudinal_force.reset();
    problem.state.position.z = -kFarAbove;
    const auto before = pair.save();
    wheelrail::PairSolution solution = pair.solve(problem);
    if (!std::isfinite(solution.least_gap)) return solution;
    pair.restore(before);
    problem.state.position.z += solution.least_gap - kClearance;
    return pair.solve(problem);
  }

  /// Loads of nothing are a loss of contact. The force of a contact of few elements grows in jumps: light loads across
  /// which it jumps get the force beside the jump. usual: load of the case [N].
  static wheelrail::PairSolution solve_pair(wheelrail::Pair& pair, const Problem& problem, double usual) {
    constexpr double kNothing = 1.0, kLight = 1e-3;  // [N], of the usual load
    if (!problem.vertical_force) return pair.solve(problem);
    if (*problem.vertical_force <= kNothing) return solve_unloaded(pair, problem);
    const auto before = pair.save();
    wheelrail::PairSolution solution = pair.solve(problem);
    if (solution.status != Status::not_converged || *problem.vertical_force > kLight * usual) return solution;
    pair.restore(before);
    Problem held = problem;
    held.vertical_force.reset();
    held.state.position.z = solution.z;
    return pair.solve(held);
  }

  /// Outputs into values, which may be the model's own. on: from the last accepted instant. keep: else all stays as it
  /// was.
  Report solve(std::vector<double>& values, double rolled, bool on, bool keep) {
    std::vector<std::shared_ptr<const wheelrail::Pair::State>> now;
    for (Wheel& wheel : wheels_) now.push_back(wheel.pair->save());
    const auto back = [&] {
      for (std::size_t i = 0; i < wheels_.size(); ++i) wheels_[i].pair->restore(now[i]);
    };
    std::vector<wheelrail::PairSolution> solutions(wheels_.size());
    try {
      parallel_for(wheels_.size(), [&](std::size_t i) {
        const Problem problem = problem_of(i, values, rolled, on && started_);
        if (!keep) wheels_[i].pair->restore(wheels_[i].before);
        solutions[i] = solve_pair(*wheels_[i].pair, problem, wheels_[i].problem.vertical_force.value_or(0.0));
      });
    } catch (...) {
      back();
      throw;
    }
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      if (solutions[i].status == Status::ok || solutions[i].status == Status::no_contact) continue;
      back();
      Report report;
      report.status = solutions[i].status;
      report.message = prefix(i) + " " + solutions[i].message;
      return report;
    }
    put_outputs(solutions, values);
    if (!keep) {
      back();
      return {};
    }
    for (std::size_t i = 0; i < wheels_.size(); ++i) wheels_[i].before = now[i];
    rolled_ = rolled;
    continued_ = on;
    started_ = true;
    return {};
  }

  void put_outputs(const std::vector<wheelrail::PairSolution>& solutions, std::vector<double>& values) const {
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t i = 0; i < wheels_.size(); ++i) {
      const wheelrail::PairSolution& s = solutions[i];
      const Vec3 arm = s.placement.X_TR.origin - s.placement.X_TWs.origin;
      force -= s.load.track.force;
      moment -= s.load.track.moment + arm.cross(s.load.track.force);
      double* out = values.data() + wheels_[i].found;
      for (const FoundRow& row : kFoundRows) {
        row.get(s, out);
        out += std::max(1u, row.size);
      }
      std::fill(out, out + (std::size(kPatchRows) + 1) * kPatches, 0.0);
      const io::CaseResult result = app::to_result(wheels_[i].given, s);
      const std::size_t count = std::min<std::size_t>(kPatches, result.patches.size());
      for (const PatchRow& row : kPatchRows) {
        const auto& known = quantity(row.key);
        for (std::size_t k = 0; k < count; ++k)
          if (known.has(result.patches[k])) out[k] = known.access.get(result.patches[k]);
        out += kPatches;
      }
      for (std::size_t k = 0; k < count; ++k)
        out[k] = s.patches[k].contact.elements_contact * s.patches[k].grid.cell_area();
    }
    put(force, values.data() + on_wheelset_);
    put(moment, values.data() + on_wheelset_ + 3);
  }

  app::SurfaceStore store_;
  std::vector<Wheel> wheels_;
  std::vector<Bound> bound_;
  std::uint32_t speed_ = 0, place_ = 0, on_wheelset_ = 0;
  bool started_ = false;    ///< there is an instant to go on from
  bool continued_ = false;  ///< the last solution went on from one
  double rolled_ = 0.0;     ///< in the last step [m]
};

}  // namespace

std::unique_ptr<Model> open_wheels(const std::filesystem::path& resources) {
  return std::make_unique<WheelsModel>(resources);
}

}  // namespace treadmark::fmi
