// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <chrono>

#include "scan_files.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

/// Seconds, for the log; no test of speed.
template <class Call>
void timed(const std::string& what, Call&& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ::testing::Test::RecordProperty(what, fmt::format("{:.2f} s", seconds));
  fmt::print("{}: {:.2f} s\n", what, seconds);
}

TEST(BigScans, ManyBlocksOfEveryFormat) {
  const char* const asked = std::getenv("TREADMARK_SCAN_POINTS");
  const std::size_t count = asked != nullptr ? std::strtoull(asked, nullptr, 10) : 300'000;
  PointCloud cloud;
  cloud.points.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = static_cast<double>(i);
    cloud.points.push_back({1e-6 * static_cast<double>((i * 7919) % 1'000'003), 1e-8 * u, 1e-3 * std::sin(1e-3 * u)});
  }
  const TemporaryFolder folder;
  for (const char* name : {"a.xyz", "a.csv", "a.ply", "a.las"}) {
    const auto file = folder.path() / name;
    timed(std::string("write ") + name, [&] { write_scan(file, cloud, LengthUnit::millimetre); });
    Scan scan;
    timed(std::string("read ") + name, [&] { scan = read_scan(file); });
    ASSERT_EQ(scan.cloud.points.size(), count);
    EXPECT_LE(scan.cloud.points.capacity(), count + count / 8 + 8192) << name;
    for (std::size_t i = 0; i < count; ++i)
      ASSERT_LE((1e-3 * scan.cloud.points[i] - cloud.points[i]).norm(), 1.1e-10) << name << " " << i;
    std::filesystem::remove(file);
  }
}

}  // namespace
}  // namespace treadmark::io
