// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "treadmark/io/cases/contact_case.hpp"

namespace treadmark::io {

namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kPerMillimetre = 1e3;
constexpr long kMostElements = 4000000;

long elements(const BasicCase& b) { return static_cast<long>(b.mx) * b.my; }

void read_kinematics(ContactReader& r) {
  ContactText& text = r.text;
  BasicCase& b = r.kept.basic;
  const int force = (*r.problem)["FORCE"];
  // A shift is a distance and a rotation, in rolling they are divided by the distance rolled.
  const bool shift = (*r.problem)["TANG"] == 1;
  text.begin_record("the line FN");
  if ((*r.problem)["NORM"] == 1) b.normal_force = text.real("FN");
  else b.approach = text.real("PEN") * kMillimetre;
  b.fx_relative.reset();
  b.fy_relative.reset();
  if (force >= 1) b.fx_relative = text.real("FX");
  else b.xi = text.real("CKSI") * (shift ? kMillimetre : 1.0);
  if (force >= 2) b.fy_relative = text.real("FY");
  else b.eta = text.real("CETA") * (shift ? kMillimetre : 1.0);
  b.phi = text.real("CPHI") * (shift ? 1.0 : kPerMillimetre);
  if (force >= 1) b.xi = 0.0;
  if (force >= 2) b.eta = 0.0;
  b.spin_x = b.spin_y = 0.0;
  if (const auto x = text.optional_real()) {
    b.spin_x = *x * kMillimetre;
    if (const auto y = text.optional_real()) b.spin_y = *y * kMillimetre;
  }
}

void read_potential_contact(ContactReader& r) {
  ContactText& text = r.text;
  BasicCase& b = r.kept.basic;
  text.begin_record("the line IPOTCN");
  const long kind = text.integer("IPOTCN");
  const SourcePosition where = text.where();
  if (kind < -6 || kind == 0 || kind > 4) text.fail(fmt::format("IPOTCN = {} does not exist", kind));
  if (kind == -6) r.refuse(where, "IPOTCN = -6, semi-double-elliptic contact (SDEC), is not supported");

  text.begin_record("the potential contact line MX");
  const long mx = text.integer("MX"), my = text.integer("MY");
  if (mx < 1 || my < 1) text.fail("MX and MY must be positive");
  if (mx > kMostElements || my > kMostElements || mx * my > kMostElements)
    text.fail(fmt::format("potential contact too large: {} x {} elements, at most {}", mx, my, kMostElements));
  b.mx = static_cast<int>(mx);
  b.my = static_cast<int>(my);
  r.kept.potential_contact = static_cast<int>(kind);

  const auto positive = [&](std::string_view name, double factor) {
    const double value = text.real(name) * factor;
    if (!(value > 0.0)) text.fail(fmt::format("{} must be positive", name));
    return value;
  };
  if (kind < 0) {
    HertzInput h;
    using Given = HertzInput::Given;
    switch (kind) {
      case -1:
        h.given = Given::curvatures;
        h.a1 = positive("A1", kPerMillimetre);
        h.b1 = positive("B1", kPerMillimetre);
        break;
      case -2:
        h.given = Given::curvature_and_ratio;
        h.a1 = positive("A1", kPerMillimetre);
        h.aob = positive("AOB", 1.0);
        break;
      case -3:
        h.given = Given::semi_axes;
        h.aa = positive("AA", kMillimetre);
        h.bb = positive("BB", kMillimetre);
        break;
      case -4:
        h.given = Given::line_curvature;
        h.a1 = positive("A1", kPerMillimetre);
        h.bb = positive("BB", kMillimetre);
        break;
      case -5:
        h.given = Given::line_semi_axis;
        h.aa = positive("AA", kMillimetre);
        h.bb = positive("BB", kMillimetre);
        break;
      default:
        for (const auto name : {"AA", "BNEG", "BPOS"}) positive(name, kMillimetre);
    }
    h.scale = positive("SCALE", 1.0);
    r.kept.hertz = h;
    b.x0 = b.y0 = b.dx = b.dy = 0.0;
    return;
  }

  const bool corner = kind <= 2;  // the first pair of numbers: lower left corner or centre of the first element
  double x = text.real(corner ? "XL" : "XC1") * kMillimetre;
  double y = text.real(corner ? "YL" : "YC1") * kMillimetre;
  if (kind == 1 || kind == 3) {
    b.dx = positive("DX", kMillimetre);
    b.dy = positive("DY", kMillimetre);
  } else {
    const double x_end = text.real(corner ? "XH" : "XCM") * kMillimetre;
    const double y_end = text.real(corner ? "YH" : "YCM") * kMillimetre;
    if (!corner && (mx < 2 || my < 2)) text.fail("IPOTCN = 4 needs at least two elements in each direction");
    b.dx = (x_end - x) / static_cast<double>(corner ? mx : mx - 1);
    b.dy = (y_end - y) / static_cast<double>(corner ? my : my - 1);
    if (!(b.dx > 0.0) || !(b.dy > 0.0)) text.fail("the potential contact has no extent");
  }
  b.x0 = corner ? x + 0.5 * b.dx : x;
  b.y0 = corner ? y + 0.5 * b.dy : y;
}

std::vector<double> read_list(ContactText& text, std::string_view record, std::string_view name, long count, double factor) {
  text.begin_record(record);
  std::vector<double> values;
  for (long i = 0; i < count; ++i)
    values.push_back(text.real(count > 20 ? fmt::format("{} {} of {}", name, i + 1, count) : fmt::format("{}{}", name, i + 1)) *
                     factor);
  return values;
}

GapInput read_gap_formula(ContactReader& r, long base) {
  ContactText& text = r.text;
  GapInput gap;
  auto& c = gap.coefficients;
  constexpr std::string_view kRecord = "the undeformed distance";
  switch (base) {
    case 1:
      gap.kind = GapInput::Kind::quadratic;
      c = read_list(text, kRecord, "B", 6, 1.0);
      for (int i = 0; i < 3; ++i) c[static_cast<std::size_t>(i)] *= kPerMillimetre;
      c[5] *= kMillimetre;
      break;
    case 2: {
      gap.kind = GapInput::Kind::circular;
      text.begin_record(kRecord);
      const long count = text.integer("NN");
      if (count < 1) text.fail("NN must be positive");
      for (const auto name : {"XM", "RM", "Y1", "DY1"}) {
        c.push_back(text.real(name) * kMillimetre);
        if (std::string_view(name) == "RM" && c.back() == 0.0) text.fail("RM must not be 0");
      }
      const auto heights = read_list(text, kRecord, "B", count, kMillimetre);
      c.insert(c.end(), heights.begin(), heights.end());
      break;
    }
    case 3: {
      gap.kind = GapInput::Kind::sinusoidal;
      c = read_list(text, kRecord, "B", 8, kMillimetre);
      for (const std::size_t wave_number : {1u, 4u}) c[wave_number] *= kPerMillimetre * kPerMillimetre;
      if (c[6] == 0.0 || c[7] == 0.0) text.fail("B7 and B8 are lengths that must not be 0");
      break;
    }
    case 9:
      gap.kind = GapInput::Kind::per_element;
      c = read_list(text, kRecord, "h of element", elements(r.kept.basic), kMillimetre);
      break;
    default:
      text.fail(fmt::format("IBASE = {} does not exist", base));
  }
  return gap;
}

void read_planform(ContactReader& r, long plan) {
  ContactText& text = r.text;
  switch (plan) {
    case 1:
      return;
    case 2:
      read_list(text, "the quadratic planform", "B", 6, 1.0);
      return;
    case 3:
      read_list(text, "the two rectangles of the planform", "XY", 8, 1.0);
      return;
    case 4: {
      text.begin_record("the line NPATCH");
      const long patches = text.integer("NPATCH");
      if (patches < 1) text.fail("NPATCH must be positive");
      for (long i = 0; i < patches; ++i) read_list(text, "the rectangle of a sub-patch", "XY", 4, 1.0);
      for (long i = 0; i + 1 < patches; ++i) read_list(text, "the coupling factors", "F", patches - 1 - i, 1.0);
      return;
    }
    default:
      text.fail(fmt::format("IPLAN = {} does not exist", plan));
  }
}

void read_gap(ContactReader& r) {
  ContactText& text = r.text;
  text.begin_record("the line IBASE");
  const long base = text.integer("IBASE");
  if (base != 9 && (base < 1 || base > 3)) text.fail(fmt::format("IBASE = {} does not exist", base));
  const long plan = text.integer("IPLAN");
  if (plan < 1 || plan > 4) text.fail(fmt::format("IPLAN = {} does not exist", plan));
  constexpr std::string_view kPlans[] = {"", "", "a quadratic planform", "two rectangles", "coupled sub-patches"};
  if (plan != 1)
    r.refuse(text.where(), fmt::format("IPLAN = {}, {}, is not supported", plan, kPlans[plan]), "use IPLAN = 1, unrestricted");
  r.kept.gap = read_gap_formula(r, base);
  r.kept.gap_elements = elements(r.kept.basic);
  read_planform(r, plan);
}

}  // namespace

