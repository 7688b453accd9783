// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/scaling/measured_loops.hpp"

#include <gtest/gtest.h>
#include <time.h>

#include <stdexcept>

#include "treadmark/core/parallel.hpp"

namespace {

using treadmark::ThreadLimit;
using treadmark::bench::measured_so_far;
using treadmark::bench::Strand;

constexpr double kShort = 4e-3;  // [s]
constexpr double kRoom = 0.15;   // of a time: interrupts

double processor_time() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void work_for(double seconds) {
  for (const double end = processor_time() + seconds; processor_time() < end;) {
  }
}

template <class Body>
Strand measured(const Body& body) {
  const Strand before = measured_so_far();
  body();
  const Strand after = measured_so_far();
  return {after.work - before.work, after.span - before.span, after.in_tasks - before.in_tasks,
          after.loops - before.loops};
}

void expect(const Strand& s, double work, double span, double in_tasks, long loops) {
  EXPECT_NEAR(s.work, work, kRoom * work);
  EXPECT_NEAR(s.span, span, kRoom * span);
  EXPECT_NEAR(s.in_tasks, in_tasks, kRoom * span);
  EXPECT_EQ(s.loops, loops);
}

TEST(MeasuredLoops, AsLongAsTheLongestTask) {
  const ThreadLimit many(64);
  const Strand s = measured([] {
    work_for(kShort);
    treadmark::parallel_for(5, [](std::size_t i) { work_for(i == 3 ? 3.0 * kShort : kShort); });
  });
  expect(s, 8.0 * kShort, 4.0 * kShort, 3.0 * kShort, 1);
}

TEST(MeasuredLoops, LoopsWithinLoops) {
  const ThreadLimit many(64);
  const Strand s = measured([] {
    treadmark::parallel_for(3, [](std::size_t i) {
      work_for(kShort);
      if (i == 1) treadmark::parallel_for(4, [](std::size_t) { work_for(kShort); });
    });
  });
  expect(s, 7.0 * kShort, 2.0 * kShort, 2.0 * kShort, 2);
}

TEST(MeasuredLoops, OneThreadHasNoLoops) {
  const ThreadLimit one(1);
  const Strand s = measured([] { treadmark::parallel_for(4, [](std::size_t) { work_for(kShort); }); });
  expect(s, 4.0 * kShort, 4.0 * kShort, 0.0, 0);
}

TEST(MeasuredLoops, GoesOnAfterAnException) {
  const ThreadLimit many(64);
  const Strand s = measured([] {
    EXPECT_THROW(treadmark::parallel_for(4,
                                         [](std::size_t i) {
                                           work_for(kShort);
                                           if (i == 1) throw std::runtime_error("planted");
                                         }),
                 std::runtime_error);
    work_for(kShort);
  });
  EXPECT_GE(s.work, s.span);
  EXPECT_EQ(s.loops, 1);
}

}  // namespace
