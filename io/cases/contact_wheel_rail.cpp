// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "treadmark/io/cases/contact_case.hpp"

namespace treadmark::io {

namespace {

constexpr double kMillimetre = 1e-3;
constexpr double kPerMillimetre = 1e3;

/// 'file' MIRRORY SCALE SMOOTH [MIRRORZ [PRFOPT]] and the lines that PRFOPT announces.
SurfaceSource read_profile(ContactReader& r, std::string_view body) {
  ContactText& text = r.text;
  text.begin_record(fmt::format("the {} profile line", body));
  GeometryFile source;
  ProfileOptions& options = source.options;
  const std::string name = text.quoted("the file name");
  const SourcePosition where = text.where();
  if (name.empty()) text.fail(fmt::format("the {} profile has no file name", body));
  source.file = resolve_name(r.folder, name);

  const long mirror_y = text.integer("MIRRORY");
  if (mirror_y < -1 || mirror_y > 1) text.fail("MIRRORY must be -1, 0 or 1");
  options.mirror_y = mirror_y == 1 ? 1 : 0;
  options.scale = text.real("SCALE");
  constexpr double kSmallestScale = 1e-6;
  if (options.scale < kSmallestScale) text.fail(fmt::format("SCALE must be at least {}", kSmallestScale));
  const double strength = text.real("SMOOTH");
  if (strength < 0.0) text.fail("SMOOTH must not be negative");

  long further = 0;
  if (const auto mirror_z = text.optional_integer()) {
    if (*mirror_z < -1 || *mirror_z > 1) text.fail("MIRRORZ must be -1, 0 or 1");
    options.mirror_z = static_cast<int>(*mirror_z);
    further = text.optional_integer().value_or(0);
    if (further < 0 || further > 2) text.fail("PRFOPT must be 0, 1 or 2");
  }

  SmoothingOptions& smoothing = options.smoothing;
  if (further >= 1) {
    text.begin_record("the profile option line ISMOOTH");
    const long method = text.integer("ISMOOTH");
    if (method < 0 || method > 2) text.fail("ISMOOTH must be 0, 1 or 2");
    smoothing.method = static_cast<SmoothingOptions::Method>(method);
    constexpr double kLeastZigzag = std::numbers::pi / 4.0;
    options.zigzag_threshold = std::max(kLeastZigzag, text.angle("ZIGTHRS"));
    smoothing.kink_high = text.angle("KINKHIGH");
    smoothing.kink_low = text.angle("KINKLOW");
    if (!(smoothing.kink_high > 0.0) || !(smoothing.kink_low > 0.0) || smoothing.kink_low > smoothing.kink_high)
      text.fail("the kink thresholds must satisfy 0 < KINKLOW <= KINKHIGH");
    smoothing.kink_width = text.real("KINKWID") * kMillimetre;
    if (!(smoothing.kink_width > 0.0)) text.fail("KINKWID must be positive");
  }
  if (further == 2) {
    text.begin_record("the profile option line ERRHND");
    options.error_handling = static_cast<int>(std::clamp(text.integer("ERRHND"), -100L, 100L));
    options.max_omit = text.real("MAXOMIT");
    if (options.max_omit < 0.0 || options.max_omit > 1.0) text.fail("MAXOMIT must lie in 0 ... 1");
    if (options.error_handling != 0)
      r.note(fmt::format("ERRHND = {} at {}: read, but errors in a profile always stop the run", options.error_handling,
                         text.where().to_string()));
  }
  // lambda is a volume in the unweighted method and a wavelength in the others.
  const bool wavelength = smoothing.method != SmoothingOptions::Method::spline;
  smoothing.strength = strength * (wavelength ? kMillimetre : kMillimetre * kMillimetre * kMillimetre);

  SurfaceSource surface;
  source.open_seam = true;  // as in the reference program
  surface.geometry = source;
  surface.where = where;
  return surface;
}

void read_discretisation(ContactReader& r) {
  ContactText& text = r.text;
  text.begin_record("the discretisation line DX");
  DiscretisationInput d;
  d.dx = text.real("DX") * kMillimetre;
  if (!(d.dx > 0.0)) text.fail("DX must be positive");
  d.ds = text.real("DS") * kMillimetre;
  if (!(d.ds > 0.0)) text.fail("DS must be positive");
  d.dq_relative = text.real("DQREL");
  if (!(d.dq_relative > 0.0)) text.fail("DQREL must be positive");
  d.angle_separation = text.angle("A_SEP");
  d.separation = text.real("D_SEP") * kMillimetre;
  d.combination = text.real("D_COMB") * kMillimetre;
  if (d.combination < 0.0) text.fail("D_COMB must not be negative");
  if (d.separation < d.combination) text.fail("D_SEP must not be less than D_COMB");
  if (const auto turning = text.optional_real()) {
    d.turning = *turning * kMillimetre;
    if (const auto miss = text.optional_real()) d.near_miss = *miss * kMillimetre;
  }
  r.kept.wheel_rail.discretisation = d;
}

void read_track(ContactReader& r) {
  ContactText& text = r.text;
  const int z = (*r.model)["ZTRACK"], config = (*r.problem)["CONFIG"];
  const bool roller = config >= 4;
  TrackInput& t = r.kept.wheel_rail.track;
  if (z == 1 || z == 3) {
    text.begin_record("the track line GAUGHT");
    const double height = text.real("GAUGHT");
    t.gauge_based = height > 0.0;
    if (t.gauge_based) {
      t.gauge_height = height * kMillimetre;
      const double which = text.real("GAUGSQ");
      if (which != 0.0 && which != 1.0)
        r.note(fmt::format("GAUGSQ = {} at {}: only the first gauge point is known", which, text.where().to_string()));
      t.gauge_width = text.real("GAUGWD") * kMillimetre;
      if (!(t.gauge_width > 0.0)) text.fail("GAUGWD must be positive");
    } else {
      t.rail_y0 = text.real("RAILY0") * kMillimetre;
      t.rail_z0 = text.real("RAILZ0") * kMillimetre;
    }
    if (roller) text.real("NOMRAD");
    else t.cant = text.angle("CANT");
    t.curvature = text.optional_real().value_or(0.0) * kPerMillimetre;
    r.kept.wheel_rail.rail = read_profile(r, "rail");
    r.kept.has_rail = true;
    const auto& file = std::get<GeometryFile>(r.kept.wheel_rail.rail.geometry).file;
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension == ".slcs" && t.gauge_based)
      throw Error(ErrorKind::configuration, "a rail given by slices has no gauge point: it needs GAUGHT <= 0",
                  r.kept.wheel_rail.rail.where, "give RAILY0 and RAILZ0");
  }
  if (z == 2 || z == 3) {
    text.begin_record("the track deviation line DY");
    t.dy = text.real("DY") * kMillimetre;
    t.dz = text.real("DZ") * kMillimetre;
    t.roll = text.angle("ROLL");
    t.vy = text.real("VY") * kMillimetre;
    t.vz = text.real("VZ") * kMillimetre;
    t.vroll = text.angle("VROLL");
    if ((*r.problem)["FORCE"] == 3) {
      text.begin_record("the massless rail line KYRAIL");
      for (const auto name : {"KYRAIL", "FYRAIL", "KZRAIL", "FZRAIL"}) text.real(name);
      text.optional_real();
    }
  }
}

void read_wheelset(ContactReader& r) {
  ContactText& text = r.text;
  const int e = (*r.model)["EWHEEL"], normal = (*r.problem)["NORM"];
  WheelRailCase& c = r.kept.wheel_rail;
  WheelsetInput& w = c.wheelset;
  if (e == 0) {
    if (r.kept.previous_normal >= 0 && r.kept.previous_normal != normal)
      throw Error(ErrorKind::configuration, fmt::format("N (NORM) = {} differs from the previous case: that needs E (EWHEEL) > 0",
                                                        normal), r.problem->where("NORM"));
    return;
  }
  if (e == 3 || e == 5) {
    text.begin_record("the wheelset line FBDIST");
    w.flange_back_distance = text.real("FBDIST") * kMillimetre;
    w.flange_back_position = text.real("FBPOS") * kMillimetre;
    w.nominal_radius = text.real("NOMRAD") * kMillimetre;
    if (!(w.nominal_radius > 0.0)) text.fail("NOMRAD must be positive");
    constexpr double kUnusedTapeLine = 999.0;
    const auto tape = text.optional_real();
    w.tape_line = tape && std::abs(*tape) < kUnusedTapeLine ? std::optional(*tape * kMillimetre) : std::nullopt;
    c.wheel = read_profile(r, "wheel");
    r.kept.has_wheel = true;
  }
  text.begin_record("the wheelset position line S");
  w.s = text.real("S") * kMillimetre;
  w.y = text.real("Y") * kMillimetre;
  if (normal == 1) c.vertical_force = text.real("FZ");
  else w.z = text.real("Z") * kMillimetre;
  w.roll = text.angle("ROLL");
  w.yaw = text.angle("YAW");
  w.pitch = text.angle("PITCH");
  if (e >= 2) {
    text.begin_record("the wheelset velocity line VS");
    w.vs = text.real("VS") * kMillimetre;
    w.vy = text.real("VY") * kMillimetre;
    w.vz = text.real("VZ") * kMillimetre;
    w.vroll = text.angle("VROLL");
    w.vyaw = text.angle("VYAW");
    if ((*r.problem)["FORCE"] == 1) text.real("FX");
    else w.vpitch = text.angle("VPITCH");
  }
  if (e >= 4) {
    text.begin_record("the wheel deviation line DXWHL");
    w.dx = text.real("DXWHL") * kMillimetre;
    w.dy = text.real("DYWHL") * kMillimetre;
    w.dz = text.real("DZWHL") * kMillimetre;
    w.droll = text.angle("DROLLW");
    w.dyaw = text.angle("DYAWW");
    w.dpitch = text.angle("DPITCHW");
    text.begin_record("the wheel deviation velocity line VXWHL");
    w.dvx = text.real("VXWHL") * kMillimetre;
    w.dvy = text.real("VYWHL") * kMillimetre;
    w.dvz = text.real("VZWHL") * kMillimetre;
    w.dvroll = text.angle("VROLLW");
    w.dvyaw = text.angle("VYAWW");
    w.dvpitch = text.angle("VPITCHW");
  }
}

void put_friction(ContactReader& r, WheelRailCase& c) {
  const ContactSequence::Friction& f = r.kept.friction;
  const int variation = (*r.model)["VARFRC"];
  using Kind = FrictionVariation::Kind;
  if (f.law == 6 && (*r.model)["FRCLAW"] == 1)
    r.refuse(r.model->where("FRCLAW"), "L (FRCLAW) = 1 keeps the temperature-dependent friction (L = 6), which is not supported");
  c.friction = f.laws.front();
  c.friction_variation = {};
  if (variation == 0) return;
  if (f.variation != variation)
    r.fail_at(*r.model, "FRCLAW", fmt::format("keeps the friction law, but none for V (VARFRC) = {} has been given", variation));
  c.friction_variation = {variation == 1 ? Kind::inclination : Kind::along_track, f.positions, f.laws};
}

}  // namespace

