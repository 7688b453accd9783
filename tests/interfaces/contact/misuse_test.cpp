// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <thread>

#include "contact_calls.hpp"
#include "treadmark/interfaces/contact/units.hpp"

namespace treadmark::testing {
namespace {

using contact::Units;
using contact::units_of;

TEST(ContactLibraryUnits, AsTheTableSays) {
  Units u;
  EXPECT_TRUE(units_of(CNTC_un_cntc, u));
  EXPECT_NEAR(u.stress(), 1e6, 1e-6);
  EXPECT_NEAR(u.compliance(), 1e-9, 1e-20);
  EXPECT_NEAR(u.density(), 1e9, 1e-4);
  EXPECT_NEAR(u.stiffness(), 1e3, 1e-9);
  EXPECT_NEAR(u.hardening(), 1e9, 1e-3);
  EXPECT_EQ(u.sign, 1.0);
  EXPECT_TRUE(units_of(CNTC_un_spck, u));
  EXPECT_EQ(u.stress(), 1.0);
  EXPECT_EQ(u.sign, -1.0);
  EXPECT_TRUE(units_of(CNTC_un_si, u));
  EXPECT_EQ(u.sign, 1.0);
  EXPECT_FALSE(units_of(1938, u));
  EXPECT_EQ(u.code, CNTC_un_si);
}

int calculate_1(int ire) {
  int error = -999;
  cntc_calculate1(Int{ire}, &error);
  return error;
}
int calculate_3(int ire, int icp) {
  int error = -999;
  cntc_calculate3(Int{ire}, Int{icp}, &error);
  return error;
}

TEST(ContactLibraryMisuse, HasACode) {
  const Library library;
  EXPECT_EQ(library.error, 0);
  EXPECT_EQ(library.version, 2520);
  int version = 0, error = -1;
  cntc_initialize(Int{1}, Int{1}, &version, &error, " ", Int{1});
  EXPECT_EQ(error, 0);
  cntc_initialize(Int{3}, Int{3}, &version, &error, " ", Int{1});
  EXPECT_EQ(error, 0);
  for (const int wrong : {0, -5, 1000, std::numeric_limits<int>::max()}) {
    EXPECT_EQ(calculate_1(wrong), -101);
    EXPECT_EQ(calculate_3(wrong, 1), -101);
    EXPECT_EQ(calculate(wrong, 1), CNTC_err_icp);
    cntc_initialize(Int{wrong}, Int{1}, &version, &error, " ", Int{1});
    EXPECT_EQ(error, CNTC_err_icp);
  }
  cntc_initialize(Int{5}, Int{2}, &version, &error, " ", Int{1});
  EXPECT_EQ(error, CNTC_err_icp);
  EXPECT_EQ(calculate_3(1, 1), -102);
  EXPECT_EQ(calculate_1(3), -104);
  EXPECT_EQ(calculate_3(3, 10), -104);
  EXPECT_EQ(calculate(1, 3), CNTC_err_icp);
  EXPECT_EQ(calculate(1, 12), CNTC_err_icp);
  EXPECT_EQ(calculate(3, -1), CNTC_err_icp);
  EXPECT_EQ(calculate_1(1), CNTC_err_profil);
  int untouched = 77;
  cntc_getnumelements(Int{1}, Int{1}, &untouched, nullptr);
  EXPECT_EQ(untouched, 77);
  double force = 77.0;
  cntc_getcontactforces(Int{3}, Int{1}, &force, nullptr, nullptr, nullptr);
  EXPECT_EQ(force, 77.0);
  subs_calculate(Int{3}, Int{1}, &error);
  EXPECT_EQ(error, CNTC_err_icp);
  const std::string log = library.log();
  for (const char* code : {"-101", "-102", "-104", "-106", "-32"}) EXPECT_NE(log.find(code), std::string::npos) << code;
}

TEST(ContactLibraryMisuse, NullsAndLengths) {
  const Library library;
  cntc_setflags(Int{1}, Int{-1}, Int{3}, nullptr, nullptr);
  cntc_setflags(Int{1}, Int{-1}, nullptr, nullptr, nullptr);
  cntc_setflags(Int{1}, Int{-1}, Int{-3}, Int{CNTC_ic_tang}, Int{1});
  EXPECT_EQ(flag(1, -1, CNTC_ic_tang), 3);
  cntc_calculate(nullptr, nullptr, nullptr);
  int error = -999;
  cntc_calculate(nullptr, nullptr, &error);
  EXPECT_EQ(error, CNTC_err_icp);
  cntc_setcreepages(Int{3}, Int{1}, nullptr, nullptr, nullptr);
  cntc_setcreepages(Int{3}, Int{1}, Real{std::nan("")}, Real{0.0}, Real{0.0});
  cntc_setprofileinputfname(Int{1}, nullptr, Int{5}, Int{0}, nullptr, Int{0}, nullptr);
  cntc_setprofileinputfname(Int{1}, "a", Int{-1}, Int{0}, nullptr, Int{0}, nullptr);
  cntc_getmaxnumthreads(nullptr);
  int threads = 0;
  cntc_getmaxnumthreads(&threads);
  EXPECT_GE(threads, 1);
  cntc_finalize(nullptr);
  cntc_finalize(Int{50});
}

TEST(ContactLibraryMisuse, TheSecondStartIsEmpty) {
  const TemporaryFolder folder;
  const std::string out = folder.path().string();
  for (int i = 0; i < 2; ++i) {
    int version = 0, error = -1;
    cntc_initialize(Int{1}, Int{3}, &version, &error, out.c_str(), Int{static_cast<int>(out.size())});
    EXPECT_EQ(error, 0);
    EXPECT_EQ(flag(1, 1, CNTC_ic_bound), 0);
    set_flags(1, 1, {{CNTC_ic_bound, 3}});
    EXPECT_EQ(flag(1, 1, CNTC_ic_bound), 3);
    cntc_initialize(Int{2}, Int{1}, &version, &error, " ", Int{1});
    cntc_finalize(Int{2});
    cntc_finalize(Int{2});
    cntc_initialize(Int{2}, Int{3}, &version, &error, " ", Int{1});  // another module than before
    EXPECT_EQ(calculate_1(2), -104);
    cntc_finalize(Int{2});
    cntc_finalize(Int{1});
  }
}

TEST(ContactLibraryMisuse, NoMoreThanAHundredElements) {
  const Library library;
  int version = 0, error = -1;
  for (int ire = 1; ire <= 100; ++ire) {
    cntc_initialize(Int{10 * ire - 5 > 999 ? ire : 10 * ire - 5}, Int{3}, &version, &error, " ", Int{1});
    ASSERT_EQ(error, 0);
  }
  cntc_initialize(Int{998}, Int{3}, &version, &error, " ", Int{1});
  EXPECT_EQ(error, CNTC_err_icp);
}

void set_slow_problem(int ire, int icp, int elements) {
  set_flags(ire, icp, {{CNTC_ic_tang, 3}});
  cntc_setmaterialparameters(Int{ire}, Int{icp}, Int{0}, Int{4}, Reals{0.28, 0.28, 82000.0, 82000.0});
  const double step = 12.0 / elements;
  cntc_setpotcontact(Int{ire}, Int{icp}, Int{1}, Int{6}, Reals{1.0 * elements, 1.0 * elements, -6.0, -6.0, step, step});
  cntc_setundeformeddistc(Int{ire}, Int{icp}, Int{1}, Int{6}, Reals{0.001, 0.0, 0.001, 0.0, 0.0, 0.0});
  cntc_setpenetration(Int{ire}, Int{icp}, Real{0.03});
  cntc_setcreepages(Int{ire}, Int{icp}, Real{0.001}, Real{0.0005}, Real{1e-4});
  cntc_setreferencevelocity(Int{ire}, Int{icp}, Real{10000.0});
}

TEST(ContactLibraryThreads, TheSecondThreadInAProblemIsTurnedAway) {
  const Library library;
  set_slow_problem(1, 1, 40);
  std::atomic<int> busy = 0, wrong = 0;
  const auto work = [&] {
    constexpr int kMostTries = 200;
    for (int i = 0; i < kMostTries && busy == 0; ++i) {
      const int code = calculate(1, 1);
      if (code == CNTC_err_busy)
        ++busy;
      else if (code != 0)
        ++wrong;
    }
  };
  std::thread other(work);
  work();
  other.join();
  EXPECT_GT(busy, 0);
  EXPECT_EQ(wrong, 0);
}

TEST(ContactLibraryThreads, DifferentProblemsAtOnceGiveTheSame) {
  const Library library;
  set_slow_problem(1, 1, 30);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(calculate(1, 1), 0);
  const double alone = forces_of(1, 1).fx;
  constexpr int kThreads = 8;
  std::vector<std::thread> threads;
  std::vector<double> found(kThreads, 0.0);
  for (int k = 0; k < kThreads; ++k)
    threads.emplace_back([&found, k] {
      const int ire = 2 + k / 4, icp = 1 + k % 4;
      set_slow_problem(ire, icp, 30);
      for (int i = 0; i < 3; ++i)
        if (calculate(ire, icp) != 0) return;
      found[static_cast<std::size_t>(k)] = forces_of(ire, icp).fx;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(found, ::testing::Each(alone));
}

// Calls of every function in a random order with random numbers, most of them of the right kind: none may crash, end
// the program, or write beyond what it may. With --gtest_shuffle --gtest_random_seed=N and --gtest_repeat=M other
// calls.
TEST(ContactLibraryMisuse, RandomCallsDoNoHarm) {
  std::mt19937 random(20260523u + static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()));
  constexpr int kGuard = 64;
  const auto pick = [&](std::initializer_list<int> of) {
    return *(of.begin() + static_cast<long>(random() % of.size()));
  };
  const auto whole = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  const auto ire = [&] { return Int{pick({1, 1, 1, 2, 2, 3, 4, 0, 1000})}; };
  const auto icp = [&] { return Int{pick({-1, -1, 1, 1, 1, 2, 9, 0, 10, -7})}; };
  const auto real = [&] {
    constexpr double kNumbers[] = {0.0, 1.0, -1.0, 0.3, 0.28, 82000.0, 1e-3, 5.0, 21.0, 460.0, 1e9, -70.0, 1e-9, 2.5};
    const unsigned at = random() % 40;
    if (at == 39) return std::numeric_limits<double>::quiet_NaN();
    if (at == 38) return std::numeric_limits<double>::infinity();
    return kNumbers[at % std::size(kNumbers)];
  };
  Reals in(200), out(600);
  Ints codes(128), values(600);
  const auto fresh = [&] {
    for (double& x : in) x = real();
    for (int& code : codes) code = pick({1933, whole(1967, 1993), whole(2000, 2023), whole(0, 30), whole(-3, 12), 0});
    // Grids stay small: what is asked for is solved.
    in[0] = pick({1, 2, 5, 9, 0, -4});
    in[1] = pick({1, 2, 7, 11, 100});
    for (int& value : values) value = whole(-3, 12);
  };
  const auto length = [&] { return Int{pick({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 100, -1})}; };
  int a = 0, b = 0, c = 0;
  double x = 0.0, y = 0.0, z = 0.0, w = 0.0;
  const std::function<void()> calls[] = {
      [&] {
        cntc_initialize(ire(), Int{pick({1, 3, 2})}, &a, &b, " ", Int{1});
      },
      [&] {
        cntc_setglobalflags(Int{2}, Ints{CNTC_if_openmp, CNTC_if_idebug}, Ints{whole(-1, 3), whole(-1, 2)});
      },
      [&] { cntc_finalize(ire()); },
      [&] { cntc_setflags(ire(), icp(), length(), codes, values); },
      [&] { cntc_setmetadata(ire(), icp(), length(), codes, in); },
      [&] { cntc_setsolverflags(ire(), icp(), Int{whole(-1, 7)}, length(), values, length(), in); },
      [&] { cntc_setmaterialparameters(ire(), icp(), Int{whole(-1, 13)}, length(), in); },
      [&] {
        cntc_setmaterialparameters(ire(), icp(), Int{0}, Int{4}, Reals{0.28, 0.28, 82000.0, 82000.0});
      },
      [&] { cntc_settemperaturedata(ire(), icp(), Int{whole(0, 4)}, length(), in); },
      [&] { cntc_settimestep(ire(), icp(), Real{real()}); },
      [&] { cntc_setrollingstepsize(ire(), icp(), Real{real()}, Real{real()}); },
      [&] { cntc_setfrictionmethod(ire(), icp(), Int{whole(-1, 40)}, length(), in); },
      [&] { cntc_setpotcontact(ire(), icp(), Int{whole(-1, 5)}, length(), in); },
      [&] { cntc_settangentialforces(ire(), icp(), Real{real()}, Real{real()}); },
      [&] { cntc_setmaterialproperties(ire(), icp(), Real{real()}, Real{real()}, Real{real()}, Real{real()}); },
      [&] { cntc_setinterfaciallayer(ire(), icp(), Int{whole(0, 5)}, length(), in); },
      [&] { cntc_setreferencevelocity(ire(), icp(), Real{real()}); },
      [&] {
        cntc_sethertzcontact(ire(), icp(), Int{whole(-7, 0)}, Int{pick({5, 5, 6, 3})}, in);
      },
      [&] { cntc_setpenetration(ire(), icp(), Real{real()}); },
      [&] { cntc_setnormalforce(ire(), icp(), Real{real()}); },
      [&] {
        cntc_setundeformeddistc(ire(), icp(), Int{pick({1, 2, 3, 9})}, length(), in);
      },
      [&] { cntc_setcreepages(ire(), icp(), Real{real()}, Real{real()}, Real{real()}); },
      [&] { cntc_setextrarigidslip(ire(), icp(), length(), in, in); },
      [&] {
        cntc_readinpfile(ire(), Int{pick({1988, 1990})}, "none.inp", Int{8}, &a);
      },
      [&] { cntc_setverticalforce(ire(), Real{real()}); },
      [&] { cntc_setprofileinputfname(ire(), "none.prr", length(), length(), values, length(), in); },
      [&] { cntc_setprofileinputvalues(ire(), length(), in, length(), values, length(), in); },
      [&] {
        cntc_setprofileinputvalues(ire(), Int{3}, Reals{-40.0, 3.0, 0.0, 0.0, 30.0, 4.0}, Int{1}, Int{0}, Int{1},
                                   Real{1.0});
      },
      [&] {
        cntc_setprofileinputvalues(ire(), Int{3}, Reals{60.0, -2.0, 0.0, 0.0, -40.0, 9.0}, Int{1}, Int{1}, Int{1},
                                   Real{1.0});
      },
      [&] {
        cntc_settrackdimensions(ire(), Int{pick({0, 1, 2, 3, 32, 33, 4})}, length(), in);
      },
      [&] { cntc_setwheelsetdimensions(ire(), Int{whole(0, 6)}, length(), in); },
      [&] { cntc_setwheelsetposition(ire(), Int{whole(0, 6)}, Int{6}, in); },
      [&] { cntc_setwheelsetvelocity(ire(), Int{whole(0, 6)}, Int{6}, in); },
      [&] {
        cntc_setwheelsetflexibility(ire(), Int{whole(0, 6)}, Int{pick({0, 12})}, in);
      },
      [&] { cntc_calculate(ire(), icp(), &a); },
      [&] { cntc_calculate1(ire(), &a); },
      [&] { cntc_calculate3(ire(), icp(), &a); },
      [&] {
        subs_addblock(ire(), icp(), Int{whole(0, 11)}, Int{whole(0, 10)}, length(), length(), Int{3}, in, in,
                      Reals{2.0, 0.1, 0.5});
      },
      [&] { subs_calculate(ire(), icp(), &a); },
      [&] { cntc_getflags(ire(), icp(), length(), codes, values); },
      [&] { cntc_getparameters(ire(), icp(), Int{whole(0, 4)}, length(), out); },
      [&] {
        cntc_getprofilevalues(ire(), Int{whole(-2, 10)}, Int{2}, Ints{whole(0, 1), whole(-1, 5)}, length(), in,
                              length(), out);
      },
      [&] { cntc_getwheelsetposition(ire(), length(), out); },
      [&] { cntc_getwheelsetvelocity(ire(), length(), out); },
      [&] { cntc_getnumcontactpatches(ire(), &a); },
      [&] { cntc_getcontactlocation(ire(), icp(), length(), out); },
      [&] { cntc_getreferencevelocity(ire(), icp(), &x); },
      [&] { cntc_gethertzcontact(ire(), icp(), length(), out); },
      [&] { cntc_getnumelements(ire(), icp(), &a, &b); },
      [&] { cntc_getgriddiscretization(ire(), icp(), &x, &y); },
      [&] { cntc_getpotcontact(ire(), icp(), length(), out); },
      [&] { cntc_getpenetration(ire(), icp(), &x); },
      [&] { cntc_getcreepages(ire(), icp(), &x, &y, &z); },
      [&] { cntc_getcontactforces(ire(), icp(), &x, &y, &z, &w); },
      [&] { cntc_getglobalforces(ire(), icp(), length(), out); },
      [&] { cntc_getcontactpatchareas(ire(), icp(), &x, &y, &z); },
      [&] { cntc_getelementdivision(ire(), icp(), length(), values); },
      [&] { cntc_getmaximumpressure(ire(), icp(), &x); },
      [&] { cntc_getmaximumtraction(ire(), icp(), &x); },
      [&] { cntc_getmaximumtemperature(ire(), icp(), &x, &y); },
      [&] { cntc_getfielddata(ire(), icp(), Int{whole(0, 24)}, length(), out); },
      [&] { cntc_gettractions(ire(), icp(), length(), out, out, out); },
      [&] { cntc_getmicroslip(ire(), icp(), length(), out, nullptr); },
      [&] { cntc_getdisplacements(ire(), icp(), length(), out, out, nullptr); },
      [&] { cntc_getsensitivities(ire(), icp(), Int{whole(-1, 6)}, Int{whole(-1, 6)}, out); },
      [&] { cntc_getcalculationtime(ire(), icp(), &x, &y); },
      [&] { cntc_resetcalculationtime(ire(), icp()); },
      [&] { subs_getblocksize(ire(), icp(), Int{whole(-1, 11)}, &a, &b, &c); },
      [&] { subs_getresults(ire(), icp(), Int{whole(0, 3)}, Int{whole(-1, 50)}, Int{whole(0, 5)}, codes, out); },
  };
  const Library library;
  // The end of the last element ends the library, and what follows starts it anew where the program stands.
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(library.folder());
  constexpr int kCalls = 6000;
  for (int i = 0; i < kCalls; ++i) {
    fresh();
    for (std::size_t k = out.size() - kGuard; k < out.size(); ++k) out[k] = -1234.5;
    calls[random() % std::size(calls)]();
    for (std::size_t k = out.size() - kGuard; k < out.size(); ++k) ASSERT_EQ(out[k], -1234.5);
  }
  EXPECT_FALSE(library.log().empty());
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace treadmark::testing
