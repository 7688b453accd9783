// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/tables/csv_of.hpp"
#include "treadmark/io/tables/hdf5_rows.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/io/tables/read_json.hpp"
#include "treadmark/io/tables/text_of.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

using testing::TemporaryFolder;

struct Wheel {
  std::string name;
  int number = 0;
  bool round = true;
  double radius = 0.0;                ///< [m]
  std::optional<double> hollow = {};  ///< [m]
  double error = 0.0;                 ///< of the radius [m]
  std::string why = {};               ///< there is no radius
};

Access<Wheel> radius_with_error() {
  Access<Wheel> access = access::of<&Wheel::radius>();
  access.uncertainty = [](const Wheel& w) { return w.error; };
  access.reason = [](const Wheel& w) { return w.why; };
  return access;
}

const Column<Wheel> kWheels[] = {
    {"name", unit::kOne, "name", access::of<&Wheel::name>(), "of the wheel", kOnlyInFiles, "wheel"},
    {"number", unit::kOne, "number", access::of<&Wheel::number>()},
    {"", unit::kOne, "round", access::of<&Wheel::round>()},
    {"radius_mm", unit::kMm, "radius", radius_with_error(), "at the tape line", kOnlyInFiles, "radius", 2},
    {"diameter_mm", unit::kMm, "", {[](const Wheel& w) { return 2.0 * w.radius; }}},
    {"hollow_mm", unit::kMm, "hollow", access::of<&Wheel::hollow>(), "", kOnlyInFiles, "hollow wear"}};

/// With a flag, and numbers of an object.
struct Pair {
  bool sound = true;
  double gauge = 1.435, gap = 0.0;
};

constexpr Column<Pair> kPairs[] = {
    {"track.gauge_mm", unit::kMm, "", access::of<&Pair::gauge>()},
    {"sound", unit::kOne, "", access::flag<&Pair::sound>()},
    {"track.gap_mm", unit::kMm, "", access::of<&Pair::gap>()},
    {"why", unit::kOne, "", access::word_or_null(+[](const Pair& p) { return std::string(p.sound ? "" : "jammed"); })}};

}  // namespace

template <>
std::span<const Column<Wheel>> columns() {
  return kWheels;
}
template <>
std::span<const Column<Pair>> columns() {
  return kPairs;
}

namespace {

TEST(JsonOf, HasWhatIsKnownInTheUnitOfItsKey) {
  EXPECT_EQ(io::dumped(io::json_of(Wheel{"left", 2, true, 0.46, {}}), -1),
            R"({"name":"left","number":2,"radius_mm":460.0,"diameter_mm":920.0})");
  EXPECT_EQ(io::json_of(Wheel{"left", 2, true, 0.46, 0.0012}).at("hollow_mm"), 1.2);
}

TEST(JsonOf, ObjectsFlagsAndTextsThatAreEmpty) {
  EXPECT_EQ(io::dumped(io::json_of(Pair{}), -1),
            R"({"track":{"gauge_mm":1435.0,"gap_mm":0.0},"sound":true,"why":null})");
  EXPECT_EQ(io::json_of(Pair{false}).at("why"), "jammed");
}

TEST(JsonOf, ListsLeaveOutWhatNoRowKnows) {
  io::Json lists;
  io::add_lists(lists, std::vector<Wheel>{{"a"}, {"b"}});
  EXPECT_FALSE(lists.contains("hollow_mm"));
  io::add_lists(lists, std::vector<Wheel>{{"a"}, {"b", 1, true, 0.46, 1e-3}});
  EXPECT_EQ(io::dumped(lists.at("hollow_mm"), -1), "[null,1.0]");
}

void expect_equal(const Wheel& a, const Wheel& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.round, b.round);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.hollow, b.hollow);
}

