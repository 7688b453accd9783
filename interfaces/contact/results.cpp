// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/interfaces/contact/calls.hpp"
#include "treadmark/interfaces/contact/log.hpp"
#include "treadmark/interfaces/contact/sensitivities.hpp"
#include "treadmark/solvers/kalker/fastsim/flexibilities.hpp"

namespace treadmark::contact {
namespace {

bool is_shift(const Problem& p) {
  return p.previous &&
         std::visit([](const auto& content) { return content.regime == Regime::shift; }, p.previous->content);
}

const io::WheelRailCase& rail_case(const Problem& p) { return std::get<io::WheelRailCase>(p.previous->content); }

/// Of the last solution; of basic contact that has none, as it is given.
Grid2 grid_of(const Active& a) {
  if (const io::PatchResult* r = patch_result(a.problem, a.patch)) return r->fields.grid;
  if (a.problem.module == 1) a.result();
  const io::BasicCase& b = a.problem.given.basic;
  return {b.x0, b.y0, b.dx, b.dy, b.mx, b.my};
}

int count(const io::PatchFields& f, int state) { return static_cast<int>(ranges::count(f.state, state)); }

/// Where the wheel's profile comes nearest to a point in its axes: arc length [m].
double wheel_arc_length(const Problem& p, double y, double z) {
  if (!p.wheel.curve) return kNaN;
  const spline::ProfileSpline& curve = *p.wheel.curve;
  const Vec2 at(y, z);
  const auto breaks = curve.breaks();
  const auto distance = [&](double s) { return (curve.position(s) - at).squaredNorm(); };
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < breaks.size(); ++k)
    if (distance(breaks[k]) < distance(breaks[nearest])) nearest = k;
  double low = breaks[nearest == 0 ? 0 : nearest - 1], high = breaks[std::min(nearest + 1, breaks.size() - 1)];
  constexpr int kThirds = 80;
  for (int i = 0; i < kThirds; ++i) {
    const double third = (high - low) / 3.0;
    if (distance(low + third) < distance(high - third))
      high -= third;
    else
      low += third;
  }
  return 0.5 * (low + high);
}

/// Middle of the pressures in track axes [m].
Vec3 pressure_centre(const io::PatchFields& f) {
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  for (int iy = 0; iy < f.grid.ny; ++iy)
    for (int ix = 0; ix < f.grid.nx; ++ix) {
      const double pressure = f.pressure[f.grid.index(ix, iy)];
      sum += pressure * Vec3(f.grid.x(ix), f.grid.y(iy), 0.0);
      weight += pressure;
    }
  return f.X_TC.apply(weight > 0.0 ? Vec3(sum / weight) : Vec3::Zero());
}

std::array<double, 38> location(const Problem& p, const io::PatchResult& r) {
  const double l = p.units.length;
  const wheelrail::PairSolution& s = *p.solution;
  std::array<double, 38> out{};
  const auto put_at = [&](std::size_t number, std::initializer_list<double> values) {
    for (const double value : values) out[number++ - 1] = value;
  };
  const bool left = rail_case(p).side == Side::left;
  const double wheel_s = wheel_arc_length(p, left ? -r.y_wheel : r.y_wheel, r.z_wheel);
  const Vec3 centre = pressure_centre(r.fields);
  const Pose &wheel = s.placement.X_TW, &rail = s.placement.X_TR, X_WsW = s.placement.X_TWs.inverse() * wheel;
  const RollYawPitch turned = roll_yaw_pitch(wheel.rotation), in_set = roll_yaw_pitch(X_WsW.rotation);
  put_at(1, {r.x_tr / l, r.y_tr / l, r.z_tr / l, r.angle});
  // Arc lengths keep the sign of a right-hand profile.
  put_at(5, {r.x_rail / l, r.y_rail / l, r.z_rail / l, (left ? -r.s_rail : r.s_rail) / l, r.angle_rail});
  put_at(10, {r.x_wheel / l, r.y_wheel / l, r.z_wheel / l, wheel_s / l, r.angle_wheel});
  put_at(15, {centre.x() / l, centre.y() / l, 0.0, s.rail_deflection_y / l, s.rail_deflection_z / l, 0.0});
  put_at(21, {wheel.origin.x() / l, wheel.origin.y() / l, wheel.origin.z() / l, turned.roll, turned.yaw});
  put_at(26, {rail.origin.y() / l, rail.origin.z() / l, roll_yaw_pitch(rail.rotation).roll, 0.0});
  put_at(30, {r.x_wheelset / l, r.y_wheelset / l, r.z_wheelset / l, r.angle_wheelset});
  put_at(34, {X_WsW.origin.x() / l, X_WsW.origin.y() / l, X_WsW.origin.z() / l, in_set.roll, in_set.yaw});
  return out;
}

std::array<double, 24> global_forces(const io::Loads& loads, const Units& u) {
  std::array<double, 24> out{};
  std::size_t i = 0;
  for (const io::Load* load : {&loads.track, &loads.wheelset, &loads.rail, &loads.wheel}) {
    for (int k = 0; k < 3; ++k) out[i++] = u.sign * load->force[k];
    for (int k = 0; k < 3; ++k) out[i++] = u.sign * load->moment[k] / u.moment();
  }
  return out;
}

// Fields.

/// Slip of rigid bodies; of a shift a distance [m].
std::vector<double> rigid_slip(const Problem& p, const io::PatchResult& r, bool lateral) {
  io::BasicCase given;  // of a wheel on a rail the spin acts about the contact reference
  std::vector<double> extra = lateral ? r.fields.extra_slip_s : r.fields.extra_slip_x;
  if (p.module == 3) {
    given = std::get<io::BasicCase>(p.previous->content);
    extra = lateral ? given.extra_slip_y : given.extra_slip_x;
  } else {
    given.spin_x = r.reference_x;
    given.spin_y = r.reference_s;
  }
  const io::SpinSlip other = lateral ? io::SpinSlip::longitudinal : io::SpinSlip::lateral;
  const double phi = given.spin_slip == other ? 0.0 : r.phi;
  const double ahead = r.has_rolling ? given.spin_offset_factor * r.dq : 0.0;
  const double ahead_x = ahead * std::cos(r.chi), ahead_y = ahead * std::sin(r.chi);
  const Grid2& g = r.fields.grid;
  std::vector<double> out(g.size());
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const std::size_t i = g.index(ix, iy);
      out[i] =
          lateral ? r.eta + phi * (g.x(ix) - given.spin_x + ahead_x) : r.xi - phi * (g.y(iy) - given.spin_y + ahead_y);
      if (!extra.empty()) out[i] += extra[i];
    }
  return out;
}

