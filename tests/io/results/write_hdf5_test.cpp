// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/write_hdf5.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/io/results/sample_block.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

std::string text_attribute(hid_t file, const char* object, const char* name) {
  const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t type = H5Aget_type(attribute);
  char* text = nullptr;
  H5Aread(attribute, type, &text);
  std::string value = text == nullptr ? "?" : text;
  H5free_memory(text);
  H5Tclose(type);
  H5Aclose(attribute);
  return value;
}

std::vector<double> number_attribute(hid_t file, const char* object, const char* name) {
  const hid_t attribute = H5Aopen_by_name(file, object, name, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t space = H5Aget_space(attribute);
  std::vector<double> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data());
  H5Sclose(space);
  H5Aclose(attribute);
  return values;
}

struct Dataset {
  std::vector<hsize_t> shape;
  std::vector<double> values;
};

Dataset read_dataset(hid_t file, const char* name) {
  Dataset out;
  const hid_t dataset = H5Dopen2(file, name, H5P_DEFAULT);
  const hid_t space = H5Dget_space(dataset);
  out.shape.resize(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
  H5Sget_simple_extent_dims(space, out.shape.data(), nullptr);
  out.values.resize(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.values.data());
  H5Sclose(space);
  H5Dclose(dataset);
  return out;
}

class WriteHdf5 : public ::testing::Test {
 protected:
  WriteHdf5() {
    io::write_hdf5(path_, run_);
    file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  }
  ~WriteHdf5() override { H5Fclose(file_); }

  testing::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "result.h5";
  io::RunResult run_ = testing::sample_run();
  hid_t file_ = -1;
};

TEST_F(WriteHdf5, KeepsEveryFieldExactlyWithItsUnit) {
  const io::PatchFields& fields = run_.cases[0].patches[1].fields;
  const std::pair<const char*, const std::vector<double>*> columns[] = {{"gap", &fields.gap},
                                                                        {"pressure", &fields.pressure},
                                                                        {"traction_x", &fields.traction_x},
                                                                        {"traction_s", &fields.traction_s},
                                                                        {"displacement_n", &fields.displacement_n},
                                                                        {"displacement_x", &fields.displacement_x},
                                                                        {"displacement_s", &fields.displacement_s},
                                                                        {"slip_x", &fields.slip_x},
                                                                        {"slip_s", &fields.slip_s},
                                                                        {"friction", &fields.friction}};
  for (const auto& [name, values] : columns) {
    const std::string place = std::string("/case_0001/patch_2/") + name;
    const Dataset read = read_dataset(file_, place.c_str());
    EXPECT_EQ(read.shape, (std::vector<hsize_t>{20, 24})) << name;  // rows along s
    ASSERT_EQ(read.values.size(), values->size());
    for (std::size_t i = 0; i < values->size(); ++i)
      EXPECT_TRUE(read.values[i] == (*values)[i] || (std::isnan(read.values[i]) && std::isnan((*values)[i])))
          << name << i;
  }
  EXPECT_EQ(text_attribute(file_, "/case_0001/patch_2/pressure", "unit"), "Pa");
  EXPECT_EQ(text_attribute(file_, "/case_0001/patch_2/slip_x", "unit"), "1");
  EXPECT_EQ(text_attribute(file_, "/case_0002/patch_1/slip_x", "unit"), "m");
  const Dataset state = read_dataset(file_, "/case_0001/patch_2/state");
  for (std::size_t i = 0; i < fields.state.size(); ++i) EXPECT_EQ(state.values[i], fields.state[i]);
}

TEST_F(WriteHdf5, PlacesTheGridInTrackAxes) {
  const io::PatchFields& fields = run_.cases[0].patches[1].fields;
  const char* patch = "/case_0001/patch_2";
  EXPECT_EQ(number_attribute(file_, patch, "x0")[0], fields.grid.x0);
  EXPECT_EQ(number_attribute(file_, patch, "ds")[0], fields.grid.dy);
  EXPECT_EQ(number_attribute(file_, patch, "nx")[0], 24);
  const auto origin = number_attribute(file_, patch, "X_TC_origin");
  const auto rotation = number_attribute(file_, patch, "X_TC_rotation");
  ASSERT_EQ(rotation.size(), 9u);
  for (std::size_t row = 0; row < 3; ++row) {
    EXPECT_EQ(origin[row], fields.X_TC.origin[static_cast<Eigen::Index>(row)]);
    for (std::size_t column = 0; column < 3; ++column)
      EXPECT_EQ(rotation[3 * row + column],
                fields.X_TC.rotation(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
  }
  const Dataset s = read_dataset(file_, "/case_0001/patch_2/s");
  ASSERT_EQ(s.shape, std::vector<hsize_t>{20});
  EXPECT_EQ(s.values[3], fields.grid.y(3));
}

TEST_F(WriteHdf5, SaysWhereItCameFrom) {
  EXPECT_EQ(text_attribute(file_, "/", "version"), "0.1.0");
  EXPECT_EQ(text_attribute(file_, "/", "input"), "flat \"one\".toml");
  EXPECT_EQ(text_attribute(file_, "/", "sha256"), "e3b0c442");
  EXPECT_EQ(number_attribute(file_, "/", "complete")[0], 1.0);
  EXPECT_EQ(text_attribute(file_, "/case_0002", "status"), "not_converged");
  EXPECT_EQ(number_attribute(file_, "/case_0001", "force_on_rail_track")[2], 125000.0);
  EXPECT_GT(H5Lexists(file_, "/case_0003", H5P_DEFAULT), 0);
  EXPECT_EQ(H5Lexists(file_, "/case_0003/patch_1", H5P_DEFAULT), 0);
}

TEST_F(WriteHdf5, BrokenFieldsLeaveTheOldFileAlone) {
  const std::string before = testing::read_text(path_);
  run_.cases[0].patches[1].fields.slip_x.pop_back();
  try {
    io::write_hdf5(path_, run_);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.message(), "case 1, patch 2: field slip_x has 479 values on a grid of 480 elements");
  }
  EXPECT_EQ(testing::read_text(path_), before);
  EXPECT_EQ(folder_.count_files(), 1u);
}

TEST(WriteHdf5File, KeepsLayersTemperaturesAndBlocksBelowTheSurface) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "more.h5";
  io::RunResult run = testing::sample_run();
  io::PatchResult& patch = run.cases[0].patches[0];
  patch.subsurface = {testing::sample_block(3, 2, 4), testing::sample_block(1, 1, 1)};
  const std::size_t n = patch.fields.grid.size();
  for (auto* field : {&patch.fields.plastic_x, &patch.fields.plastic_s, &patch.fields.yield_stress,
                      &patch.fields.temperature_1, &patch.fields.temperature_2})
    for (std::size_t i = 0; i < n; ++i) field->push_back(static_cast<double>(i) / 7.0);
  io::write_hdf5(path, run);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  for (const char* name : {"plastic_x", "plastic_s", "yield_stress", "temperature_1", "temperature_2"})
    EXPECT_EQ(read_dataset(file, (std::string("/case_0001/patch_1/") + name).c_str()).values, patch.fields.plastic_x);
  EXPECT_EQ(text_attribute(file, "/case_0001/patch_1/temperature_2", "unit"), "degC");
  EXPECT_EQ(H5Lexists(file, "/case_0001/patch_2/temperature_1", H5P_DEFAULT), 0);
  EXPECT_EQ(H5Lexists(file, "/case_0001/patch_2/subsurface", H5P_DEFAULT), 0);

  const std::string block = "/case_0001/patch_1/subsurface/block1/";
  const Dataset stress = read_dataset(file, (block + "stress").c_str());
  EXPECT_EQ(stress.shape, (std::vector<hsize_t>{4, 2, 3, 9}));
  const Dataset tresca = read_dataset(file, (block + "tresca").c_str()),
                n_place = read_dataset(file, (block + "n").c_str());
  EXPECT_EQ(tresca.shape, (std::vector<hsize_t>{4, 2, 3}));
  const Dataset principal = read_dataset(file, (block + "principal").c_str());
  for (std::size_t i = 0; i < 24; ++i) {
    const io::SubsurfaceValue& v = patch.subsurface[0].values[i];
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_EQ(stress.values[9 * i + k], v.stress(static_cast<Eigen::Index>(k / 3), static_cast<Eigen::Index>(k % 3)));
    EXPECT_EQ(tresca.values[i], v.tresca);
    EXPECT_EQ(n_place.values[i], v.point.z());
    EXPECT_EQ(principal.values[3 * i + 1], v.principal[1]);
  }
  EXPECT_EQ(text_attribute(file, (block + "von_mises").c_str(), "unit"), "Pa");
  EXPECT_GT(H5Lexists(file, "/case_0001/patch_1/subsurface/block2", H5P_DEFAULT), 0);
  H5Fclose(file);

  patch.subsurface[1].nx = 2;
  EXPECT_THROW(io::write_hdf5(path, run), Error);
}

TEST(WriteHdf5File, AnEmptyRunIsAValidFile) {
  const testing::TemporaryFolder folder;
  io::write_hdf5(folder.path() / "empty.h5", {});
  EXPECT_GT(H5Fis_hdf5((folder.path() / "empty.h5").c_str()), 0);
}

}  // namespace
}  // namespace treadmark