BasicCase read_basic(ContactReader& r) {
  ContactText& text = r.text;
  const ControlWord& problem = *r.problem;
  const ControlWord& model = *r.model;
  const int tangential = problem["TANG"], history = problem["PVTIME"];
  const bool by_row = model["VARFRC"] == 3;

  r.read_solver();
  read_kinematics(r);
  if (model["FRCLAW"] != 1 && !by_row) r.read_friction(1, false);
  if (model["INFLCF"] >= 2) {
    if (tangential >= 2) r.read_rolling();
    r.read_material();
  }
  r.read_damping();
  r.read_heat();
  if (model["DISCNS"] == 2) read_potential_contact(r);
  if (r.kept.potential_contact == 0)
    throw Error(ErrorKind::configuration, fmt::format("D (DISCNS) = {} keeps the potential contact, but no earlier case has "
                                                      "given it", model["DISCNS"]),
                model.where("DISCNS"), "use D = 2 in the first case");
  if (model["FRCLAW"] != 1 && by_row) r.read_friction(r.kept.basic.my, false);
  const bool hertzian = r.kept.potential_contact < 0;
  if (!hertzian && model["RZNORM"] == 2) read_gap(r);
  if (model["EXRHS"] == 9) {
    text.begin_record("the extra rigid slip");
    for (long i = 0; i < 2 * elements(r.kept.basic); ++i) text.real(i % 2 == 0 ? "WX" : "WY");
    r.kept.has_extra_slip = true;
  } else if (model["EXRHS"] == 0) {
    r.kept.has_extra_slip = false;
  } else if (model["EXRHS"] == 1 && r.kept.has_extra_slip) {
    r.refuse(model.where("EXRHS"), "E (EXRHS) = 1 keeps the extra rigid slip of every element, which is not supported");
  }
  r.read_subsurface();

  BasicCase b = r.kept.basic;
  if (hertzian) {
    b.geometry = r.kept.hertz;
  } else {
    if (!r.kept.gap)
      throw Error(ErrorKind::configuration, fmt::format("Z (RZNORM) = {} keeps the undeformed distance, but no earlier case has "
                                                        "given it", model["RZNORM"]),
                  model.where("RZNORM"), "use Z = 2");
    if (r.kept.gap->kind == GapInput::Kind::per_element && r.kept.gap_elements != elements(b))
      throw Error(ErrorKind::configuration, "the undeformed distance of every element is kept although the number of elements "
                                            "has changed", model.where("RZNORM"), "use Z (RZNORM) = 2");
    b.geometry = *r.kept.gap;
  }
  b.normal_force_prescribed = problem["NORM"] == 1;
  b.regime = tangential == 0 ? RegimeInput::none : tangential == 1 ? RegimeInput::shift : RegimeInput::steady;
  const int bound = problem["BOUND"];
  b.normal_model = bound == 2 ? NormalModelInput::elliptic : bound == 3 ? NormalModelInput::parabolic : NormalModelInput::full;
  if ((bound == 2 || bound == 3) && !hertzian)
    r.refuse(problem.where("BOUND"), fmt::format("B (BOUND) = {}, {}, without Hertzian geometry is not supported", bound,
                                                 problem.described("BOUND").meaning), "use IPOTCN < 0");
  b.material = r.effective_material();
  if (model["MATER"] == 3) {
    b.tangential_model = TangentialModelInput::fastsim;
    b.fastsim_k0 = r.kept.simplified.k0;
    b.fastsim_alpha = r.kept.simplified.alpha;
    b.fastsim_beta = r.kept.simplified.beta;
  }
  if (r.kept.friction_law == 6 && model["FRCLAW"] == 1)
    r.refuse(model.where("FRCLAW"), "L (FRCLAW) = 1 keeps the temperature-dependent friction (L = 6), which is not supported");
  b.friction = r.kept.friction;
  b.solver = r.kept.solver;
  if (tangential >= 2 && !r.kept.has_rolling)
    throw Error(ErrorKind::configuration, fmt::format("T (TANG) = {} needs the rolling line CHI DQ VELOC, but no case has given it",
                                                      tangential), problem.where("TANG"), "use C (INFLCF) = 2 here");

  // A shift that continues needs the tractions of earlier cases; steady states do not.
  if (tangential == 1 && r.kept.started && history == 0)
    r.refuse(problem.where("PVTIME"), "P (PVTIME) = 0, continue from the previous case, is not supported with T (TANG) = 1, shift");
  if (tangential == 1 && r.kept.started && history == 3 && r.kept.tangential_history)
    r.refuse(problem.where("PVTIME"), "P (PVTIME) = 3, keep the previous time, is not supported with T (TANG) = 1 after P = 0");
  if (!r.kept.started || history == 1 || history == 2) r.kept.tangential_history = false;
  else if (history == 0) r.kept.tangential_history = true;
  return b;
}

}  // namespace treadmark::io
