// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cctype>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/contact_case.hpp"

namespace treadmark::io {

namespace {

void read_placement(ContactReader& r) {
  ContactText& text = r.text;
  Track& t = r.kept.wheel_rail.track;
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
  if (r.on_roller()) {
    r.kept.roller_radius = text.real("NOMRAD") * kMillimetre;
    if (*r.kept.roller_radius == 0.0) text.fail("NOMRAD of a roller must not be 0");
    t.cant = 0.0;
  } else {
    t.cant = text.angle("CANT");
  }
  t.curvature = text.optional_real().value_or(0.0) * kMilli;
  r.kept.wheel_rail.rail = read_profile(r, "rail");
  r.kept.has_rail = true;
  const auto& file = std::get<GeometryFile>(r.kept.wheel_rail.rail.geometry).file;
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  if (extension == ".slcs" && t.gauge_based)
    throw Error(ErrorKind::configuration, "a rail given by slices has no gauge point: it needs GAUGHT <= 0",
                r.kept.wheel_rail.rail.where, "give RAILY0 and RAILZ0");
}

void read_springs(ContactReader& r) {
  ContactText& text = r.text;
  text.begin_record("the massless rail line KYRAIL");
  RailSprings springs;
  springs.stiffness_y = text.real("KYRAIL") * kMilli;
  springs.force_y = text.real("FYRAIL");
  springs.stiffness_z = text.real("KZRAIL") * kMilli;
  springs.force_z = text.real("FZRAIL");
  if (const auto step = text.optional_real()) {
    springs.first_step_y = *step * kMillimetre;
    if (!(springs.first_step_y > 0.0)) text.fail("DYSTEP0 must be positive");
  }
  r.kept.rail_springs = springs;
}

}  // namespace

void read_track(ContactReader& r) {
  ContactText& text = r.text;
  const int z = (*r.model)["ZTRACK"];
  Track& t = r.kept.wheel_rail.track;
  if (z == 1 || z == 3) read_placement(r);
  if (z < 2) return;
  text.begin_record("the track deviation line DY");
  t.dy = text.real("DY") * kMillimetre;
  t.dz = text.real("DZ") * kMillimetre;
  t.roll = text.angle("ROLL");
  t.vy = text.real("VY") * kMillimetre;
  t.vz = text.real("VZ") * kMillimetre;
  t.vroll = text.angle("VROLL");
  if ((*r.problem)["FORCE"] == 3) read_springs(r);
}

}  // namespace treadmark::io
