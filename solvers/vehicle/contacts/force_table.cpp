// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/force_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <mutex>
#include <numbers>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::vehicle {

ForceTable::ForceTable(std::shared_ptr<const ContactTable> contact, wheelrail::Side side,
                       std::shared_ptr<const CreepTable> creep)
    : contact_(std::move(contact)), creep_(std::move(creep)), side_(side), element_(contact_, side, creep_) {}

namespace {

/// All numbers of an answer that there is not.
WheelForces without_numbers(ContactReaction r) {
  using R = ContactReaction;
  for (wheelrail::Wrench* load : {&r.on_rail, &r.on_wheelset}) load->force = load->moment = Vec3::Constant(kNaN);
  for (double R::*number : {&R::least_gap, &R::normal_force, &R::longitudinal_creep_force, &R::lateral_creep_force,
                            &R::spin_moment, &R::frictional_power, &R::elastic_energy, &R::contact_x, &R::contact_y,
                            &R::area, &R::max_pressure, &R::wheelset_z})
    r.*number = kNaN;
  r.patches = 0;
  r.tangents.clear();
  return {std::move(r), kNaN, kNaN, kNaN};
}

bool all_finite(const WheelForces& f) {
  return ranges::all_of(columns<WheelForces>(),
                        [&](const auto& column) { return std::isfinite(column.access.get(f)); });
}

}  // namespace

WheelForces ForceTable::at(const WheelMotion& wanted) {
  if (!(wanted.vertical_load >= 0.0) || !std::isfinite(wanted.vertical_load))
    throw Error(ErrorKind::configuration, "the vertical load of a wheel must not be negative", {},
                "give 0 where its height is given");
  const bool loaded = wanted.vertical_load > 0.0;
  WheelForces out;
  ContactReaction& r = out.reaction;
  try {
    r = loaded ? element_.under_load(wanted.motion, wanted.vertical_load) : element_.evaluate(wanted.motion);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::numerical) throw;
    r.status = Status::failed;
    r.message = error.message();
  }
  out.z = loaded ? r.wheelset_z : wanted.motion.wheelset.z;
  const double most = contact_->most_load();
  const bool answered = r.status == Status::ok;
  // What the pressures carry, friction apart.
  const double carried = answered ? r.normal_force * r.tangents.front().X_TC.rotation(2, 2) : 0.0;
  if (!(carried <= most)) {
    r.status = Status::failed;
    r.message = fmt::format("the wheel presses with {:.4g} kN; the contact table reaches to {:.4g} kN", 1e-3 * carried,
                            1e-3 * most);
  }
  if (is_unsolved(r)) return without_numbers(std::move(r));
  if (r.status != Status::ok) return out;
  const double speed = std::abs(wanted.motion.wheelset_velocity.x);
  out.t_gamma = speed > 0.0 ? r.frictional_power / speed : 0.0;
  const Mat3& axes = r.tangents.front().X_TC.rotation;
  out.contact_angle = std::atan2(axes(2, 1), axes(1, 1));
  if (all_finite(out)) return out;
  r.status = Status::failed;
  r.message = "the motion is beyond what forces can be computed for";
  return without_numbers(std::move(r));
}

const TableError& TableCheck::of(const std::string& number) const {
  const auto found = ranges::find(errors, number, &TableError::number);
  if (found == errors.end())
    throw Error(ErrorKind::configuration,
                "no number of a table that is compared with the exact theory is named " + number);
  return *found;
}

