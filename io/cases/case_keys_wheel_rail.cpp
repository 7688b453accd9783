// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <numbers>

#include "treadmark/core/platform/from_chars.hpp"
#include "treadmark/io/cases/key_builder.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

namespace {

using W = WheelRailCase;

constexpr KeyLimits kSpeed{{}, -kMostSpeed, kMostSpeed};
constexpr KeyLimits kAside{{}, -1000.0, 1000.0};    // [mm]
constexpr KeyLimits kQuarterTurn{{}, -90.0, 90.0};  // [deg]

bool is_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

/// "1:40", "1:37.5"
bool is_ratio(std::string_view text) {
  if (!text.starts_with("1:")) return false;
  text.remove_prefix(2);
  const std::size_t dot = text.find('.');
  return is_digits(text.substr(0, dot)) && (dot == std::string_view::npos || is_digits(text.substr(dot + 1)));
}

void add_track(KeyList& list) {
  list.number<W>("track.gauge_mm", kGaugeMm, "track gauge; the rail is placed by its gauge point",
                 [](W& c) -> double& { return c.track.gauge_width; });
  CaseKey& gauge = list.keys.back();
  gauge.info.group = "track placement";
  gauge.info.alternative = "gauge";
  gauge.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    Track& t = content_of<W>(c).track;
    t.gauge_width = v.number() * unit_of_key("gauge_mm");
    t.gauge_based = true;
  };
  gauge.written = [](const Case& c, const std::filesystem::path&) {
    const Track& t = std::get<W>(c.content).track;
    return t.gauge_based ? exact_text(t.gauge_width, unit_of_key("gauge_mm")) : std::string();
  };
  list.number<W>("track.gauge_height_mm", kPositive, "depth below the rail top at which the gauge is measured",
                 [](W& c) -> double& { return c.track.gauge_height; });
  const auto absolute = [&](const std::string& name, const std::string& doc, double Track::*member) {
    list.number<W>("track." + name, kAnyNumber, doc, [member](W& c) -> double& { return c.track.*member; });
    CaseKey& key = list.keys.back();
    key.info.group = "track placement";
    key.info.alternative = "absolute";
    key.set = [member](Case& c, const CaseValue& v, const std::filesystem::path&) {
      Track& t = content_of<W>(c).track;
      t.*member = v.number() * unit_of_key("y_mm");
      t.gauge_based = false;
    };
    key.written = [member](const Case& c, const std::filesystem::path&) {
      const Track& t = std::get<W>(c.content).track;
      return t.gauge_based ? std::string() : exact_text(t.*member, unit_of_key("y_mm"));
    };
  };
  absolute("rail_y_mm", "rail profile origin placed at this y instead of by the gauge", &Track::rail_y0);
  absolute("rail_z_mm", "rail profile origin placed at this z instead of by the gauge", &Track::rail_z0);

