// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/to_whole.hpp"
#include "treadmark/interfaces/contact/calls.hpp"
#include "treadmark/interfaces/contact/log.hpp"
#include "treadmark/io/cases/validate_case.hpp"

// What moves and what presses, and the geometry of basic contact.

namespace treadmark::contact {
namespace {

using Values = std::span<const double>;

[[noreturn]] void refuse_values(const char* what, int which, std::size_t count) {
  throw Refusal{CNTC_err_input, fmt::format("{} = {} does not exist, or not with {} values", what, which, count)};
}

int elements(double count) { return to_whole<int>(std::clamp(std::round(count), 1.0, 1e6)); }

void set_hertz(Problem& p, int kind, Values v) {
  if (kind < -6 || kind > -1 || v.size() != (kind == -6 ? 6u : 5u)) refuse_values("IPOTCN", kind, v.size());
  require_finite(v, "rparam");
  constexpr double kShortest = 1e-9, kFlattest = 1e-9, kLeastRatio = 1e-6;  // [m], [1/m], [-]
  const double length = p.units.length, curvature = p.units.curvature();
  const auto as_length = [&](double x) { return std::max(x * length, kShortest); };
  const auto as_curvature = [&](double x) { return std::max(x * curvature, kFlattest); };
  using Given = io::HertzInput::Given;
  io::HertzInput h;
  switch (kind) {
    case -1:
      h.given = Given::curvatures, h.a1 = as_curvature(v[2]), h.b1 = as_curvature(v[3]);
      break;
    case -2:
      h.given = Given::curvature_and_ratio, h.a1 = as_curvature(v[2]), h.aob = std::max(v[3], kLeastRatio);
      break;
    case -3:
      h.given = Given::semi_axes, h.aa = as_length(v[2]), h.bb = as_length(v[3]);
      break;
    case -4:
      h.given = Given::line_curvature, h.a1 = as_curvature(v[2]), h.bb = as_length(v[3]);
      break;
    case -5:
      h.given = Given::line_semi_axis, h.aa = as_length(v[2]), h.bb = as_length(v[3]);
      break;
    default:
      h.given = Given::semi_double_elliptic, h.aa = as_length(v[2]);
      h.bb_negative = as_length(v[3]), h.bb_positive = as_length(v[4]);
      h.bb = 0.5 * (h.bb_negative + h.bb_positive);
  }
  h.scale = std::max(v.back(), kLeastRatio);
  constexpr int kElliptic = 2;
  if (kind == -4 || kind == -5) p.flags.at(CNTC_ic_bound) = kElliptic;
  p.given.potential_contact = kind;
  p.given.hertz = h;
  p.given.basic.mx = elements(v[0]);
  p.given.basic.my = elements(v[1]);
}

/// Of basic contact: a rectangle of elements.
void set_elements(Problem& p, int kind, Values v) {
  if (kind < 1 || kind > 4 || v.size() != 6) refuse_values("IPOTCN", kind, v.size());
  require_finite(v, "rparam");
  constexpr double kSmallest = 1e-15;  // [m]
  io::BasicCase& b = p.given.basic;
  const double l = p.units.length;
  const int mx = elements(v[0]), my = elements(v[1]);
  const bool corner = kind <= 2, sizes = kind == 1 || kind == 3;
  const auto step = [&](double low, double high, int count) {
    return sizes ? high * l : (high - low) * l / std::max(1, corner ? count : count - 1);
  };
  b.mx = mx;
  b.my = my;
  b.dx = std::max(step(v[2], v[4], mx), kSmallest);
  b.dy = std::max(step(v[3], v[5], my), kSmallest);
  b.x0 = v[2] * l + (corner ? 0.5 * b.dx : 0.0);
  b.y0 = v[3] * l + (corner ? 0.5 * b.dy : 0.0);
  p.given.potential_contact = kind;
}

/// Of a wheel on a rail: what elements are made of.
void set_discretisation(Problem& p, int kind, Values v) {
  const bool known = kind == 0 ? v.size() == 2 || v.size() == 3 : kind == -1 && v.size() >= 5 && v.size() <= 7;
  if (!known) refuse_values("IPOTCN", kind, v.size());
  require_finite(v, "rparam");
  const double l = p.units.length;
  io::DiscretisationInput& d = p.given.wheel_rail.discretisation;
  d.dx = v[0] * l;
  d.ds = v[1] * l;
  if (kind == 0) return;
  d.angle_separation = v[2];
  d.separation = v[3] * l;
  d.combination = v[4] * l;
  d.turning = v.size() > 5 ? v[5] * l : 2.0 * d.separation - d.combination;
  d.near_miss = v.size() > 6 ? v[6] * l : -1e-3;
}

void set_gap(Problem& p, int base, Values v) {
  using Kind = io::GapInput::Kind;
  require_finite(v, "prmudf");
  const double l = p.units.length, c = p.units.curvature();
  io::GapInput gap;
  auto& out = gap.coefficients;
  const auto scaled = [&](std::initializer_list<double> by) {
    for (const double factor : by) out.push_back(v[out.size()] * factor);
  };
  if (base == 1 && v.size() == 6) {
    gap.kind = Kind::quadratic;
    scaled({c, c, c, 1.0, 1.0, l});
  } else if (base == 2 && v.size() >= 6 && std::round(v[0]) == static_cast<double>(v.size() - 5)) {
    gap.kind = Kind::circular;
    for (const double value : v.subspan(1)) out.push_back(value * l);
  } else if (base == 3 && v.size() == 8) {
    gap.kind = Kind::sinusoidal;
    scaled({l, c, l, l, c, l, l, l});
  } else if (base == 9 &&
             v.size() == static_cast<std::size_t>(p.given.basic.mx) * static_cast<std::size_t>(p.given.basic.my)) {
    gap.kind = Kind::per_element;
    for (const double value : v) out.push_back(value * l);
  } else {
    refuse_values("IBASE", base, v.size());
  }
  p.given.gap = std::move(gap);
}

void set_extra_slip(Problem& p, Values wx, Values wy) {
  constexpr int kPerElement = 9;
  require_finite(wx, "wx");
  require_finite(wy, "wy");
  const io::BasicCase& b = p.given.basic;
  const std::size_t count = static_cast<std::size_t>(b.mx) * static_cast<std::size_t>(b.my);
  if (count > static_cast<std::size_t>(io::kMostElements))
    throw Refusal{CNTC_err_discr, fmt::format("{} x {} elements are too many", b.mx, b.my)};
  double greatest = 0.0;
  const auto taken = [&](Values from, std::vector<double>& to) {
    to.assign(count, 0.0);
    for (std::size_t i = 0; i < count && i < from.size(); ++i) {
      to[i] = from[i];
      greatest = std::max(greatest, std::abs(from[i]));
    }
  };
  taken(wx, p.given.extra_slip_x);
  taken(wy, p.given.extra_slip_y);
  p.flags.at(CNTC_ic_exrhs) = kPerElement;
  log(Detail::calls, fmt::format("extra rigid slip: at most {:.6g}", greatest));
}

}  // namespace
}  // namespace treadmark::contact