namespace {

constexpr std::array<std::array<const char*, 2>, CheckedPoint::kNumbers> kComparedNumbers = {
    {{"z", ""},
     {"normal_force", "normal force"},
     {"fx", "friction bound"},
     {"fy", "normal force"},
     {"spin_moment", "friction bound times sqrt(ab)"},
     {"t_gamma", "friction bound times creepage"}}};

struct CheckPoint {
  CheckedPoint place;
  WheelMotion wanted;
};

std::vector<CheckPoint> draw(const ForceTable& table, const wheelrail::Problem& exact, const TableCheckOptions& o) {
  const ContactTable& t = table.contact();
  Random random(static_cast<std::uint64_t>(o.seed));
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  const auto angle = [&](const TableAngles& angles) {
    return angles.intervals > 0 ? between(-angles.most, angles.most) : 0.0;
  };
  // Of any order of magnitude down to a hundredth of the greatest, either sign.
  const auto creepage = [&] {
    constexpr double kLeast = 0.01;
    const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
    return sign * o.creepage * std::pow(kLeast, random.uniform());
  };
  const double least = t.least_load(), most = t.most_load();
  const Vec3 arm = t.nominal().X_TW.origin - t.nominal().X_TWs.origin;
  std::vector<CheckPoint> points;
  points.reserve(static_cast<std::size_t>(o.points));
  for (int i = 0; i < o.points; ++i) {
    CheckPoint c;
    CheckedPoint& at = c.place;
    at.y = between(t.y_min(), t.y_max());
    PairMotion& m = c.wanted.motion;
    m.wheelset.roll = at.roll = angle(t.roll()), m.wheelset.yaw = at.yaw = angle(t.yaw());
    const Vec3 turned = rotation_x(m.wheelset.roll) * rotation_z(m.wheelset.yaw) * arm - arm;
    m.wheelset.y = at.y - turned.y();
    // Friction beside the pressures must not lift the load above the table's greatest one.
    constexpr double kBelow = 0.8;
    c.wanted.vertical_load = at.load = least * std::pow(kBelow * most / least, random.uniform());
    m.wheelset_velocity.x = o.speed;
    m.wheelset_velocity.y = o.speed * (creepage() + m.wheelset.yaw);
    m.wheelset_velocity.pitch = -o.speed / exact.wheelset.nominal_radius * (1.0 + creepage());
    points.push_back(c);
  }
  return points;
}

wheelrail::Problem problem_at(const wheelrail::Problem& rest, const PairMotion& m, double load) {
  wheelrail::Problem p = rest;
  p.state.position = m.wheelset;
  p.state.velocity = m.wheelset_velocity;
  p.vertical_force = load;
  return p;
}

CheckedPoint compare(ForceTable table, wheelrail::Pair& pair, const wheelrail::Problem& rest, const CheckPoint& c) {
  CheckedPoint out = c.place;
  const double load = c.wanted.vertical_load;
  const wheelrail::PairSolution s = pair.solve(problem_at(rest, c.wanted.motion, load));
  out.solved = s.status == Status::ok && !s.patches.empty();
  if (!out.solved) return out;
  const WheelForces under_load = table.at(c.wanted);
  WheelMotion at_height{c.wanted.motion, 0.0};
  at_height.motion.wheelset.z = s.z;
  const WheelForces at_z = table.at(at_height);
  out.answered = under_load.reaction.status == Status::ok && !is_unsolved(at_z.reaction);
  if (!out.answered) return out;

  double normal = 0.0, moment = 0.0, power = 0.0, area = 0.0;
  const wheelrail::PatchSolution* largest = nullptr;
  for (const wheelrail::PatchSolution& patch : s.patches) {
    const kalker::ContactSolution& k = patch.contact;
    normal += k.force_n, moment += k.moment_n, power -= k.frictional_power;
    area += k.elements_contact * patch.grid.cell_area();
    if (!largest || k.force_n > largest->contact.force_n) largest = &patch;
  }
  const ContactReaction& r = under_load.reaction;
  const wheelrail::ContactKinematics& creep = largest->kinematics;
  const FrictionLaw law =
      friction_at(rest.friction_inclination, rest.friction_laws, largest->frame.angle, rest.friction);
  constexpr double kLeastCreepage = 1e-4;
  // Without friction nothing is off by any share of it.
  const double bound = std::max(std::numeric_limits<double>::min(), law.static_friction() * normal),
               size = std::sqrt(area * std::numbers::inv_pi),
               creepage = std::max(kLeastCreepage, std::hypot(creep.xi, creep.eta, size * creep.phi));
  const double speed = c.wanted.motion.wheelset_velocity.x;
  out.error = {under_load.z - s.z,
               at_z.reaction.normal_force / normal - 1.0,
               (r.on_rail.force.x() - s.load.track.force.x()) / bound,
               (r.on_rail.force.y() - s.load.track.force.y()) / normal,
               (r.spin_moment - moment) / (bound * size),
               (under_load.t_gamma - power / speed) / (bound * creepage)};
  return out;
}

}  // namespace