TEST(ReadJson, HasWhatWasWritten) {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    Wheel wheel;
    io::read_json(io::read_json_file(folder.write("wheel.json", text)), wheel);
    return wheel;
  };
  for (const Wheel& wheel : {Wheel{"left", 2, true, 0.5, 1e-3}, Wheel{"right", 1, true, 0.25, {}}})
    expect_equal(read(io::dumped(io::json_of(wheel))), wheel);
  EXPECT_TRUE(std::isnan(read(R"({"name": "left", "number": 2, "radius_mm": null})").radius));
  EXPECT_THROW(read(R"({"name": "left", "number": 2})"), Error);
  EXPECT_THROW(read(R"({"name": "left", "number": 2.5, "radius_mm": 460})"), Error);
}

TEST(CsvOf, HasAHeadAndALineARow) {
  EXPECT_EQ(io::csv_of(std::vector<Wheel>{{"left, front", 2, true, 0.46, {}}}),
            "name,number,radius_mm,diameter_mm,hollow_mm\n\"left, front\",2,460,920,\n");
}

TEST(TextOf, HasWhatPeopleReadWithUnitsErrorsAndReasons) {
  const Wheel wheel{"left", 2, true, 0.46, {}, 1e-5};
  EXPECT_EQ(io::lines_of(wheel, 8), "wheel   left\nradius  460.00 +- 0.01 mm\n");
  EXPECT_EQ(io::phrase_of(wheel), "wheel left, radius 460.00 +- 0.01 mm");
  const Wheel lost{"right", 1, true, kNaN, -1e-9, 0.0, "no tape line"};
  EXPECT_EQ(io::phrase_of(lost), "wheel right, radius no tape line, hollow wear -1e-06 mm");
  EXPECT_EQ(io::table_of(std::vector<Wheel>{wheel, lost}),
            "wheel  radius mm  hollow wear mm\nleft      460.00               -\nright          -          -1e-06\n");
  EXPECT_EQ(io::shown_number(-1e-9, 3), "0.000");
}

TEST(Hdf5Rows, AreReadAsTheyWereWritten) {
  TREADMARK_NEEDS("hdf5");
  const TemporaryFolder folder;
  const std::vector<Wheel> wheels{{"left", 1, true, 0.4601, 1e-3}, {"right", 2, false, 0.1 + 0.2, {}}};
  io::Hdf5Writer file(folder.path() / "a.h5");
  io::write_attributes(file.root(), wheels.back());
  io::write_rows(file.root().make_group("all"), wheels);
  io::write_rows(file.root().make_group("none"), std::vector<Wheel>{});
  file.commit();
  const io::Hdf5Reader read(folder.path() / "a.h5");
  Wheel one;
  io::read_attributes(read.root(), one);
  expect_equal(one, wheels.back());
  EXPECT_FALSE(read.root().has_attribute("hollow"));
  const io::Hdf5GroupReader all = read.root().open_group("all");
  EXPECT_EQ(all.text_of("radius", "unit"), "m");
  EXPECT_EQ(all.text_of("radius", "meaning"), "at the tape line");
  const std::vector<Wheel> again = io::read_rows<Wheel>(all);
  ASSERT_EQ(again.size(), wheels.size());
  for (std::size_t i = 0; i < wheels.size(); ++i) expect_equal(again[i], wheels[i]);
  EXPECT_TRUE(io::read_rows<Wheel>(read.root().open_group("none")).empty());
}

TEST(Hdf5Rows, ColumnsOfUnequalLengthsAreRefused) {
  TREADMARK_NEEDS("hdf5");
  const TemporaryFolder folder;
  io::Hdf5Writer file(folder.path() / "a.h5");
  const std::vector<std::string> names{"left"};
  const std::vector<double> two{1.0, 2.0};
  file.root().write({"name", {1}, "1", ""}, names);
  for (const char* column : {"number", "round", "radius", "hollow"}) file.root().write({column, {2}, "1", ""}, two);
  file.commit();
  EXPECT_THROW(io::read_rows<Wheel>(io::Hdf5Reader(folder.path() / "a.h5").root()), Error);
}

}  // namespace
}  // namespace treadmark