/// A field in SI units, and what one unit of the caller is of it.
struct Field {
  std::vector<double> values;
  double unit = 1.0;
};

Field field(const Problem& p, const io::PatchResult& r, int code) {
  const io::PatchFields& f = r.fields;
  const Units& u = p.units;
  const double stress = u.stress(), length = u.length, acting = u.sign;
  const double slip = acting * (is_shift(p) ? kMillimetre : 1.0);  // a shift is in mm whatever the units
  switch (code) {
    case CNTC_fld_h: {
      constexpr double kFar = 1e20;
      Field out{f.gap, length};
      for (double& h : out.values)
        if (std::isnan(h)) h = kFar * length;
      return out;
    }
    case CNTC_fld_mu:
      return {f.friction, 1.0};
    case CNTC_fld_px:
      return {f.traction_x, acting * stress};
    case CNTC_fld_py:
      return {f.traction_s, acting * stress};
    case CNTC_fld_pn:
      return {f.pressure, stress};
    case CNTC_fld_ux:
      return {f.displacement_x, length};
    case CNTC_fld_uy:
      return {f.displacement_s, length};
    case CNTC_fld_un:
      return {f.displacement_n, length};
    case CNTC_fld_taucrt:
      return {f.yield_stress, stress};
    case CNTC_fld_uplsx:
      return {f.plastic_x, length};
    case CNTC_fld_uplsy:
      return {f.plastic_s, length};
    case CNTC_fld_sx:
      return {f.slip_x, slip};
    case CNTC_fld_sy:
      return {f.slip_s, slip};
    case CNTC_fld_temp1:
      return {f.temperature_1, 1.0};
    case CNTC_fld_temp2:
      return {f.temperature_2, 1.0};
    case CNTC_fld_wx:  // callers expect the opposite sign of slip and creepages
      return {rigid_slip(p, r, false), -slip};
    case CNTC_fld_wy:
      return {rigid_slip(p, r, true), -slip};
    default:
      throw Refusal{CNTC_err_input, fmt::format("there is no field {}", code)};
  }
}

