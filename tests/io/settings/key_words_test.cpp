// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/key_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace treadmark::io {
namespace {

using ::testing::ElementsAre;
using ::testing::Pair;

TEST(KeyWords, SayNameAndUnit) {
  const auto words = [](const char* path) {
    const KeyWords all = words_of_key(path);
    return all.name + '|' + all.unit;
  };
  EXPECT_EQ(words("wheelset.vertical_force_N"), "wheelset: vertical force|N");
  EXPECT_EQ(words("track.cant_deg"), "track: cant|°");
  EXPECT_EQ(words("simulation.speed_km_h"), "simulation: speed|km/h");
  EXPECT_EQ(words("wheelset.s_mm"), "wheelset: s|mm");  // a name that is a unit, too
  EXPECT_EQ(words("wheel.flats.0.depth_mm"), "wheel flats 0: depth|mm");
  EXPECT_EQ(words("lateral_pad_stiffness_N_per_m"), "lateral pad stiffness|N/m");
  EXPECT_EQ(words("damping_N_s_per_m"), "damping|N s/m");
  EXPECT_EQ(words("roll_inertia_kg_m2"), "roll inertia|kg m²");
  EXPECT_EQ(words("curvature_per_m"), "curvature|1/m");
  EXPECT_EQ(words("gravity_m_s2"), "gravity|m/s²");
  EXPECT_EQ(words("layer_flexibility_mm_per_MPa"), "layer flexibility|mm/MPa");
  EXPECT_EQ(words("friction.coefficient"), "friction: coefficient|");
}

TEST(InputList, SaysValuesWithTheirUnits) {
  InputList list;
  KeyInfo force, deg, rad, flats;
  list.add(force, "wheelset.vertical_force_N", {"100000", "100000", "81234.5"});
  list.add(force, "small_force_N", {"12"});
  deg.group = rad.group = "cant", deg.alternative = "deg", rad.alternative = "rad";
  list.add(deg, "track.cant_deg", {"1.4320961841646465"});
  list.add(rad, "track.cant", {"\"1:40\""});
  list.add(force, "discretisation.dx_mm", {"\"auto\""});
  list.add(force, "wheelset.pitch_deg", {"-3", "-2", "-1", "0", "1", "2", "3"});
  flats.type = KeyType::table_list;
  list.add(flats, "wheel.flats", {"[{ length_mm = 60, depth_mm = 1.4 }]", "[{ length_mm = 60, depth_mm = 1.2 }]"});
  EXPECT_THAT(list.words(),
              ElementsAre(Pair("wheelset: vertical force", "100, 81.2345 kN"), Pair("small force", "12 N"),
                          Pair("track: cant", "1:40"), Pair("discretisation: dx", "auto"),
                          Pair("wheelset: pitch", "-3 to 3° (7 values)"), Pair("wheel flats 0: length", "60 mm"),
                          Pair("wheel flats 0: depth", "1.4, 1.2 mm")));
}

}  // namespace
}  // namespace treadmark::io