  constexpr KeyLimits kCant{{}, -45.0, 45.0};
  list.angle<W>("track.cant", kCant, "rail inclination, positive = rail head turned inward",
                [](W& c) -> double& { return c.track.cant; });
  KeyInfo ratio = key_info("track.cant", KeyType::text, "rail inclination as a ratio, for example \"1:40\"");
  ratio.pattern = "^1:[0-9]+(\\.[0-9]+)?$";
  ratio.matches = is_ratio;
  ratio.like = "\"1:40\"";
  ratio.group = "track.cant";
  ratio.alternative = "ratio";
  ratio.scope = KeyScope::wheel_rail;
  CaseKey& inclined = list.add(ratio);
  inclined.written = [](const Case& c, const std::filesystem::path&) {
    const double cant = std::get<W>(c.content).track.cant, run = std::round(1.0 / std::tan(cant));
    return run >= 1.0 && std::isfinite(run) && std::atan(1.0 / run) == cant ? fmt::format("\"1:{:.0f}\"", run)
                                                                            : std::string();
  };
  inclined.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    const std::string& text = v.text();
    double run = 0.0;
    from_chars(text.data() + 2, text.data() + text.size(), run);
    if (!(run >= 1.0))
      throw Error(ErrorKind::configuration, "track.cant must lie between 1:1 and flat", v.where,
                  "for example \"1:40\"");
    content_of<W>(c).track.cant = std::atan(1.0 / run);
  };
  list.number<W>("track.curvature_per_m", kAnyNumber, "curvature of the track, positive in a curve to the right",
                 [](W& c) -> double& { return c.track.curvature; });
  list.number<W>("track.irregularity_y_mm", kAnyNumber, "lateral irregularity of the rail",
                 [](W& c) -> double& { return c.track.dy; });
  list.number<W>("track.irregularity_z_mm", kAnyNumber, "vertical irregularity of the rail, positive down",
                 [](W& c) -> double& { return c.track.dz; });
  list.angle<W>("track.irregularity_roll", kAnyNumber, "roll irregularity of the rail",
                [](W& c) -> double& { return c.track.roll; });
  list.number<W>("track.irregularity_vy_m_s", kSpeed, "lateral velocity of the rail",
                 [](W& c) -> double& { return c.track.vy; });
  list.number<W>("track.irregularity_vz_m_s", kSpeed, "vertical velocity of the rail",
                 [](W& c) -> double& { return c.track.vz; });
  list.number<W>("track.irregularity_vroll_rad_s", kSpeed, "roll rate of the rail",
                 [](W& c) -> double& { return c.track.vroll; });
}