/// zero: without friction there are no tractions, and what is not there is 0.
void put_field(const Active& a, int code, std::span<double> out, bool zero = false) {
  const io::PatchResult& r = a.result();
  const Field found = field(a.problem, r, code);
  if (found.values.empty() && !zero) throw Refusal{CNTC_err_input, fmt::format("the solution has no field {}", code)};
  for (std::size_t i = 0; i < out.size() && i < r.fields.grid.size(); ++i)
    out[i] = found.values.empty() ? 0.0 : found.values[i] / found.unit;
}

// Parameters.

constexpr int kLayer = 4;

std::vector<double> rolling_parameters(const Active& a) {
  const Problem& p = a.problem;
  const Units& u = p.units;
  const double yield = p.material_digit == kLayer ? p.material.yield / u.stress() : 0.0;
  const io::BasicCase& b = p.given.basic;
  if (p.module == 3)
    return {b.velocity / u.velocity(), b.chi, b.dq / u.length, b.spin_x / u.length, b.spin_y / u.length, yield};
  const io::PatchResult& r = a.result();
  return {r.velocity / u.velocity(), r.chi, r.dq / u.length, r.reference_x / u.length, r.reference_s / u.length, yield};
}

/// Of the simplified theory as it was used; of a layer its own; else none.
kalker::Flexibilities flexibilities_of(const Active& a) {
  const Problem& p = a.problem;
  kalker::Flexibilities none;
  none.spin_x = none.spin_y = 1.0;
  if (p.material_digit == kLayer) none.lx = none.ly = p.material.thickness / p.material.g3;
  const io::PatchResult* r = patch_result(p, a.patch);
  const TangentialModel model = of_contact_digit(kTangentialTheories, p.material_digit);
  if (r == nullptr || model == TangentialModel::full || r->ncon == 0) return none;
  kalker::ContactProblem q;
  q.material = p.given.material;
  q.tangential_model = model;
  q.fastsim = {p.material.k0, p.material.alpha, p.material.beta, p.material.flexibility};
  q.grid = r->fields.grid;
  if (p.module == 3) q.hertz = app::hertz_shape(std::get<io::BasicCase>(p.previous->content));
  const double mu = p.given.friction.laws.front().static_friction();
  return kalker::flexibilities(q, {r->xi, r->eta, r->phi}, mu, r->fn,
                               kalker::equivalent_ellipse(q.grid, r->fields.pressure), true);
}

std::vector<double> material_parameters(const Active& a) {
  const Problem& p = a.problem;
  const Units& u = p.units;
  const Material& m = p.given.material;
  const MaterialInput& in = p.material;
  const CombinedMaterial c = combine(m);
  const kalker::Flexibilities f = flexibilities_of(a);
  const double l3 = f.spin_x != 0.0 ? f.lx / f.spin_x : 0.0;
  return {m.shear_modulus_1 / u.stress(),
          m.shear_modulus_2 / u.stress(),
          c.shear_modulus / u.stress(),
          m.poisson_1,
          m.poisson_2,
          c.poisson,
          c.difference,
          f.lx / u.compliance(),
          f.ly / u.compliance(),
          l3 / u.compliance(),
          in.k0,
          in.alpha,
          in.beta,
          f.slope,
          in.g3 / u.stress(),
          in.thickness / u.length,
          in.yield / u.stress(),
          in.hardening / u.hardening(),
          in.damping.normal,
          in.damping.tangential,
          in.damping.max_rate_normal,
          in.damping.max_rate_tangential};
}

