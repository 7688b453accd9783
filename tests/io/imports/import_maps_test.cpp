// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/imports/import_maps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "treadmark/core/error.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/tests/io/imports/sample_report.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

using ::testing::HasSubstr;

/// Of a report of this body.
io::ImportReport maps_in(const std::filesystem::path& path, Body body) {
  io::ImportReport report;
  report.body = body;
  io::read_import_maps(path, report);
  return report;
}

class ImportMapsFile : public ::testing::Test {
 protected:
  std::string bytes(const std::filesystem::path& file) const {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  /// Writes a file with one map of two rows and three columns.
  void write_small(const std::string& format, std::vector<double> a_edges, std::size_t values) const {
    io::Hdf5Writer file(path_);
    file.root().add(io::Attribute{"format", format});
    file.root().add(io::Attribute{"body", std::string("rail")});
    const double zero = 0.0;
    file.root().write({"nominal_radius", {}, "m", ""}, {&zero, 1});
    const io::Hdf5GroupWriter group = file.root().make_group("noise");
    const std::vector<double> s{0.0, 0.1, 0.2, 0.3}, value(values, 1.0);
    group.write({"a_edges", {a_edges.size()}, "m", ""}, a_edges);
    group.write({"s_edges", {4}, "m", ""}, s);
    group.write({"value", {values}, "m", ""}, value);
    file.commit();
  }
  void refused(const std::string& words) const {
    try {
      maps_in(path_, Body::rail);
      ADD_FAILURE() << "read, should be refused: " << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_data);
      EXPECT_THAT(std::string(error.what()), HasSubstr(words));
      EXPECT_EQ(error.where().file, path_.string());
    }
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "maps.h5";
};

void expect_equal(const io::BandMap& found, const io::BandMap& wanted) {
  EXPECT_EQ(found.rows, wanted.rows);
  EXPECT_EQ(found.columns, wanted.columns);
  EXPECT_EQ(found.a_min, wanted.a_min);
  EXPECT_EQ(found.a_max, wanted.a_max);
  EXPECT_EQ(found.s_min, wanted.s_min);
  EXPECT_EQ(found.s_max, wanted.s_max);
  ASSERT_EQ(found.value.size(), wanted.value.size());
  for (std::size_t i = 0; i < found.value.size(); ++i)
    if (!(found.value[i] == wanted.value[i] || (std::isnan(found.value[i]) && std::isnan(wanted.value[i])))) {
      ADD_FAILURE() << "cell " << i << ": " << found.value[i] << " where " << wanted.value[i] << " was written";
      return;
    }
}

TEST_F(ImportMapsFile, AllMapsComeBackAsTheyWere) {
  const io::ImportReport report = testing::sample_report();
  io::write_import_maps(path_, report);
  const io::ImportReport maps = maps_in(path_, Body::wheel);
  EXPECT_EQ(maps.nominal_radius, 0.46);
  expect_equal(maps.density, report.density);
  expect_equal(maps.removed_map, report.removed_map);
  expect_equal(maps.fitted, report.fitted);
  expect_equal(maps.residual, report.residual);
  expect_equal(maps.noise_map, report.noise_map);
}

TEST_F(ImportMapsFile, HasTheLayoutOfTheManual) {
  const io::ImportReport report = testing::sample_report();
  io::write_import_maps(path_, report);
  const io::Hdf5Reader file(path_);
  EXPECT_EQ(file.root().text("format"), "treadmark import maps 1");
  EXPECT_EQ(file.root().text("body"), "wheel");
  for (const auto& [name, unit] :
       {std::pair{"density", "1/m^2"}, {"removed", "1/m^2"}, {"fitted", "m"}, {"residual", "m"}, {"noise", "m"}}) {
    SCOPED_TRACE(name);
    const io::Hdf5GroupReader group = file.root().open_group(name);
    EXPECT_EQ(group.text_of("value", "unit"), unit);
    EXPECT_EQ(group.text_of("a_edges", "unit"), "m");
  }
  const io::Hdf5GroupReader noise = file.root().open_group("noise");
  const std::vector<double> a = noise.numbers("a_edges"), s = noise.numbers("s_edges");
  ASSERT_EQ(a.size(), 291u);
  ASSERT_EQ(s.size(), 29u);
  EXPECT_EQ(a.back(), report.noise_map.a_max);
  EXPECT_NEAR(a[1] - a[0], report.noise_map.a_max / 290.0, 1e-12);
  EXPECT_EQ(noise.numbers("value")[28], static_cast<double>(report.noise_map.value[28]));
}

TEST_F(ImportMapsFile, TheSameReportGivesTheSameBytes) {
  io::write_import_maps(path_, testing::sample_report());
  io::write_import_maps(folder_.path() / "again.h5", testing::sample_report());
  EXPECT_EQ(bytes(path_), bytes(folder_.path() / "again.h5"));
}

TEST_F(ImportMapsFile, MapsThatAReportLacksAreEmpty) {
  io::write_import_maps(path_, testing::sample_map_report());
  const io::ImportReport maps = maps_in(path_, Body::rail);
  EXPECT_FALSE(maps.fitted.value.empty());
  for (const io::BandMap* map : {&maps.density, &maps.removed_map, &maps.residual, &maps.noise_map})
    EXPECT_TRUE(map->value.empty());
}

TEST_F(ImportMapsFile, RefusesMapsThatDoNotFitTheirSizes) {
  io::ImportReport report = testing::sample_map_report();
  report.fitted.value.pop_back();
  EXPECT_THROW(io::write_import_maps(path_, report), Error);
  EXPECT_FALSE(std::filesystem::exists(path_));
}

TEST_F(ImportMapsFile, RefusesOtherFiles) {
  refused("does not exist");
  folder_.write("maps.h5", "no maps at all");
  refused("cannot read");
  const char* format = "treadmark import maps 1";
  write_small(format, {0.0, 0.5, 1.0}, 6);
  EXPECT_EQ(maps_in(path_, Body::rail).noise_map.rows, 2u);
  EXPECT_THROW(maps_in(path_, Body::wheel), Error);
  write_small("treadmark result 1", {0.0, 0.5, 1.0}, 6);
  refused("\"treadmark result 1\"");
  write_small(format, {0.0, 0.6, 1.0}, 6);
  refused("unequal size");
  write_small(format, {1.0, 0.5, 0.0}, 6);
  refused("unequal size");
  write_small(format, {0.0}, 6);
  refused("no cells");
  write_small(format, {0.0, 0.5, 1.0}, 7);
  refused("7 values for 2 times 3");
  io::write_import_maps(path_, testing::sample_map_report());
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 2);
  refused("cannot read");
}

}  // namespace
}  // namespace treadmark
