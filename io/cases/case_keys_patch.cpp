// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/key_builder.hpp"

namespace treadmark::io {

namespace {

using B = BasicCase;

void add_load(KeyList& list) {
  const auto vertical = [&](const std::string& name, KeyLimits limits, const std::string& doc, double B::*member,
                            bool force) {
    list.number<B>("patch." + name, limits, doc, [member](B& c) -> double& { return c.*member; });
    CaseKey& key = list.keys.back();
    key.info.group = "patch normal";
    key.info.alternative = name;
    key.info.default_text.clear();
    key.set = [member, force, unit = unit_of_key(name)](Case& c, const CaseValue& v, const std::filesystem::path&) {
      content_of<B>(c).*member = v.number() * unit;
      content_of<B>(c).normal_force_prescribed = force;
    };
  };
  vertical("normal_force_N", kPositive, "normal force (one of this and approach_mm is required)", &B::normal_force,
           true);
  vertical("approach_mm", kAnyNumber, "prescribed approach of the bodies", &B::approach, false);

  // Creepage, shift and force are three ways to say what drives one direction.
  const auto driven = [&](const std::string& name, const std::string& doc, const std::string& direction,
                          double B::*member, std::optional<double> B::*force) {
    list.number<B>("patch." + name, kAnyNumber, doc, [member](B& c) -> double& { return c.*member; });
    CaseKey& key = list.keys.back();
    key.info.group = "patch " + direction;
    key.info.alternative = name;
    key.set = [member, force, unit = unit_of_key(name)](Case& c, const CaseValue& v, const std::filesystem::path&) {
      content_of<B>(c).*member = v.number() * unit;
      (content_of<B>(c).*force).reset();
    };
  };
  const auto forced = [&](const std::string& name, const std::string& doc, const std::string& direction,
                          double B::*member, std::optional<double> B::*force) {
    KeyInfo info = key_info("patch." + name, KeyType::number, doc);
    info.at_least = -1.0;
    info.at_most = 1.0;
    info.group = "patch " + direction;
    info.alternative = name;
    info.scope = KeyScope::patch;
    list.add(info).set = [member, force](Case& c, const CaseValue& v, const std::filesystem::path&) {
      content_of<B>(c).*force = v.number();
      content_of<B>(c).*member = 0.0;
    };
  };
  driven("creepage_x", "longitudinal creepage (rail - wheel)/V", "x", &B::xi, &B::fx_relative);
  driven("shift_x_mm", "longitudinal shift (regime = \"shift\")", "x", &B::xi, &B::fx_relative);
  forced("force_x_relative", "longitudinal force on body 1 over mu F_n, instead of the creepage", "x", &B::xi,
         &B::fx_relative);
  driven("creepage_y", "lateral creepage", "y", &B::eta, &B::fy_relative);
  driven("shift_y_mm", "lateral shift (regime = \"shift\")", "y", &B::eta, &B::fy_relative);
  forced("force_y_relative", "lateral force on body 1 over mu F_n; needs force_x_relative", "y", &B::eta,
         &B::fy_relative);
  for (const auto& [name, doc] : {std::pair<std::string, std::string>{"spin_rad_m", "spin creepage"},
                                  {"shift_rotation_rad", "rotation of a shift (regime = \"shift\")"}}) {
    KeyInfo& info = list.number<B>("patch." + name, kAnyNumber, doc, [](B& c) -> double& { return c.phi; });
    info.group = "patch rotation";
    info.alternative = name;
  }
  list.number<B>("patch.spin_center_x_mm", kAnyNumber, "x of the point about which the spin acts",
                 [](B& c) -> double& { return c.spin_x; });
  list.number<B>("patch.spin_center_y_mm", kAnyNumber, "y of the point about which the spin acts",
                 [](B& c) -> double& { return c.spin_y; });
}

void add_rolling(KeyList& list) {
  list.angle<B>("patch.rolling_direction", kAnyNumber, "rolling direction chi: 0 = +x",
                [](B& c) -> double& { return c.chi; });
  list.number<B>("patch.rolling_step_mm", kPositive, "distance rolled per step", [](B& c) -> double& { return c.dq; });
  list.number<B>("patch.velocity_m_s", kPositive, "rolling velocity", [](B& c) -> double& { return c.velocity; });
  list.number<B>("patch.spin_offset_factor", kNotNegative,
                 "share of the rolling step by which the spin centre is moved",
                 [](B& c) -> double& { return c.spin_offset_factor; });
  list.choice<B>(
      "patch.normal_model", words_of<B>(kNormalTheories),
      "pressure: solved; the Hertzian ellipsoid, a paraboloid or two half ellipsoids ([patch.hertz] only); or a fast "
      "approximation (KPEC, ANALYN) at a given approach",
      [](B& c) -> NormalModel& { return c.normal_model; });
  add_simplified_theory<B>(list, "patch.");
}

void add_extra_slip(KeyList& list) {
  // As creepages and shifts: relative velocities in rolling, distances in a shift.
  const auto component = [&](const std::string& name, const std::string& axis, const std::string& doc,
                             std::vector<double> B::*member) {
    KeyInfo& info =
        list.number_list<B>("patch." + name, doc, [member](B& c) -> std::vector<double>& { return c.*member; });
    info.group = "patch extra " + axis;
    info.alternative = name;
  };
  component("extra_slip_x", "x", "rigid slip in x added to every element (x fastest), relative to the rolling velocity",
            &B::extra_slip_x);
  component("extra_shift_x_mm", "x", "the same as a distance (regime = \"shift\")", &B::extra_slip_x);
  component("extra_slip_y", "y", "rigid slip in y added to every element", &B::extra_slip_y);
  component("extra_shift_y_mm", "y", "the same as a distance (regime = \"shift\")", &B::extra_slip_y);
}

}  // namespace

void add_patch_keys(KeyList& list) {
  add_load(list);
  add_rolling(list);
  add_extra_slip(list);
}

}  // namespace treadmark::io