/// In mm whatever the units.
std::vector<double> friction_parameters(const Problem& p) {
  const auto& f = p.given.friction;
  std::vector<double> out = {static_cast<double>(p.friction_digit), static_cast<double>(f.laws.size()),
                             f.laws.front().memory_distance / kMillimetre,
                             f.laws.front().memory_velocity / kMillimetre};
  for (std::size_t i = 0; i < f.laws.size(); ++i) {
    const double position = f.positions.empty() ? 0.0 : f.positions[i] / (f.variation == 2 ? kMillimetre : 1.0);
    out.insert(out.end(), {position, f.laws[i].static_friction(), f.laws[i].kinetic});
  }
  return out;
}

std::array<double, 10> hertz_numbers(const Problem& p) {
  const io::HertzInput& h = p.given.hertz;
  kalker::HertzShape shape;
  shape.curvature_x = h.a1, shape.curvature_y = h.b1;
  shape.semi_axis_x = h.aa, shape.semi_axis_y = h.bb;
  shape.semi_axis_y_minus = h.bb_negative, shape.semi_axis_y_plus = h.bb_positive;
  if (const auto* solved = p.previous ? std::get_if<io::BasicCase>(&p.previous->content) : nullptr)
    if (const auto found = app::hertz_shape(*solved)) shape = *found;
  const double l = p.units.length, c = p.units.curvature();
  const double sum = shape.curvature_x + shape.curvature_y, a = shape.semi_axis_x, b = shape.semi_axis_y;
  return {shape.curvature_x / c,           shape.curvature_y / c, a / l,   b / l,
          sum > 0.0 ? 2.0 / sum / l : 0.0, std::sqrt(a * b) / l,  h.scale, shape.semi_axis_y_minus / l,
          shape.semi_axis_y_plus / l,      b > 0.0 ? a / b : 0.0};
}

}  // namespace
}  // namespace treadmark::contact

using namespace treadmark::contact;

void cntc_getparameters(int* ire, int* icp, int* itask, int* lenarr, double* values) {
  on_problem("cntc_getparameters", ire, icp, For::patch, [&](Active& a) {
    const auto out = room(values, lenarr, "values");
    switch (const int task = need(itask, "itask")) {
      case 1:
        return fill(out, rolling_parameters(a));
      case 2:
        return fill(out, material_parameters(a));
      case 3:
        return fill(out, friction_parameters(a.problem));
      default:
        throw Refusal{CNTC_err_input, fmt::format("there is no task {}", task)};
    }
  });
}

void cntc_getnumcontactpatches(int* ire, int* npatch) {
  on_problem("cntc_getnumcontactpatches", ire, nullptr, For::rail, [&](Active& a) {
    put(npatch, a.problem.result ? static_cast<int>(a.problem.result->patches.size()) : 0);
  });
}

void cntc_getcontactlocation(int* ire, int* icp, int* lenarr, double* values) {
  on_problem("cntc_getcontactlocation", ire, icp, For::rail_patch, [&](Active& a) {
    const auto* r = patch_result(a.problem, a.patch);
    fill(room(values, lenarr, "values"), r != nullptr ? location(a.problem, *r) : std::array<double, 38>{});
  });
}

void cntc_getreferencevelocity(int* ire, int* icp, double* veloc) {
  on_problem("cntc_getreferencevelocity", ire, icp, For::patch, [&](Active& a) {
    const double v = a.problem.module == 3 ? a.problem.given.basic.velocity : a.result().velocity;
    put(veloc, v / a.problem.units.velocity());
  });
}

void cntc_gethertzcontact(int* ire, int* icp, int* lenarr, double* values) {
  on_problem("cntc_gethertzcontact", ire, icp, For::basic,
             [&](Active& a) { fill(room(values, lenarr, "values"), hertz_numbers(a.problem)); });
}

void cntc_getnumelements(int* ire, int* icp, int* mx, int* my) {
  on_problem("cntc_getnumelements", ire, icp, For::patch, [&](Active& a) {
    const treadmark::Grid2 grid = grid_of(a);
    put(mx, grid.nx);
    put(my, grid.ny);
  });
}

