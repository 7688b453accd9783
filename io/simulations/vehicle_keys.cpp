// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/vehicle_keys.hpp"

#include "treadmark/io/simulations/read_vehicle.hpp"

namespace treadmark::io {

namespace {

void add_places(KeyRows<Places>& list, const std::string& part) {
  list.words("between", "two bodies, or one and \"ground\"; required with at_m, or places", &Places::between,
             kNoDefault, "the two bodies that are connected")
      .written(
          [](const Places& p) { return fmt::format("[{}, {}]", toml_text(p.between[0]), toml_text(p.between[1])); });
  list.points("at_m", "one " + part + " at each of these points", &Places::points, kNoDefault,
              "a list of points, one part at each of them");
}

KeyTable<Places> places_of(const std::string& part) {
  return key_table<Places>([&](auto& list) {
    add_places(list, part);
    list.table("places", KeyType::table_list, "between and at_m for several pairs of bodies", place_keys().infos,
               &Places::several);
  });
}

/// name, between, at_m and places of a part that connects bodies, then its own keys.
TableKeys connecting(const KeyTable<Places>& places, const TableKeys& own) {
  TableKeys keys{needed(key_info("name", KeyType::text, "several equal ones are numbered from 1"))};
  keys.insert(keys.end(), places.infos.begin(), places.infos.end());
  keys.insert(keys.end(), own.begin(), own.end());
  return keys;
}

template <class Root>
void add_direction(KeyRows<Root>& list) {
  list.choice("direction", {{"x", Freedom::x}, {"y", Freedom::y}, {"z", Freedom::z}},
              "of the displacement, the second body against the first", &Root::direction, kNeeded);
}

void add_oscillator(KeyRows<AxleMode>& list) {
  list.number("frequency_Hz", kPositive, "of the free wheelset at rest", &AxleMode::frequency, kNeeded);
  list.number("damping_ratio", {{}, 0.0, 1.0}, "over critical damping", &AxleMode::damping_ratio);
}

}  // namespace

const TableKeys& vehicle_tables() {
  static const TableKeys keys{
      needed(table_key("vehicle", KeyType::table, "the vehicle as a whole", vehicle_keys().infos)),
      needed(table_key("bodies", KeyType::table_list, "rigid bodies", body_keys().infos)),
      table_key("springs", KeyType::table_list, "springs and dampers between them", spring_table_keys()),
      table_key("bump_stops", KeyType::table_list, "springs with a characteristic", bump_stop_table_keys()),
      table_key("damper_curves", KeyType::table_list, "dampers with a characteristic", damper_curve_table_keys()),
      table_key("frictions", KeyType::table_list, "dry friction that sticks and slides", friction_table_keys()),
      table_key("air_springs", KeyType::table_list, "gas that bears, with reservoirs behind orifices",
                air_spring_table_keys()),
      needed(table_key("wheelsets", KeyType::table_list, "bodies that run on the rails, the leading one first",
                       wheelset_keys().infos)),
      table_key("axles", KeyType::table_list, "how wheelsets bend and twist", axle_keys().infos)};
  return keys;
}

const KeyTable<ModelHead>& vehicle_keys() {
  static const auto keys = key_table<ModelHead>([](auto& list) {
    add_model_name(list);
    add_model_factors(list);
  });
  return keys;
}

const KeyTable<BodySpec>& body_keys() {
  using B = BodySpec;
  static const auto keys = key_table<B>([](auto& list) {
    list.text("name", "letters, digits, `_`, `-`; equal bodies are numbered from 1", &B::name, kNeeded);
    list.number("mass_kg", kPositive, "its mass", &B::mass, kNeeded | kByMass);
    list.triple("inertia_kg_m2", kNotNegative, "positive about every axis about which the body can rotate", &B::inertia,
                kByMass);
    list.triple("position_m", kAnyNumber, "centre of mass; this or the next one is required", &B::position, kNoDefault,
                "centre of mass [x, y, z]; positions_m for several equal bodies")
        .written([](const B& body) {
          return exact_list({body.position.begin(), body.position.end()}, 1.0);
        });
    list.value(key_info("positions_m", KeyType::triple_list, "those of several equal bodies"), &B::position);
    list.value(key_info("free", KeyType::text_list,
                        "directions in which it moves: \"x\", \"y\", \"z\", \"roll\", \"pitch\", \"yaw\""),
               &B::free, kNeeded,
               "list the directions in which it can move: \"x\", \"y\", \"z\", \"roll\", \"pitch\", \"yaw\"")
        .written([](const B& body) {
          std::string words;
          for (int f = 0; f < kFreedoms; ++f)
            if (body.free.at(static_cast<std::size_t>(f)))
              words += fmt::format("{}\"{}\"", words.empty() ? "" : ", ", freedom_word(f));
          return '[' + words + ']';
        });
  });
  return keys;
}

const KeyTable<Places>& place_keys() {
  static const auto keys = key_table<Places>([](auto& list) { add_places(list, "part"); });
  return keys;
}

const KeyTable<Places>& spring_place_keys() {
  static const KeyTable<Places> keys = places_of("spring");
  return keys;
}

const KeyTable<SpringSpec>& spring_keys() {
  using S = SpringSpec;
  static const auto keys = key_table<S>([](auto& list) {
    const auto three = [&list](const char* name, const char* doc, SixValues S::*six, std::size_t first,
                               unsigned factor) {
      const auto place = [ six, first ](auto& s) -> auto& { return (s.*six)[first]; };
      list.triple(name, kNotNegative, doc, place, factor).shown("[0, 0, 0]");
    };
    const char* const in_series = "springs in series with these dampers, 0 = rigid";
    three("stiffness_N_per_m", "along x, y, z", &S::stiffness, 0, kByStiffness);
    three("damping_N_s_per_m", "along x, y, z", &S::damping, 0, kByDamping);
    three("damper_stiffness_N_per_m", in_series, &S::damper_stiffness, 0, kByStiffness);
    three("rotational_stiffness_N_m_per_rad", "about x, y, z", &S::stiffness, 3, kByStiffness);
    three("rotational_damping_N_m_s_per_rad", "about x, y, z", &S::damping, 3, kByDamping);
    three("rotational_damper_stiffness_N_m_per_rad", in_series, &S::damper_stiffness, 3, kByStiffness);
  });
  return keys;
}

const TableKeys& spring_table_keys() {
  static const TableKeys keys = connecting(spring_place_keys(), spring_keys().infos);
  return keys;
}

const KeyTable<Places>& bump_stop_place_keys() {
  static const KeyTable<Places> keys = places_of("bump stop");
  return keys;
}

const KeyTable<BumpStopSpec>& bump_stop_keys() {
  using B = BumpStopSpec;
  static const auto keys = key_table<B>([](auto& list) {
    add_direction(list);
    list.flag("odd",
              "the force is the same the other way; false: displacements of both signs, with force 0 at displacement 0",
              &B::odd);
    list.number_list("displacement_mm", kAnyNumber, "increasing", &B::displacement, kNeeded);
    list.number_list("force_N", kAnyNumber,
                     "at them, against the displacement, from 0 where it is odd; linear between, continued by the last "
                     "slopes",
                     &B::force, kNeeded);
  });
  return keys;
}

const TableKeys& bump_stop_table_keys() {
  static const TableKeys keys = connecting(bump_stop_place_keys(), bump_stop_keys().infos);
  return keys;
}

const KeyTable<Places>& damper_curve_place_keys() {
  static const KeyTable<Places> keys = places_of("damper");
  return keys;
}

const KeyTable<DamperCurveSpec>& damper_curve_keys() {
  using D = DamperCurveSpec;
  static const auto keys = key_table<D>([](auto& list) {
    add_direction(list);
    list.number_list("velocity_m_s", kNotNegative, "increasing from 0; the force is odd", &D::velocity, kNeeded);
    list.number_list("force_N", kNotNegative,
                     "from 0, not decreasing; linear between, continued by the last slope; scaled as damping",
                     &D::force, kNeeded | kByDamping)
        .key.numbers = [](D& damper) { return std::span<double>(damper.force); };
    list.number("series_stiffness_N_per_m", kNotNegative,
                "of a spring in series, 0 = rigid; with it the force must increase", &D::series_stiffness,
                kByStiffness);
  });
  return keys;
}

const TableKeys& damper_curve_table_keys() {
  static const TableKeys keys = connecting(damper_curve_place_keys(), damper_curve_keys().infos);
  return keys;
}

const KeyTable<Places>& friction_place_keys() {
  static const KeyTable<Places> keys = places_of("friction");
  return keys;
}

const KeyTable<DryFrictionSpec>& friction_keys() {
  using F = DryFrictionSpec;
  static const auto keys = key_table<F>([](auto& list) {
    list.value(key_info("directions", KeyType::text_list,
                        "one or two of \"x\", \"y\", \"z\", in which it slides at a time, or one rotation"),
               &F::directions, kNeeded, "one or two of \"x\", \"y\", \"z\", or \"roll\", \"pitch\" or \"yaw\"");
    list.number("arm_mm", kPositive, "of a rotation (required there): where friction acts", &F::arm, kNoDefault);
    list.number("stiffness_N_per_m", kPositive, "while it sticks; of a rotation at its arm", &F::stiffness, kNeeded);
    list.number(
        "damping_N_s_per_m", kNotNegative,
        "beside that stiffness: what has come to rest swings on it, and with static_ratio may break loose again",
        &F::damping);
    list.number("coefficient", kNotNegative, "bound of the force over the normal force while it slides",
                &F::coefficient, kNeeded);
    list.number("coefficient_back", kNotNegative,
                "of one direction: while the second body slides back against the first; without it the same",
                &F::coefficient_back);
    list.number("static_ratio", {{}, 1.0, 10.0}, "bound while it sticks over that while it slides", &F::static_ratio);
    list.number("normal_force_N", kNotNegative, "constant part of the normal force", &F::normal_force);
    list.value(key_info("load_of", KeyType::text_list,
                        "springs whose vertical load, or bump stops whose force, is part of the normal force: one for "
                        "all places, or one for each; a name of several equal ones stands for them one after the "
                        "other"),
               &F::load_of);
    list.number("load_share", kPositive, "normal force over that load", &F::load_share);
  });
  return keys;
}

const TableKeys& friction_table_keys() {
  static const TableKeys keys = connecting(friction_place_keys(), friction_keys().infos);
  return keys;
}

const KeyTable<Places>& air_spring_place_keys() {
  static const KeyTable<Places> keys = places_of("air spring");
  return keys;
}

const KeyTable<AirSpringSpec>& air_spring_keys() {
  using A = AirSpringSpec;
  static const auto keys = key_table<A>([](auto& list) {
    list.number("load_N", kPositive,
                "by which it shares a weight with other springs; its pressure follows from what it bears", &A::load,
                kNeeded);
    list.number("area_m2", kPositive, "on which the pressure acts", &A::area, kNeeded);
    list.number("bellows_m3", kPositive, "volume of its gas at rest, with what is open to it", &A::bellows, kNeeded);
    list.number("reservoir_m3", kNotNegative, "volume behind the orifice", &A::reservoir);
    list.number("orifice_mm", kPositive, "diameter of the orifice; required with a reservoir", &A::orifice, kNoDefault,
                "the diameter of the orifice before the reservoir");
    list.number("loss_coefficient", kPositive,
                "pressure that the orifice takes over the dynamic one in it; required with a reservoir", &A::loss,
                kNoDefault, "what the orifice takes of the pressure, over the dynamic one in it");
    list.number("exponent", {{}, 1.0, 2.0}, "n of p Vⁿ: 1 isothermal, 1.4 adiabatic air", &A::exponent);
  });
  return keys;
}

const TableKeys& air_spring_table_keys() {
  static const TableKeys keys = connecting(air_spring_place_keys(), air_spring_keys().infos);
  return keys;
}

const KeyTable<WheelsetSpec>& wheelset_keys() {
  using W = WheelsetSpec;
  static const auto keys = key_table<W>([](auto& list) {
    list.text("body", "free in z at least", &W::body, kNeeded);
    list.number("nominal_radius_mm", kWheelRadiusMm, "of its wheels", &W::nominal_radius, kNeeded);
    list.value(key_info("axle", KeyType::text, "name of one of `[[axles]]`; without it it is rigid"), &W::axle);
  });
  return keys;
}

const KeyTable<FlexibleAxle>& axle_keys() {
  using A = FlexibleAxle;
  static const auto keys = key_table<A>([](auto& list) {
    list.text("name", "letters, digits, `_`, `-`", &A::name, kNeeded);
    list.number("wheel_distance_mm", kPositive, "of the middle planes of both wheels", &A::wheel_distance, kNeeded);
    list.number("wheel_polar_inertia_kg_m2", kNotNegative,
                "of one wheel with its discs about the axle, part of the body's own", &A::wheel_polar_inertia,
                kNeeded | kByMass);
    list.number_list("places_mm", kAnyNumber,
                     "along the axle from its middle to the right, increasing: wheels, axle boxes and what else is "
                     "held by springs; required with `bending`",
                     &A::places, kNoDefault, "shapes need the places at which they are given");
    list.table("bending", KeyType::table_list, "vibrations of the free wheelset, each in both planes",
               bending_keys().infos, &A::bending);
    list.table("torsion", KeyType::table_list, "vibrations of the free wheelset about its axle", torsion_keys().infos,
               &A::torsion);
  });
  return keys;
}

const KeyTable<AxleMode>& bending_keys() {
  static const auto keys = key_table<AxleMode>([](auto& list) {
    add_oscillator(list);
    list.number("modal_mass_kg", kPositive, "integral of mass times shape², scaled as the shape is", &AxleMode::mass,
                kNeeded);
    list.number_list("shape", kAnyNumber, "displacement at each of `places_mm`", &AxleMode::shape, kNeeded);
    list.number_list("slope_per_m", kAnyNumber, "its derivative along the axle there", &AxleMode::slope, kNeeded);
  });
  return keys;
}

const KeyTable<AxleMode>& torsion_keys() {
  static const auto keys = key_table<AxleMode>([](auto& list) {
    add_oscillator(list);
    list.number("modal_inertia_kg_m2", kPositive,
                "sum of moments of inertia times rotation², scaled as the rotations are", &AxleMode::mass, kNeeded);
    list.number_list("wheel_rotation", kAnyNumber, "of the left and the right wheel", &AxleMode::rotation, kNeeded);
  });
  return keys;
}

}  // namespace treadmark::io