using namespace treadmark::contact;

void cntc_settimestep(int* ire, int* icp, double* dt) {
  on_problem("cntc_settimestep", ire, icp, For::whole, [&](Active& a) {
    const double step = number(dt, "dt");
    if (a.problem.module == 1) return;
    if (!(step > 0.0)) throw Refusal{CNTC_err_input, "the time step must be positive"};
    constexpr int kShift = 1;
    if (a.problem.flags[CNTC_ic_tang] <= kShift) a.problem.time_step = step;
  });
}

void cntc_setrollingstepsize(int* ire, int* icp, double* chi, double* dq) {
  on_problem("cntc_setrollingstepsize", ire, icp, For::whole, [&](Active& a) {
    const double step = number(dq, "dq");
    if (!(step > 0.0)) throw Refusal{CNTC_err_input, "the rolling step must be positive"};
    treadmark::io::ContactSequence& g = a.problem.given;
    if (a.problem.module == 1) {
      g.wheel_rail.discretisation.dq_relative = step;
    } else {
      g.basic.chi = number(chi, "chi");
      g.basic.dq = step * a.problem.units.length;
    }
  });
}

void cntc_setreferencevelocity(int* ire, int* icp, double* veloc) {
  on_problem("cntc_setreferencevelocity", ire, icp, For::basic, [&](Active& a) {
    constexpr double kSlowest = 1e-12;  // [m/s]
    a.problem.given.basic.velocity = std::max(std::abs(number(veloc, "veloc")) * a.problem.units.velocity(), kSlowest);
  });
}

