// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <random>
#include <string>

#include "treadmark/backends/offset/file.hpp"
#include "treadmark/backends/offset/sparse_offsets.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/backends/offset/wheel_with_flat.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using offset::Interpolation;
using offset::OffsetFile;
namespace fs = std::filesystem;

constexpr double kR = 0.46;

class VdbFile : public ::testing::Test {
 protected:
  static OffsetFile wheel() {
    const auto base = analytic::make_standard_surface({"S1002"}, Body::wheel, kR);
    const auto target =
        analytic::make_standard_surface({"S1002"}, Body::wheel, kR, {rounded_flat(0.06, 0.8e-3, kPi, 0.05, 0.004)});
    const auto sample =
        offset::sample_offsets(*target, *base, Body::wheel, kR, {2e-3, 2e-3, 1e-9, region(kPi, 0.05, kR)});
    return {sample.offsets, {Body::wheel, kR, StandardProfile{"S1002"}, {}}};
  }
  std::string bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void put(const std::string& data) const { std::ofstream(path_, std::ios::binary) << data; }
  /// The kind of error that reading gives; -1: none.
  int kind() const {
    try {
      offset::read_vdb(path_);
    } catch (const Error& e) {
      EXPECT_FALSE(e.message().empty());
      EXPECT_LT(e.message().size(), 300u);
      EXPECT_EQ(e.where().file, path_.string());
      return static_cast<int>(e.kind());
    }
    return -1;
  }
  static constexpr int kInputData = static_cast<int>(ErrorKind::input_data);
  void SetUp() override { TREADMARK_NEEDS("openvdb"); }
  const TemporaryFolder folder_;
  const fs::path path_ = folder_.path() / "offsets.vdb";
};

TEST_F(VdbFile, RoundTripKeepsEveryBit) {
  const OffsetFile written = wheel();
  offset::write_vdb(path_, written);
  const OffsetFile read = offset::read_vdb(path_);
  EXPECT_EQ(read.base.body, Body::wheel);
  EXPECT_EQ(read.base.nominal_radius, kR);
  EXPECT_EQ(std::get<StandardProfile>(read.base.shape).name, "S1002");
  EXPECT_EQ(offset::active_count(*read.offsets), offset::active_count(*written.offsets));
  const auto base = analytic::make_standard_surface({"S1002"}, Body::wheel, kR);
  const Grid2 g{-0.04, -0.03, 0.0011, 0.0009, 70, 70};
  for (const Interpolation interpolation :
       {Interpolation::bilinear, Interpolation::quadratic, Interpolation::bicubic}) {
    const auto a = offset::make_offset_surface(base, written.offsets, interpolation, "offset");
    const auto b = offset::make_offset_surface(base, read.offsets, interpolation, "offset");
    EXPECT_EQ(greatest_difference(heights(*a, level(kPi, 0.0, kR), g), heights(*b, level(kPi, 0.0, kR), g)), 0.0);
    EXPECT_EQ(a->memory_bytes(), b->memory_bytes());
  }
}

TEST_F(VdbFile, KeepsBasesOfArcsAndPoints) {
  const OffsetMap map{"map", {-0.1, -0.02, 0.01, 0.002, 21, 21}, std::vector<float>(441, 1e-4f)};
  const auto offsets = offset::offsets_from_map(map, Body::rail, 1e-9).offsets;
  const ArcChain chain{-0.0301, 1.0 / 3.0, -0.1, {{0.03, 3.3}, {0.02, 0.0}, {0.01, 1.0 / 0.07}}};
  offset::write_vdb(path_, {offsets, {Body::rail, 0.0, chain, {}}});
  const auto arcs = std::get<ArcChain>(offset::read_vdb(path_).base.shape);
  EXPECT_EQ(arcs.start_z, chain.start_z);
  ASSERT_EQ(arcs.segments.size(), 3u);
  EXPECT_EQ(arcs.segments[2].curvature, 1.0 / 0.07);

  Profile points{Body::rail, {-0.01, 1e-3 / 3.0, 0.02}, {1e-4, 0.0, 1.0 / 7000.0}, "points of a test", {}, {}};
  points.smoothing.strength = 1e-7 / 3.0;
  offset::write_vdb(path_, {offsets, {Body::rail, 0.0, points, {}}});
  const auto back = std::get<Profile>(offset::read_vdb(path_).base.shape);
  EXPECT_EQ(back.y, points.y);
  EXPECT_EQ(back.z, points.z);
  EXPECT_EQ(back.name, points.name);
  EXPECT_EQ(back.smoothing.strength, points.smoothing.strength);
}

