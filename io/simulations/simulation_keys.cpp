// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/simulation_keys.hpp"

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/io/settings/key_schema.hpp"
#include "treadmark/io/simulations/design_keys.hpp"
#include "treadmark/io/simulations/evolve_keys.hpp"
#include "treadmark/io/simulations/limit_keys.hpp"
#include "treadmark/io/simulations/line_keys.hpp"
#include "treadmark/io/simulations/study_keys.hpp"
#include "treadmark/io/simulations/vehicle_keys.hpp"
#include "treadmark/model/vehicle/assessment.hpp"
#include "treadmark/model/vehicle/train.hpp"

namespace treadmark::io {

namespace {

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
  return {table_key("layout", KeyType::table, "the line: straights, curves, cant, gauge", layout_keys().infos),
          table_key("irregularities", KeyType::table, "deviations of the rails from it", irregularity_keys().infos),
          table_key("assessment", KeyType::table, "what is read out of the run", assessment_keys().infos)};
}
TableKeys simulation_tables() {
  TableKeys keys{needed(table_key("simulation", KeyType::table, "a vehicle on its track", simulation_keys().infos))};
  for (KeyInfo& key : line_tables()) keys.push_back(std::move(key));
  return keys;
}
TableKeys study_tables() {
  return {needed(table_key("study", KeyType::table, "runs with varied keys", study_keys().infos))};
}
TableKeys evolve_tables() {
  return {table_key("evolve", KeyType::table, "surfaces that contact changes", evolve_keys().infos)};
}

TableKeys design_tables() {
  return {needed(table_key("design", KeyType::table, "what is sought, and what for", design_keys().infos))};
}

/// The tables of a base beside those of its study or evolution.
TableKeys with_base(TableKeys keys) {
  keys.push_back(table_key("simulation", KeyType::table, "of the base", simulation_keys().infos));
  for (KeyInfo& key : line_tables()) keys.push_back(std::move(key));
  keys.push_back(table_key("cases", KeyType::table_list, "of the base, a case file"));
  return keys;
}

}  // namespace

