// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/wheelrail/pair_step.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/stopwatch.hpp"
#include "treadmark/detection/contact_search.hpp"
#include "treadmark/model/contact/theories.hpp"
#include "treadmark/solvers/wheelrail/contact_program/coarse_search.hpp"
#include "treadmark/solvers/wheelrail/curved_loads.hpp"
#include "treadmark/solvers/wheelrail/search_window.hpp"
#include "treadmark/solvers/wheelrail/surface_loads.hpp"
#include "treadmark/solvers/wheelrail/surface_slip.hpp"

namespace treadmark::wheelrail {

namespace {

/// Interpenetration half as long as the search window: the bodies do not touch, they lie in each other.
constexpr double kDeepestOfRadius = 0.02;

}  // namespace

PairStep::PairStep(const Geometry& geometry, const Problem& problem, const Instant& previous,
                   std::vector<kalker::ContactSolver>& solvers, std::vector<kalker::ContactSolver>& few_solvers,
                   PhaseTimes& times, detection::BodyPair bodies, RailMemory& rail_memory)
    : geometry_(geometry),
      problem_(problem),
      previous_(previous),
      solvers_(solvers),
      few_solvers_(few_solvers),
      times_(times),
      rail_memory_(rail_memory),
      bodies_(std::move(bodies)),
      tangential_share_(previous.shares),
      elements_(geometry, problem, previous.stiffness > 0.0) {}

/// What is deeper lies beyond all contact mechanics [m].
double PairStep::deepest() const { return kDeepestOfRadius * problem_.wheelset.nominal_radius; }

bool PairStep::aligned() const {
  return problem_.regime == kalker::Regime::shift || problem_.regime == kalker::Regime::transient;
}

bool PairStep::place(double rail_dy) {
  patches_.clear();
  between_.reset();
  hidden_ = 0, closest_ = kNaN;
  Problem moved = problem_;
  moved.track.dy += rail_dy;
  if (height_sought(moved)) moved.state.position.z = 0.0;
  start_z_ = moved.state.position.z;
  start_ = placement_ = treadmark::wheelrail::place(geometry_, moved, &rail_memory_);
  bodies_.X_TR = start_.X_TS, bodies_.X_TW = start_.X_TA;
  bodies_.distance_mesh = distance_mesh(problem_);
  const Stopwatch watch(times_.search_s);
  const detection::SearchSettings settings = search_settings(geometry_, moved, start_, &rail_memory_);
  const std::string& detector = problem_.discretisation.detector;
  if (detector.empty())
    search_ = std::make_unique<detection::ContactSearch>(bodies_, settings);
  else
    search_ = detection::detector_of(detector).make(bodies_, settings);
  if (at_given_height()) return true;  // the gap is found together with the patches
  const double gap = search_->least_gap();
  touching_z_ = start_z_ + gap;
  return !std::isnan(gap);
}

bool PairStep::at_given_height() const { return !height_sought(problem_); }

/// Conventions::contact has one creepage for all parts, strip theory one for every row.
bool PairStep::parts_creep_apart() const {
  return problem_.solver.conventions != Conventions::contact && !theory(problem_.tangential_model).limits.strips;
}

/// Creepages, or slip of the surfaces.
void PairStep::move(Patch& patch) const {
  PatchSolution& s = patch.solution;
  s.kinematics = contact_kinematics(problem_, placement_, s.frame.X_TC, s.approach);
  if (!patch.reference) {
    if (!parts_creep_apart()) return;
    PartSlip slip = part_slip(problem_, placement_, *geometry_.rail, s, patch.parts);
    s.extra_slip_x = std::move(slip.x);
    s.extra_slip_y = std::move(slip.y);
    patch.slip_heights = std::move(slip.heights);
    return;
  }
  SurfaceSlip slip =
      surface_slip(problem_, placement_, s.frame.X_TC, s.grid, *patch.reference, patch.surfaces, s.kinematics);
  s.kinematics = slip.kinematics;
  s.extra_slip_x = std::move(slip.extra_x);
  s.extra_slip_y = std::move(slip.extra_y);
  patch.slip_heights = std::move(slip.heights);
}

kalker::ContactSolver& PairStep::solver(std::size_t i, const Patch& patch) {
  const bool few = few_elements();
  std::vector<kalker::ContactSolver>& solvers = few ? few_solvers_ : solvers_;
  std::vector<char>& warm = few ? few_warm_ : warm_;
  while (solvers.size() <= i) solvers.emplace_back();
  warm.resize(std::max(warm.size(), i + 1), 0);
  if (!std::exchange(warm[i], 1)) {
    if (!few && patch.before.size() == 1 && patch.before.front()->solver)
      solvers[i].restore(patch.before.front()->solver);
    else
      solvers[i].reset();
  }
  return solvers[i];
}

kalker::ContactProblem contact_problem_of(const Problem& p, const PatchSolution& s) {
  kalker::ContactProblem c;
  c.grid = s.grid;
  c.material = p.material;
  c.friction = friction_at(p.friction_inclination, p.friction_laws, s.frame.angle, p.friction);
  c.normal_model = p.normal_model;
  c.tangential_model = p.tangential_model;
  c.fastsim = p.fastsim;
  c.influence = p.influence;
  c.extra_slip_x = s.extra_slip_x;
  c.extra_slip_y = s.extra_slip_y;
  c.thermal = p.thermal;
  c.sensitivities = p.sensitivities;
  c.force_prescribed = false;
  c.approach = s.approach;
  c.regime = p.regime;
  c.creepage = {s.kinematics.xi, s.kinematics.eta, s.kinematics.phi, s.reference_C.x(), s.reference_C.y()};
  c.rolling.chi = s.kinematics.chi;
  c.rolling.velocity = s.kinematics.velocity;
  c.rolling.step = p.regime == kalker::Regime::shift ? 1.0 : p.discretisation.dq_relative * s.grid.dx;
  c.rolling.usual_step = p.discretisation.usual_dq_relative * s.grid.dx;
  c.settings = p.solver;
  // A wheel that stands still does not creep.
  if (!(s.kinematics.velocity > 0.0)) c.regime = kalker::Regime::frictionless;
  return c;
}

kalker::ContactProblem PairStep::contact_problem(const Patch& patch) const {
  const Problem& p = problem_;
  const PatchSolution& s = patch.solution;
  kalker::ContactProblem c = contact_problem_of(p, s);
  c.gap = patch.gap;
  c.sub_patches = patch.parts;
  if (p.reference_surface == ReferenceSurface::curved) {
    c.influence = influence_on(*patch.reference, s.grid, p.influence);
    c.friction_of_row = friction_on(*patch.reference, s.frame.angle, p);
  }
  c.history = patch.history ? (p.history == kalker::HistoryUse::normal_only ? kalker::HistoryUse::normal_only
                                                                            : kalker::HistoryUse::keep_going)
                            : kalker::HistoryUse::start;
  return c;
}

/// Resultant about the contact reference.
void PairStep::resolve_forces(Patch& patch) const {
  PatchSolution& s = patch.solution;
  const kalker::ContactSolution& c = s.contact;
  if (patch.reference) {
    const Wrench load = resultant_on(*patch.reference, s.grid, c);
    s.force_C = load.force;
    s.moment_C = load.moment;
    return;
  }
  const Vec3 arm(s.reference_C.x(), s.reference_C.y(), 0.0);
  s.force_C = {c.force_x, c.force_y, c.force_n};
  s.moment_C = Vec3(c.moment_x, c.moment_y, c.moment_n) - arm.cross(s.force_C);
}

bool PairStep::stays(double z, double eps) {
  // Forces of a measured flat change by about eps then, at sharp edges by more (docs/method.md).
  constexpr double kOfElement = 400.0, kTurn = 1.0;
  const Stopwatch watch(times_.search_s);
  ++times_.looks;
  const std::vector<detection::ContactPatch> found = search_->at(z - start_z_).patches;
  const PatchSolution& s = patches_.front().solution;
  if (found.size() != 1 || found.front().parts.size() != s.region.parts.size()) return false;
  const detection::ContactPatch& here = found.front();
  // in elements, along the plane
  const double x = (here.x - s.region.x) / s.grid.dx, y = (here.y - s.region.y) / (std::cos(s.frame.angle) * s.grid.dy);
  return std::hypot(x, y) <= kOfElement * eps && std::abs(here.inclination - s.region.inclination) <= kTurn * eps;
}

double PairStep::stiffness_guess(double z) {
  const Stopwatch watch(times_.search_s);
  ++times_.looks;
  const detection::SearchResult found = search_->at(z - start_z_);
  if (!(found.least_gap < 0.0)) return 0.0;
  // A sphere's force by the volume and depth of its interpenetration: F = 4/3 e* sqrt(V d / pi), V = pi R d^2.
  const CombinedMaterial material = combine(problem_.material);
  const double e_star = material.shear_modulus / (1.0 - material.poisson);
  double force = 0.0;
  for (const detection::ContactPatch& patch : found.patches) {
    const double depth = -patch.least_gap, lean = std::cos(patch.inclination);
    // the integral of the squared depth of a paraboloid is 2/3 of V d
    const double volume_depth = problem_.discretisation.linear_weight ? patch.weight * depth : 1.5 * patch.weight;
    force += lean * 4.0 / 3.0 * e_star * std::sqrt(std::max(0.0, volume_depth * lean) * std::numbers::inv_pi);
  }
  return force / std::pow(-found.least_gap, 1.5);
}

/// The wheelset and what follows from its height alone.
void PairStep::lower(double dz) {
  for (Pose* pose : {&placement_.X_TWs, &placement_.X_TW, &placement_.X_TA}) pose->origin.z() += dz;
  z_ += dz, least_gap_ -= dz, closest_ -= dz;
}

/// Of the pressures that carry a vertical load together with the tractions they cause [N]; none where that does not
/// follow from one normal force, or takes solutions at many approaches.
std::optional<double> PairStep::normal_load(const Patch& patch, double load) const {
  if (problem_.normal_model != kalker::NormalModel::full || patch.reference || patch.parts.count > 1)
    return std::nullopt;
  constexpr double kUpright = 0.1;
  const Vec3 force_C = Vec3::UnitZ() + share_near(patch.solution.region.extent.box);
  const double upright = (patch.solution.frame.X_TC.rotation * force_C).z();
  return upright > kUpright && load > 0.0 ? std::optional(load / upright) : std::nullopt;
}

/// Pressures of a patch at its approach, or under a vertical load where it can be given.
void PairStep::press(std::size_t i, Patch& patch, std::optional<double> load) {
  PatchSolution& s = patch.solution;
  {
    const Stopwatch watch(times_.normal_s);
    ++(few_elements() ? times_.looks : times_.normal_solves);
    kalker::ContactProblem problem = contact_problem(patch);
    const std::optional<double> force = load ? normal_load(patch, *load) : std::nullopt;
    problem.force_prescribed = force.has_value(), problem.normal_force = force.value_or(0.0);
    s.contact = solver(i, patch).solve_normal(problem);
    carries_load_ = force && s.contact.status == Status::ok;
  }
  if (s.contact.status == Status::no_contact) return;
  if (carries_load_) {
    lower((s.contact.approach - s.approach) / s.frame.X_TC.rotation(2, 2));
    s.approach = s.contact.approach;
  }
  resolve_forces(patch);
  patch.normal_force_C = patch.predicted_force_C = s.force_C;
  patch.predicted_force_C += share_near(s.region.extent.box) * s.contact.force_n;
  patch.normal = s.contact;
}

void PairStep::carry(double load) { press(0, patches_.front(), load); }

void PairStep::evaluate(double z, std::optional<double> load) {
  placement_ = start_;
  const double dz = z - start_z_;
  lower(dz), z_ = z;
  carries_load_ = false;
  patches_.clear();
  detection::SearchResult found;
  {
    const Stopwatch watch(times_.search_s);
    found = search_->at(dz);
    elements_.expect(found.patches);
    ++(few_elements() ? times_.looks : times_.searches);
  }
  least_gap_ = found.least_gap;
  closest_ = found.closest;
  hidden_ = 0;
  between_.reset();
  too_deep_ = -found.least_gap > deepest() ? -found.least_gap : 0.0;
  if (too_deep_ > 0.0) return;

  const detection::BodyPair bodies = detection::moved(bodies_, dz);
  std::vector<Patch> located(found.patches.size());
  {
    const Stopwatch watch(times_.distance_s);
    for (std::size_t i = 0; i < located.size(); ++i) locate(found.patches[i], bodies, located[i]);
    for (Patch& patch : located) take_over(located, patch);
  }
  for (Patch& patch : located) {
    {
      const Stopwatch watch(times_.distance_s);
      if (!few_elements()) ++times_.distances;
      measure_distance(bodies, patch);
    }
    // Interpenetration between the element centres only: no contact on this grid.
    if (!(patch.solution.approach > 0.0)) {
      const detection::ContactPatch& region = patch.solution.region;
      if (patch.part_hidden)
        ++hidden_;
      else if (!between_ || region.least_gap < between_->least_gap)
        between_ = region;
      continue;
    }
    move(patch);
    press(patches_.size(), patch, located.size() == 1 ? load : std::nullopt);
    if (patch.solution.contact.status != Status::no_contact) patches_.push_back(std::move(patch));
  }
}

bool PairStep::learn_elements() {
  std::vector<const PatchSolution*> solved;
  for (const Patch& patch : patches_) solved.push_back(&patch.solution);
  return elements_.learn(solved);
}

/// Of the patches that were there when tractions were found last: patches come, go, join and part while the wheel
/// moves.
Vec3 PairStep::share_near(const Rectangle& box) const {
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (const TangentialShare& t : tangential_share_) {
    if (t.box.x_min > box.x_max || t.box.x_max < box.x_min || t.box.y_min > box.y_max || t.box.y_max < box.y_min)
      continue;
    sum += t.normal_force * t.share;
    weight += t.normal_force;
  }
  return weight > 0.0 ? Vec3(sum / weight) : Vec3::Zero();
}

double PairStep::friction_share() const {
  double share = 0.0;
  for (const Patch& patch : patches_)
    share = std::max(
        share, std::abs(std::sin(patch.solution.frame.angle)) * contact_problem(patch).friction.static_friction());
  return share;
}

void PairStep::solve_tangential(double pitch_rate, double eps) {
  const Stopwatch watch(times_.tangential_s);
  problem_.state.velocity.pitch = pitch_rate;
  tangential_share_.clear();
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    Patch& patch = patches_[i];
    PatchSolution& s = patch.solution;
    move(patch);
    s.contact = patch.normal;
    kalker::ContactProblem problem = contact_problem(patch);
    problem.settings.eps = eps;
    problem.sensitivities = problem.sensitivities && !few_elements();
    if (problem.regime != kalker::Regime::frictionless) ++(few_elements() ? times_.looks : times_.tangential_solves);
    kalker::ContactSolver& contact_solver = solver(i, patch);
    if (patch.history) contact_solver.continue_from(*patch.history);
    contact_solver.solve_tangential(problem, s.contact);
    resolve_forces(patch);
    patch.predicted_force_C = s.force_C;
    if (patch.normal.force_n > 0.0)
      tangential_share_.push_back(
          {s.region.extent.box, patch.normal.force_n, (s.force_C - patch.normal_force_C) / patch.normal.force_n});
  }
}