void cntc_getgriddiscretization(int* ire, int* icp, double* dx, double* dy) {
  on_problem("cntc_getgriddiscretization", ire, icp, For::any, [&](Active& a) {
    const auto& d = a.problem.given.wheel_rail.discretisation;
    const bool as_set = a.problem.module == 1 && a.patch < 0;
    const treadmark::Grid2 grid = as_set ? treadmark::Grid2{0.0, 0.0, d.dx, d.ds, 0, 0} : grid_of(a);
    put(dx, grid.dx / a.problem.units.length);
    put(dy, grid.dy / a.problem.units.length);
  });
}

void cntc_getpotcontact(int* ire, int* icp, int* lenarr, double* values) {
  on_problem("cntc_getpotcontact", ire, icp, For::patch, [&](Active& a) {
    const treadmark::Grid2 g = grid_of(a);
    const double l = a.problem.units.length;
    const auto out = room(values, lenarr, "values");
    treadmark::ranges::fill(out, 0.0);
    fill(out, std::array{static_cast<double>(g.nx), static_cast<double>(g.ny), g.x0 / l, g.y0 / l, g.dx / l, g.dy / l});
  });
}

void cntc_getpenetration(int* ire, int* icp, double* pen) {
  on_problem("cntc_getpenetration", ire, icp, For::patch,
             [&](Active& a) { put(pen, a.result().approach / a.problem.units.length); });
}

void cntc_getcreepages(int* ire, int* icp, double* vx, double* vy, double* phi) {
  on_problem("cntc_getcreepages", ire, icp, For::patch, [&](Active& a) {
    const auto& r = a.result();
    const Units& u = a.problem.units;
    const bool shift = is_shift(a.problem);
    put(vx, u.sign * r.xi / (shift ? u.length : 1.0));
    put(vy, u.sign * r.eta / (shift ? u.length : 1.0));
    put(phi, u.sign * r.phi / (shift ? 1.0 : u.curvature()));
  });
}

void cntc_getcontactforces(int* ire, int* icp, double* fn, double* tx, double* ty, double* mz) {
  on_problem("cntc_getcontactforces", ire, icp, For::patch, [&](Active& a) {
    const auto& r = a.result();
    const Units& u = a.problem.units;
    put(fn, r.fn);
    put(tx, u.sign * r.fx);
    put(ty, u.sign * r.fs);
    put(mz, u.sign * r.mn / u.moment());
  });
}

void cntc_getglobalforces(int* ire, int* icp, int* lenarr, double* values) {
  on_problem("cntc_getglobalforces", ire, icp, For::rail_any, [&](Active& a) {
    const Problem& p = a.problem;
    if (!p.result) throw Refusal{CNTC_err_icp, "there is no solution"};
    const auto* r = patch_result(p, a.patch);
    const auto& loads = a.patch < 0 ? p.result->loads : r != nullptr ? r->loads : std::optional<treadmark::io::Loads>();
    const auto out = room(values, lenarr, "values");
    treadmark::ranges::fill(out, 0.0);
    if (loads) fill(out, global_forces(*loads, p.units));
  });
}

void cntc_getcontactpatchareas(int* ire, int* icp, double* carea, double* harea, double* sarea) {
  on_problem("cntc_getcontactpatchareas", ire, icp, For::patch, [&](Active& a) {
    const auto& r = a.result();
    const double element = r.fields.grid.cell_area() / a.problem.units.area();
    put(carea, r.ncon * element);
    put(harea, count(r.fields, 1) * element);
    put(sarea, count(r.fields, 2) * element);
  });
}

void cntc_getelementdivision(int* ire, int* icp, int* lenarr, int* eldiv) {
  on_problem("cntc_getelementdivision", ire, icp, For::patch,
             [&](Active& a) { fill(room(eldiv, lenarr, "eldiv"), a.result().fields.state); });
}

void cntc_getmaximumpressure(int* ire, int* icp, double* pnmax) {
  on_problem("cntc_getmaximumpressure", ire, icp, For::patch,
             [&](Active& a) { put(pnmax, a.result().pmax / a.problem.units.stress()); });
}

