// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/contact/theories.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

using ::testing::HasSubstr;
using Influence = InfluenceSettings::Kind;

// The number of enumerators. A new one breaks the compilation here (-Wswitch) until it is counted.
constexpr int count(NormalModel m) {
  switch (m) {
    case NormalModel::full:
    case NormalModel::elliptic:
    case NormalModel::parabolic:
    case NormalModel::semi_double_elliptic:
    case NormalModel::kpec:
    case NormalModel::analyn:
      return 6;
  }
  return 0;
}
constexpr int count(TangentialModel m) {
  switch (m) {
    case TangentialModel::full:
    case TangentialModel::fastsim:
    case TangentialModel::fastsim_one_flexibility:
    case TangentialModel::fastrip:
    case TangentialModel::linear:
      return 5;
  }
  return 0;
}
constexpr int count(Regime r) {
  switch (r) {
    case Regime::frictionless:
    case Regime::shift:
    case Regime::transient:
    case Regime::steady:
      return 4;
  }
  return 0;
}
constexpr int count(Influence k) {
  switch (k) {
    case Influence::constant:
    case Influence::bilinear:
    case Influence::angle_corrected:
    case Influence::table:
      return 4;
  }
  return 0;
}

template <class Id, std::size_t rows>
void expect_complete(const Theory<Id> (&table)[rows]) {
  ASSERT_EQ(static_cast<int>(rows), count(Id{}));
  const std::string list = theory_list();
  std::set<std::string_view> words;
  std::set<int> digits;
  for (std::size_t i = 0; i < rows; ++i) {
    EXPECT_EQ(static_cast<std::size_t>(table[i].id), i) << table[i].word;
    EXPECT_EQ(theory(table[i].id).word, table[i].word);
    EXPECT_TRUE(words.insert(table[i].word).second) << table[i].word;
    EXPECT_THAT(list, HasSubstr("\n  " + std::string(table[i].word) + ' '));
    EXPECT_THAT(list, HasSubstr(' ' + std::string(table[i].name)));
    if (table[i].digit.value < 0) continue;
    EXPECT_TRUE(digits.insert(table[i].digit.value).second) << table[i].word;
    EXPECT_EQ(of_contact_digit(table, table[i].digit.value), table[i].id);
  }
}

TEST(Theories, EveryEnumeratorHasItsRowAndIsListed) {
  expect_complete(kNormalTheories);
  expect_complete(kTangentialTheories);
  expect_complete(kRegimes);
  expect_complete(kInfluenceKinds);
}

TEST(Theories, ListSaysWhereATheoryMayBeUsed) {
  const std::string list = theory_list();
  EXPECT_THAT(list, HasSubstr("FaStrip; steady rolling only\n"));
  EXPECT_THAT(list, HasSubstr("FASTSIM with three flexibilities; rolling only\n"));
  EXPECT_THAT(list, HasSubstr("elliptic pressure; [patch] only; Hertzian geometry\n"));
  EXPECT_THAT(list, HasSubstr("KPEC; a [patch] needs a given approach\n"));
  EXPECT_EQ(ranges::count(list, '\n'), 4 + 6 + 5 + 4 + 4);
}

TEST(Theories, OtherDigitsAskForTheFirstRow) {
  EXPECT_EQ(of_contact_digit(kNormalTheories, 1), NormalModel::full);          // a thin sheet
  EXPECT_EQ(of_contact_digit(kTangentialTheories, 4), TangentialModel::full);  // an interface layer
}

}  // namespace
}  // namespace treadmark
