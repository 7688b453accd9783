// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Tables of cases (cases_file): the same cases as [[cases]] with lists makes, read piece by piece.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "treadmark/io/cases/case_rows.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/sha256.hpp"
#include "treadmark/tests/io/cases/same_cases.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using treadmark::testing::error_of;
using treadmark::testing::TemporaryFolder;

const std::string kPair =
    "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\n"
    "wheelset = { vertical_force_N = 1e5, velocity_m_s = 20, rolling = \"nominal\" }\n";

class CaseTableFile : public ::testing::Test {
 protected:
  ListedCases listed(const std::string& table, const std::vector<std::string>& overrides = {}) {
    folder_.write("places.csv", table);
    return read_listed_cases(folder_.write("list.toml", "cases_file = \"places.csv\"\n" + kPair), overrides);
  }
  std::string refusal(const std::string& table, const std::vector<std::string>& overrides = {}) {
    return error_of([&] { listed(table, overrides); });
  }
  CaseFile written_out(const std::string& cases) { return read_any_case(folder_.write("cases.toml", kPair + cases)); }

  TemporaryFolder folder_;
};

TEST_F(CaseTableFile, MakesTheCasesOfLists) {
  const std::string table =
      "\xEF\xBB\xBF"
      "wheelset.y_mm, wheelset.yaw_deg ,friction.coefficient,friction.law\r\n"
      "# places of a curve\r\n"
      "0,0.1,0.3,coulomb\r\n"
      "\r\n"
      "+2.5,-0.2,0.25,coulomb\r\n"
      "-3e0,0,.4,\"coulomb\"";
  const CaseFile expected = written_out(
      "[[cases]]\nwheelset.y_mm = [0, 2.5, -3]\nwheelset.yaw_deg = [0.1, -0.2, 0]\nfriction.coefficient = [0.3, 0.25, "
      "0.4]\n");
  const ListedCases given = listed(table);
  ASSERT_NE(given.rows, nullptr);
  EXPECT_EQ(given.rows->size(), 3u);
  EXPECT_EQ(given.rows->sha256(), sha256_hex(table));
  EXPECT_EQ(given.file.cases.size(), 1u);
  EXPECT_EQ(given.rows->numbers().size(), 3u);
  const CaseFile all = read_any_case(folder_.path() / "list.toml");
  ASSERT_EQ(all.cases.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(all.cases[i].number, static_cast<int>(i) + 1);
  testing::expect_same_cases(all, expected);
  EXPECT_EQ(all.cases[1].where.line, 5);
  const std::vector<CaseRow> rows = given.rows->block(0);
  EXPECT_EQ(rows[1].numbers.size(), 3u);
  EXPECT_THAT(rows[1].numbers, ::testing::UnorderedElementsAre(2.5, -0.2, 0.25));
}

TEST_F(CaseTableFile, MayHaveLineEndsOfAnySystem) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    std::string table = "wheelset.y_mm";
    for (int i = 0; i < 100; ++i) table += end + std::to_string(i);
    const ListedCases given = listed(table);
    ASSERT_EQ(given.rows->size(), 100u);
    const std::vector<CaseRow> rows = given.rows->block(1);
    ASSERT_EQ(rows.size(), 36u);
    EXPECT_EQ(rows.back().numbers, std::vector<double>{99.0});
    EXPECT_EQ(rows.back().content.where.line, 101);
  }
}

TEST_F(CaseTableFile, IsReadInBlocks) {
  std::string table = "wheelset.y_mm\n";
  for (int i = 0; i < 150; ++i) table += std::to_string(0.01 * i) + "\n";
  const ListedCases given = listed(table);
  EXPECT_EQ(given.rows->blocks(), 3u);
  std::size_t number = 0;
  for (std::size_t k = 0; k < 3; ++k)
    for (const CaseRow& row : given.rows->block(k)) {
      EXPECT_EQ(row.content.number, static_cast<int>(++number));
      EXPECT_NEAR(std::get<WheelRailCase>(row.content.content).state.position.y, 1e-5 * static_cast<double>(number - 1),
                  1e-12);
    }
  EXPECT_EQ(number, 150u);
  // another number in its place, and no less a row of the table
  std::string other = table;
  other[table.find("\n0.7") + 3] = '8';
  folder_.write("places.csv", other);
  EXPECT_THAT(error_of([&] { given.rows->block(1); }), HasSubstr("changed while it was read"));
  EXPECT_EQ(given.rows->block(0).size(), 64u);
  folder_.write("places.csv", "wheelset.y_mm\n1\n");
  EXPECT_THAT(error_of([&] { given.rows->block(2); }), HasSubstr("changed while it was read"));
}

TEST_F(CaseTableFile, OverridesHoldForEveryRow) {
  const ListedCases given = listed("wheelset.y_mm\n0\n1\n", {"wheelset.y_mm=3", "friction.coefficient=0.2"});
  for (const CaseRow& row : given.rows->block(0)) {
    const auto& c = std::get<WheelRailCase>(row.content.content);
    EXPECT_DOUBLE_EQ(c.state.position.y, 3e-3);
    EXPECT_DOUBLE_EQ(c.friction.static_friction(), 0.2);
  }
  // what rows say of it is not told as theirs
  EXPECT_TRUE(given.rows->numbers().empty());
  EXPECT_THAT(given.file.notes, ElementsAre(HasSubstr("the column wheelset.y_mm of")));
  const ListedCases angles = listed("wheelset.s_mm,wheelset.yaw_deg\n7,1\n", {"wheelset.yaw_rad=0.002"});
  ASSERT_EQ(angles.rows->numbers().size(), 1u);
  const CaseRow first = angles.rows->block(0).front();
  EXPECT_EQ(first.numbers, std::vector<double>{7.0});
  EXPECT_DOUBLE_EQ(std::get<WheelRailCase>(first.content.content).state.position.yaw, 2e-3);
  EXPECT_TRUE(listed("wheelset.y_mm\n0\n", {"friction.coefficient=0.2"}).file.notes.empty());
  EXPECT_THAT(refusal("wheelset.y_mm\n0\n", {"wheelset.y_mm=[0, 1]"}), HasSubstr("makes cases, and so does"));
}

