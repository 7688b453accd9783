// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/track_keys.hpp"

#include "treadmark/io/simulations/vehicle_keys.hpp"

namespace treadmark::io {

KeyInfo needed(KeyInfo info) {
  info.required = true;
  return info;
}

KeyInfo table_key(std::string name, KeyType type, std::string doc, TableKeys keys) {
  KeyInfo info = key_info(std::move(name), type, std::move(doc));
  info.elements = std::move(keys);
  return info;
}

void add_model_name(KeyRows<ModelHead>& list) {
  list.text("name", "of the model", &ModelHead::name, kNeeded);
  list.text("source", "where the numbers come from", &ModelHead::source);
}

void add_model_factors(KeyRows<ModelHead>& list) {
  list.number("scale_mass", kPositive, "factor on all masses and moments of inertia", &ModelHead::mass);
  list.number("scale_stiffness", kPositive,
              "factor on all stiffnesses of springs; bump stops, air springs, axles and rails stay",
              &ModelHead::stiffness);
  list.number("scale_damping", kNotNegative, "factor on all damping", &ModelHead::damping);
}

const TableKeys& track_tables() {
  static const TableKeys keys{
      needed(table_key("track", KeyType::table, "the track as a whole", track_keys().infos)),
      table_key("rail", KeyType::table, "a flexible rail; required where kind is \"flexible\"", rail_keys()),
      table_key("seats", KeyType::table, "what carries a flexible rail; required where kind is \"flexible\"",
                seats_keys()),
      table_key("varied", KeyType::table_list, "seats of a flexible rail that differ", varied_seat_keys().infos),
      table_key("joints", KeyType::table_list, "of flexible rails, at the same places on both", joint_keys().infos),
      table_key("lateral", KeyType::table, "flexible rails sideways as masses on springs, and tracks fitted to them",
                lateral_keys().infos),
      table_key("bodies", KeyType::table_list, "rigid bodies; required where kind is \"lumped\"", body_keys().infos),
      table_key("springs", KeyType::table_list, "springs and dampers between them", spring_table_keys())};
  return keys;
}

const KeyTable<ModelHead>& track_keys() {
  static const auto keys = key_table<ModelHead>([](auto& list) {
    add_model_name(list);
    list.choice("kind", {{"lumped", false}, {"flexible", true}},
                "masses on springs below each wheelset, or rails that bend on sleepers", &ModelHead::flexible);
    list.words("rails", "the bodies that carry the left and the right rail (required where kind is \"lumped\")",
               &ModelHead::rails, kNoDefault, "the bodies that are the left and the right rail");
    add_model_factors(list);
  });
  return keys;
}

const KeyTable<RailBeam>& beam_keys() {
  static const auto keys = key_table<RailBeam>([](auto& list) {
    list.number("bending_stiffness_N_m2", kPositive, "E I of one rail, vertically", &RailBeam::bending_stiffness,
                kNeeded);
    list.number("shear_stiffness_N", kPositive, "kappa G A of one rail", &RailBeam::shear_stiffness, kNeeded);
    list.number("mass_kg_per_m", kPositive, "of one rail", &RailBeam::mass, kNeeded | kByMass);
    list.number("rotary_inertia_kg_m", kNotNegative, "density times I", &RailBeam::rotary_inertia, kByMass);
    list.number("damping_us", kNotNegative, "inner damping over stiffness: the loss factor is 2 pi f times this",
                &RailBeam::damping_time);
  });
  return keys;
}

const KeyTable<FlexibleTrack>& rail_distance_keys() {
  static const auto keys = key_table<FlexibleTrack>([](auto& list) {
    list.number("distance_m", {0.1, {}, 10.0}, "of the middles of both rails", &FlexibleTrack::gauge);
  });
  return keys;
}

const KeyTable<RailSideways>& sideways_keys() {
  using S = RailSideways;
  static const auto keys = key_table<S>([](auto& list) {
    list.number("lateral_bending_stiffness_N_m2", kPositive,
                "E I sideways; with it rails bend and twist sideways, and what follows counts", &S::bending_stiffness,
                kNeeded);
    list.number("lateral_shear_stiffness_N", kPositive, "kappa G A sideways; required then", &S::shear_stiffness,
                kNeeded);
    list.number("lateral_rotary_inertia_kg_m", kNotNegative, "density times I sideways", &S::rotary_inertia, kByMass);
    list.number("torsional_stiffness_N_m2", kPositive, "G J of St Venant's torsion; required then",
                &S::torsional_stiffness, kNeeded);
    list.number("polar_inertia_kg_m", kPositive, "density times polar moment of area about the centroid; required then",
                &S::polar_inertia, kNeeded | kByMass);
    list.number("height_mm", kPositive, "of the top above the foot; required then", &S::height, kNeeded);
    list.number("centroid_height_mm", kNotNegative, "of the centroid above the foot; required then", &S::centroid,
                kNeeded);
    list.number("shear_centre_height_mm", kNotNegative, "of the shear centre; default that of the centroid",
                &S::shear_centre, kNoDefault);
  });
  return keys;
}

namespace {

void append(TableKeys& keys, const TableKeys& more, bool always = true) {
  for (KeyInfo info : more) {
    info.required = info.required && always;
    keys.push_back(std::move(info));
  }
}

}  // namespace

const TableKeys& rail_keys() {
  static const TableKeys keys = [] {
    TableKeys all = beam_keys().infos;
    append(all, rail_distance_keys().infos);
    append(all, sideways_keys().infos, false);
    return all;
  }();
  return keys;
}

const KeyTable<SeatRow>& seat_row_keys() {
  static const auto keys = key_table<SeatRow>([](auto& list) {
    list.integer("count", 4, kMostSeats, "of sleepers", &SeatRow::count);
    list.value(key_info("spacing_m", KeyType::number, "from sleeper to sleeper; this or the next one is required",
                        {0.0, {}, 100.0}),
               &SeatRow::spacings, kNoDefault, "spacings_m for unequal ones")
        .read_by([](SeatRow& row, const CaseValue& value) { row.spacings = {value.number()}; });
    list.number_list("spacings_m", {0.0, {}, 100.0}, "unequal ones, over and over again", &SeatRow::spacings);
    list.integer("bay_elements", 2, 64, "beam elements from sleeper to sleeper", &SeatRow::bay_elements);
    list.integer("absorbing_bays", 0, kMostSeats,
                 "bays at each end in which the rail is damped more and more; at most a quarter of `count`",
                 &SeatRow::absorbing_bays);
    list.number("absorption_per_s", kNotNegative, "damping over mass at both ends, from 0 growing with the square",
                &SeatRow::absorption);
  });
  return keys;
}

const KeyTable<RailSeat>& seat_keys() {
  using S = RailSeat;
  static const auto keys = key_table<S>([](auto& list) {
    list.number("pad_stiffness_N_per_m", kPositive, "of the pad of one seat", &S::pad_stiffness,
                kNeeded | kByStiffness | kByPad);
    list.number("pad_damping_N_s_per_m", kNotNegative, "of it", &S::pad_damping, kByDamping | kByPad);
    list.number("sleeper_mass_kg", kPositive, "of a whole sleeper, which has two seats", &S::sleeper_mass,
                kNeeded | kByMass | kBySleeper)
        .read_by([](S& seat, const CaseValue& value) { seat.sleeper_mass = 0.5 * value.number(); });
    list.number("bed_stiffness_N_per_m", kPositive, "of what carries a sleeper at one seat", &S::bed_stiffness,
                kNeeded | kByStiffness | kByBed);
    list.number("bed_damping_N_s_per_m", kNotNegative, "of it", &S::bed_damping, kByDamping | kByBed);
  });
  return keys;
}

const KeyTable<RailSeat>& sideways_seat_keys() {
  using S = RailSeat;
  static const auto keys = key_table<S>([](auto& list) {
    list.number("lateral_pad_stiffness_N_per_m", kPositive,
                "of a seat at the rail's foot; required where rails bend sideways", &S::lateral_pad_stiffness,
                kNeeded | kByStiffness | kByPad);
    list.number("lateral_pad_damping_N_s_per_m", kNotNegative, "of it", &S::lateral_pad_damping, kByDamping | kByPad);
    list.number("roll_stiffness_N_m_per_rad", kPositive,
                "of a seat against rolling of the rail; required where rails bend sideways", &S::roll_stiffness,
                kNeeded | kByStiffness | kByPad);
    list.number("roll_damping_N_m_s_per_rad", kNotNegative, "of it", &S::roll_damping, kByDamping | kByPad);
    list.number("lateral_bed_stiffness_N_per_m", kPositive,
                "of what holds a sleeper sideways at one seat; required where rails bend sideways",
                &S::lateral_bed_stiffness, kNeeded | kByStiffness | kByBed);
    list.number("lateral_bed_damping_N_s_per_m", kNotNegative, "of it", &S::lateral_bed_damping, kByDamping | kByBed);
  });
  return keys;
}

const TableKeys& seats_keys() {
  static const TableKeys keys = [] {
    const TableKeys& row = seat_row_keys().infos;
    constexpr std::ptrdiff_t kBeforeSeats = 3;  // count and spacings
    TableKeys all(row.begin(), row.begin() + kBeforeSeats);
    append(all, seat_keys().infos);
    append(all, TableKeys(row.begin() + kBeforeSeats, row.end()));
    append(all, sideways_seat_keys().infos, false);
    return all;
  }();
  return keys;
}

const KeyTable<VariedSeats>& varied_seat_keys() {
  using V = VariedSeats;
  static const auto keys = key_table<V>([](auto& list) {
    list.integer("first_seat", 1, kMostSeats, "from 1", &V::first, kNeeded);
    list.integer("last_seat", 1, kMostSeats, "default the first one", &V::last);
    list.number("pad_factor", kPositive, "on stiffness and damping of pads, vertical, lateral and in roll", &V::pad);
    list.number("sleeper_factor", kPositive, "on the mass of sleepers", &V::sleeper);
    list.number("bed_factor", kNotNegative,
                "on stiffness and damping below sleepers, vertical and lateral; 0: they hang", &V::bed);
  });
  return keys;
}

const KeyTable<RailJoint>& joint_keys() {
  using J = RailJoint;
  static const auto keys = key_table<J>([](auto& list) {
    list.number("place_m", kNotNegative, "from the first seat; joints lie at least the longest bay apart", &J::x,
                kNeeded);
    list.number("hinge_stiffness_N_m_per_rad", kNotNegative,
                "moment that the fishplates carry over the angle that they open by; 0: a hinge", &J::hinge_stiffness,
                kNeeded);
    list.number("dip_mm", kNotNegative,
                "how much lower the tops of the unloaded rails lie at the joint; they meet at an angle of 4 dip_mm "
                "over dip_length_mm",
                &J::dip_depth);
    list.number("dip_length_mm", kPositive, "to either side, over which the slope falls linearly to 0", &J::dip_length);
    list.number("lateral_hinge_stiffness_N_m_per_rad", kNotNegative,
                "the same as hinge_stiffness sideways; without it rails go on there as one",
                &J::lateral_hinge_stiffness);
  });
  return keys;
}

const KeyTable<LateralSupport>& lateral_keys() {
  using L = LateralSupport;
  static const auto keys = key_table<L>([](auto& list) {
    list.number("pad_stiffness_N_per_m", kPositive, "at a wheel, not at a seat", &L::pad_stiffness,
                kNeeded | kByStiffness);
    list.number("pad_damping_N_s_per_m", kNotNegative, "at a wheel", &L::pad_damping, kByDamping);
    list.number("bed_stiffness_N_per_m", kPositive, "below half a sleeper, at a wheel", &L::bed_stiffness,
                kNeeded | kByStiffness);
    list.number("bed_damping_N_s_per_m", kNotNegative, "at a wheel", &L::bed_damping, kByDamping);
    list.number("foot_width_mm", kPositive, "of the rail: pads resist its rolling over it", &L::foot_width, kNeeded);
    list.number("roll_radius_mm", kPositive, "radius of gyration of the rail about its axis", &L::roll_inertia, kNeeded)
        .read_by([](L& l, const CaseValue& value) {
          const double radius = value.number() * unit_of_key("_mm");
          l.roll_inertia = radius * radius;
        });
    list.number("rail_mass_kg", kPositive, "of the rail that moves sideways at a wheel", &L::rail_mass,
                kNeeded | kByMass);
    list.number("sleeper_mass_kg", kPositive, "of the halves of sleepers that move with it", &L::sleeper_mass,
                kNeeded | kByMass);
  });
  return keys;
}

}  // namespace treadmark::io
