// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/read_hdf5.hpp"

#include <gtest/gtest.h>
#include <hdf5.h>

#include <fstream>
#include <limits>
#include <optional>
#include <random>

#include "treadmark/core/error.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/tests/io/results/same_run.hpp"
#include "treadmark/tests/io/results/sample_block.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

Mat3 any_matrix() {
  Mat3 m;
  m << 1.1, 1.2, 1.3, 2.1, 2.2, 2.3, 3.1, 3.2, 3.3;
  return m;
}

io::Loads any_loads(double first) {
  io::Loads loads;
  for (io::Load* load : {&loads.track, &loads.rail, &loads.wheelset, &loads.wheel}) {
    load->force = {first, first + 1.0, first + 2.0};
    load->moment = {-first, -first - 1.0, -first - 2.0};
    first *= 1.7;
  }
  return loads;
}

/// Every member that files hold, with values of its own.
io::RunResult full_run() {
  io::RunResult run = testing::sample_run();
  run.complete = false;
  run.sampled = testing::sample_surfaces();
  io::CaseResult& c = run.cases[0];
  c.vy = 0.1, c.vz = 0.2, c.vroll = 0.3, c.vyaw = 0.4;
  c.loads = any_loads(3.0);
  c.rail_deflection = Vec2(1e-4, 2e-4);
  c.roller = {-0.8, -12.5};
  c.bodies = io::CaseResult::Bodies{{Vec3(0.1, 0.2, 0.3), any_matrix()}, {Vec3(0.4, 0.5, 0.6), -any_matrix()}};
  c.wheel_surface = "wheel_1";
  c.rail_surface = "rail_1";
  io::PatchResult& p = c.patches[0];
  p.x_wheelset = 0.11, p.y_wheelset = 0.12, p.z_wheelset = 0.13;
  p.angle_rail = 0.21, p.angle_wheelset = 0.22, p.angle_wheel = 0.23;
  p.reference_x = 1e-4, p.reference_s = 2e-4;
  p.chi = 0.5;
  p.id = std::numeric_limits<std::uint64_t>::max();
  p.came_from = {7, 9};
  p.loads = any_loads(11.0);
  p.local = io::PatchResult::LocalForces{1.0, 2.0, 3.0};
  p.max_temperature_1 = 101.0;
  p.max_temperature_2 = 102.0;
  for (auto* field : {&p.fields.plastic_x, &p.fields.plastic_s, &p.fields.yield_stress, &p.fields.temperature_1,
                      &p.fields.temperature_2, &p.fields.extra_slip_x, &p.fields.extra_slip_s})
    for (std::size_t i = 0; i < p.fields.grid.size(); ++i)
      field->push_back(static_cast<double>(i) / 7.0 + p.fields.plastic_x.size());
  for (int iy = 0; iy < p.fields.grid.ny; ++iy) p.fields.row_angle.push_back(0.01 * iy);
  p.subsurface = {testing::sample_block(3, 2, 4), testing::sample_block(1, 1, 1)};
  run.cases[3].number = 12345;  // behind case 9999, which has another number of digits
  for (io::CaseResult& one : run.cases)
    for (io::PatchResult& patch : one.patches) patch.npot = static_cast<int>(patch.fields.grid.size());
  return run;
}

class ReadHdf5 : public ::testing::Test {
 protected:
  ReadHdf5() { io::write_hdf5(path_, run_); }

  /// Changes the file by way of the HDF5 library, then expects an error that holds these words.
  template <class Change>
  void expect_refused(Change change, const std::string& words) {
    io::write_hdf5(path_, run_);
    const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    ASSERT_GE(H5Fclose(file), 0);
    expect_unreadable(words);
  }

  void expect_unreadable(const std::string& words) {
    try {
      io::read_hdf5(path_);
      FAIL() << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_data) << error.what();
      EXPECT_NE(error.message().find(words), std::string::npos) << error.message();
      EXPECT_EQ(error.where().file, path_.string());
    }
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "fields.h5";
  io::RunResult run_ = full_run();
};

void remove(hid_t file, const char* name) { ASSERT_GE(H5Ldelete(file, name, H5P_DEFAULT), 0) << name; }

void remove_attribute(hid_t file, const char* object, const char* name) {
  ASSERT_GE(H5Adelete_by_name(file, object, name, H5P_DEFAULT), 0) << name;
}

