// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Calls wheelrail::Pair very often with inputs in any order, from two threads with a pair each on the same surfaces;
// every so often a thread makes surfaces anew, with other defects. Memory must not grow once every kind of input has
// been met, and a problem that comes back must have the same answer to the last bit.
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace {

using namespace treadmark;
using wheelrail::Pair;
using wheelrail::PairSolution;
using wheelrail::Problem;

constexpr double kRadius = 0.46;

double resident_mib() {
  std::ifstream statm("/proc/self/statm");
  long total = 0, resident = 0;
  statm >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

Problem fixed_problem() {
  Problem p;
  p.track.cant = 1.0 / 40.0;
  p.state.position.y = 1.5e-3;
  p.state.velocity = {.x = 10.0, .pitch = -21.73};
  p.vertical_force = 5e4;
  p.discretisation.dx = p.discretisation.ds = 1.2e-3;
  return p;
}

/// Any input: good, off the rail, inside it, not a number, unreachable, in time or not.
Problem any_problem(Random& random) {
  Problem p = fixed_problem();
  const auto between = [&](double a, double b) { return a + (b - a) * random.uniform(); };
  const auto one_in = [&](double n) { return random.uniform() * n < 1.0; };
  p.side = one_in(2) ? wheelrail::Side::left : wheelrail::Side::right;
  p.state.position = {between(0, 10),       between(-8e-3, 8e-3), between(-1e-3, 1e-3),
                      between(-5e-3, 5e-3), between(-0.02, 0.02), between(-3, 3)};
  p.state.velocity.y = between(-0.1, 0.1);
  p.state.velocity.pitch *= between(0.99, 1.01);
  p.vertical_force = between(1e3, 1.2e5);
  p.track.curvature = between(-1e-3, 1e-3);
  if (one_in(8)) p.vertical_force.reset();
  if (one_in(12)) p.regime = kalker::Regime::frictionless;
  if (one_in(6)) p.tangential_model = kalker::TangentialModel::fastsim;
  if (one_in(10)) p.longitudinal_force = between(-2e4, 2e4);
  if (one_in(20))
    p.rail_springs = wheelrail::RailSprings{.stiffness_y = between(1e7, 1e8), .stiffness_z = between(0.0, 1e8)};
  if (one_in(30)) p.material.shear_modulus_1 = between(2e10, 2e11);
  if (one_in(40)) p.discretisation.dx = between(0.7e-3, 2e-3);
  if (one_in(50)) p.state.position.y = between(-1.0, 1.0);
  if (one_in(100)) p.state.position.z = 0.05;
  if (one_in(100)) p.state.position.roll = std::atof("nan");
  if (one_in(5)) {
    p.regime = one_in(3) ? kalker::Regime::shift : kalker::Regime::transient;
    p.history = one_in(3) ? kalker::HistoryUse::start : kalker::HistoryUse::keep_going;
    p.tangential_model = kalker::TangentialModel::full;
    p.enforce_step_rule = false;
  }
  return p;
}

struct Work {
  std::atomic<long> calls{0}, failed{0}, refused{0}, surfaces{0};
  std::atomic<bool> wrong{false}, over{false};
};

/// The same rail with a wheel of another flat each time.
wheelrail::Geometry other_geometry(Random& random) {
  WheelFlat flat;
  flat.length = 0.02 + 0.06 * random.uniform();
  flat.depth = 1e-4 + 1e-3 * random.uniform();
  flat.width = 0.05;
  return {analytic::make_standard_surface({"60E1"}, Body::rail, 0.0),
          analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius, {flat}), true, false};
}

void solve_any(Pair& pair, Random& random, Work& work) {
  try {
    if (pair.solve(any_problem(random)).status != Status::ok) ++work.failed;
  } catch (const Error&) {
    ++work.refused;
  }
}

void call_often(const wheelrail::Geometry& geometry, std::uint64_t seed, long calls, Work& work) {
  Pair pair(geometry);
  Random random(seed);
  const PairSolution expected = Pair(geometry).solve(fixed_problem());
  constexpr long kCheckEvery = 500, kOtherEvery = 1000, kOnOther = 5;
  for (long i = 0; i < calls && !work.wrong && !work.over; ++i, ++work.calls) {
    if (i % kOtherEvery == kOtherEvery - 1) {
      Pair other(other_geometry(random));
      ++work.surfaces;
      for (long k = 0; k < kOnOther; ++k) solve_any(other, random, work);
    }
    if (i % kCheckEvery == 0) {
      const PairSolution again = pair.solve(fixed_problem());
      if (again.z != expected.z || again.patches.at(0).contact.traction_x != expected.patches.at(0).contact.traction_x)
        work.wrong = true;
      continue;
    }
    solve_any(pair, random, work);
  }
}

/// Resident memory by calls, once every kind of input has been met: least squares.
class Growth {
 public:
  void add(double calls, double mib) { n_ += 1.0, x_ += calls, y_ += mib, xx_ += calls * calls, xy_ += calls * mib; }
  double per_call() const {
    const double spread = n_ * xx_ - x_ * x_;
    return spread > 0.0 ? (n_ * xy_ - x_ * y_) / spread : 0.0;
  }

 private:
  double n_ = 0.0, x_ = 0.0, y_ = 0.0, xx_ = 0.0, xy_ = 0.0;
};

/// Until there were so many calls, or for so long [s], whichever is given.
int run(long calls, double seconds) {
  const wheelrail::Geometry geometry{analytic::make_standard_surface({"60E1"}, Body::rail, 0.0),
                                     analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius), true, true};
  Work work;
  std::thread first([&] { call_often(geometry, 1, calls / 2, work); }),
      second([&] { call_often(geometry, 2, calls - calls / 2, work); });
  const auto start = std::chrono::steady_clock::now();
  double early = 0.0, largest = 0.0;
  Growth growth;
  long printed = 0;
  while (work.calls < calls && !work.wrong) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const double now = resident_mib();
    const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const double share =
        seconds > 0.0 ? passed / seconds : static_cast<double>(work.calls) / static_cast<double>(calls);
    if (share < 0.3)
      early = std::max(early, now);
    else
      growth.add(static_cast<double>(work.calls), now);
    largest = std::max(largest, now);
    if (static_cast<long>(10.0 * share) > printed) {
      printed = static_cast<long>(10.0 * share);
      std::printf("%8ld calls  %6ld surfaces  %8.1f MiB\n", work.calls.load(), work.surfaces.load(), now);
      std::fflush(stdout);
    }
    if (seconds > 0.0 && share >= 1.0) work.over = true;
    if (work.over) break;
  }
  first.join();
  second.join();
  constexpr double kMany = 1e7;
  std::printf(
      "%ld calls, of which %ld with another status than ok and %ld refused; memory %.1f MiB in the first 30 %%, %.1f "
      "MiB at most, by its trend %.0f MiB after 1e7 calls\n",
      work.calls.load(), work.failed.load(), work.refused.load(), early, largest,
      largest + std::max(0.0, growth.per_call()) * kMany);
  if (work.wrong) std::printf("a problem that came back has another answer\n");
  constexpr double kRoom = 1.1, kRoomMib = 8.0;
  const bool grown = largest > kRoom * early + kRoomMib;
  if (grown) std::printf("memory has grown\n");
  return work.wrong || grown ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  long calls = 100000;
  double hours = 0.0;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string option = argv[i];
    if (option == "--calls") calls = std::atol(argv[i + 1]);
    if (option == "--hours") hours = std::atof(argv[i + 1]);
  }
  if (argc % 2 == 0 || calls < 100 || hours < 0.0) {
    std::fprintf(stderr, "usage: bench_endurance [--calls N | --hours H], N >= 100\n");
    return 2;
  }
  if (hours > 0.0) calls = std::numeric_limits<long>::max();
  try {
    return run(calls, 3600.0 * hours);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