void add_wheelset(KeyList& list) {
  list.number<W>("wheelset.flange_back_distance_mm", kNotNegative,
                 "distance between the flange backs of the two wheels",
                 [](W& c) -> double& { return c.wheelset.flange_back_distance; });
  list.number<W>("wheelset.flange_back_position_mm", kAnyNumber, "y of the flange back in wheel profile coordinates",
                 [](W& c) -> double& { return c.wheelset.flange_back_position; });
  list.number<W>("wheelset.nominal_radius_mm", kWheelRadiusMm, "wheel radius where the profile has z = 0",
                 [](W& c) -> double& { return c.wheelset.nominal_radius; });
  KeyInfo tape = key_info("wheelset.tape_line_y_mm", KeyType::number,
                          "y of the tape line in wheel profile coordinates; without it the profile's z = 0 counts");
  tape.scope = KeyScope::wheel_rail;
  CaseKey& line = list.add(tape);
  line.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    content_of<W>(c).wheelset.tape_line = v.number() * unit_of_key("y_mm");
  };
  line.written = [](const Case& c, const std::filesystem::path&) {
    const auto& y = std::get<W>(c.content).wheelset.tape_line;
    return y ? exact_text(*y, unit_of_key("y_mm")) : std::string();
  };
  list.number<W>("wheelset.s_mm", kAnyNumber, "position along the track",
                 [](W& c) -> double& { return c.state.position.x; });
  list.number<W>("wheelset.y_mm", kAside, "lateral position", [](W& c) -> double& { return c.state.position.y; });

  const auto vertical = [&](const std::string& name, KeyLimits limits, const std::string& doc, auto place, bool force) {
    list.number<W>("wheelset." + name, limits, doc, place);
    CaseKey& key = list.keys.back();
    key.info.group = "wheelset vertical";
    key.info.alternative = name;
    key.info.default_text.clear();
    key.set = [place, force, unit = unit_of_key(name)](Case& c, const CaseValue& v, const std::filesystem::path&) {
      W& content = content_of<W>(c);
      place(content) = v.number() * unit;
      content.vertical_force_prescribed = force;
    };
    key.written = [force, written = key.written](const Case& c, const std::filesystem::path& folder) {
      return std::get<W>(c.content).vertical_force_prescribed == force ? written(c, folder) : std::string();
    };
  };
  vertical(
      "vertical_force_N", kPositive, "vertical force of this wheel on the rail (one of this and z_mm is required)",
      [](W& c) -> double& { return c.vertical_force; }, true);
  vertical(
      "z_mm", kAnyNumber, "prescribed vertical displacement of the axle, positive down",
      [](W& c) -> double& { return c.state.position.z; }, false);
  list.angle<W>("wheelset.roll", kQuarterTurn, "roll angle", [](W& c) -> double& { return c.state.position.roll; });
  list.angle<W>("wheelset.yaw", kQuarterTurn, "yaw angle", [](W& c) -> double& { return c.state.position.yaw; });
  list.angle<W>("wheelset.pitch", kAnyNumber,
                "pitch angle; it turns out-of-round wheels: material angle theta = -pitch is lowest",
                [](W& c) -> double& { return c.state.position.pitch; });
  for (const std::string unit : {"m_s", "km_h"}) {
    KeyInfo& velocity = list.number<W>("wheelset.velocity_" + unit, kSpeed, "forward velocity",
                                       [](W& c) -> double& { return c.state.velocity.x; });
    for (auto* limit : {&velocity.at_least, &velocity.at_most}) *limit = **limit / unit_of_key(velocity.path);
    velocity.group = "wheelset.velocity";
    velocity.alternative = unit;
  }
  list.number<W>("wheelset.vy_m_s", kSpeed, "lateral velocity", [](W& c) -> double& { return c.state.velocity.y; });
  list.number<W>("wheelset.vz_m_s", kSpeed, "vertical velocity", [](W& c) -> double& { return c.state.velocity.z; });
  list.number<W>("wheelset.vroll_rad_s", kSpeed, "roll rate", [](W& c) -> double& { return c.state.velocity.roll; });
  list.number<W>("wheelset.vyaw_rad_s", kSpeed, "yaw rate", [](W& c) -> double& { return c.state.velocity.yaw; });
  list.number<W>("wheelset.vpitch_rad_s", kSpeed,
                 "pitch rate, negative when rolling forward (pure rolling: -velocity/radius)",
                 [](W& c) -> double& { return c.state.velocity.pitch; });
  CaseKey& rate = list.keys.back();
  rate.info.group = "wheelset pitch rate";
  rate.info.alternative = "rate";
  rate.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    content_of<W>(c).state.velocity.pitch = v.number();
    content_of<W>(c).longitudinal_force.reset();
    content_of<W>(c).rolls_by_radius = false;
  };
  rate.written = [written = rate.written](const Case& c, const std::filesystem::path& folder) {
    const W& w = std::get<W>(c.content);
    return w.longitudinal_force || w.rolls_by_radius ? std::string() : written(c, folder);
  };
  KeyInfo force = key_info(
      "wheelset.longitudinal_force_N", KeyType::number,
      "longitudinal force on the rail in wheelset axes; the pitch rate is then sought (positive: the wheel brakes)");
  force.scope = KeyScope::wheel_rail;
  force.group = "wheelset pitch rate";
  force.alternative = "force";
  CaseKey& longitudinal = list.add(force);
  longitudinal.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    content_of<W>(c).longitudinal_force = v.number();
    content_of<W>(c).rolls_by_radius = false;
  };
  longitudinal.written = [](const Case& c, const std::filesystem::path&) {
    const auto& fx = std::get<W>(c.content).longitudinal_force;
    return fx ? exact_text(*fx, 1.0) : std::string();
  };
  KeyInfo rolling = key_info("wheelset.rolling", KeyType::choice,
                             "the pitch rate of a wheel without drive and brakes: free = longitudinal_force_N = 0, "
                             "nominal = -velocity/nominal_radius");
  rolling.choices = {"free", "nominal"};
  rolling.scope = KeyScope::wheel_rail;
  rolling.group = "wheelset pitch rate";
  rolling.alternative = "rolling";
  CaseKey& rolls = list.add(rolling);
  rolls.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    W& w = content_of<W>(c);
    w.rolls_by_radius = v.text() == "nominal";
    w.longitudinal_force.reset();
    if (!w.rolls_by_radius) w.longitudinal_force = 0.0;
  };
  rolls.written = [](const Case& c, const std::filesystem::path&) {
    return std::get<W>(c.content).rolls_by_radius ? toml_text("nominal") : std::string();
  };
}