void require_sensible(const TableCheckOptions& o) {
  constexpr int kMostPoints = 1000000;
  if (o.points < 1 || o.points > kMostPoints || !(o.speed > 0.0) || !std::isfinite(o.speed) ||
      !(o.creepage > 0.0 && o.creepage <= 0.5))
    throw Error(ErrorKind::configuration,
                "a table is compared at 1 to 1000000 points, at a positive speed and creepages up to 0.5");
}

TableCheck table_check_of(const TableCheckOptions& options, const std::vector<CheckedPoint>& points) {
  TableCheck check;
  check.options = options;
  for (const auto& [number, over] : kComparedNumbers)
    check.errors.push_back({number, over, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  for (const CheckedPoint& p : points) {
    const bool solved = p.solved && ranges::all_of(p.error, [](double error) { return std::isfinite(error * error); });
    (!solved ? check.unsolved : !p.answered ? check.unanswered : check.compared) += 1;
    if (!solved || !p.answered) continue;
    for (std::size_t k = 0; k < check.errors.size(); ++k) {
      TableError& error = check.errors[k];
      error.rms += p.error[k] * p.error[k];
      if (std::abs(p.error[k]) < error.worst) continue;
      error.worst = std::abs(p.error[k]);
      error.y = p.y, error.roll = p.roll, error.yaw = p.yaw, error.load = p.load;
    }
  }
  if (check.compared == 0)
    throw Error(ErrorKind::numerical, "the table could be compared with the exact theory nowhere");
  for (TableError& error : check.errors) error.rms = std::sqrt(error.rms / check.compared);
  constexpr double kRisk = 0.01;
  check.beyond = 1.0 - std::pow(kRisk, 1.0 / check.compared);
  return check;
}

void require_whole(const TableCheck& check) {
  const auto finite = [](const auto& row) {
    return ranges::all_of(columns<std::remove_cvref_t<decltype(row)>>(), [&](const auto& column) {
      return column.access.get == nullptr || std::isfinite(column.access.get(row));
    });
  };
  bool whole = check.compared > 0 && finite(check) && check.errors.size() == kComparedNumbers.size();
  for (std::size_t k = 0; whole && k < kComparedNumbers.size(); ++k)
    whole = check.errors[k].number == kComparedNumbers[k][0] && finite(check.errors[k]);
  if (!whole) throw Error(ErrorKind::configuration, "the comparison with the exact theory is not whole");
}

TableCheck check_table(const ForceTable& table, const wheelrail::Geometry& geometry, const wheelrail::Problem& exact,
                       const TableCheckOptions& options, const Progress& progress) {
  require_sensible(options);
  const ForceTable right = table.on(wheelrail::Side::right);
  wheelrail::Problem rest = table.contact().problem();
  rest.regime = kalker::Regime::steady;
  rest.tangential_model = kalker::TangentialModel::full;
  rest.refinement = false;
  rest.discretisation = exact.discretisation;
  const std::vector<CheckPoint> points = draw(right, rest, options);
  std::vector<CheckedPoint> compared(points.size());
  std::mutex mutex;
  std::size_t finished = 0;
  parallel_for(points.size(), [&](std::size_t i) {
    check_cancelled();
    wheelrail::Pair pair(geometry);
    compared[i] = compare(right, pair, rest, points[i]);
    const std::lock_guard lock(mutex);
    ++finished;
    if (progress.report) progress.report(finished, points.size(), "comparison with the exact theory");
  });

  return table_check_of(options, compared);
}

}  // namespace treadmark::vehicle

namespace treadmark {
namespace {

using access::of;
using access::word;
using unit::kM;
using unit::kN;
using unit::kOne;
using vehicle::TableCheck;
using vehicle::TableError;
using vehicle::WheelForces;
using vehicle::WheelMotion;
using wheelrail::SixMotion;

constexpr FileUnit kRad{"rad"}, kSpeed{"m/s"}, kRate{"rad/s"}, kNm{"N m"}, kW{"W"}, kM2{"m2"}, kPa{"Pa"};

template <auto Member>
constexpr Access<WheelMotion> place() {
  return {[](const WheelMotion& w) { return w.motion.wheelset.*Member; },
          [](WheelMotion& w, double value) { w.motion.wheelset.*Member = value; }};
}
template <auto Member>
constexpr Access<WheelMotion> rate() {
  return {[](const WheelMotion& w) { return w.motion.wheelset_velocity.*Member; },
          [](WheelMotion& w, double value) { w.motion.wheelset_velocity.*Member = value; }};
}
template <auto Member>
constexpr Access<WheelMotion> rail() {
  return {[](const WheelMotion& w) { return w.motion.rail.*Member; },
          [](WheelMotion& w, double value) { w.motion.rail.*Member = value; }};
}
template <auto Member>
constexpr Access<WheelForces> reaction() {
  return {[](const WheelForces& f) { return static_cast<double>(f.reaction.*Member); }};
}
template <auto Load, auto Part, int I>
constexpr Access<WheelForces> load() {
  return {[](const WheelForces& f) { return (f.reaction.*Load.*Part)[I]; }};
}

using R = vehicle::ContactReaction;
using Load = wheelrail::Wrench;
using Rail = vehicle::RailMotion;

// clang-format off
constexpr Column<WheelMotion> kMotion[] = {
    {"", kM, "y", place<&SixMotion::y>(), "wheelset to the right of its central position"},
    {"", kM, "z", place<&SixMotion::z>(), "downwards; does not count with a load"},
    {"", kRad, "roll", place<&SixMotion::roll>(), "of the wheelset"},
    {"", kRad, "yaw", place<&SixMotion::yaw>(), "of the wheelset"},
    {"", kSpeed, "vx", rate<&SixMotion::x>(), "along the track"},
    {"", kSpeed, "vy", rate<&SixMotion::y>(), "to the right"},
    {"", kSpeed, "vz", rate<&SixMotion::z>(), "downwards"},
    {"", kRate, "vroll", rate<&SixMotion::roll>(), "rate of roll"},
    {"", kRate, "vyaw", rate<&SixMotion::yaw>(), "rate of yaw"},
    {"", kRate, "vpitch", rate<&SixMotion::pitch>(), "rate of pitch, negative forwards"},
    {"", kN, "vertical_load", of<&WheelMotion::vertical_load>(), "on the rail; 0: the height z is given"},
    {"", kM, "rail_y", rail<&Rail::y>(), "rail to the right of its place at rest"},
    {"", kM, "rail_z", rail<&Rail::z>(), "downwards"},
    {"", kRad, "rail_roll", rail<&Rail::roll>(), "roll of the rail"},
    {"", kSpeed, "rail_vy", rail<&Rail::vy>(), "to the right"},
    {"", kSpeed, "rail_vz", rail<&Rail::vz>(), "downwards"},
    {"", kRate, "rail_vroll", rail<&Rail::vroll>(), "rate of roll of the rail"}};

constexpr Column<WheelForces> kForces[] = {
    {"", kM, "z", of<&WheelForces::z>(), "height of the wheelset, given or found, downwards"},
    {"", kM, "least_gap", reaction<&R::least_gap>(), "negative: penetration along the normal"},
    {"", kN, "normal_force", reaction<&R::normal_force>(), "along the normal of the contact"},
    {"", kN, "fx", reaction<&R::longitudinal_creep_force>(), "creep force on the rail, forwards"},
    {"", kN, "fs", reaction<&R::lateral_creep_force>(), "creep force on the rail, lateral in the plane of contact"},
    {"", kNm, "spin_moment", reaction<&R::spin_moment>(), "of creep on the rail, about the normal"},
    {"", kN, "rail_fx", load<&R::on_rail, &Load::force, 0>(), "on the rail, track axes"},
    {"", kN, "rail_fy", load<&R::on_rail, &Load::force, 1>(), "on the rail, track axes"},
    {"", kN, "rail_fz", load<&R::on_rail, &Load::force, 2>(), "on the rail, track axes"},
    {"", kNm, "rail_mx", load<&R::on_rail, &Load::moment, 0>(), "on the rail, about the origin of its profile"},
    {"", kNm, "rail_my", load<&R::on_rail, &Load::moment, 1>(), "on the rail, about the origin of its profile"},
    {"", kNm, "rail_mz", load<&R::on_rail, &Load::moment, 2>(), "on the rail, about the origin of its profile"},
    {"", kN, "wheelset_fx", load<&R::on_wheelset, &Load::force, 0>(), "on the wheelset, track axes"},
    {"", kN, "wheelset_fy", load<&R::on_wheelset, &Load::force, 1>(), "on the wheelset, track axes"},
    {"", kN, "wheelset_fz", load<&R::on_wheelset, &Load::force, 2>(), "on the wheelset, track axes"},
    {"", kNm, "wheelset_mx", load<&R::on_wheelset, &Load::moment, 0>(), "on the wheelset, about its centre"},
    {"", kNm, "wheelset_my", load<&R::on_wheelset, &Load::moment, 1>(), "on the wheelset, about its centre"},
    {"", kNm, "wheelset_mz", load<&R::on_wheelset, &Load::moment, 2>(), "on the wheelset, about its centre"},
    {"", kN, "t_gamma", of<&WheelForces::t_gamma>(), "power of friction over speed"},
    {"", kW, "friction_power", reaction<&R::frictional_power>(), "lost"},
    {"", kRad, "contact_angle", of<&WheelForces::contact_angle>(), "against the plane of the track"},
    {"", kM, "contact_x", reaction<&R::contact_x>(), "from the axle, forwards"},
    {"", kM, "contact_y", reaction<&R::contact_y>(), "track axes"},
    {"", kM2, "area", reaction<&R::area>(), "of contact"},
    {"", kPa, "max_pressure", reaction<&R::max_pressure>(), "greatest, of the ellipses"}};

constexpr Column<TableError> kErrors[] = {
    {"number", kOne, "number", of<&TableError::number>(), "", kInTable, "number"},
    {"over", kOne, "over", of<&TableError::over>(), "what it is divided by; empty: z, in m", kInTable, "over"},
    {"worst", kOne, "worst", of<&TableError::worst>(), "magnitude", kInTable, "worst"},
    {"rms", kOne, "rms", of<&TableError::rms>(), "root of the mean square", kInTable, "rms"},
    {"y_m", kM, "y", of<&TableError::y>(), "where it was worst", kInTable, "at y", 5},
    {"roll_rad", kRad, "roll", of<&TableError::roll>(), "", kInTable, "roll", 5},
    {"yaw_rad", kRad, "yaw", of<&TableError::yaw>(), "", kInTable, "yaw", 5},
    {"load_N", kN, "load", of<&TableError::load>(), "vertical", kInTable, "load", 0}};

constexpr Column<TableCheck> kCheck[] = {
    {"compared", kOne, "compared", of<&TableCheck::compared>(), "points that both have an answer for", kInTable, "points compared"},
    {"unsolved", kOne, "unsolved", of<&TableCheck::unsolved>(), "for which the exact theory has none", kInTable, "not solved exactly"},
    {"unanswered", kOne, "unanswered", of<&TableCheck::unanswered>(), "for which the table has none", kInTable, "without answer"},
    {"beyond", kOne, "beyond", of<&TableCheck::beyond>(), "greatest share of all places with errors above the worst, with a confidence of 99 %", kInTable, "beyond the worst, at most", 4}};
// clang-format on

}  // namespace

template <>
std::span<const Column<WheelMotion>> columns() {
  return kMotion;
}
template <>
std::span<const Column<WheelForces>> columns() {
  return kForces;
}
template <>
std::span<const Column<TableError>> columns() {
  return kErrors;
}
template <>
std::span<const Column<TableCheck>> columns() {
  return kCheck;
}

}  // namespace treadmark