const KeyTable<SimulationFile>& simulation_keys() {
  using F = SimulationFile;
  using S = SimulationSettings;
  static const auto keys = key_table<F>([](auto& list) {
    list.value(key_info("vehicle", KeyType::path, "vehicle file"), &F::vehicle_file, kNeeded, "name the vehicle file");
    list.table("train", KeyType::table_list, "vehicles that follow the leading one, coupled to it and to each other",
               train_keys().infos, &F::train);
    list.value(key_info("track", KeyType::path, "track file; without it the track is rigid"), &F::track_file);
    list.number("speed_m_s", {{}, 0.0, 1000.0}, "speed at the start, more than 0; this or the next one is required",
                setting(&S::speed), kNoDefault, "a simulation needs a speed");
    list.number("speed_km_h", {{}, 0.0, 3600.0}, "speed at the start in km/h, in place of speed_m_s",
                setting(&S::speed), kNoDefault);
    list.table("speed_profile", KeyType::table, "speeds behind the start; without it the speed is constant",
               speed_profile_keys().infos, setting(&S::profile));
    list.table("free_run", KeyType::table,
               "speeds behind the start that follow from torques, forces along x, gradients and resistance; with "
               "distance_m",
               free_run_keys().infos, &F::free_run);
    list.table("torques", KeyType::table_list, "motors and brakes on axles", torque_keys().infos, &F::torques);
    list.table("forces", KeyType::table_list, "from outside on bodies and rails: wind, couplers, a push",
               force_keys().infos, &F::forces);
    list.table("spring_motions", KeyType::table_list, "ground ends of springs that move: actuators, shakers",
               spring_motion_keys().infos, &F::spring_motions);
    list.table("rail_shifts", KeyType::table_list, "rails that move in time below wheels", rail_shift_keys().infos,
               &F::rail_shifts);
    list.table("twist", KeyType::table, "a twist test: rails below all wheels that twist the vehicle and its bogies",
               twist_keys().infos, &F::twist);
    list.number("distance_m", kPositive, "travelled in all; this or the next one is required", setting(&S::distance),
                kNoDefault, "say how far, distance_m, or how long, duration_s");
    list.number("duration_s", kPositive, "of the whole simulation", setting(&S::duration), kNoDefault);
    list.number("gravity_m_s2", {0.0, {}, 1e3}, "acceleration of gravity", setting(&S::gravity));
    list.number("tolerance_um", kPositive, "local error of a step", setting(&S::tolerance));
    list.number("max_step_us", kPositive, "longest step", setting(&S::max_step));
    list.number("min_step_us", kPositive, "shortest step", setting(&S::min_step));
    list.number(
        "max_step_elements", kPositive,
        "distance travelled in a step over `discretisation.dx_mm`; in transient rolling 1 without the key, at most 2 "
        "(dt ≤ 2 dx/V). Steps of two elements take half the time, but lateral creep forces then scatter by some per "
        "cent, because elements at the leading edge stick or slip as they happen to come in",
        setting(&S::max_step_elements));
    list.number("spectral_radius", {{}, 0.5, 1.0},
                "of the time integration at infinite frequency: 1 = no numerical damping",
                setting(&S::spectral_radius));
    list.number(
        "from_midspan_mm", kAnyNumber,
        "on a flexible track: place of the vehicle's x = 0 at the start, ahead of the middle between two sleepers",
        setting(&S::from_midspan));
    list.flag("shared_rails",
              "on a flexible track: all wheels of a side run on one rail and feel each other through it; false: each "
              "has a rail of its own",
              setting(&S::shared_rails));
    list.number("rail_start_m", kAnyNumber,
                "place of the leading wheelset along the rails at the start, from where x of rails that vary, their "
                "defects and friction along the track count; the other wheelsets stand behind it as in the vehicle",
                setting(&S::rail_start));
    list.choice("contact", kContactModels, "of wheels that `[[simulation.wheels]]` does not name; they are round",
                setting(&S::contact));
    list.number("auto_force_error", kPositive,
                "with contact = \"auto\": what forces of a table may be wrong by, over the normal force",
                setting(&S::force_error));
    list.number("auto_wear_error", kPositive,
                "with contact = \"auto\": what the wear number of a table may be wrong by, over that of the full "
                "contact",
                setting(&S::wear_error));
    list.choice("creep_forces",
                {{"shen_hedrick_elkins", CreepForcesInput::shen_hedrick_elkins},
                 {"exact_table", CreepForcesInput::exact_table}},
                "of wheels whose contact is a table: Kalker's coefficients with saturation, or a table of solutions "
                "of the exact theory on Hertzian ellipses",
                setting(&S::creep_forces));
    list.number(
        "checkpoint_s", kPositive,
        "time of the computer between two checkpoints; twenty times what the last one took, where that is longer",
        setting(&S::checkpoint));
    list.number("output_every_mm", kNotNegative,
                "distance travelled between two lines of the history; 0 = every step. The summary counts every step",
                setting(&S::output_every));
    list.table("fields", KeyType::table, "when contact fields are kept", field_keys().infos, &F::fields);
    list.table("wheels", KeyType::table_list, "how the contact of single wheels is found", wheel_keys().infos,
               &F::wheels);
    list.number("axle_box_y_mm", kNotNegative,
                "of the points of axle boxes whose accelerations are written down, to both sides of the wheelset's "
                "middle",
                [](F& f) -> double& { return f.history.axle_box_y; });
    list.words(
        "channels", "columns of the history beside time and distance, `*` for any letters; without it all",
        [](F & f) -> auto& { return f.history.channels; });
    list.table(
        "points", KeyType::table_list, "points of bodies whose accelerations are written down", point_keys().infos,
        [](F & f) -> auto& { return f.history.points; });
    list.table("check_rails", KeyType::table_list, "rails that hold the backs of flanges", check_rail_keys().infos,
               &F::check_rails);
    list.table("other_wheel", KeyType::table,
               "shape of the round wheels, with the keys of `[wheel]`; required where `[wheel]` is made of slices or "
               "triangles and a wheel is round",
               {}, &F::other_wheel);
    const auto rail = [&list](const std::string& side, auto place) {
      list.table(side + "_rail", KeyType::table,
                 fmt::format("shape of the {} rail instead of `[rail]`, with its keys; y of both sides points away "
                             "from the middle of the track",
                             side),
                 {}, place);
    };
    rail("left", &F::left_rail);
    rail("right", &F::right_rail);
    list.table("table_rail", KeyType::table,
               "rail of one section for wheels with table contact, with the keys of `[rail]`; required where their "
               "own rail varies by more than its defects",
               {}, &F::table_rail);
  });
  return keys;
}