void add_flexible_wheelset(KeyList& list) {
  const auto deviation = [&](const std::string& name, const std::string& doc, SixMotion WheelsetState::*motion,
                             double SixMotion::*axis) {
    list.number<W>("wheelset.deviation_" + name, name.starts_with('v') ? kSpeed : kAnyNumber, doc,
                   [=](W& c) -> double& { return c.state.*motion.*axis; });
  };
  const auto rotation = [&](const std::string& name, const std::string& doc, double SixMotion::*axis) {
    list.angle<W>("wheelset.deviation_" + name, kAnyNumber, doc,
                  [axis](W& c) -> double& { return c.state.wheel_offset.*axis; });
  };
  constexpr auto kOffset = &WheelsetState::wheel_offset, kRate = &WheelsetState::wheel_velocity;
  deviation("x_mm", "longitudinal deviation of the wheel of a flexible wheelset", kOffset, &SixMotion::x);
  deviation("y_mm", "lateral deviation", kOffset, &SixMotion::y);
  deviation("z_mm", "vertical deviation", kOffset, &SixMotion::z);
  rotation("roll", "roll deviation", &SixMotion::roll);
  rotation("yaw", "yaw deviation", &SixMotion::yaw);
  rotation("pitch", "pitch deviation", &SixMotion::pitch);
  deviation("vx_m_s", "rate of the longitudinal deviation", kRate, &SixMotion::x);
  deviation("vy_m_s", "rate of the lateral deviation", kRate, &SixMotion::y);
  deviation("vz_m_s", "rate of the vertical deviation", kRate, &SixMotion::z);
  deviation("vroll_rad_s", "rate of the roll deviation", kRate, &SixMotion::roll);
  deviation("vyaw_rad_s", "rate of the yaw deviation", kRate, &SixMotion::yaw);
  deviation("vpitch_rad_s", "rate of the pitch deviation", kRate, &SixMotion::pitch);
}

/// A side of the elements, or the word that has it chosen from each patch.
void add_element_side(KeyList& list, const std::string& path, const std::string& doc, double ElementGrid::*side,
                      bool ElementGrid::*chosen) {
  KeyInfo& info = list.number<W>(path, kPositive, doc, [side](W& c) -> double& { return c.discretisation.*side; });
  const std::string word = "auto";
  info.choices = {word};
  info.default_text = '"' + word + '"';
  CaseKey& key = list.keys.back();
  key.set = [=, number = key.set](Case& c, const CaseValue& v, const std::filesystem::path& folder) {
    DiscretisationInput& d = content_of<W>(c).discretisation;
    d.*chosen = std::holds_alternative<std::string>(v.data);
    if (d.*chosen)
      d.*side = ElementGrid{}.*side;
    else
      number(c, v, folder);
  };
  key.written = [=, number = key.written](const Case& c, const std::filesystem::path& folder) {
    return std::get<W>(c.content).discretisation.*chosen ? toml_text(word) : number(c, folder);
  };
}