TEST_F(CaseTableFile, RefusesWithThePlace) {
  EXPECT_THAT(refusal("wheelset.y_mm\n0\nfar\n"), HasSubstr("places.csv:3: "));
  EXPECT_THAT(refusal("wheelset.y_mm\n0\nnan\n"), HasSubstr("places.csv:3: "));
  EXPECT_THAT(refusal("wheelset.y_mm,friction.coefficient\n0,0.3\n1\n"),
              HasSubstr("places.csv:3: cells of the row: 1, columns of the table: 2"));
  EXPECT_THAT(refusal("wheelset.y_mm,friction.coefficient\n0,\n"), HasSubstr("friction.coefficient is empty"));
  EXPECT_THAT(refusal("wheelset.y_mm,friction.coefficient\n0,-1\n"), HasSubstr("places.csv:2: "));
  EXPECT_THAT(refusal("wheelset.y\n0\n"), HasSubstr("places.csv:1: "));
  EXPECT_THAT(refusal("wheelset.y_mm;friction.coefficient\n0;0.3\n"), HasSubstr("semicolons"));
  EXPECT_THAT(refusal("wheelset.y_mm,wheelset.y_mm\n0,0\n"), HasSubstr("two columns"));
  EXPECT_THAT(refusal("wheelset.yaw_deg,wheelset.yaw_rad\n0,0\n"), HasSubstr("places.csv:1: "));
  EXPECT_THAT(refusal("wheelset.y_mm\n"), HasSubstr("no rows"));
  EXPECT_THAT(refusal(std::string("wheelset.y_mm\n0\0\n", 17)), HasSubstr("zero bytes"));
  for (const char* head :
       {"wheel.shape.standard", "wheelset.nominal_radius_mm", "case.steps", "case.history", "rail.flats"})
    EXPECT_THAT(refusal(std::string(head) + "\n1\n"), HasSubstr("places.csv:1: ")) << head;
  EXPECT_THAT(refusal("wheelset.y_mm,\n0,1\n"), HasSubstr("places.csv:1: column 2 has no name"));
  for (const char* cell : {"\"0,5\"", "3 mm", "+-3", "++3", "1e", "0x1", "1e999"})
    EXPECT_THAT(refusal(std::string("wheelset.y_mm\n0\n") + cell + "\n"),
                AllOf(HasSubstr("places.csv:3: wheelset.y_mm = '"), HasSubstr("is no number")))
        << cell;
  EXPECT_THAT(refusal("discretisation.max_elements\n1.5\n"), HasSubstr("is no whole number"));
  EXPECT_THAT(refusal("wheelset.y_mm\n\"0\n1\"\n"), HasSubstr("places.csv:2: a quote is not closed"));
  EXPECT_THAT(refusal("wheelset.y_mm\n" + std::string(1000, 'x') + "\n"), HasSubstr("xxx...' is no number"));
  EXPECT_THAT(refusal("wheelset.y_mm\n0\n", {"case.steps=4"}), HasSubstr("do not follow each other"));
  EXPECT_THAT(refusal("patch.hertz.semi_axis_x_mm,patch.gap.kind\n1,quadratic\n"),
              HasSubstr("places.csv:1: [patch.hertz] and [patch.gap] exclude each other"));
  EXPECT_THAT(refusal(""), HasSubstr("no rows"));
  EXPECT_THAT(refusal("\xFF\xFEw\0"), HasSubstr("UTF-16"));
  constexpr std::size_t kEndless = 70'000'000;
  EXPECT_THAT(refusal("wheelset.y_mm\n0\n" + std::string(kEndless, '1')),
              HasSubstr("places.csv:3: a line of more than 64 million characters"));
  // of several the first
  std::string table = "wheelset.y_mm\n";
  for (int i = 0; i < 500; ++i) table += i == 170 || i == 333 ? "x\n" : "0\n";
  EXPECT_THAT(refusal(table), HasSubstr("places.csv:172: "));
}

TEST_F(CaseTableFile, StandsAlone) {
  folder_.write("places.csv", "wheelset.y_mm\n0\n");
  const auto refused = [&](const std::string& text) {
    return error_of([&] { read_any_case(folder_.write("list.toml", text)); });
  };
  EXPECT_THAT(refused("cases_file = \"places.csv\"\n" + kPair + "[[cases]]\nwheelset.y_mm = 1\n"),
              HasSubstr("exclude each other"));
  EXPECT_THAT(refused("cases_file = 3\n" + kPair), HasSubstr("cases_file must be text"));
  EXPECT_THAT(refused("cases_file = \"place.csv\"\n" + kPair), HasSubstr("place.csv"));
  EXPECT_THAT(refused("cases_file = \"places.csv\"\ncase.history = \"continue\"\n" + kPair),
              HasSubstr("do not follow each other"));
}

}  // namespace
}  // namespace treadmark::io
