// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/io/simulations/table_of.hpp"
#include "treadmark/io/simulations/track_keys.hpp"

namespace treadmark::io {
namespace {

TableReader part_of(const TableReader& document, std::string_view key, const TableKeys& known) {
  const CaseTable* table = document.table(key);
  if (table == nullptr) document.fail(fmt::format("[{}] is missing, a flexible track needs it", key));
  return {*table, document.find(key)->where, std::string(key), known};
}

/// None where rails do not bend sideways.
std::optional<RailSideways> read_sideways(const TableReader& rail) {
  using S = RailSideways;
  const TableOf<S> table(rail, sideways_keys());
  if (table.find(&S::bending_stiffness) == nullptr) {
    for (const KeyInfo& key : sideways_keys().infos)
      if (table.find(key.path) != nullptr)
        table.need(&S::bending_stiffness, fmt::format("{} goes with it", table.path_of(key.path)));
    return std::nullopt;
  }
  S s = table.read();
  if (table.find(&S::shear_centre) == nullptr) s.shear_centre = s.centroid;
  for (double S::*height : {&S::centroid, &S::shear_centre})
    if (table.find(height) != nullptr && s.*height > s.height)
      table.refuse(height, fmt::format("{} is larger than {}", table.path_of(height), table.path_of(&S::height)),
                   "heights are above the foot");
  return s;
}

RailSeat read_seat(const TableReader& table, bool sideways) {
  RailSeat seat = TableOf(table, seat_keys()).read();
  if (sideways) {
    TableOf(table, sideways_seat_keys()).read(seat);
    return seat;
  }
  for (const KeyInfo& key : sideways_seat_keys().infos)
    if (const CaseValue* value = table.find(key.path))
      throw Error(ErrorKind::configuration, fmt::format("{} is for rails that bend sideways", table.path_of(key.path)),
                  value->where, fmt::format("give rail.{}, or [lateral] instead", sideways_keys().infos.front().path));
  return seat;
}

void read_seats(const TableReader& all, FlexibleTrack& track) {
  const TableOf<SeatRow> table(all, seat_row_keys());
  table.need(&SeatRow::spacings);
  SeatRow row = table.read();
  if (row.spacings.empty())
    table.refuse(&SeatRow::spacings, fmt::format("{} is empty", table.path_of(&SeatRow::spacings)));
  RailSeat seat = read_seat(all, track.sideways.has_value());
  const auto count = static_cast<std::size_t>(row.count);
  for (std::size_t i = 0; i < count; ++i) {
    track.seats.push_back(seat);
    seat.x += row.spacings[i % row.spacings.size()];
  }
  track.bay_elements = row.bay_elements;
  track.absorption = row.absorption;
  const int most = row.count / 4;
  if (table.find(&SeatRow::absorbing_bays) == nullptr) row.absorbing_bays = std::min(row.absorbing_bays, most);
  track.absorbing_bays = row.absorbing_bays;
  if (track.absorbing_bays > most)
    table.refuse(
        &SeatRow::absorbing_bays,
        fmt::format("seats.absorbing_bays = {} are more than a quarter of {} seats", track.absorbing_bays, count),
        "make seats.count larger");
}

void vary_seats(const TableOf<VariedSeats>& table, FlexibleTrack& track) {
  const VariedSeats varied = table.read();
  const auto count = static_cast<int>(track.seats.size());
  const int first = varied.first, last = varied.last.value_or(first);
  if (last < first || last > count)
    table.fail(fmt::format("varied: there are no seats {} to {} among {}", first, last, count),
               "seats are counted from 1");
  for (int i = first - 1; i < last; ++i)
    for (const KeyTable<RailSeat>* keys : {&seat_keys(), &sideways_seat_keys()}) {
      RailSeat& seat = track.seats[static_cast<std::size_t>(i)];
      scale(*keys, seat, kByPad, varied.pad);
      scale(*keys, seat, kBySleeper, varied.sleeper);
      scale(*keys, seat, kByBed, varied.bed);
    }
}

RailJoint read_joint(const TableOf<RailJoint>& table, const FlexibleTrack& track) {
  const RailJoint joint = table.read();
  const std::vector<RailSeat>& seats = track.seats;
  const auto refuse = [&](const std::string& what, const std::string& advice) {
    table.refuse(&RailJoint::x, fmt::format("{} = {:.6g}: {}", table.path_of(&RailJoint::x), joint.x, what), advice);
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

}  // namespace

FlexibleTrack read_flexible_track(const TableReader& document) {
  FlexibleTrack track;
  const TableReader rail = part_of(document, "rail", rail_keys());
  TableOf(rail, beam_keys()).read(track.rail);
  TableOf(rail, rail_distance_keys()).read(track);
  track.sideways = read_sideways(rail);
  read_seats(part_of(document, "seats", seats_keys()), track);
  for (const CaseValue* one : document.tables("varied")) vary_seats(TableOf(*one, "varied", varied_seat_keys()), track);
  if (ranges::none_of(track.seats, [](const RailSeat& seat) { return seat.bed_stiffness > 0.0; }))
    document.fail("all sleepers hang: nothing holds the track");
  for (const CaseValue* one : document.tables("joints"))
    track.joints.push_back(read_joint(TableOf(*one, "joints", joint_keys()), track));
  if (document.find("lateral") != nullptr)
    track.lateral = TableOf(part_of(document, "lateral", lateral_keys().infos), lateral_keys()).read();
  return track;
}

}  // namespace treadmark::io
