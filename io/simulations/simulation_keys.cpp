// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/simulation_keys.hpp"

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/settings/key_schema.hpp"
#include "treadmark/model/assessment.hpp"
#include "treadmark/model/irregularities.hpp"
#include "treadmark/model/track_layout.hpp"

namespace treadmark::io {

namespace {

KeyInfo needed(KeyInfo info) {
  info.required = true;
  return info;
}
KeyInfo with_default(std::string text, KeyInfo info) {
  info.default_text = std::move(text);
  return info;
}
KeyInfo one_of(std::string name, std::vector<std::string> choices, std::string doc) {
  KeyInfo info = key_info(std::move(name), KeyType::choice, std::move(doc));
  info.choices = std::move(choices);
  return info;
}
/// A table or a list of tables.
KeyInfo table_key(std::string name, KeyType type, std::string doc, TableKeys keys = {}) {
  KeyInfo info = key_info(std::move(name), type, std::move(doc));
  info.elements = std::move(keys);
  return info;
}

KeyInfo scale_key(std::string name, KeyLimits limits, std::string doc) {
  return with_default("1", key_info(std::move(name), KeyType::number, std::move(doc), limits));
}

TableKeys model_keys() {
  return {
      needed(key_info("name", KeyType::text, "of the model")),
      key_info("source", KeyType::text, "where the numbers come from"),
      scale_key("scale_mass", kPositive, "factor on all masses and moments of inertia"),
      scale_key("scale_stiffness", kPositive, "factor on all stiffnesses of springs; bump stops, axles and rails stay"),
      scale_key("scale_damping", kNotNegative, "factor on all damping")};
}

TableKeys place_keys_of(const std::string& part) {
  return {key_info("between", KeyType::text_list, "two bodies, or one and \"ground\"; required with at_m, or places"),
          key_info("at_m", KeyType::triple_list, "one " + part + " at each of these points")};
}

/// name, between, at_m and places of a part that connects bodies, then its own keys.
TableKeys connecting(const std::string& part, const TableKeys& own) {
  TableKeys keys = place_keys_of(part);
  keys.insert(keys.begin(), needed(key_info("name", KeyType::text, "several equal ones are numbered from 1")));
  keys.push_back(
      table_key("places", KeyType::table_list, "between and at_m for several pairs of bodies", place_keys()));
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

KeyInfo six_key(std::string name, std::string doc) {
  return with_default("[0, 0, 0]", key_info(std::move(name), KeyType::triple, std::move(doc), kNotNegative));
}

std::string schema_of(std::string_view title, TableKeys keys, bool with_case) {
  if (with_case) {
    keys.push_back(key_info("title", KeyType::text, "without it the name of the file"));
    for (const CaseKey& key : case_keys())
      if (key.info.scope != KeyScope::patch) keys.push_back(key.info);
  }
  return file_schema(title, keys);
}

/// Where the vehicle runs: tables beside [simulation].
TableKeys line_tables() {
  return {table_key("layout", KeyType::table, "the line: straights, curves, cant, gauge", layout_keys()),
          table_key("irregularities", KeyType::table, "deviations of the rails from it", irregularity_keys()),
          table_key("assessment", KeyType::table, "what is read out of the run", assessment_keys())};
}
TableKeys simulation_tables() {
  TableKeys keys{needed(table_key("simulation", KeyType::table, "a vehicle on its track", simulation_keys()))};
  for (KeyInfo& key : line_tables()) keys.push_back(std::move(key));
  return keys;
}
TableKeys study_tables() { return {needed(table_key("study", KeyType::table, "runs with varied keys", study_keys()))}; }

}  // namespace

const TableKeys& vehicle_tables() {
  static const TableKeys keys{
      needed(table_key("vehicle", KeyType::table, "the vehicle as a whole", vehicle_keys())),
      needed(table_key("bodies", KeyType::table_list, "rigid bodies", body_keys())),
      table_key("springs", KeyType::table_list, "springs and dampers between them", spring_keys()),
      table_key("bump_stops", KeyType::table_list, "springs with a characteristic", bump_stop_keys()),
      needed(table_key("wheelsets", KeyType::table_list, "bodies that run on the rails, the leading one first",
                       wheelset_keys())),
      table_key("axles", KeyType::table_list, "how wheelsets bend and twist", axle_keys())};
  return keys;
}

const TableKeys& track_tables() {
  static const TableKeys keys{
      needed(table_key("track", KeyType::table, "the track as a whole", track_keys())),
      table_key("rail", KeyType::table, "a flexible rail; required where kind is \"flexible\"", rail_beam_keys()),
      table_key("seats", KeyType::table, "what carries a flexible rail; required where kind is \"flexible\"",
                seat_keys()),
      table_key("varied", KeyType::table_list, "seats of a flexible rail that differ", varied_seat_keys()),
      table_key("joints", KeyType::table_list, "of flexible rails, at the same places on both", joint_keys()),
      table_key("lateral", KeyType::table, "flexible rails sideways as masses on springs, and tracks fitted to them",
                lateral_keys()),
      table_key("bodies", KeyType::table_list, "rigid bodies; required where kind is \"lumped\"", body_keys()),
      table_key("springs", KeyType::table_list, "springs and dampers between them", spring_keys())};
  return keys;
}

const TableKeys& vehicle_keys() {
  static const TableKeys keys = model_keys();
  return keys;
}

const TableKeys& track_keys() {
  static const TableKeys keys = [] {
    TableKeys list = model_keys();
    list.insert(
        list.begin() + 2,
        {with_default("\"lumped\"", one_of("kind", {"lumped", "flexible"},
                                           "masses on springs below each wheelset, or rails that bend on sleepers")),
         key_info("rails", KeyType::text_list,
                  "the bodies that carry the left and the right rail (required where kind is \"lumped\")")});
    return list;
  }();
  return keys;
}

const TableKeys& rail_beam_keys() {
  static const TableKeys keys{
      needed(key_info("bending_stiffness_N_m2", KeyType::number, "E I of one rail, vertically", kPositive)),
      needed(key_info("shear_stiffness_N", KeyType::number, "kappa G A of one rail", kPositive)),
      needed(key_info("mass_kg_per_m", KeyType::number, "of one rail", kPositive)),
      with_default("0", key_info("rotary_inertia_kg_m", KeyType::number, "density times I", kNotNegative)),
      with_default("0", key_info("damping_us", KeyType::number,
                                 "inner damping over stiffness: the loss factor is 2 pi f times this", kNotNegative)),
      with_default("1.507", key_info("distance_m", KeyType::number, "of the middles of both rails", {0.1, {}, 10.0})),
      key_info("lateral_bending_stiffness_N_m2", KeyType::number,
               "E I sideways; with it rails bend and twist sideways, and what follows counts", kPositive),
      key_info("lateral_shear_stiffness_N", KeyType::number, "kappa G A sideways; required then", kPositive),
      with_default("0",
                   key_info("lateral_rotary_inertia_kg_m", KeyType::number, "density times I sideways", kNotNegative)),
      key_info("torsional_stiffness_N_m2", KeyType::number, "G J of St Venant's torsion; required then", kPositive),
      key_info("polar_inertia_kg_m", KeyType::number,
               "density times polar moment of area about the centroid; required then", kPositive),
      key_info("height_mm", KeyType::number, "of the top above the foot; required then", kPositive),
      key_info("centroid_height_mm", KeyType::number, "of the centroid above the foot; required then", kNotNegative),
      key_info("shear_centre_height_mm", KeyType::number, "of the shear centre; default that of the centroid",
               kNotNegative)};
  return keys;
}

const TableKeys& seat_keys() {
  static const TableKeys keys{
      with_default("120", key_info("count", KeyType::integer, "of sleepers", {{}, 4.0, kMostSeats})),
      key_info("spacing_m", KeyType::number, "from sleeper to sleeper; this or the next one is required",
               {0.0, {}, 100.0}),
      key_info("spacings_m", KeyType::number_list, "unequal ones, over and over again", {0.0, {}, 100.0}),
      needed(key_info("pad_stiffness_N_per_m", KeyType::number, "of the pad of one seat", kPositive)),
      with_default("0", key_info("pad_damping_N_s_per_m", KeyType::number, "of it", kNotNegative)),
      needed(key_info("sleeper_mass_kg", KeyType::number, "of a whole sleeper, which has two seats", kPositive)),
      needed(key_info("bed_stiffness_N_per_m", KeyType::number, "of what carries a sleeper at one seat", kPositive)),
      with_default("0", key_info("bed_damping_N_s_per_m", KeyType::number, "of it", kNotNegative)),
      with_default(
          "16", key_info("bay_elements", KeyType::integer, "beam elements from sleeper to sleeper", {{}, 2.0, 64.0})),
      with_default("30", key_info("absorbing_bays", KeyType::integer,
                                  "bays at each end in which the rail is damped more and more; at most a quarter of "
                                  "`count`",
                                  {{}, 0.0, kMostSeats})),
      with_default("2000", key_info("absorption_per_s", KeyType::number,
                                    "damping over mass at both ends, from 0 growing with the square", kNotNegative)),
      key_info("lateral_pad_stiffness_N_per_m", KeyType::number,
               "of a seat at the rail's foot; required where rails bend sideways", kPositive),
      with_default("0", key_info("lateral_pad_damping_N_s_per_m", KeyType::number, "of it", kNotNegative)),
      key_info("roll_stiffness_N_m_per_rad", KeyType::number,
               "of a seat against rolling of the rail; required where rails bend sideways", kPositive),
      with_default("0", key_info("roll_damping_N_m_s_per_rad", KeyType::number, "of it", kNotNegative)),
      key_info("lateral_bed_stiffness_N_per_m", KeyType::number,
               "of what holds a sleeper sideways at one seat; required where rails bend sideways", kPositive),
      with_default("0", key_info("lateral_bed_damping_N_s_per_m", KeyType::number, "of it", kNotNegative))};
  return keys;
}

const TableKeys& varied_seat_keys() {
  static const TableKeys keys{
      needed(key_info("first_seat", KeyType::integer, "from 1", {{}, 1.0, kMostSeats})),
      key_info("last_seat", KeyType::integer, "default the first one", {{}, 1.0, kMostSeats}),
      with_default("1", key_info("pad_factor", KeyType::number,
                                 "on stiffness and damping of pads, vertical, lateral and in roll", kPositive)),
      with_default("1", key_info("sleeper_factor", KeyType::number, "on the mass of sleepers", kPositive)),
      with_default(
          "1", key_info("bed_factor", KeyType::number,
                        "on stiffness and damping below sleepers, vertical and lateral; 0: they hang", kNotNegative))};
  return keys;
}

const TableKeys& joint_keys() {
  static const TableKeys keys{
      needed(key_info("place_m", KeyType::number, "from the first seat; joints lie at least the longest bay apart",
                      kNotNegative)),
      needed(key_info("hinge_stiffness_N_m_per_rad", KeyType::number,
                      "moment that the fishplates carry over the angle that they open by; 0: a hinge", kNotNegative)),
      with_default("0", key_info("dip_mm", KeyType::number,
                                 "how much lower the tops of the unloaded rails lie at the joint; they meet at an "
                                 "angle of 4 dip_mm over dip_length_mm",
                                 kNotNegative)),
      with_default("1000", key_info("dip_length_mm", KeyType::number,
                                    "to either side, over which the slope falls linearly to 0", kPositive)),
      key_info("lateral_hinge_stiffness_N_m_per_rad", KeyType::number,
               "the same as hinge_stiffness sideways; without it rails go on there as one", kNotNegative)};
  return keys;
}

const TableKeys& lateral_keys() {
  static const TableKeys keys{
      needed(key_info("pad_stiffness_N_per_m", KeyType::number, "at a wheel, not at a seat", kPositive)),
      with_default("0", key_info("pad_damping_N_s_per_m", KeyType::number, "at a wheel", kNotNegative)),
      needed(key_info("bed_stiffness_N_per_m", KeyType::number, "below half a sleeper, at a wheel", kPositive)),
      with_default("0", key_info("bed_damping_N_s_per_m", KeyType::number, "at a wheel", kNotNegative)),
      needed(key_info("foot_width_mm", KeyType::number, "of the rail: pads resist its rolling over it", kPositive)),
      needed(key_info("roll_radius_mm", KeyType::number, "radius of gyration of the rail about its axis", kPositive)),
      needed(key_info("rail_mass_kg", KeyType::number, "of the rail that moves sideways at a wheel", kPositive)),
      needed(key_info("sleeper_mass_kg", KeyType::number, "of the halves of sleepers that move with it", kPositive))};
  return keys;
}

const TableKeys& body_keys() {
  static const TableKeys keys{
      needed(key_info("name", KeyType::text, "letters, digits, `_`, `-`; equal bodies are numbered from 1")),
      needed(key_info("mass_kg", KeyType::number, "its mass", kPositive)),
      key_info("inertia_kg_m2", KeyType::triple, "positive about every axis about which the body can rotate",
               kNotNegative),
      key_info("position_m", KeyType::triple, "centre of mass; this or the next one is required"),
      key_info("positions_m", KeyType::triple_list, "those of several equal bodies"),
      needed(key_info("free", KeyType::text_list,
                      "directions in which it moves: \"x\", \"y\", \"z\", \"roll\", \"pitch\", \"yaw\""))};
  return keys;
}

const TableKeys& place_keys() {
  static const TableKeys keys = place_keys_of("part");
  return keys;
}

const TableKeys& spring_keys() {
  static const TableKeys keys = connecting(
      "spring",
      {six_key("stiffness_N_per_m", "along x, y, z"), six_key("damping_N_s_per_m", "along x, y, z"),
       six_key("damper_stiffness_N_per_m", "springs in series with these dampers, 0 = rigid"),
       six_key("rotational_stiffness_N_m_per_rad", "about x, y, z"),
       six_key("rotational_damping_N_m_s_per_rad", "about x, y, z"),
       six_key("rotational_damper_stiffness_N_m_per_rad", "springs in series with these dampers, 0 = rigid")});
  return keys;
}

const TableKeys& bump_stop_keys() {
  static const TableKeys keys = connecting(
      "bump stop",
      {needed(one_of("direction", {"x", "y", "z"}, "of the displacement, the second body against the first")),
       needed(key_info("displacement_mm", KeyType::number_list, "increasing; the force is odd", kNotNegative)),
       needed(key_info("force_N", KeyType::number_list,
                       "from 0, not decreasing; linear between, continued by the last slope", kNotNegative))});
  return keys;
}

const TableKeys& wheelset_keys() {
  static const TableKeys keys{needed(key_info("body", KeyType::text, "free in z at least")),
                              needed(key_info("nominal_radius_mm", KeyType::number, "of its wheels", kWheelRadiusMm)),
                              key_info("axle", KeyType::text, "name of one of `[[axles]]`; without it it is rigid")};
  return keys;
}

const TableKeys& axle_keys() {
  static const TableKeys keys{
      needed(key_info("name", KeyType::text, "letters, digits, `_`, `-`")),
      needed(key_info("wheel_distance_mm", KeyType::number, "of the middle planes of both wheels", kPositive)),
      needed(key_info("wheel_polar_inertia_kg_m2", KeyType::number,
                      "of one wheel with its discs about the axle, part of the body's own", kNotNegative)),
      key_info("places_mm", KeyType::number_list,
               "along the axle from its middle to the right, increasing: wheels, axle boxes and what else is held by "
               "springs; required with `bending`"),
      table_key("bending", KeyType::table_list, "vibrations of the free wheelset, each in both planes", bending_keys()),
      table_key("torsion", KeyType::table_list, "vibrations of the free wheelset about its axle", torsion_keys())};
  return keys;
}

namespace {

TableKeys mode_keys(const TableKeys& own) {
  TableKeys keys{
      needed(key_info("frequency_Hz", KeyType::number, "of the free wheelset at rest", kPositive)),
      with_default("0", key_info("damping_ratio", KeyType::number, "over critical damping", {{}, 0.0, 1.0}))};
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

}  // namespace

const TableKeys& bending_keys() {
  static const TableKeys keys = mode_keys(
      {needed(key_info("modal_mass_kg", KeyType::number, "integral of mass times shape², scaled as the shape is",
                       kPositive)),
       needed(key_info("shape", KeyType::number_list, "displacement at each of `places_mm`", kAnyNumber)),
       needed(key_info("slope_per_m", KeyType::number_list, "its derivative along the axle there", kAnyNumber))});
  return keys;
}

const TableKeys& torsion_keys() {
  static const TableKeys keys = mode_keys(
      {needed(key_info("modal_inertia_kg_m2", KeyType::number,
                       "sum of moments of inertia times rotation², scaled as the rotations are", kPositive)),
       needed(key_info("wheel_rotation", KeyType::number_list, "of the left and the right wheel", kAnyNumber))});
  return keys;
}

const std::vector<SettingKey<SimulationSettings>>& plain_setting_keys() {
  using S = SimulationSettings;
  static const std::vector<SettingKey<S>> keys = [] {
    SettingKeys<S> list;
    list.number("gravity_m_s2", {0.0, {}, 1e3}, "acceleration of gravity", [](S& s) -> double& { return s.gravity; });
    list.number("tolerance_um", kPositive, "local error of a step", [](S& s) -> double& { return s.tolerance; });
    list.add(key_info("max_step_us", KeyType::number, "longest step", kPositive)).set =
        [](S& s, const CaseValue& v, const std::filesystem::path&) {
          s.max_step = v.number() * unit_of_key("max_step_us");
        };
    list.number("min_step_us", kPositive, "shortest step", [](S& s) -> double& { return s.min_step; });
    list.number(
        "max_step_elements", kPositive,
        "distance travelled in a step over `discretisation.dx_mm`; in transient rolling 1 without the key, at most 2 "
        "(dt ≤ 2 dx/V). Steps of two elements take half the time, but lateral creep forces then scatter by some per "
        "cent, because elements at the leading edge stick or slip as they happen to come in",
        [](S& s) -> double& { return s.max_step_elements; });
    list.number("spectral_radius", {{}, 0.5, 1.0},
                "of the time integration at infinite frequency: 1 = no numerical damping",
                [](S& s) -> double& { return s.spectral_radius; });
    list.number(
        "from_midspan_mm", kAnyNumber,
        "on a flexible track: place of the vehicle's x = 0 at the start, ahead of the middle between two sleepers",
        [](S& s) -> double& { return s.from_midspan; });
    list.flag(
        "shared_rails",
        "on a flexible track: all wheels of a side run on one rail and feel each other through it; false: each "
        "has a rail of its own",
        [](auto& s) -> auto& { return s.shared_rails; });
    list.number("rail_start_m", kAnyNumber,
                "place of the leading wheelset along the rails at the start, from where x of rails that vary, their "
                "defects and friction along the track count; the other wheelsets stand behind it as in the vehicle",
                [](S& s) -> double& { return s.rail_start; });
    list.choice<S>("creep_forces",
                   std::vector<std::pair<std::string, CreepForcesInput>>{
                       {"shen_hedrick_elkins", CreepForcesInput::shen_hedrick_elkins},
                       {"exact_table", CreepForcesInput::exact_table}},
                   "of wheels whose contact is a table: Kalker's coefficients with saturation, or a table of solutions "
                   "of the exact theory on Hertzian ellipses",
                   [](S& s) -> CreepForcesInput& { return s.creep_forces; });
    list.number(
        "checkpoint_s", kPositive,
        "time of the computer between two checkpoints; twenty times what the last one took, where that is longer",
        [](S& s) -> double& { return s.checkpoint; });
    list.number("output_every_mm", kNotNegative,
                "distance travelled between two lines of the history; 0 = every step. The summary counts every step",
                [](S& s) -> double& { return s.output_every; });
    return std::move(list.keys);
  }();
  return keys;
}

const TableKeys& simulation_keys() {
  static const TableKeys keys = [] {
    TableKeys list{
        needed(key_info("vehicle", KeyType::path, "vehicle file")),
        key_info("track", KeyType::path, "track file; without it the track is rigid"),
        key_info("speed_m_s", KeyType::number, "speed at the start, more than 0; this or the next one is required",
                 {{}, 0.0, 1000.0}),
        key_info("speed_km_h", KeyType::number, "speed at the start in km/h, in place of speed_m_s", {{}, 0.0, 3600.0}),
        table_key("speed_profile", KeyType::table, "speeds behind the start; without it the speed is constant",
                  speed_profile_keys()),
        table_key("torques", KeyType::table_list, "motors and brakes on axles", torque_keys()),
        key_info("distance_m", KeyType::number, "travelled in all; this or the next one is required", kPositive),
        key_info("duration_s", KeyType::number, "of the whole simulation", kPositive)};
    for (const auto& key : plain_setting_keys()) list.push_back(key.info);
    list.push_back(table_key("fields", KeyType::table, "when contact fields are kept", field_keys()));
    list.push_back(table_key("wheels", KeyType::table_list, "how the contact of single wheels is found", wheel_keys()));
    list.push_back(with_default("1000", key_info("axle_box_y_mm", KeyType::number,
                                                 "of the points of axle boxes whose accelerations are written down, to "
                                                 "both sides of the wheelset's middle",
                                                 kNotNegative)));
    list.push_back(key_info("channels", KeyType::text_list,
                            "columns of the history beside time and distance, `*` for any letters; without it all"));
    list.push_back(table_key("points", KeyType::table_list, "points of bodies whose accelerations are written down",
                             point_keys()));
    list.push_back(
        table_key("check_rails", KeyType::table_list, "rails that hold the backs of flanges", check_rail_keys()));
    list.push_back(
        table_key("other_wheel", KeyType::table,
                  "shape of the round wheels, with the keys of `[wheel]`; required where `[wheel]` is made of "
                  "slices or triangles and a wheel is round"));
    for (const char* side : {"left", "right"})
      list.push_back(table_key(fmt::format("{}_rail", side), KeyType::table,
                               fmt::format("shape of the {} rail instead of `[rail]`, with its keys; y of both sides "
                                           "points away from the middle of the track",
                                           side)));
    list.push_back(table_key("table_rail", KeyType::table,
                             "rail of one section for wheels with table contact, with the keys of `[rail]`; required "
                             "where their own rail varies by more than its defects"));
    return list;
  }();
  return keys;
}

const TableKeys& speed_profile_keys() {
  static const TableKeys keys{
      needed(key_info("time_s", KeyType::number_list, "increasing, from more than 0", kPositive)),
      needed(key_info("speed_m_s", KeyType::number_list,
                      "at these times, more than 0; straight lines between, constant behind the last one",
                      {{}, 0.0, 1000.0}))};
  return keys;
}

const TableKeys& torque_keys() {
  static const TableKeys keys{
      needed(key_info("wheelset", KeyType::integer, "number of the wheelset, 1 = leading", {{}, 1.0, 1e6})),
      needed(key_info("time_s", KeyType::number_list, "increasing", kNotNegative)),
      needed(key_info("torque_N_m", KeyType::number_list,
                      "at these times, positive in traction; straight lines between, constant before and behind")),
      needed(key_info("reaction", KeyType::text, "body that holds motor or brake, or \"ground\""))};
  return keys;
}

const TableKeys& field_keys() {
  static const TableKeys keys{
      key_info("pitch_deg", KeyType::number_list,
               "increasing; contact fields are kept where a wheelset passes these angles"),
      key_info("position_m", KeyType::number_list, "increasing; contact fields are kept at these distances travelled",
               kNotNegative)};
  return keys;
}

const TableKeys& wheel_keys() {
  static const TableKeys keys{
      needed(key_info("wheelset", KeyType::integer, "number of the wheelset, 1 = leading", {{}, 1.0, 1e6})),
      needed(one_of("side", {"left", "right"}, "of the wheelset")),
      needed(one_of("contact", {"full", "table"}, "the contact problem itself, or a table of solutions")),
      with_default("true", key_info("defects", KeyType::flag, "false: the wheel is round")),
      with_default("0", key_info("pitch_deg", KeyType::number,
                                 "pitch of the wheelset at the start, the same for both its wheels")),
      key_info("full_from_m", KeyType::number,
               "of a full contact: from this place along the rail, with a table before; at least 0.1 m before the end"),
      key_info("full_to_m", KeyType::number, "to this place, with a table behind")};
  return keys;
}

const TableKeys& point_keys() {
  static const TableKeys keys{needed(key_info("name", KeyType::text, "letters, digits, `_`, `-`")),
                              needed(key_info("body", KeyType::text, "of the vehicle")),
                              needed(key_info("at_m", KeyType::triple, "where it is, loaded and at rest")),
                              with_default("\"car_body\"", one_of("kind", {kPointKinds.begin(), kPointKinds.end()},
                                                                  "which filters and limits an assessment takes"))};
  return keys;
}

const TableKeys& assessment_keys() {
  static const TableKeys keys{
      with_default("\"passenger\"", one_of("vehicle", {kVehicleKinds.begin(), kVehicleKinds.end()}, "limits differ")),
      key_info("from_m", KeyType::number,
               "where the assessment begins without sections, and spectra begin; without it 0, or where all wheelsets "
               "are behind the wind-up of irregularities",
               kNotNegative),
      key_info("spectra", KeyType::text_list, "channels whose spectra are wanted, `*` for any letters"),
      table_key("sections", KeyType::table_list, "parts of the run; without them it is assessed as a whole",
                section_keys())};
  return keys;
}

const TableKeys& section_keys() {
  static const TableKeys keys{needed(key_info("name", KeyType::text, "one of its own")),
                              needed(key_info("from_m", KeyType::number, "distance travelled", kNotNegative)),
                              needed(key_info("to_m", KeyType::number, "distance travelled", kNotNegative)),
                              with_default("\"straight\"", one_of("kind", {kSectionKinds.begin(), kSectionKinds.end()},
                                                                  "quasi-static forces are assessed in curves"))};
  return keys;
}

const TableKeys& check_rail_keys() {
  static const TableKeys keys{
      needed(one_of("side", {"left", "right"}, "whose flanges it holds")),
      needed(key_info("from_m", KeyType::number, "place along the rail")),
      needed(key_info("to_m", KeyType::number, "more than `from_m`")),
      needed(key_info("face_y_mm", KeyType::number,
                      "of the guiding face from the middle of the track: half the gauge less the flangeway",
                      kPositive)),
      with_default("10", key_info("depth_mm", KeyType::number,
                                  "below the rail tops, z = 0, where the back of the flange touches it")),
      needed(key_info("stiffness_N_per_m", KeyType::number, "lateral, against the running rail", kPositive)),
      with_default("0", key_info("damping_N_s_per_m", KeyType::number, "in parallel", kNotNegative)),
      with_default("0.3", key_info("friction", KeyType::number, "coefficient", kNotNegative)),
      with_default("0", key_info("flare_m", KeyType::number,
                                 "length at both ends over which the face recedes with the square", kNotNegative)),
      with_default("0", key_info("flare_mm", KeyType::number, "by so much", kNotNegative))};
  return keys;
}

const TableKeys& layout_keys() {
  static const TableKeys keys{
      with_default("0", key_info("start_m", KeyType::number,
                                 "place of the vehicle's x = 0 at the start, from the "
                                 "beginning of the line",
                                 kNotNegative)),
      key_info("gauge_mm", KeyType::number, "where no element says another; without it that of `[track]`", kGaugeMm),
      with_default("1500", key_info("cant_base_mm", KeyType::number, "width over which cant is measured", kPositive)),
      with_default("\"centre\"",
                   one_of("cant_about", {"centre", "low_rail"}, "what keeps its height where the track is canted")),
      needed(table_key("elements", KeyType::table_list, "one behind the other", element_keys()))};
  return keys;
}

const TableKeys& element_keys() {
  static const TableKeys keys{
      needed(
          one_of("kind", {"straight", "curve", "transition"},
                 "a transition goes from the element before it to the one behind it; at the ends of the line from or "
                 "to a straight without cant")),
      needed(key_info("length_m", KeyType::number, "along the centre line in plan", {0.0, {}, kLongestLine})),
      key_info("radius_m", KeyType::number, "of a curve (required there): positive to the right, negative to the left"),
      with_default("0", key_info("cant_mm", KeyType::number,
                                 "of a curve: how much the outer rail lies higher; of a straight: the left one")),
      key_info("gauge_mm", KeyType::number, "of a straight or a curve", kGaugeMm),
      with_default("\"clothoid\"",
                   one_of("shape", {"clothoid", "bloss"}, "of a transition: how curvature, cant and gauge go over"))};
  return keys;
}

const TableKeys& irregularity_keys() {
  static const TableKeys keys = [] {
    TableKeys list{
        key_info("file", KeyType::path, "measured ones, as text with named columns; this or `spectra` is required"),
        with_default("0", key_info("offset_m", KeyType::number, "added to the distances of the file")),
        key_info("nominal_gauge_mm", KeyType::number,
                 "from which a gauge such as 1436.2 mm in the file is counted; without it what the file states, the "
                 "gauge of the track, or the nearest one in use",
                 kPositive),
        key_info("sampling_m", KeyType::number,
                 "way between two rows of the file, where its distances do not tell (broken chains)", kPositive),
        with_default("false", key_info("as_stated", KeyType::flag,
                                       "distances of the file are used as they stand, also where they jump")),
        with_default("false", key_info("seen_backwards", KeyType::flag,
                                       "left, right and signs of the file are as seen along falling distances")),
        key_info("begin_m", KeyType::number, "from here on they grow; without it from in front of the vehicle"),
        with_default("20",
                     key_info("wind_up_m", KeyType::number, "length over which they grow from zero", kNotNegative)),
        with_default("1", key_info("seed", KeyType::integer, "another number, another track with the same spectra",
                                   {{}, 0.0, 1e15})),
        with_default("3", key_info("shortest_wavelength_m", KeyType::number, "that occurs in spectra", kPositive)),
        with_default("70", key_info("longest_wavelength_m", KeyType::number, "that occurs in spectra", kPositive)),
        with_default("30", key_info("sinusoids_per_third_octave", KeyType::integer, "of which spectra are made",
                                    {{}, 1.0, 1000.0}))};
    for (const std::string_view name : kIrregularityNames)
      list.push_back(with_default(
          "1", key_info(fmt::format("{}_factor", name), KeyType::number, "on this function; -1 changes its sign")));
    list.push_back(table_key("spectra", KeyType::table_list, "power spectral densities, at most one of each function",
                             spectrum_keys()));
    return list;
  }();
  return keys;
}

const TableKeys& spectrum_keys() {
  static const TableKeys keys{
      needed(one_of("function", {kIrregularityNames.begin(), kIrregularityNames.end()}, "of the track")),
      needed(one_of("form", {"two_poles", "three_poles", "table"},
                    "A c²/((k² + r²)(k² + c²)), the same times k²/(k² + s²), or numbers")),
      key_info("amplitude_m_rad", KeyType::number, "A (required but for a table)", kNotNegative),
      key_info("omega_c_rad_m", KeyType::number, "c (required but for a table)", kPositive),
      with_default("0", key_info("omega_r_rad_m", KeyType::number, "r", kNotNegative)),
      with_default("0", key_info("omega_s_rad_m", KeyType::number, "s", kNotNegative)),
      key_info("wavenumber_rad_m", KeyType::number_list, "of a table, increasing", kPositive),
      key_info("density_m3_rad", KeyType::number_list, "of a table at them; straight lines between logarithms",
               kPositive),
      with_default(
          "1", key_info("sides", KeyType::integer,
                        "1: the variance is the integral over positive wavenumbers; 2: twice that", {{}, 1.0, 2.0}))};
  return keys;
}

const TableKeys& study_keys() {
  static const TableKeys keys{
      key_info("title", KeyType::text, "without it the name of the file"),
      key_info("base", KeyType::path, "simulation or case file"),
      table_key("vary", KeyType::table_list, "what is varied, the last one fastest", vary_keys()),
      table_key("figures", KeyType::table_list, "pictures of the results", figure_keys())};
  return keys;
}

const TableKeys& vary_keys() {
  static const TableKeys keys{
      key_info("key", KeyType::text, "key of the base, as in `--set`"),
      key_info("label", KeyType::text, "for charts, default the key"),
      key_info("values", KeyType::value_list,
               "numbers, texts, true or false, lists, or sets of keys: tables of `label` (required) and `set`, a list "
               "of `\"key=value\"` (required)"),
      key_info("from", KeyType::number, "instead of `values`: evenly spaced numbers from here"),
      key_info("to", KeyType::number, "the last of them"),
      key_info("count", KeyType::integer, "how many of them", {{}, 2.0, kMostValues}),
      with_default("\"linear\"", one_of("spacing", {"linear", "logarithmic"}, "even steps or even ratios"))};
  return keys;
}

const TableKeys& vary_value_keys() {
  static const TableKeys keys{needed(key_info("label", KeyType::text, "for charts")),
                              needed(key_info("set", KeyType::text_list, "\"key=value\""))};
  return keys;
}

const std::vector<SettingKey<EvolutionFile>>& plain_evolve_keys() {
  using E = EvolutionFile;
  static const std::vector<SettingKey<E>> keys = [] {
    SettingKeys<E> list;
    list.number("max_depth_mm", kPositive, "most that an update may remove",
                [](E& e) -> double& { return e.max_depth; });
    list.number("max_pressure_change", kPositive,
                "most that an update may change the largest pressure of a case, as a share",
                [](E& e) -> double& { return e.max_pressure_change; });
    list.number("smallest_step", {0.0, {}, 1.0},
                "share of the whole that an update makes at least, whatever the limits say",
                [](E& e) -> double& { return e.smallest_step; });
    list.integer("updates", 1, kMostValues, "so many equal updates instead of those that keep the limits",
                 [](E& e) -> int& { return e.updates; })
        .default_text.clear();
    list.integer("fields_every", 0, kMostValues, "contact fields of every so many generations are kept; 0: none",
                 [](E& e) -> int& { return e.fields_every; });
    return list.keys;
  }();
  return keys;
}

const TableKeys& evolve_keys() {
  static const TableKeys keys = [] {
    TableKeys list{
        key_info("title", KeyType::text, "without it the name of the file"),
        key_info("base", KeyType::path, "case or simulation file; its tables may stand beside [evolve] instead"),
        key_info("distance_km", KeyType::number, "that the wheelset runs; required where [evolve.wheel] is", kPositive),
        key_info("passages", KeyType::number, "of wheels over a rail; required where [evolve.rail] is", kPositive),
        table_key("vary", KeyType::table_list, "positions: their product, the last one fastest, as in [[study.vary]]",
                  vary_keys()),
        key_info("weights", KeyType::number_list,
                 "share of each position in the order of the product, made to sum up to 1; default: equal",
                 kNotNegative)};
    for (const auto& key : plain_evolve_keys()) list.push_back(key.info);
    list.push_back(table_key("wheel", KeyType::table, "the wheel evolves", evolving_body_keys()));
    list.push_back(table_key("rail", KeyType::table, "the rail evolves", evolving_body_keys()));
    return list;
  }();
  return keys;
}

const std::vector<SettingKey<EvolvingBody>>& plain_evolving_body_keys() {
  using B = EvolvingBody;
  static const std::vector<SettingKey<B>> keys = [] {
    SettingKeys<B> list;
    list.choice<B>("along", std::vector<std::pair<std::string, bool>>{{"uniform", false}, {"local", true}},
                   "the same all round or along the track, or each place by itself: cases of the base follow each "
                   "other round the wheel or along the rail",
                   [](B& b) -> bool& { return b.local; });
    list.number("du_mm", kPositive, "step of the cells along, where it is local", [](B& b) -> double& { return b.du; });
    list.number("dy_mm", kPositive, "step of the cells across", [](B& b) -> double& { return b.dy; });
    list.number("smoothing_mm", kNotNegative,
                "standard deviation of the Gaussian kernel over what an update removes; 0: none",
                [](B& b) -> double& { return b.smoothing; });
    return list.keys;
  }();
  return keys;
}

const TableKeys& evolving_body_keys() {
  static const TableKeys keys = [] {
    TableKeys list = infos_of<EvolvingBody>(plain_evolving_body_keys());
    list.push_back(needed(table_key("law", KeyType::table, "how contact removes depth", wear_law_keys())));
    list.push_back(table_key("fatigue", KeyType::table, "what contact does to the material below, without changing it",
                             fatigue_keys()));
    list.push_back(table_key("flow", KeyType::table, "how contact makes the material below flow", flow_law_keys()));
    return list;
  }();
  return keys;
}

const std::vector<SettingKey<WearLaw>>& plain_wear_law_keys() {
  using L = WearLaw;
  static const std::vector<SettingKey<L>> keys = [] {
    SettingKeys<L> list;
    list.number("hardness_GPa", kPositive, "archard: of the body that wears",
                [](L& l) -> double& { return l.hardness; })
        .default_text.clear();
    list.number_list(
        "k", "archard: coefficient, one for each regime of slip speed", [](L & l) -> auto& { return l.k; },
        kNotNegative);
    list.number_list(
        "slip_m_s", "archard: slip speeds between the regimes", [](L & l) -> auto& { return l.slip_limits; },
        kPositive);
    list.number("k_seizure", kNotNegative, "archard: coefficient at high pressures; 0: there is no such regime",
                [](L& l) -> double& { return l.k_seizure; });
    list.number("seizure_pressure_over_hardness", kPositive, "archard: where high pressures begin",
                [](L& l) -> double& { return l.seizure_ratio; });
    list.number_list(
        "t_gamma_area_MPa",
        "t_gamma: points of a broken line (1 MPa = 1 N/mm²), which goes on straight behind the last",
        [](L & l) -> auto& { return l.t_gamma_area; }, kNotNegative);
    list.number_list(
        "wear_rate_ug_m_mm2", "t_gamma: mass by distance and area at these points",
        [](L & l) -> auto& { return l.wear_rate; }, kNotNegative);
    list.number("density_kg_m3", kPositive, "t_gamma: of the body that wears",
                [](L& l) -> double& { return l.density; })
        .default_text.clear();
    list.number_list(
        "volume_per_work_mm3_J", "energy: coefficient, one for each regime of power by area",
        [](L & l) -> auto& { return l.volume_per_work; }, kNotNegative);
    list.number_list(
        "power_density_W_mm2", "energy: powers by area between the regimes",
        [](L & l) -> auto& { return l.power_limits; }, kPositive);
    return list.keys;
  }();
  return keys;
}

const TableKeys& wear_law_keys() {
  static const TableKeys keys = [] {
    std::vector<std::string> words;
    for (const WearTheoryRow& row : kWearTheories) words.emplace_back(row.word);
    TableKeys list{needed(one_of("theory", words, "see `treadmark list laws`")),
                   needed(key_info("source", KeyType::text, "where the numbers come from; results repeat it"))};
    for (const auto& key : plain_wear_law_keys()) list.push_back(key.info);
    return list;
  }();
  return keys;
}

const std::vector<SettingKey<FatigueSettings>>& plain_fatigue_keys() {
  using F = FatigueSettings;
  static const std::vector<SettingKey<F>> keys = [] {
    SettingKeys<F> list;
    for (const FatigueNumber& number : kFatigueNumbers)
      list.number(std::string(number.key), kPositive, std::string(number.meaning),
                  [value = number.value](F& f) -> double& { return f.*value; })
          .default_text.clear();
    list.number_list(
        "depths_mm", "subsurface, dang_van: below the surface, increasing, from the size of an element on",
        [](F & f) -> auto& { return f.depths; }, kPositive);
    list.number_list(
        "t_gamma_N", "whole_life: points of a broken line, which goes on straight behind the last",
        [](F & f) -> auto& { return f.t_gamma; }, kNotNegative);
    list.number_list(
        "damage_per_passage", "whole_life: at these points; 1: failure, negative: wear takes more than fatigue adds",
        [](F & f) -> auto& { return f.passage_damage; });
    return list.keys;
  }();
  return keys;
}

const TableKeys& fatigue_keys() {
  static const TableKeys keys = [] {
    std::string words;
    for (const FatigueMeasureRow& row : fatigue_measures())
      words += fmt::format("{}`\"{}\"`", words.empty() ? "" : ", ", row.word);
    TableKeys list{needed(key_info("measures", KeyType::text_list, words + ": see `treadmark list laws`")),
                   needed(key_info("source", KeyType::text, "where the numbers come from; results repeat it"))};
    for (const auto& key : plain_fatigue_keys()) list.push_back(key.info);
    return list;
  }();
  return keys;
}

const std::vector<SettingKey<FlowLaw>>& plain_flow_law_keys() {
  using L = FlowLaw;
  static const std::vector<SettingKey<L>> keys = [] {
    SettingKeys<L> list;
    const auto number = [&list](const char* name, const char* doc, auto place) {
      list.number(name, kPositive, doc, place).default_text.clear();
    };
    number("shear_yield_MPa", "k of the fresh material, in cyclic shear",
           [](L& l) -> double& { return l.shear_yield; });
    number("strain_per_cycle", "C: shear strain of a passage with twice the shear stress at which the material yields",
           [](L& l) -> double& { return l.strain_per_cycle; });
    list.number_list(
        "depths_mm", "of the layers, increasing, at least two: from the size of an element down to where nothing flows",
        [](L & l) -> auto& { return l.depths; }, kPositive);
    number("hardening_factor", "beta: yield after much strain over k; without it the material does not harden",
           [](L& l) -> double& { return l.hardening_factor; });
    number("hardening_rate", "alpha: yield is k max(1, beta sqrt(1 - exp(-alpha strain)))",
           [](L& l) -> double& { return l.hardening_rate; });
    return list.keys;
  }();
  return keys;
}

const TableKeys& flow_law_keys() {
  static const TableKeys keys = [] {
    std::vector<std::string> words;
    for (const FlowTheoryRow& row : kFlowTheories) words.emplace_back(row.word);
    TableKeys list{needed(one_of("theory", words, "see `treadmark list laws`")),
                   needed(key_info("source", KeyType::text, "where the numbers come from; results repeat it"))};
    for (const auto& key : plain_flow_law_keys()) list.push_back(key.info);
    return list;
  }();
  return keys;
}

const TableKeys& figure_keys() {
  static const TableKeys keys{
      needed(key_info("file", KeyType::text, "a name without folders that ends with `.svg`")),
      needed(one_of("kind", {"history", "summary", "patches"},
                    "a line for each run, a point for each run, or contact patches")),
      key_info("title", KeyType::text, "above the figure"),
      key_info("x", KeyType::text, "column along the axis, or the key of a variation (required but for patches)"),
      key_info("y", KeyType::text_list, "columns (required but for patches)"),
      key_info("x_label", KeyType::text, "instead of that of the column"),
      key_info("y_label", KeyType::text, "instead of that of the columns"),
      key_info("x_range", KeyType::number_list, "two numbers"),
      key_info("series", KeyType::text, "variation whose values get a line each, by its key or label"),
      key_info("labels", KeyType::text_list, "names of these lines instead of the values"),
      key_info("only", KeyType::text_list,
               "`\"key=value\"`: of the variations named, by key or label, only these values are drawn"),
      table_key("mark", KeyType::table_list, "numbers of others", mark_keys())};
  return keys;
}

const TableKeys& mark_keys() {
  static const TableKeys keys{needed(key_info("x", KeyType::number, "in the unit of the column")),
                              needed(key_info("y", KeyType::number, "in the unit of the column")),
                              key_info("label", KeyType::text, "beside it")};
  return keys;
}

std::string vehicle_file_schema() { return schema_of("Treadmark vehicle file", vehicle_tables(), false); }
std::string track_file_schema() { return schema_of("Treadmark track file", track_tables(), false); }
std::string simulation_file_schema() { return schema_of("Treadmark simulation file", simulation_tables(), true); }
namespace {

/// The tables of a base beside those of its study or evolution.
TableKeys with_base(TableKeys keys) {
  keys.push_back(table_key("simulation", KeyType::table, "of the base", simulation_keys()));
  for (KeyInfo& key : line_tables()) keys.push_back(std::move(key));
  keys.push_back(table_key("cases", KeyType::table_list, "of the base, a case file"));
  return keys;
}

}  // namespace

std::string evolve_file_schema() {
  TableKeys keys{needed(table_key("evolve", KeyType::table, "surfaces that contact changes", evolve_keys()))};
  return schema_of("Treadmark evolution file", with_base(std::move(keys)), true);
}

std::string study_file_schema() { return schema_of("Treadmark study file", with_base(study_tables()), true); }

std::string vehicle_key_table() { return key_table(vehicle_tables()); }
std::string track_key_table() { return key_table(std::span(track_tables()).first(5)); }
std::string simulation_key_table() { return key_table(simulation_tables()); }
std::string study_key_table() { return key_table(study_tables()); }
std::string evolve_key_table() {
  return key_table(TableKeys{table_key("evolve", KeyType::table, "surfaces that contact changes", evolve_keys())});
}

}  // namespace treadmark::io
