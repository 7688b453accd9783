// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/limit_keys.hpp"

namespace treadmark::io {
namespace {

/// A condition that need not be there. words: of the enumerators, in their order.
template <class Enum, std::size_t count>
std::vector<std::pair<std::string, std::optional<Enum>>> optional_words(
    const std::array<std::string_view, count>& words) {
  std::vector<std::pair<std::string, std::optional<Enum>>> pairs;
  for (std::size_t i = 0; i < count; ++i) pairs.emplace_back(words[i], static_cast<Enum>(i));
  return pairs;
}

}  // namespace

const KeyTable<RunningLimits>& limit_file_keys() {
  using L = RunningLimits;
  static const auto keys = key_table<L>([](auto& list) {
    list.text("edition", "of the standard whose limits these are, or where else they are from", &L::edition, kNeeded,
              "say whose limits these are: standard, year, table");
    list.flag("verified", "whether somebody has compared the file with that text", &L::verified);
    list.table("limits", KeyType::table_list, "of the rows whose conditions hold, the least limit counts",
               limit_keys().infos, &L::limits, kNeeded);
  });
  return keys;
}

const KeyTable<RunningLimit>& limit_keys() {
  using L = RunningLimit;
  static const auto keys = key_table<L>([](auto& list) {
    list.text("quantity", "whose limit it is, as `assess` calls it", &L::quantity, kNeeded);
    list.choice("vehicle", optional_words<VehicleKind>(kVehicleKinds), "which it is for; without it all", &L::vehicle);
    list.choice("section", optional_words<SectionKind>(kSectionKinds), "where it holds; without it everywhere",
                &L::section);
    list.number("from_radius_m", kNotNegative, "of the line in the section: this one and wider ones", &L::from_radius);
    list.number("to_radius_m", kPositive, "tighter ones; without it straights, too", &L::to_radius, kNoDefault);
    list.number("above_speed_km_h", kNotNegative, "mean speed of the section", &L::above_speed);
    list.number("value", kAnyNumber, "the limit, in the SI unit of the quantity", &L::constant);
    list.number("by_load", kAnyNumber, "more by the load of the wheelset at rest, 2 Q0: times that in N", &L::by_load);
    list.number("by_curvature", kAnyNumber, "more by the radius: over that in m", &L::by_curvature);
  });
  return keys;
}

}  // namespace treadmark::io
