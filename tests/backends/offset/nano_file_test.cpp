// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Files that are evaluated where they lie. NanoVDB's own reader is the other opinion of what they hold.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>

#include <nanovdb/util/IO.h>

#include "treadmark/backends/offset/coefficients.hpp"
#include "treadmark/backends/offset/file.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/backends/offset/wheel_with_flat.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using offset::Interpolation;
using offset::OffsetFile;
using ::testing::AnyOf;
using ::testing::HasSubstr;

class NanoFile : public ::testing::Test {
 protected:
  static constexpr double kRadius = 0.46;
  static constexpr std::size_t kSumAt = 224 + 664;  // of the check sum: the last number of the first grid's data

  NanoFile() { setenv("TREADMARK_MODULES", "/nowhere", 1); }  // where no OpenVDB is
  ~NanoFile() override { unsetenv("TREADMARK_MODULES"); }

  static OffsetFile wheel() {
    const auto base = analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius);
    const auto target = analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius,
                                                        {rounded_flat(0.06, 0.8e-3, 0.0, 0.05, 0.004)});
    // across the seam of the turn and the middle of the profile: indices of both signs, nodes of all corners
    const auto sample =
        offset::sample_offsets(*target, *base, Body::wheel, kRadius, {2e-3, 2e-3, 1e-9, region(0.0, 0.05, kRadius)});
    return {sample.offsets, {Body::wheel, kRadius, StandardProfile{"S1002"}, {}}};
  }
  std::string bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& data) const { std::ofstream(path_, std::ios::binary) << data; }
  /// With a check sum that fits.
  void put_sealed(std::string data) const {
    data.replace(kSumAt, 8, 8, '\0');
    const std::uint64_t sum = offset::sum_of(data.data(), data.size());
    data.replace(kSumAt, 8, reinterpret_cast<const char*>(&sum), 8);
    put(data);
  }
  std::string refusal() const {
    return refusal_of([&] { offset::read_vdb(path_); }, ErrorKind::input_data);
  }

  const TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "wheel.nvdb";
};

TEST_F(NanoFile, GivesTheSameHeightsToTheLastBit) {
  const OffsetFile written = wheel();
  offset::write_vdb(path_, written);
  const OffsetFile read = offset::read_vdb(path_);
  EXPECT_EQ(read.remark, "");
  EXPECT_EQ(read.base.nominal_radius, kRadius);
  EXPECT_EQ(std::get<StandardProfile>(read.base.shape).name, "S1002");
  EXPECT_EQ(offset::active_count(*read.offsets), offset::active_count(*written.offsets));
  const auto base = analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius);
  const Grid2 g{-0.04, -0.03, 0.0011, 0.0009, 70, 70};
  for (const Interpolation interpolation :
       {Interpolation::bilinear, Interpolation::quadratic, Interpolation::bicubic}) {
    const auto a = offset::make_offset_surface(base, written.offsets, interpolation, "offset");
    const auto b = offset::make_offset_surface(base, read.offsets, interpolation, "offset");
    EXPECT_EQ(greatest_difference(heights(*a, level(0.0, 0.0, kRadius), g), heights(*b, level(0.0, 0.0, kRadius), g)),
              0.0);
  }
  // What is read is written as the same bytes again.
  const std::string first = bytes();
  offset::write_vdb(path_, read);
  EXPECT_EQ(bytes(), first);
}

TEST_F(NanoFile, IsReadByNanoVdb) {
  const OffsetFile written = wheel();
  offset::write_vdb(path_, written);
  const auto handles = nanovdb::io::readGrids(path_.string());
  ASSERT_EQ(handles.size(), 2u);
  const offset::SheetGrid cubic =
      offset::spline_coefficients(*written.offsets, 3, offset::smallest_coefficient(*written.offsets));
  const offset::SheetGrid* const sheets[] = {&written.offsets->grid, &cubic};
  for (std::size_t n = 0; n < 2; ++n) {
    const auto* grid = handles[n].grid<float>();
    ASSERT_NE(grid, nullptr);
    EXPECT_EQ(grid->activeVoxelCount(), sheets[n]->active_count());
    auto at = grid->getAccessor();
    int below = 0;
    for (int i = 0; i < written.offsets->frame.turn; ++i)
      for (int j = -64; j < 64; ++j) {
        const nanovdb::Coord place(i, j >> 3, j & 7);
        ASSERT_EQ(at.getValue(place), sheets[n]->value(i, j)) << i << ' ' << j;
        below += j < 0 && at.isActive(place);
      }
    EXPECT_GT(below, 0);
    const nanovdb::Vec3d y = grid->indexToWorld(nanovdb::Vec3d(3.0, 2.0, 1.0));
    EXPECT_NEAR(y[0], written.offsets->frame.u0 + 3.0 * written.offsets->frame.du, 1e-15);
    EXPECT_NEAR(y[1] + y[2], written.offsets->frame.y0 + 17.0 * written.offsets->frame.dy, 1e-15);
  }
}