const KeyTable<TrainPart>& train_keys() {
  using T = TrainPart;
  static const auto keys = key_table<T>([](auto& list) {
    const auto of = [](auto CouplerSpec::*member) {
      return [member](auto& t) -> auto& { return t.coupler.*member; };
    };
    list.value(key_info("vehicle", KeyType::path, "vehicle file; without it the leading vehicle"), &T::file);
    list.integer("count", 1, kLongestTrain, "of equal vehicles", &T::count);
    list.number("behind_m", kPositive, "place of its x = 0 behind that of the vehicle before", &T::behind, kNeeded);
    list.words("between", "coupled bodies: one of the vehicle before, one of this vehicle", &T::between, kNeeded,
               "the bodies that are coupled, [before, this]");
    list.triple("at_m", kAnyNumber, "where the coupler acts, in coordinates of the vehicle before",
                of(&CouplerSpec::position), kNeeded, "where the coupler acts, [x, y, z]");
    list.number("slack_mm", kNotNegative, "free play of the coupler, from push to pull", of(&CouplerSpec::slack));
    list.number_list("travel_mm", kNotNegative, "beyond it, from 0, increasing; in pull and push alike",
                     of(&CouplerSpec::travel), kNeeded, "travels of the spring from 0");
    list.number_list("force_N", kNotNegative,
                     "of the spring at them, from 0, increasing; linear between, continued by the last slope",
                     of(&CouplerSpec::force), kNeeded, "forces of the spring at its travels");
    list.number("damping_N_s_per_m", kNotNegative, "of a damper, whose force is never more than the spring's",
                of(&CouplerSpec::damping));
    list.number("friction", {{}, 0.0, 1.0}, "of the draft gear: bound of the friction over the spring's force",
                of(&CouplerSpec::friction));
    list.number("friction_stiffness_N_per_m", kPositive, "while it sticks; required with friction",
                of(&CouplerSpec::friction_stiffness), kNoDefault, "how stiff the draft gear is while friction sticks");
  });
  return keys;
}

const KeyTable<FreeRun>& free_run_keys() {
  using R = FreeRun;
  static const auto keys = key_table<R>([](auto& list) {
    list.number("resistance_N", kNotNegative, "of the whole train at all speeds", &R::resistance);
    list.number("resistance_N_s_per_m", kNotNegative, "times the speed", &R::by_speed);
    list.number("resistance_N_s2_per_m2", kNotNegative, "times the square of the speed", &R::by_square);
    list.number_list("gradient_at_m", kAnyNumber, "places along the line, increasing", &R::place);
    list.number_list("gradient_per_mille", {{}, -200.0, 200.0},
                     "at them, positive where the line climbs; linear between, constant before and behind",
                     &R::gradient);
  });
  return keys;
}

const KeyTable<SpeedProfile>& speed_profile_keys() {
  static const auto keys = key_table<SpeedProfile>([](auto& list) {
    list.number_list("time_s", kPositive, "increasing, from more than 0", &SpeedProfile::time, kNeeded);
    list.number_list("speed_m_s", {{}, 0.0, 1000.0},
                     "at these times, more than 0; straight lines between, constant behind the last one",
                     &SpeedProfile::speed, kNeeded);
  });
  return keys;
}

