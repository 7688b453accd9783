// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/damage/fatigue.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

using ::testing::HasSubstr;

TEST(FatigueMeasures, LieInTheOrderOfTheEnumerators) {
  for (std::size_t i = 0; i < fatigue_measures().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(fatigue_measures()[i].measure), i);
    EXPECT_EQ(words_of(std::vector{fatigue_measures()[i].measure}), fatigue_measures()[i].word);
  }
  EXPECT_EQ(fatigue_measures().back().word, "martensite");
}

TEST(FatigueMeasures, WordsLeadBackToThem) {
  const std::vector<FatigueMeasure> two{FatigueMeasure::dang_van, FatigueMeasure::fi_surf};
  EXPECT_EQ(words_of(two), "dang_van fi_surf");
  EXPECT_EQ(measures_of("dang_van fi_surf"), two);
  EXPECT_TRUE(measures_of("").empty());
  try {
    measures_of("fi_surf rust");
    FAIL() << "a word that is no measure was taken";
  } catch (const Error& e) {
    EXPECT_THAT(e.message(), HasSubstr("'rust'"));
  }
}

/// A measure whose number lay at another's place would overwrite it.
TEST(FatigueMeasures, NumbersOfContactsHavePlacesAndNamesOfTheirOwn) {
  std::set<std::string_view> keys, stored;
  ContactFatigue contact;
  double next = 1.0;
  for (const Column<ContactFatigue>& column : columns<ContactFatigue>()) {
    EXPECT_TRUE(keys.insert(column.key).second) << column.key;
    EXPECT_TRUE(stored.insert(column.stored).second) << column.stored;
    column.access.put(contact, next++);
  }
  next = 1.0;
  for (const Column<ContactFatigue>& column : columns<ContactFatigue>())
    EXPECT_EQ(column.access.get(contact), next++) << column.key;
  EXPECT_EQ(contact.friction, 1.0);
  EXPECT_EQ(contact[FatigueMeasure::martensite], next - 1.0);
}

TEST(FatigueState, TakesTheLargestOfContactsAndDepths) {
  FatigueSettings known;
  known.austenite = 40.0;
  std::vector<ContactFatigue> contacts(2);
  contacts[0][FatigueMeasure::fi_surf] = -0.2, contacts[1][FatigueMeasure::fi_surf] = -0.1;
  SurfaceRecord record(1, 2);
  record.stresses[0].shear.ref(0, 3) = 2e8, record.stresses[1].shear.ref(0, 1) = 3e8;
  record.temperature.ref(0, 0) = 50.0;
  const FatigueState state{known, contacts, record};
  EXPECT_EQ(state.largest(FatigueMeasure::fi_surf), -0.1);
  EXPECT_EQ(state.ever(&StressRecord::shear), 3e8);
  EXPECT_EQ(row_of(FatigueMeasure::martensite).of_body.back().in_file(state), 10.0);
  EXPECT_EQ(row_of(FatigueMeasure::subsurface).of_body[1].key, "shear_ever_MPa");
  EXPECT_NEAR(row_of(FatigueMeasure::subsurface).of_body[1].in_file(state), 300.0, 1e-10);
}

}  // namespace
}  // namespace treadmark