TEST_F(NanoFile, MayHoldNothing) {
  const OffsetMap map{"map", {-0.1, -0.02, 0.01, 0.002, 21, 21}, std::vector<float>(441, 0.0f)};
  const auto offsets = offset::offsets_from_map(map, Body::rail, 1e-9).offsets;
  offset::write_vdb(path_, {offsets, {Body::rail, 0.0, StandardProfile{"60E1"}, {}}});
  EXPECT_EQ(offset::active_count(*offset::read_vdb(path_).offsets), 0u);
}

TEST_F(NanoFile, NoDamageGoesUnnoticed) {
  offset::write_vdb(path_, wheel());
  const std::string good = bytes();
  std::mt19937 random(5);
  for (int trial = 0; trial < 150; ++trial) {
    const std::size_t at = trial < 110 ? static_cast<std::size_t>(8 * trial) : random() % good.size();
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ static_cast<char>(1 + random() % 255));
    put(bad);
    ASSERT_THAT(refusal(), HasSubstr("NanoVDB file")) << at;
  }
  for (std::size_t n = 0; n < good.size(); n += 1 + good.size() / 61) {
    put(good.substr(0, n));
    ASSERT_THAT(refusal(), HasSubstr("NanoVDB file")) << n << " bytes";
  }
  put(good + "x");
  EXPECT_THAT(refusal(), HasSubstr("damaged"));
}

// Whoever makes a hostile file makes a check sum that fits.
TEST_F(NanoFile, HostileNumbersLeadNowhere) {
  offset::write_vdb(path_, wheel());
  const std::string good = bytes();
  std::mt19937 random(7);
  const auto read_damaged = [&](std::size_t at, std::size_t count, char byte) {
    std::string bad = good;
    bad.replace(at, count, count, byte);
    put_sealed(bad);
    EXPECT_THAT(refusal(), AnyOf("no error", HasSubstr("wheel.nvdb"))) << count << " bytes at " << at;
  };
  // all numbers of the first grid and its tree, then anywhere
  for (std::size_t at = 224; at < 224 + 672 + 64; at += 4)
    for (const char byte : {'\xff', '\x01'}) read_damaged(at, 4, byte);
  for (int trial = 0; trial < 200; ++trial)
    read_damaged(random() % (good.size() - 16), 1 + random() % 16, static_cast<char>(random() % 256));
}

TEST_F(NanoFile, WhatNoOffsetsAreIsRefused) {
  constexpr std::size_t kGrid = 224, kTree = kGrid + 672, kSteps = kGrid + 384, kPlace = kGrid + 528, kValues = 96;
  offset::write_vdb(path_, wheel());
  const std::string good = bytes();
  const auto number_at = [&](std::size_t at) {
    std::uint64_t number = 0;
    std::memcpy(&number, good.data() + at, sizeof(number));
    return static_cast<std::size_t>(number);
  };
  const auto with = [&](std::size_t at, auto value) {
    std::string bad = good;
    std::memcpy(bad.data() + at, &value, sizeof(value));
    put_sealed(bad);
    return refusal();
  };
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN(),
                   kBeyond = std::numeric_limits<double>::infinity();
  for (const std::size_t step : {kSteps, kSteps + 4 * sizeof(double)})
    for (const double value : {kNoNumber, kBeyond, -2e-3, 0.0})
      EXPECT_THAT(with(step, value), HasSubstr("steps of the offsets must be positive")) << value;
  for (const double value : {kNoNumber, kBeyond})
    EXPECT_THAT(with(kPlace, value), HasSubstr("steps of the offsets must be positive")) << value;
  const std::size_t leaf = kTree + number_at(kTree), second = kGrid + number_at(kGrid + 32),
                    coefficients = second + kTree + number_at(second + kTree) + kValues;
  for (const std::size_t axis : {0, 4})
    EXPECT_THAT(with(leaf + axis, std::numeric_limits<std::int32_t>::min()), HasSubstr("damaged"));
  EXPECT_THAT(with(leaf + kValues, 1.5f), HasSubstr("greater than a metre"));
  EXPECT_THAT(with(coefficients, 1e30f), HasSubstr("greater than a metre"));
}

TEST_F(NanoFile, WhatIsNoneOfOursIsNamed) {
  EXPECT_THAT(refusal(), HasSubstr("wheel.nvdb"));  // missing
  put("");
  EXPECT_THAT(refusal(), HasSubstr("is empty"));
  put(std::string(" BDV\0\0\0\0", 8) + std::string(3000, 'x'));
  EXPECT_THAT(refusal(), HasSubstr("not a NanoVDB file"));
  offset::write_vdb(path_, wheel());
  const auto handle = nanovdb::io::readGrid(path_.string());
  nanovdb::io::writeGrid(path_.string(), handle);
  EXPECT_THAT(refusal(), HasSubstr("NanoVDB file"));
  EXPECT_THROW(offset::read_vdb("/dev/null/x.nvdb"), Error);
  std::filesystem::remove(path_);
  ASSERT_EQ(mkfifo(path_.c_str(), 0600), 0);  // nobody waits for what comes
  EXPECT_THAT(refusal(), HasSubstr("cannot be read"));
}

}  // namespace
}  // namespace treadmark::testing