TEST_F(VdbFile, RefusesOtherBasesAndPlaces) {
  OffsetFile file = wheel();
  EXPECT_THROW(offset::write_vdb("/dev/null/folder/x.vdb", file), Error);
  file.base.body = Body::rail;
  EXPECT_THROW(offset::write_vdb(path_, file), Error);
  file = wheel();
  file.base.shape = SliceSet{};
  EXPECT_THROW(offset::write_vdb(path_, file), Error);
  EXPECT_THROW(offset::write_vdb(path_, {nullptr, file.base}), Error);
}

TEST_F(VdbFile, RefusesMissingEmptyForeignAndCutFiles) {
  EXPECT_EQ(kind(), kInputData);  // missing
  put("");
  EXPECT_EQ(kind(), kInputData);
  put("solid cube\nendsolid");
  EXPECT_EQ(kind(), kInputData);
  put(std::string(" BDV\0\0\0\0", 8));
  EXPECT_EQ(kind(), kInputData);
  offset::write_vdb(path_, wheel());
  const std::string good = bytes();
  EXPECT_EQ(kind(), -1);
  for (std::size_t n = 0; n < good.size(); n += 1 + good.size() / 41) {
    put(good.substr(0, n));
    EXPECT_EQ(kind(), kInputData) << n << " bytes";
  }
  put(good + "x");
  EXPECT_EQ(kind(), kInputData);
  EXPECT_THROW(offset::read_vdb(fs::path(::testing::TempDir())), Error);
}

TEST_F(VdbFile, NoSingleDamageGoesUnnoticed) {
  offset::write_vdb(path_, wheel());
  const std::string good = bytes();
  std::mt19937 random(5);
  for (int trial = 0; trial < 300; ++trial) {
    std::string bad = good;
    const std::size_t at = trial < 60 ? static_cast<std::size_t>(trial) : random() % bad.size();
    const int many = trial % 3 == 0 ? 1 : 1 + static_cast<int>(random() % 16);
    for (int k = 0; k < many && at + static_cast<std::size_t>(k) < bad.size(); ++k)
      bad[at + static_cast<std::size_t>(k)] =
          static_cast<char>(bad[at + static_cast<std::size_t>(k)] ^ static_cast<char>(1 + random() % 255));
    put(bad);
    ASSERT_EQ(kind(), kInputData) << "trial " << trial;
  }
}

/// The same file with a check sum that fits.
std::string sealed(std::string data) {
  std::uint64_t sum = 14695981039346656037ull;
  for (std::size_t i = 0; i + 24 < data.size(); ++i)
    sum = (sum ^ static_cast<unsigned char>(data[i])) * 1099511628211ull;
  for (int k = 0; k < 8; ++k) data[data.size() - 8 + static_cast<std::size_t>(k)] = static_cast<char>(sum >> (8 * k));
  return data;
}

/// The same file with another text of the same length in it, and a check sum that fits.
std::string edited(std::string data, const std::string& from, const std::string& to) {
  const std::size_t at = data.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  EXPECT_EQ(from.size(), to.size());
  return sealed(data.replace(at, from.size(), to));
}

// Whoever makes a hostile file makes a check sum that fits. OpenVDB meets it in a process of its own, which may end.
TEST_F(VdbFile, HostileSizesCostNoMemory) {
  constexpr long kMost = 1000000;  // [kB], also with sanitizers; a single length that is believed takes 4 GB
  const OffsetMap map{"map", {-0.1, -0.02, 0.01, 0.002, 21, 21}, std::vector<float>(441, 1e-4f)};
  const auto offsets = offset::offsets_from_map(map, Body::rail, 1e-9).offsets;
  offset::write_vdb(path_, {offsets, {Body::rail, 0.0, StandardProfile{"60E1"}, {}}});
  const std::string good = bytes();
  const std::size_t size = good.size() - 24;
  const auto read_damaged = [&](std::size_t at, std::size_t count, char byte) {
    std::string bad = good;
    bad.replace(at, count, count, byte);
    put(sealed(bad));
    const int found = kind();
    EXPECT_TRUE(found == -1 || found == kInputData) << count << " bytes at " << at;
  };
  std::mt19937 random(7);
  for (std::size_t at = 8; at < 1500; at += 23) read_damaged(at, 4, at % 2 == 0 ? '\xff' : '\x7f');
  for (std::size_t at = 8; at < 1500; at += 200) read_damaged(at, 8, '\0');
  for (int trial = 0; trial < 60; ++trial) {
    const std::size_t count = 1 + random() % 600, at = random() % (size - count);
    read_damaged(at, count, static_cast<char>(random() % 3 == 0 ? random() % 256 : 255));
  }
  rusage own{}, programs{};
  getrusage(RUSAGE_SELF, &own);
  getrusage(RUSAGE_CHILDREN, &programs);
  EXPECT_LT(std::max(own.ru_maxrss, programs.ru_maxrss), kMost);
}