template <class Value>
void set_attribute(hid_t file, const char* object, const char* name, hid_t type, std::vector<Value> values) {
  H5Adelete_by_name(file, object, name, H5P_DEFAULT);
  const hsize_t size = values.size();
  const hid_t space = size == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, nullptr);
  const hid_t attribute = H5Acreate_by_name(file, object, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(H5Awrite(attribute, type, values.data()), 0);
  H5Aclose(attribute);
  H5Sclose(space);
}

void set_text(hid_t file, const char* object, const char* name, const char* text) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  set_attribute<const char*>(file, object, name, type, {text});
  H5Tclose(type);
}

void replace_dataset(hid_t file, const char* name, std::vector<hsize_t> size) {
  remove(file, name);
  const hid_t space = H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr);
  const hid_t dataset = H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  ASSERT_GE(dataset, 0);
  H5Dclose(dataset);
  H5Sclose(space);
}

TEST_F(ReadHdf5, EverythingWrittenComesBack) { testing::expect_same_run(io::read_hdf5(path_), run_); }

TEST_F(ReadHdf5, AnEmptyRunComesBack) {
  run_ = {};
  io::write_hdf5(path_, run_);
  testing::expect_same_run(io::read_hdf5(path_), run_);
}

TEST_F(ReadHdf5, FilesFromBeforeSurfacesAreRead) {
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  remove(file, "surfaces");
  for (const char* name :
       {"X_TA_origin", "X_TA_rotation", "X_TS_origin", "X_TS_rotation", "wheel_surface", "rail_surface"})
    remove_attribute(file, "case_0001", name);
  for (const char* name : {"elements_in_contact", "elements_in_adhesion", "elements_in_slip"})
    remove_attribute(file, "case_0001/patch_2", name);
  H5Fclose(file);
  run_.sampled.clear();
  run_.cases[0].bodies.reset();
  run_.cases[0].wheel_surface = run_.cases[0].rail_surface = "";
  testing::expect_same_run(io::read_hdf5(path_), run_);  // the elements are counted again
}

