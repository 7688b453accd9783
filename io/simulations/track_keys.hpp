// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "treadmark/io/settings/key_rows.hpp"
#include "treadmark/model/vehicle/flexible_track.hpp"

namespace treadmark::io {

inline constexpr double kMostSeats = 5000;

/// Factors of vehicles and tracks, and of [[varied]] seats, as marks of keys.
inline constexpr unsigned kByMass = kFirstFactor, kByStiffness = 2 * kByMass, kByDamping = 2 * kByStiffness,
                          kByPad = 2 * kByDamping, kBySleeper = 2 * kByPad, kByBed = 2 * kBySleeper;

/// [vehicle] or [track].
struct ModelHead {
  std::string name, source;
  double mass = 1.0, stiffness = 1.0, damping = 1.0;  ///< factors
  bool flexible = false;                              ///< only of a track, as rails
  std::vector<std::string> rails;
};

/// All numbers of a Root times the factors of its model.
template <class Root>
void scale(const KeyTable<Root>& keys, Root& root, const ModelHead& head) {
  scale(keys, root, kByMass, head.mass);
  scale(keys, root, kByStiffness, head.stiffness);
  scale(keys, root, kByDamping, head.damping);
}

/// [seats] but for the seats.
struct SeatRow {
  int count = 120;
  std::vector<double> spacings;  ///< from each seat to the next, over and over again [m]
  int bay_elements = FlexibleTrack{}.bay_elements;
  int absorbing_bays = 30;
  double absorption = 2000.0;  ///< [1/s]
};

/// [[varied]].
struct VariedSeats {
  int first = 0;            ///< from 1
  std::optional<int> last;  ///< none: the first one
  double pad = 1.0, sleeper = 1.0, bed = 1.0;
};

/// The tables of track files, with the keys of each.
const TableKeys& track_tables();
const KeyTable<ModelHead>& track_keys();
/// [rail]: all keys, the rail as a beam, what it has sideways, and the distance of both rails.
const TableKeys& rail_keys();
const KeyTable<RailBeam>& beam_keys();
const KeyTable<RailSideways>& sideways_keys();
const KeyTable<FlexibleTrack>& rail_distance_keys();
/// [seats]: all keys, those of the row, of a seat, and of a seat below rails that bend sideways.
const TableKeys& seats_keys();
const KeyTable<SeatRow>& seat_row_keys();
const KeyTable<RailSeat>& seat_keys();
const KeyTable<RailSeat>& sideways_seat_keys();
const KeyTable<VariedSeats>& varied_seat_keys();
const KeyTable<RailJoint>& joint_keys();
const KeyTable<LateralSupport>& lateral_keys();

/// Of the head of vehicles and tracks: name and source, and the factors.
void add_model_name(KeyRows<ModelHead>& list);
void add_model_factors(KeyRows<ModelHead>& list);

/// A table or a list of tables of a file.
KeyInfo table_key(std::string name, KeyType type, std::string doc, TableKeys keys = {});
KeyInfo needed(KeyInfo info);

}  // namespace treadmark::io