namespace {

/// Files count wheelsets from 1.
template <class Root>
void add_wheelset(KeyRows<Root>& list) {
  list.integer("wheelset", 1, 1e6, "number of the wheelset, 1 = leading", &Root::wheelset, kNeeded)
      .read_by([](Root& root, const CaseValue& value) { root.wheelset = static_cast<int>(value.integer()) - 1; });
}

}  // namespace

const KeyTable<AxleTorque>& torque_keys() {
  using T = AxleTorque;
  static const auto keys = key_table<T>([](auto& list) {
    add_wheelset(list);
    list.number_list("time_s", kNotNegative, "increasing", &T::time, kNeeded);
    list.number_list("torque_N_m", kAnyNumber,
                     "at these times, positive in traction; straight lines between, constant before and behind",
                     &T::torque, kNeeded);
    list.text("reaction", "body that holds motor or brake, or \"ground\"", &T::reaction, kNeeded);
  });
  return keys;
}

namespace {

/// Which rails, left and right below which wheelsets.
template <class Root>
void add_rails_below(KeyRows<Root>& list, const std::string& side) {
  list.value(
          key_info("wheelset", KeyType::integer, "below which one, 1 = leading; without it below all", {{}, 1.0, 1e6}),
          &Root::wheelset)
      .read_by([](Root& root, const CaseValue& value) { root.wheelset = static_cast<int>(value.integer()) - 1; });
  list.value(key_info("side", KeyType::text, side), &Root::left);
}

/// time_s and a list of displacements.
template <class Root>
void add_motion(KeyRows<Root>& list, const std::string& displacement) {
  list.number_list("time_s", kNotNegative, "increasing", &Root::time, kNeeded);
  list.number_list(displacement, kAnyNumber,
                   "at these times; a smooth curve between, which does not overshoot, constant before and behind",
                   &Root::displacement, kNeeded);
}

}  // namespace

const KeyTable<BodyForce>& force_keys() {
  using B = BodyForce;
  static const auto keys = key_table<B>([](auto& list) {
    list.text("body", "of the vehicle; this or `side` is required", &B::body, kNoDefault);
    add_rails_below(list, "of a rail: \"left\" or \"right\", which runs along with the wheelset");
    list.value(key_info("at_m", KeyType::triple,
                        "where it acts, of the vehicle at rest; without it at the centre of mass"),
               &B::point)
        .read_by([](B& force, const CaseValue& value) {
          const std::vector<double> at = numbers_of(value, 1.0);
          force.point = Vec3(at[0], at[1], at[2]);
        });
    list.choice("direction",
                {{"x", Freedom::x},
                 {"y", Freedom::y},
                 {"z", Freedom::z},
                 {"roll", Freedom::roll},
                 {"pitch", Freedom::pitch},
                 {"yaw", Freedom::yaw}},
                "of the force, or of a moment", &B::direction, kNeeded);
    list.number_list("time_s", kNotNegative, "increasing", &B::time, kNeeded);
    list.number_list("force_N", kAnyNumber, "at these times; straight lines between, constant before and behind",
                     &B::force, kNoDefault);
    list.number_list("moment_N_m", kAnyNumber, "the same of a moment", &B::force, kNoDefault);
  });
  return keys;
}

const KeyTable<SpringMotion>& spring_motion_keys() {
  using M = SpringMotion;
  static const auto keys = key_table<M>([](auto& list) {
    list.text("spring", "one that connects a body with \"ground\"; with several equal ones its number, too", &M::spring,
              kNeeded);
    list.choice("direction", {{"x", Freedom::x}, {"y", Freedom::y}, {"z", Freedom::z}}, "of the motion", &M::direction,
                kNeeded);
    add_motion(list, "displacement_mm");
  });
  return keys;
}

const KeyTable<RailShift>& rail_shift_keys() {
  using R = RailShift;
  static const auto keys = key_table<R>([](auto& list) {
    add_rails_below(list, "\"left\" or \"right\"; without it both rails");
    list.choice("direction", {{"y", Freedom::y}, {"z", Freedom::z}}, "of the motion, y to the right, z down",
                &R::direction, kNeeded);
    add_motion(list, "displacement_mm");
  });
  return keys;
}