TEST_F(ReadHdf5, PosesOfBodiesAreReadByTheirOldNames) {
  const hid_t file = H5Fopen(path_.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  for (const auto& [now, before] : {std::pair{"X_TA_origin", "X_TW_origin"},
                                    {"X_TA_rotation", "X_TW_rotation"},
                                    {"X_TS_origin", "X_TR_origin"},
                                    {"X_TS_rotation", "X_TR_rotation"}})
    ASSERT_GE(H5Arename_by_name(file, "case_0001", now, before, H5P_DEFAULT), 0);
  H5Fclose(file);
  testing::expect_same_run(io::read_hdf5(path_), run_);
}

TEST_F(ReadHdf5, OtherFilesAreRefused) {
  expect_refused([](hid_t file) { set_text(file, "/", "format", "treadmark result 2"); }, "treadmark result 2");
  expect_refused([](hid_t file) { set_text(file, "/", "format", "treadmark simulation 1"); }, "treadmark simulation 1");
  expect_refused([](hid_t file) { remove_attribute(file, "/", "format"); }, "does not say");
  std::ofstream(path_) << "no HDF5 at all";
  expect_unreadable("the file");
  std::filesystem::remove(path_);
  expect_unreadable("the file");
}

TEST_F(ReadHdf5, DamagedFilesAreRefused) {
  expect_refused([](hid_t file) { remove(file, "surfaces/wheel_1/z"); }, "z");
  expect_refused([](hid_t file) { remove(file, "surfaces/wheel_1"); }, "wheel_1");
  expect_refused([](hid_t file) { remove(file, "surfaces"); }, "no surface wheel_1");
  expect_refused([](hid_t file) { replace_dataset(file, "surfaces/rail_1/y", {4, 1}); }, "shape");
  expect_refused([](hid_t file) { replace_dataset(file, "surfaces/rail_1/x", {4}); }, "table");
  expect_refused(
      [](hid_t file) {
        replace_dataset(file, "case_0001/patch_2/slip_x", {24, 20});
      },
      "slip_x: it has the shape [24, 20], not [20, 24]");
  expect_refused([](hid_t file) { replace_dataset(file, "case_0001/patch_1/row_angle", {24}); }, "row_angle");
  expect_refused(
      [](hid_t file) {
        replace_dataset(file, "case_0001/patch_1/subsurface/block1/stress", {4, 2, 3, 8});
      },
      "stress");
  expect_refused([](hid_t file) { replace_dataset(file, "case_0001/patch_1/subsurface/block1/x", {4, 2}); }, "box");
  expect_refused([](hid_t file) { remove(file, "case_0001/patch_1/subsurface/block1/tresca"); }, "tresca");
  expect_refused([](hid_t file) { remove_attribute(file, "case_0001/patch_2", "fn"); }, "fn");
  expect_refused([](hid_t file) { remove_attribute(file, "case_0001", "status"); }, "status");
  expect_refused([](hid_t file) { set_text(file, "case_0001", "status", "fine"); }, "\"fine\"");
  expect_refused([](hid_t file) { set_text(file, "case_0001/patch_1", "id", "-3"); }, "\"-3\"");
  expect_refused([](hid_t file) { set_attribute<int>(file, "case_0002", "number", H5T_NATIVE_INT, {7}); },
                 "case 7 in case_0002");
  expect_refused([](hid_t file) { set_attribute<int>(file, "case_0001/patch_2", "nx", H5T_NATIVE_INT, {-24}); },
                 "-24 by 20");
  expect_refused([](hid_t file) { set_attribute<int>(file, "case_0001/patch_2", "nx", H5T_NATIVE_INT, {2000000000}); },
                 "2000000000 by 20");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused([&](hid_t file) { set_attribute<double>(file, "case_0001/patch_2", "nx", H5T_NATIVE_DOUBLE, {nan}); },
                 "nx");
  expect_refused([&](hid_t file) { set_attribute<double>(file, "case_0001/patch_2", "dx", H5T_NATIVE_DOUBLE, {nan}); },
                 "no size");
  expect_refused([&](hid_t file) { set_attribute<double>(file, "case_0001/patch_2", "x0", H5T_NATIVE_DOUBLE, {nan}); },
                 "no size");
  expect_refused(
      [&](hid_t file) {
        set_attribute<double>(file, "case_0001", "X_TA_origin", H5T_NATIVE_DOUBLE, {1.0, 2.0});
      },
      "X_TA_origin");
}

TEST_F(ReadHdf5, FilesCutOffAreRefused) {
  const auto size = std::filesystem::file_size(path_);
  for (const std::uintmax_t left : {size - 1, size / 2, std::uintmax_t{500}, std::uintmax_t{8}, std::uintmax_t{0}}) {
    std::filesystem::resize_file(path_, left);
    expect_unreadable("the file");
  }
}

TEST_F(ReadHdf5, DatasetsThatClaimMoreThanTheyStoreAreRefused) {
  // Never written: nothing is stored.
  expect_refused([](hid_t file) { replace_dataset(file, "surfaces/wheel_1/x", {4000, 4000}); }, "u");
  expect_refused(
      [](hid_t file) {
        replace_dataset(file, "surfaces/wheel_1/u", {4000});
        for (const char* name : {"x", "y", "z", "deviation"})
          replace_dataset(file, (std::string("surfaces/wheel_1/") + name).c_str(), {4000, 4000});
      },
      "u");
}

/// Whatever bytes are changed: either everything can be read, if not the same, or there is an error.
TEST(ReadHdf5Fuzz, NoByteMakesItCrash) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "fields.h5";
  io::RunResult run;
  run.geometry_sha256 = {{"a.prr", "11"}};
  run.settings = {"x=1"};
  io::CaseResult c;
  c.number = 1;
  c.has_wheelset = true;
  c.message = "words";
  c.patches = {testing::ball_patch(4, 3, 1e9)};
  c.patches[0].subsurface = {testing::sample_block(2, 1, 1)};
  c.wheel_surface = "wheel_1";
  run.cases = {c};
  run.sampled = testing::sample_surfaces();
  io::write_hdf5(path, run);
  const std::string sound = testing::read_text(path);
  std::mt19937 random(20240607);
  int refused = 0;
  for (int i = 0; i < 400; ++i) {
    std::string bytes = sound;
    const int changes = 1 + static_cast<int>(random() % 4);
    for (int k = 0; k < changes; ++k) bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    std::ofstream(path, std::ios::binary) << bytes;
    try {
      io::read_hdf5(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_data) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 20);
}

}  // namespace
}  // namespace treadmark