Vec3 PairStep::force_T() const {
  Vec3 sum = Vec3::Zero();
  for (const Patch& p : patches_) sum += p.solution.frame.X_TC.rotation * p.predicted_force_C;
  return sum;
}

double PairStep::normal_force() const {
  double sum = 0.0;
  for (const Patch& p : patches_) sum += p.solution.contact.force_n;
  return sum;
}

void PairStep::estimate_refinement(kalker::ContactSolver& coarse) {
  for (Patch& patch : patches_)
    patch.solution.refinement =
        kalker::estimate_refinement(contact_problem(patch), patch.solution.contact, !at_given_height(), coarse);
}

void PairStep::find_surface_loads() {
  const MaterialVelocity material = material_velocity(problem_, placement_);
  for (Patch& patch : patches_) {
    PatchSolution& s = patch.solution;
    s.surface_loads = surface_loads(
        geometry_, placement_, material, s,
        patch.reference ? *patch.reference : detection::plane_reference(s.grid, s.reference_C), patch.slip_heights);
  }
}

std::vector<PatchSolution> PairStep::take_patches() {
  std::vector<PatchSolution> out;
  for (Patch& p : patches_) out.push_back(std::move(p.solution));
  patches_.clear();
  return out;
}

Instant PairStep::finish() {
  Instant now;
  now.next_id = previous_.next_id;
  now.shares = tangential_share_;
  now.s = problem_.state.position.x;
  // Steady contacts that follow each other start from one another too; single ones leave nothing behind.
  const bool remember_solver = aligned() || problem_.history != kalker::HistoryUse::start;
  std::vector<std::uint64_t> taken;
  for (std::size_t i = 0; i < patches_.size(); ++i) {
    Patch& patch = patches_[i];
    PatchSolution& s = patch.solution;
    // A patch keeps its number; where several come of one, the first does.
    for (const std::uint64_t id : s.came_from)
      if (s.id == 0 && std::find(taken.begin(), taken.end(), id) == taken.end()) s.id = id;
    if (s.id == 0) s.id = now.next_id++;
    taken.push_back(s.id);
    PatchMemory m;
    m.id = s.id;
    m.box = patch.box;
    const kalker::ContactSolver& contact_solver = solver(i, patch);
    m.history = contact_solver.history();
    m.force_C = s.force_C;
    if (remember_solver) m.solver = contact_solver.save();
    const double shift_x = s.frame.X_TC.origin.x() - s.reference_C.x(), shift_y = s.reference_s - s.reference_C.y();
    m.box.x_min += shift_x, m.box.x_max += shift_x;
    m.box.y_min += shift_y, m.box.y_max += shift_y;
    m.history.grid.x0 += shift_x;
    m.history.grid.y0 += shift_y;
    now.patches.push_back(std::move(m));
  }
  return now;
}