TEST_F(VdbFile, WhatEndsTheProgramOfOpenVdbIsAnError) {
  offset::write_vdb(path_, wheel());
  const fs::path program = folder_.path() / "treadmark-openvdb";
  const auto refusal_by = [&](const char* end, ErrorKind kind) {
    std::ofstream(program) << "#!/bin/sh\n" << end << '\n';
    fs::permissions(program, fs::perms::owner_all);
    setenv("TREADMARK_MODULES", folder_.path().c_str(), 1);
    std::string said = refusal_of([&] { offset::read_vdb(path_); }, kind);
    unsetenv("TREADMARK_MODULES");
    return said;
  };
  for (const char* end : {"exit 0", "kill -SEGV $$", "kill -KILL $$"})
    EXPECT_THAT(refusal_by(end, ErrorKind::input_data), ::testing::HasSubstr("OpenVDB broke down over the VDB file"))
        << end;
  EXPECT_THAT(refusal_by("exit 2", ErrorKind::configuration),
              ::testing::AllOf(::testing::HasSubstr("treadmark-openvdb is of another version"),
                               ::testing::HasSubstr("install the Debian package treadmark-openvdb")));
  EXPECT_EQ(kind(), -1);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "a program is left";
}

TEST_F(VdbFile, RefusesEntriesThatMakeNoSense) {
  offset::write_vdb(path_, wheel());
  const std::string good = bytes();
  put(edited(good, "S1002", "S1003"));  // not this reader's business
  EXPECT_EQ(kind(), -1);
  using Pair = std::pair<std::string, std::string>;
  const std::string one_metre("\x01\0\0\0m", 5), one_mile("\x01\0\0\0i", 5);
  for (const auto& [from, to] :
       {Pair{"wheel", "whale"}, Pair{"wheel", "rail\n"}, Pair{"0.46000000000000002", "-.46000000000000002"},
        Pair{"0.46000000000000002", "nan0000000000000000"}, Pair{"standard", "standart"},
        Pair{"treadmark offsets 1", "treadmark offsets 2"}, Pair{"tolerance", "tolerante"},
        Pair{one_metre, one_mile}}) {
    put(edited(good, from, to));
    EXPECT_EQ(kind(), kInputData) << from << " to " << to;
  }
}

TEST(VdbMetadata, RefusesStepsOfNothing) {
  const SurfaceSpec rail{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  const OffsetMap map{"map", {-0.1, -0.02, 0.01, 0.002, 21, 21}, std::vector<float>(441, 1e-4f)};
  offset::Metadata m = offset::to_metadata(*offset::offsets_from_map(map, Body::rail, 1e-9).offsets, rail);
  offset::SparseOffsets read;
  SurfaceSpec base;
  EXPECT_NO_THROW(offset::from_metadata(m, read, base, "file"));
  for (const char* frame : {"0 0 1e-10 0.001 0 0 0", "0 0 0.001 1e-300 0 0 0"}) {
    m["frame"] = frame;
    try {
      offset::from_metadata(m, read, base, "file");
      ADD_FAILURE() << frame;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::input_data);
      EXPECT_NE(std::string(e.what()).find("steps"), std::string::npos) << e.what();
    }
  }
}

TEST(VdbMetadata, DoesNotRepeatLongEntries) {
  const SurfaceSpec rail{Body::rail, 0.0, StandardProfile{"60E1"}, {}};
  const OffsetMap map{"map", {-0.1, -0.02, 0.01, 0.002, 21, 21}, std::vector<float>(441, 1e-4f)};
  const offset::Metadata good = offset::to_metadata(*offset::offsets_from_map(map, Body::rail, 1e-9).offsets, rail);
  offset::SparseOffsets read;
  SurfaceSpec base;
  for (const char* entry : {"format", "units", "body", "base"}) {
    offset::Metadata m = good;
    m[entry] = std::string(100000, 'x');
    try {
      offset::from_metadata(m, read, base, "file");
      ADD_FAILURE() << entry;
    } catch (const Error& e) {
      EXPECT_LT(e.message().size(), 300u) << entry;
    }
  }
}

TEST_F(VdbFile, RefusesNumbersThatAreNone) {
  const OffsetMap map{"map", {-0.1, -0.02, 0.01, 0.002, 21, 21}, std::vector<float>(441, 1.2345e-4f)};
  const auto offsets = offset::offsets_from_map(map, Body::rail, 1e-9).offsets;
  offset::write_vdb(path_, {offsets, {Body::rail, 0.0, StandardProfile{"60E1"}, {}}});
  const std::string good = bytes();
  const auto raw = [](float v) { return std::string(reinterpret_cast<const char*>(&v), sizeof(v)); };
  const std::string from = raw(1.2345e-4f);
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e9f}) {
    put(edited(good, from, raw(bad)));
    EXPECT_EQ(kind(), kInputData) << bad;
  }
}

}  // namespace
}  // namespace treadmark::testing
