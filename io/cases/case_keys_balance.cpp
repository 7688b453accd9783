// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/key_builder.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

namespace {

using W = WheelRailCase;

/// What a section of keys describes; any key of it brings it into being.
template <class Part>
Part& made(std::optional<Part>& part) {
  if (!part) part.emplace();
  return *part;
}

/// section.active = false takes away what the other keys have made.
template <class Part>
void add_switch(KeyList& list, const std::string& section, const std::string& what, std::optional<Part> W::*part) {
  KeyInfo info =
      key_info(section + ".active", KeyType::flag, what + "; any other key of [" + section + "] asks for it too");
  info.scope = KeyScope::wheel_rail;
  info.default_text = "false";
  CaseKey& key = list.add(info);
  key.set = [part](Case& c, const CaseValue& v, const std::filesystem::path&) {
    auto& place = content_of<W>(c).*part;
    if (v.flag())
      made(place);
    else
      place.reset();
  };
  key.text = [part](const Case& c) { return std::string(std::get<W>(c.content).*part ? "true" : "false"); };
}

template <class Part>
void add_number(KeyList& list, const std::string& path, KeyLimits limits, const std::string& doc,
                std::optional<Part> W::*part, double Part::*member) {
  list.number<W>(path, limits, doc, [part, member](W& c) -> double& { return made(c.*part).*member; });
  say_only_where(list.keys.back(), [part](const Case& c) { return (std::get<W>(c.content).*part).has_value(); });
}

void add_roller(KeyList& list) {
  const auto number = [&](const std::string& name, KeyLimits limits, const std::string& doc, double Roller::*member) {
    add_number(list, "roller." + name, limits, doc, &W::roller, member);
  };
  number("nominal_radius_mm", kAnyNumber,
         "radius where the roller's profile has z = 0; negative: the wheel runs inside a ring",
         &Roller::nominal_radius);
  number("pitch_rate_rad_s", {{}, -kMostSpeed, kMostSpeed},
         "pitch rate of the roller, positive where a wheel on it rolls forward (shift: rotation)", &Roller::pitch_rate);
  add_switch(list, "roller",
             "a roller with the profile of [rail] in place of the rail; wheelset.s_mm is where the axle stands over "
             "the roller's",
             &W::roller);
}

void add_springs(KeyList& list) {
  using S = RailSprings;
  const auto number = [&](const std::string& name, KeyLimits limits, const std::string& doc, double S::*member) {
    add_number(list, "track.springs." + name, limits, doc, &W::rail_springs, member);
  };
  number("stiffness_y_N_per_mm", kPositive, "lateral stiffness under the rail, which moves under its load",
         &S::stiffness_y);
  number("stiffness_z_N_per_mm", kNotNegative, "vertical stiffness; 0 = no vertical deflection", &S::stiffness_z);
  number("force_y_N", kAnyNumber, "further lateral force on the rail", &S::force_y);
  number("force_z_N", kAnyNumber, "further vertical force on the rail", &S::force_z);
  number("first_step_y_mm", kPositive, "first lateral step of the search for the deflection", &S::first_step_y);
  add_switch(list, "track.springs", "a rail without mass on springs", &W::rail_springs);
}

void add_damping(KeyList& list) {
  using D = Damping;
  const auto number = [&](const std::string& name, const std::string& doc, double D::*member) {
    add_number(list, "damping." + name, kNotNegative, doc, &W::damping, member);
  };
  number("normal_s", "normal force of damping over the change of the contact force in time", &D::normal);
  number("tangential_s", "the same of tangential forces", &D::tangential);
  number("max_rate_normal_N_per_s", "limit of the change of the normal force that counts", &D::max_rate_normal);
  number("max_rate_tangential_N_per_s", "limit of the change of tangential forces that counts",
         &D::max_rate_tangential);
  add_switch(list, "damping", "damping of the contact forces", &W::damping);
}

}  // namespace

void add_balance_keys(KeyList& list) {
  add_roller(list);
  add_springs(list);
  add_damping(list);
  using R = ReferenceSurface;
  list.choice<W, R>(
      "contact.reference_surface",
      {{"plane", R::plane}, {"plane_surface_slip", R::plane_surface_slip}, {"curved", R::curved}},
      "tangent plane with creepages, tangent plane with the rigid slip of the surfaces at every element, or conformal "
      "contact on a surface that is curved across the rail; in simulations the second unless given, where the theory "
      "takes it",
      [](W& c) -> R& { return c.reference_surface; });
}

}  // namespace treadmark::io