const KeyTable<TwistTest>& twist_keys() {
  using T = TwistTest;
  static const auto keys = key_table<T>([](auto& list) {
    list.number("vehicle_per_mille", kAnyNumber, "cross level over the distance between the middles of the bogies",
                &T::vehicle);
    list.number("bogie_per_mille", kAnyNumber, "cross level over the wheelbase of each bogie", &T::bogie);
    list.integer("wheelsets_per_bogie", 1, 1000, "from the front on; 1: single axles", &T::wheelsets_per_bogie);
    list.number("period_s", kPositive,
                "in which the twist grows in a quarter of it, changes to the other sign in two and fades", &T::period,
                kNeeded, "give a period that is long against all vibrations of the vehicle");
  });
  return keys;
}

const KeyTable<FieldRequests>& field_keys() {
  static const auto keys = key_table<FieldRequests>([](auto& list) {
    list.number_list("pitch_deg", kAnyNumber,
                     "increasing; contact fields are kept where a wheelset passes these angles", &FieldRequests::pitch);
    list.number_list("position_m", kNotNegative, "increasing; contact fields are kept at these distances travelled",
                     &FieldRequests::position);
  });
  return keys;
}

const KeyTable<WheelContactInput>& wheel_keys() {
  using W = WheelContactInput;
  static const auto keys = key_table<W>([](auto& list) {
    add_wheelset(list);
    list.choice("side", {{"left", Side::left}, {"right", Side::right}}, "of the wheelset", &W::side, kNeeded);
    list.choice("contact", kContactModels,
                "the contact problem itself, a table of solutions, or by itself the table where that is right",
                &W::model, kNeeded);
    list.flag("defects", "false: the wheel is round", &W::defects).shown("true");
    list.number("pitch_deg", kAnyNumber, "pitch of the wheelset at the start, the same for both its wheels", &W::pitch)
        .shown("0");
    list.number("full_from_m", kAnyNumber,
                "of a full contact: from this place along the rail, with a table before; at least 0.1 m before the end",
                &W::full_from);
    list.number("full_to_m", kAnyNumber, "to this place, with a table behind", &W::full_to);
  });
  return keys;
}

const KeyTable<PointInput>& point_keys() {
  using P = PointInput;
  static const auto keys = key_table<P>([](auto& list) {
    list.text("name", "letters, digits, `_`, `-`", &P::name, kNeeded);
    list.text("body", "of the vehicle", &P::body, kNeeded);
    list.triple("at_m", kAnyNumber, "where it is, loaded and at rest", &P::arm, kNeeded);
    list.choice("kind", kPointKinds, "which filters and limits an assessment takes", &P::kind);
  });
  return keys;
}

const KeyTable<AssessmentRequest>& assessment_keys() {
  using A = AssessmentRequest;
  static const auto keys = key_table<A>([](auto& list) {
    list.choice("vehicle", kVehicleKinds, "limits differ", &A::vehicle);
    list.number("from_m", kNotNegative,
                "where the assessment begins without sections, and spectra begin; without it 0, or where all wheelsets "
                "are behind the wind-up of irregularities",
                &A::from, kNoDefault);
    list.words("spectra", "channels whose spectra are wanted, `*` for any letters", &A::spectra);
    list.words("laws", "named laws of wear and fatigue that are asked of the wheels: see `treadmark list laws`",
               &A::laws);
    list.value(key_info("limits", KeyType::path,
                        "[file of limits](assessment.md#limits); without it those that the literature quotes"),
               &A::limits);
    list.table("sections", KeyType::table_list, "parts of the run; without them it is assessed as a whole",
               section_keys().infos, &A::sections);
  });
  return keys;
}

