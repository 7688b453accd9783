// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <optional>

#include "treadmark/core/error.hpp"
#include "treadmark/io/tables/hdf5_rows.hpp"
#include "treadmark/io/tables/json_of.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

using testing::TemporaryFolder;

struct Wheel {
  std::string name;
  int number = 0;
  bool round = true;
  double radius = 0.0;           ///< [m]
  std::optional<double> hollow;  ///< [m]
};

constexpr Column<Wheel> kWheels[] = {
    {"name", unit::kOne, "name", access::of<&Wheel::name>(), "of the wheel"},
    {"number", unit::kOne, "number", access::of<&Wheel::number>()},
    {"", unit::kOne, "round", access::of<&Wheel::round>()},
    {"radius_mm", unit::kMm, "radius", access::of<&Wheel::radius>(), "at the tape line"},
    {"diameter_mm", unit::kMm, "", {[](const Wheel& w) { return 2.0 * w.radius; }}},
    {"hollow_mm", unit::kMm, "hollow", access::of<&Wheel::hollow>()}};

}  // namespace

template <>
std::span<const Column<Wheel>> columns() {
  return kWheels;
}

namespace {

TEST(JsonOf, HasWhatIsKnownInTheUnitOfItsKey) {
  EXPECT_EQ(io::dumped(io::json_of(Wheel{"left", 2, true, 0.46, {}}), -1),
            R"({"name":"left","number":2,"radius_mm":460.0,"diameter_mm":920.0})");
  EXPECT_EQ(io::json_of(Wheel{"left", 2, true, 0.46, 0.0012}).at("hollow_mm"), 1.2);
}

void expect_equal(const Wheel& a, const Wheel& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.number, b.number);
  EXPECT_EQ(a.round, b.round);
  EXPECT_EQ(a.radius, b.radius);
  EXPECT_EQ(a.hollow, b.hollow);
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