void cntc_getmaximumtraction(int* ire, int* icp, double* ptmax) {
  on_problem("cntc_getmaximumtraction", ire, icp, For::patch, [&](Active& a) {
    const auto& f = a.result().fields;
    double greatest = 0.0;
    for (std::size_t i = 0; i < f.traction_x.size(); ++i)
      greatest = std::max(greatest, std::hypot(f.traction_x[i], f.traction_s[i]));
    put(ptmax, greatest / a.problem.units.stress());
  });
}

void cntc_getmaximumtemperature(int* ire, int* icp, double* t1max, double* t2max) {
  on_problem("cntc_getmaximumtemperature", ire, icp, For::patch, [&](Active& a) {
    const auto& r = a.result();
    if (!r.max_temperature_1) warn("WARNING: there are no temperatures where H (HEAT) = 0");
    put(t1max, r.max_temperature_1.value_or(0.0));
    put(t2max, r.max_temperature_2.value_or(0.0));
  });
}

void cntc_getfielddata(int* ire, int* icp, int* ifld, int* lenarr, double* fld) {
  on_problem("cntc_getfielddata", ire, icp, For::patch,
             [&](Active& a) { put_field(a, need(ifld, "ifld"), room(fld, lenarr, "fld")); });
}

void cntc_gettractions(int* ire, int* icp, int* lenarr, double* pn, double* px, double* py) {
  on_problem("cntc_gettractions", ire, icp, For::patch, [&](Active& a) {
    put_field(a, CNTC_fld_pn, room(pn, lenarr, "pn"));
    put_field(a, CNTC_fld_px, room(px, lenarr, "px"), true);
    put_field(a, CNTC_fld_py, room(py, lenarr, "py"), true);
  });
}

void cntc_getmicroslip(int* ire, int* icp, int* lenarr, double* sx, double* sy) {
  on_problem("cntc_getmicroslip", ire, icp, For::patch, [&](Active& a) {
    put_field(a, CNTC_fld_sx, room(sx, lenarr, "sx"), true);
    put_field(a, CNTC_fld_sy, room(sy, lenarr, "sy"), true);
  });
}

void cntc_getdisplacements(int* ire, int* icp, int* lenarr, double* un, double* ux, double* uy) {
  on_problem("cntc_getdisplacements", ire, icp, For::patch, [&](Active& a) {
    put_field(a, CNTC_fld_un, room(un, lenarr, "un"), true);
    put_field(a, CNTC_fld_ux, room(ux, lenarr, "ux"), true);
    put_field(a, CNTC_fld_uy, room(uy, lenarr, "uy"), true);
  });
}

void cntc_getsensitivities(int* ire, int* icp, int* lenout, int* lenin, double* sens) {
  on_problem("cntc_getsensitivities", ire, icp, For::patch, [&](Active& a) {
    const int rows = need(lenout, "lenout"), columns = need(lenin, "lenin");
    if (rows < 0 || columns < 0) throw Refusal{CNTC_err_icp, "the size of the matrix is negative"};
    if (sens == nullptr) return;
    const SensitivityMatrix matrix = sensitivities(a.problem, a.result(), rows > 3);
    for (int column = 0; column < std::min(columns, 4); ++column)
      for (int row = 0; row < std::min(rows, 4); ++row)
        sens[static_cast<std::size_t>(column) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(row)] =
            matrix[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  });
}

void cntc_getcalculationtime(int* ire, int* icp, double* tcpu, double* twall) {
  on_problem("cntc_getcalculationtime", ire, icp, For::patch, [&](Active& a) {
    const auto found = a.problem.times.find(a.patch);
    const Stopwatch watch = found == a.problem.times.end() ? Stopwatch{} : found->second;
    put(tcpu, watch.cpu);
    put(twall, watch.wall);
  });
}

void cntc_resetcalculationtime(int* ire, int* icp) {
  on_problem("cntc_resetcalculationtime", ire, icp, For::patch, [&](Active& a) { a.problem.times.erase(a.patch); });
}