const KeyTable<AssessmentSection>& section_keys() {
  using S = AssessmentSection;
  static const auto keys = key_table<S>([](auto& list) {
    list.text("name", "one of its own", &S::name, kNeeded);
    list.number("from_m", kNotNegative, "distance travelled", &S::from, kNeeded);
    list.number("to_m", kNotNegative, "distance travelled", &S::to, kNeeded);
    list.choice("kind", kSectionKinds, "quasi-static forces are assessed in curves", &S::kind);
  });
  return keys;
}

const KeyTable<CheckRailInput>& check_rail_keys() {
  using C = CheckRailInput;
  static const auto keys = key_table<C>([](auto& list) {
    list.choice("side", {{"left", Side::left}, {"right", Side::right}}, "whose flanges it holds", &C::side, kNeeded);
    list.number("from_m", kAnyNumber, "place along the rail", &C::from, kNeeded);
    list.number("to_m", kAnyNumber, "more than `from_m`", &C::to, kNeeded);
    list.number("face_y_mm", kPositive,
                "of the guiding face from the middle of the track: half the gauge less the flangeway", &C::face_y,
                kNeeded);
    list.number("depth_mm", kAnyNumber, "below the rail tops, z = 0, where the back of the flange touches it",
                &C::depth);
    list.number("stiffness_N_per_m", kPositive, "lateral, against the running rail", &C::stiffness, kNeeded);
    list.number("damping_N_s_per_m", kNotNegative, "in parallel", &C::damping);
    list.number("friction", kNotNegative, "coefficient", &C::friction);
    list.number("flare_m", kNotNegative, "length at both ends over which the face recedes with the square",
                &C::flare_length);
    list.number("flare_mm", kNotNegative, "by so much", &C::flare);
  });
  return keys;
}

std::string vehicle_file_schema() { return schema_of("Treadmark vehicle file", vehicle_tables(), false); }
std::string track_file_schema() { return schema_of("Treadmark track file", track_tables(), false); }
std::string simulation_file_schema() { return schema_of("Treadmark simulation file", simulation_tables(), true); }
std::string study_file_schema() { return schema_of("Treadmark study file", with_base(study_tables()), true); }
std::string evolve_file_schema() {
  TableKeys keys = evolve_tables();
  keys.front().required = true;
  return schema_of("Treadmark evolution file", with_base(std::move(keys)), true);
}

std::string design_file_schema() {
  TableKeys keys = design_tables();
  keys.push_back(table_key("cases", KeyType::table_list, "of the base"));
  return schema_of("Treadmark design file", std::move(keys), true);
}

std::string limits_file_schema() { return schema_of("Treadmark file of limits", limit_file_keys().infos, false); }

std::string vehicle_key_table() { return key_table(vehicle_tables()); }
std::string track_key_table() { return key_table(std::span(track_tables()).first(5)); }
std::string simulation_key_table() { return key_table(simulation_tables()); }
std::string limits_key_table() { return key_table(limit_file_keys().infos); }
std::string study_key_table() { return key_table(study_tables()); }
std::string evolve_key_table() { return key_table(evolve_tables()); }
std::string design_key_table() { return key_table(design_tables()); }

Inputs inputs_of(const SimulationFile& file) {
  const SimulationFile fresh;
  Inputs out{{"vehicle", file.vehicle.name}};
  if (!file.vehicle_file.path.empty()) out.emplace_back("vehicle file", file.vehicle_file.path.filename().string());
  if (file.track_file) out.emplace_back("track file", file.track_file->path.filename().string());
  if (file.irregularity_file) out.emplace_back("irregularities", file.irregularity_file->path.filename().string());
  InputList inputs;
  for (const SettingKey<SimulationFile>& key : simulation_keys().rows) {
    const std::string value = value_of(key, file, {});
    if (value != value_of(key, fresh, {})) inputs.add(key.info, "simulation." + key.info.path, {value});
  }
  Case contact;
  contact.content = file.contact;
  for (Inputs list : {inputs.words(), inputs_of({&contact, 1}, file.path.parent_path())})
    out.insert(out.end(), list.begin(), list.end());
  return out;
}

}  // namespace treadmark::io