void add_discretisation(KeyList& list) {
  add_element_side(list, "discretisation.dx_mm",
                   "element size in rolling direction; auto: chosen from each patch, 0.5 mm where patches share a "
                   "raster (shifts, transient rolling, damping, simulations)",
                   &ElementGrid::dx, &ElementGrid::choose_dx);
  add_element_side(list, "discretisation.ds_mm", "element size in lateral direction; auto: as above", &ElementGrid::ds,
                   &ElementGrid::choose_ds);
  list.number<W>("discretisation.dq_relative", {0.0, {}, kMostStep}, "rolling step over dx",
                 [](W& c) -> double& { return c.discretisation.dq_relative; });
  list.angle<W>("discretisation.angle_separation", kNotNegative,
                "patches whose contact angles differ by more stay apart",
                [](W& c) -> double& { return c.discretisation.angle_separation; });
  list.number<W>("discretisation.separation_mm", kNotNegative,
                 "patches farther apart than this do not influence each other",
                 [](W& c) -> double& { return c.discretisation.separation; });
  list.number<W>("discretisation.combination_mm", kNotNegative, "patches nearer than this become one",
                 [](W& c) -> double& { return c.discretisation.combination; });
  KeyInfo turning = key_info("discretisation.turning_mm", KeyType::number,
                             "patches nearer than this get similar contact angles; default 2 separation - combination");
  turning.scope = KeyScope::wheel_rail;
  CaseKey& turned = list.add(turning);
  turned.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    content_of<W>(c).discretisation.turning = v.number() * unit_of_key("turning_mm");
  };
  turned.written = [](const Case& c, const std::filesystem::path&) {
    const auto& distance = std::get<W>(c.content).discretisation.turning;
    return distance ? exact_text(*distance, unit_of_key("turning_mm")) : std::string();
  };
  list.number<W>("discretisation.near_miss_mm", kAnyNumber,
                 "near misses with a smaller gap extend a patch; negative = off",
                 [](W& c) -> double& { return c.discretisation.near_miss; });
  list.integer<W>("discretisation.max_elements", 100, 1000000, "greatest size of a potential contact area",
                  [](W& c) -> int& { return c.discretisation.max_elements; });
  list.choice<W, bool>("discretisation.weight", {{"squared", false}, {"linear", true}},
                       "weight of the interpenetration in the contact reference point",
                       [](W& c) -> bool& { return c.discretisation.linear_weight; });
  list.choice<W, int>(
      "discretisation.method", {{"automatic", 2}, {"grid", 5}, {"grid_steep", 6}, {"initial_contact", 7}},
      "contact search: automatic (locus for constant profiles), on a grid, on a grid for steep slopes, or with the "
      "reference at the initial contact point",
      [](W& c) -> int& { return c.discretisation.method; });
  KeyInfo prune =
      key_info("discretisation.prune", KeyType::flag,
               "search on a grid: leave out what provably cannot touch; false = evaluate all of the grid, without the "
               "locus of constant profiles too");
  prune.scope = KeyScope::wheel_rail;
  prune.default_text = "true";
  const auto add_flag = [&]<class Flag>(const KeyInfo& info, Flag DiscretisationInput::*member) {
    CaseKey& key = list.add(info);
    key.set = [member](Case& c, const CaseValue& v, const std::filesystem::path&) {
      content_of<W>(c).discretisation.*member = Flag{v.flag()};
    };
    key.text = [member](const Case& c) {
      return std::string(std::get<W>(c.content).discretisation.*member == Flag{true} ? "true" : "false");
    };
  };
  add_flag(prune, &DiscretisationInput::prune);
  KeyInfo detector = key_info("discretisation.detector", KeyType::text,
                              "what looks for contact, by its name (treadmark list detectors), in place of method and "
                              "prune");
  detector.scope = KeyScope::wheel_rail;
  CaseKey& detected = list.add(detector);
  detected.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    content_of<W>(c).discretisation.detector = v.text();
  };
  detected.text = [](const Case& c) {
    const std::string& name = std::get<W>(c.content).discretisation.detector;
    return name.empty() ? std::string() : toml_text(name);
  };
  KeyInfo mesh = key_info("discretisation.reference_search_mesh", KeyType::flag,
                          "search on the coarse mesh of the reference program (for comparison)");
  mesh.scope = KeyScope::wheel_rail;
  mesh.default_text = "false";
  add_flag(mesh, &DiscretisationInput::conventions);
}

}  // namespace

void add_wheel_rail_keys(KeyList& list) {
  list.choice<W, Side>("case.side", {{"left", Side::left}, {"right", Side::right}},
                       "side of the track that the wheel runs on", [](W& c) -> Side& { return c.side; });
  add_track(list);
  add_wheelset(list);
  add_flexible_wheelset(list);
  add_discretisation(list);
}

}  // namespace treadmark::io