kalker::SubPatches sub_patches(const Discretisation& discretisation, const detection::ContactPatch& region,
                               std::span<const Vec2> places) {
  kalker::SubPatches sub;
  const auto& parts = region.parts;
  detection::PatchRules rules;
  rules.separation = discretisation.separation;
  rules.combination = discretisation.combination;
  const std::size_t n = parts.size();
  sub.count = static_cast<int>(n);
  sub.coupling.assign(n * n, 1.0);
  const auto beside = [&](std::size_t k, const Vec2& p) {
    const Rectangle& box = parts[k].box;
    return std::hypot(std::max({0.0, box.x_min - p.x(), p.x() - box.x_max}),
                      std::max({0.0, box.y_min - p.y(), p.y() - box.y_max}));
  };
  for (const Vec2& place : places) {
    std::size_t nearest = 0;
    for (std::size_t k = 1; k < n; ++k)
      if (beside(k, place) < beside(nearest, place)) nearest = k;
    sub.part.push_back(static_cast<std::uint8_t>(nearest + 1));
  }
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t j = 0; j < k; ++j)
      sub.coupling[k * n + j] = sub.coupling[j * n + k] =
          detection::sub_patch_coupling(detection::patch_distance(parts[k], parts[j]), rules);
  return sub;
}

}  // namespace treadmark::wheelrail
