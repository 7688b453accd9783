// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"

namespace treadmark::io {
namespace {

TableReader part_of(const TableReader& document, std::string_view key, const TableKeys& known) {
  const CaseTable* table = document.table(key);
  if (table == nullptr) document.fail(fmt::format("[{}] is missing, a flexible track needs it", key));
  return {*table, document.find(key)->where, std::string(key), known};
}

int integer_or(const TableReader& table, std::string_view key, int otherwise) {
  return table.find(key) == nullptr ? otherwise : table.integer(key);
}

RailBeam read_beam(const TableReader& table) {
  return {table.number("bending_stiffness_N_m2"), table.number("shear_stiffness_N"), table.number("mass_kg_per_m"),
          table.number_or("rotary_inertia_kg_m", 0.0), table.number_or("damping_us", 0.0)};
}

constexpr std::string_view kSideways = "lateral_bending_stiffness_N_m2";

/// None where rails do not bend sideways.
std::optional<RailSideways> read_sideways(const TableReader& table) {
  if (table.find(kSideways) == nullptr) {
    for (const std::string_view key :
         {"lateral_shear_stiffness_N", "lateral_rotary_inertia_kg_m", "torsional_stiffness_N_m2", "polar_inertia_kg_m",
          "height_mm", "centroid_height_mm", "shear_centre_height_mm"})
      if (table.find(key) != nullptr) table.need(kSideways, fmt::format("{} goes with it", table.path_of(key)));
    return std::nullopt;
  }
  RailSideways s;
  s.bending_stiffness = table.number(kSideways);
  s.shear_stiffness = table.number("lateral_shear_stiffness_N");
  s.rotary_inertia = table.number_or("lateral_rotary_inertia_kg_m", 0.0);
  s.torsional_stiffness = table.number("torsional_stiffness_N_m2");
  s.polar_inertia = table.number("polar_inertia_kg_m");
  s.height = table.number("height_mm");
  s.centroid = table.number("centroid_height_mm");
  s.shear_centre = table.number_or("shear_centre_height_mm", s.centroid);
  for (const std::string_view key : {"centroid_height_mm", "shear_centre_height_mm"})
    if (const CaseValue* value = table.find(key); value != nullptr && table.number(key) > s.height)
      throw Error(ErrorKind::configuration,
                  fmt::format("{} is larger than {}", table.path_of(key), table.path_of("height_mm")), value->where,
                  "heights are above the foot");
  return s;
}

void read_seats_sideways(const TableReader& table, bool sideways, RailSeat& seat) {
  if (!sideways) {
    for (const std::string_view key :
         {"lateral_pad_stiffness_N_per_m", "lateral_pad_damping_N_s_per_m", "roll_stiffness_N_m_per_rad",
          "roll_damping_N_m_s_per_rad", "lateral_bed_stiffness_N_per_m", "lateral_bed_damping_N_s_per_m"})
      if (const CaseValue* value = table.find(key))
        throw Error(ErrorKind::configuration, fmt::format("{} is for rails that bend sideways", table.path_of(key)),
                    value->where, fmt::format("give rail.{}, or [lateral] instead", kSideways));
    return;
  }
  seat.lateral_pad_stiffness = table.number("lateral_pad_stiffness_N_per_m");
  seat.lateral_pad_damping = table.number_or("lateral_pad_damping_N_s_per_m", 0.0);
  seat.roll_stiffness = table.number("roll_stiffness_N_m_per_rad");
  seat.roll_damping = table.number_or("roll_damping_N_m_s_per_rad", 0.0);
  seat.lateral_bed_stiffness = table.number("lateral_bed_stiffness_N_per_m");
  seat.lateral_bed_damping = table.number_or("lateral_bed_damping_N_s_per_m", 0.0);
}

/// Distances from each seat to the next, one for each seat.
std::vector<double> read_spacings(const TableReader& table, std::size_t count) {
  table.exclude("spacing_m", "spacings_m");
  std::vector<double> pattern = table.numbers("spacings_m");
  if (table.find("spacings_m") == nullptr) {
    table.need("spacing_m", "spacings_m for unequal ones");
    pattern = {table.number("spacing_m")};
  }
  if (pattern.empty())
    throw Error(ErrorKind::configuration, "seats.spacings_m is empty", table.find("spacings_m")->where);
  std::vector<double> spacings;
  for (std::size_t i = 0; i < count; ++i) spacings.push_back(pattern[i % pattern.size()]);
  return spacings;
}

void read_seats(const TableReader& table, FlexibleTrack& track) {
  const auto count = static_cast<std::size_t>(integer_or(table, "count", 120));
  const std::vector<double> spacings = read_spacings(table, count);
  RailSeat seat;
  seat.pad_stiffness = table.number("pad_stiffness_N_per_m");
  seat.pad_damping = table.number_or("pad_damping_N_s_per_m", 0.0);
  seat.sleeper_mass = 0.5 * table.number("sleeper_mass_kg");
  seat.bed_stiffness = table.number("bed_stiffness_N_per_m");
  seat.bed_damping = table.number_or("bed_damping_N_s_per_m", 0.0);
  read_seats_sideways(table, track.sideways.has_value(), seat);
  for (const double spacing : spacings) {
    track.seats.push_back(seat);
    seat.x += spacing;
  }
  track.bay_elements = integer_or(table, "bay_elements", track.bay_elements);
  track.absorption = table.number_or("absorption_per_s", 2000.0);
  const int most = static_cast<int>(count / 4);
  track.absorbing_bays = integer_or(table, "absorbing_bays", std::min(30, most));
  if (track.absorbing_bays > most)
    throw Error(
        ErrorKind::configuration,
        fmt::format("seats.absorbing_bays = {} are more than a quarter of {} seats", track.absorbing_bays, count),
        table.find("absorbing_bays")->where, "make seats.count larger");
}

void vary_seats(const TableReader& table, FlexibleTrack& track) {
  const auto count = static_cast<int>(track.seats.size());
  const int first = table.integer("first_seat"), last = integer_or(table, "last_seat", first);
  if (last < first || last > count)
    table.fail(fmt::format("varied: there are no seats {} to {} among {}", first, last, count),
               "seats are counted from 1");
  const double pad = table.number_or("pad_factor", 1.0), sleeper = table.number_or("sleeper_factor", 1.0),
               bed = table.number_or("bed_factor", 1.0);
  for (int i = first - 1; i < last; ++i) {
    RailSeat& seat = track.seats[static_cast<std::size_t>(i)];
    for (double* of_pad : {&seat.pad_stiffness, &seat.pad_damping, &seat.lateral_pad_stiffness,
                           &seat.lateral_pad_damping, &seat.roll_stiffness, &seat.roll_damping})
      *of_pad *= pad;
    seat.sleeper_mass *= sleeper;
    for (double* of_bed :
         {&seat.bed_stiffness, &seat.bed_damping, &seat.lateral_bed_stiffness, &seat.lateral_bed_damping})
      *of_bed *= bed;
  }
}

RailJoint read_joint(const TableReader& table, const FlexibleTrack& track) {
  RailJoint joint;
  joint.x = table.number("place_m");
  joint.hinge_stiffness = table.number("hinge_stiffness_N_m_per_rad");
  joint.dip_depth = table.number_or("dip_mm", joint.dip_depth);
  joint.dip_length = table.number_or("dip_length_mm", joint.dip_length);
  joint.lateral_hinge_stiffness = table.number_if("lateral_hinge_stiffness_N_m_per_rad");
  const std::vector<RailSeat>& seats = track.seats;
  const auto refuse = [&](const std::string& what, const std::string& advice) {
    throw Error(ErrorKind::configuration, fmt::format("joints.place_m = {:.6g}: {}", joint.x, what),
                table.need("place_m").where, advice);
  };
  if (!(joint.x <= seats.back().x))
    refuse(fmt::format("the last seat lies {:.6g} m from the first one", seats.back().x),
           "a joint lies between them; make seats.count larger");
  double longest = 0.0;
  for (std::size_t i = 1; i < seats.size(); ++i) longest = std::max(longest, seats[i].x - seats[i - 1].x);
  for (const RailJoint& other : track.joints)
    if (!(std::abs(joint.x - other.x) >= longest * (1.0 - 1e-9)))
      refuse(fmt::format("another joint lies {:.6g} m from it", std::abs(joint.x - other.x)),
             fmt::format("keep joints at least the longest bay apart, {:.6g} m", longest));
  return joint;
}

LateralSupport read_lateral(const TableReader& table) {
  const double radius = table.number("roll_radius_mm");
  return {table.number("pad_stiffness_N_per_m"), table.number_or("pad_damping_N_s_per_m", 0.0),
          table.number("bed_stiffness_N_per_m"), table.number_or("bed_damping_N_s_per_m", 0.0),
          table.number("foot_width_mm"),         radius * radius,
          table.number("rail_mass_kg"),          table.number("sleeper_mass_kg")};
}

}  // namespace

FlexibleTrack read_flexible_track(const TableReader& document) {
  FlexibleTrack track;
  const TableReader rail = part_of(document, "rail", rail_beam_keys());
  track.rail = read_beam(rail);
  track.gauge = rail.number_or("distance_m", track.gauge);
  track.sideways = read_sideways(rail);
  read_seats(part_of(document, "seats", seat_keys()), track);
  for (const CaseValue* one : document.tables("varied"))
    vary_seats(TableReader(one->table(), one->where, "varied", varied_seat_keys()), track);
  if (std::ranges::none_of(track.seats, [](const RailSeat& seat) { return seat.bed_stiffness > 0.0; }))
    document.fail("all sleepers hang: nothing holds the track");
  for (const CaseValue* one : document.tables("joints"))
    track.joints.push_back(read_joint(TableReader(one->table(), one->where, "joints", joint_keys()), track));
  if (document.find("lateral") != nullptr) track.lateral = read_lateral(part_of(document, "lateral", lateral_keys()));
  return track;
}

}  // namespace treadmark::io