void cntc_setpenetration(int* ire, int* icp, double* pen) {
  on_problem("cntc_setpenetration", ire, icp, For::basic, [&](Active& a) {
    a.problem.given.basic.approach = number(pen, "pen") * a.problem.units.length;
    a.problem.flags.at(CNTC_ic_norm) = 0;
  });
}

void cntc_setnormalforce(int* ire, int* icp, double* fn) {
  on_problem("cntc_setnormalforce", ire, icp, For::basic, [&](Active& a) {
    a.problem.given.basic.normal_force = number(fn, "fn");
    a.problem.flags.at(CNTC_ic_norm) = 1;
  });
}

void cntc_setverticalforce(int* ire, double* fz) {
  on_problem("cntc_setverticalforce", ire, nullptr, For::rail, [&](Active& a) {
    a.problem.given.wheel_rail.vertical_force = number(fz, "fz");
    a.problem.flags.at(CNTC_ic_norm) = 1;
  });
}

void cntc_setcreepages(int* ire, int* icp, double* vx, double* vy, double* phi) {
  on_problem("cntc_setcreepages", ire, icp, For::basic, [&](Active& a) {
    constexpr int kShift = 1;
    const bool shift = a.problem.flags[CNTC_ic_tang] == kShift;
    const double x = number(vx, "vx"), y = number(vy, "vy"), turn = number(phi, "phi");
    treadmark::io::BasicCase& b = a.problem.given.basic;
    b.xi = x * (shift ? a.problem.units.length : 1.0);
    b.eta = y * (shift ? a.problem.units.length : 1.0);
    b.phi = turn * (shift ? 1.0 : a.problem.units.curvature());
  });
}

void cntc_settangentialforces(int* ire, int* icp, double* fx, double* fy) {
  on_problem("cntc_settangentialforces", ire, icp, For::whole, [&](Active& a) {
    const double x = number(fx, "fx"), y = number(fy, "fy");
    if (a.problem.module == 1) {
      a.problem.given.longitudinal_force = x;
      return;
    }
    const double length = std::max(1.0, std::hypot(x, y));
    a.problem.given.basic.fx_relative = x / length;
    a.problem.given.basic.fy_relative = y / length;
  });
}

void cntc_sethertzcontact(int* ire, int* icp, int* ipotcn, int* nparam, double* rparam) {
  on_problem("cntc_sethertzcontact", ire, icp, For::basic,
             [&](Active& a) { set_hertz(a.problem, need(ipotcn, "ipotcn"), array(rparam, nparam, "rparam")); });
}

void cntc_setpotcontact(int* ire, int* icp, int* ipotcn, int* nparam, double* rparam) {
  on_problem("cntc_setpotcontact", ire, icp, For::whole, [&](Active& a) {
    const auto values = array(rparam, nparam, "rparam");
    (a.problem.module == 1 ? set_discretisation : set_elements)(a.problem, need(ipotcn, "ipotcn"), values);
  });
}

void cntc_setundeformeddistc(int* ire, int* icp, int* ibase, int* nparam, double* prmudf) {
  on_problem("cntc_setundeformeddistc", ire, icp, For::basic,
             [&](Active& a) { set_gap(a.problem, need(ibase, "ibase"), array(prmudf, nparam, "prmudf")); });
}

void cntc_setextrarigidslip(int* ire, int* icp, int* lenarr, double* wx, double* wy) {
  on_problem("cntc_setextrarigidslip", ire, icp, For::basic,
             [&](Active& a) { set_extra_slip(a.problem, array(wx, lenarr, "wx"), array(wy, lenarr, "wy")); });
}