WheelRailCase read_wheel_rail(ContactReader& r) {
  ContactText& text = r.text;
  const ControlWord& problem = *r.problem;
  const ControlWord& model = *r.model;

  r.read_solver();
  if (model["FRCLAW"] != 1) {
    long sets = 1;
    if (model["VARFRC"] != 0) {
      text.begin_record("the line NVF");
      sets = text.integer("NVF");
      if (sets < 1) text.fail("NVF must be positive");
    }
    r.read_friction(sets);
  }
  if (model["INFLCF"] == 9) throw r.refusals.front();
  if (model["INFLCF"] >= 2) {
    r.read_influence();
    r.read_material();
  }
  r.read_damping();
  r.read_heat();
  if (model["DISCNS"] >= 2) {
    read_discretisation(r);
    r.kept.discretisation_method = model["DISCNS"];
  }
  read_track(r);
  read_wheelset(r);
  r.read_subsurface();

  // Parts that are missing because no case has given them.
  if (!r.kept.has_rail)
    throw Error(ErrorKind::configuration, fmt::format("Z (ZTRACK) = {} keeps the rail, but no earlier case has given it",
                                                      model["ZTRACK"]), model.where("ZTRACK"), "use Z = 3 in the first case");
  if (!r.kept.has_wheel)
    throw Error(ErrorKind::configuration, fmt::format("E (EWHEEL) = {} keeps the wheel, but no earlier case has given it",
                                                      model["EWHEEL"]), model.where("EWHEEL"), "use E = 3 in the first case");

  WheelRailCase c = r.kept.wheel_rail;
  c.side = problem["CONFIG"] % 4 == 0 ? Side::left : Side::right;
  c.vertical_force_prescribed = problem["NORM"] == 1;
  constexpr RegimeInput kRegimes[] = {RegimeInput::none, RegimeInput::shift, RegimeInput::transient, RegimeInput::steady};
  c.regime = kRegimes[problem["TANG"]];
  c.material = r.effective_material();
  put_friction(r, c);
  c.normal_model = problem["BOUND"] == 5   ? NormalModelInput::kpec
                   : problem["BOUND"] == 6 ? NormalModelInput::analyn
                                           : NormalModelInput::full;
  r.put_simplified_theory(c.tangential_model, c.fastsim_k0, c.fastsim_alpha, c.fastsim_beta, c.fastsim_flexibility);
  c.influence = r.kept.influence;
  if (model["INFLCF"] <= 1 && c.influence.kind == InfluenceInput::Kind::angle_corrected)
    r.refuse(model.where("INFLCF"), fmt::format("C (INFLCF) = {} keeps angle-corrected influence coefficients, which are not supported",
                                                model["INFLCF"]));
  c.solver = r.kept.solver;
  DiscretisationInput& d = c.discretisation;
  const int method = r.kept.discretisation_method;
  if (model["DISCNS"] < 2 && (method == 3 || method == 4 || method >= 8))
    r.refuse(model.where("DISCNS"), fmt::format("D (DISCNS) = {} keeps D = {}, which is not supported", model["DISCNS"], method));
  d.method = method;
  d.linear_weight = r.weight == 1;
  d.max_elements = r.kept.max_elements;
  d.reference_search_mesh = true;
  r.kept.previous_normal = problem["NORM"];
  return c;
}

}  // namespace treadmark::io
