// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Calls of the C interface in any order with any arguments that a C compiler lets through: bytes name the functions,
// the objects and the numbers. What holds of every call is checked after it.
#include <array>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "treadmark.h"
#include "treadmark/core/platform/bit_cast.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

namespace {

const std::string kWheelRail =
    "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\n"
    "[track]\ngauge_mm = 1435.0\ncant = \"1:40\"\n"
    "[wheelset]\nnominal_radius_mm = 460\nvertical_force_N = 80e3\nvelocity_m_s = 20\nvpitch_rad_s = -43.5\n"
    "[friction]\ncoefficient = 0.3\n[discretisation]\ndx_mm = 3\nds_mm = 3\n";
const std::string kPatch =
    "[patch]\nnormal_force_N = 1000.0\nmx = 9\nmy = 9\nx0_mm = -1.6\ny0_mm = -1.6\ndx_mm = 0.4\ndy_mm = 0.4\n"
    "[patch.gap]\nkind = \"quadratic\"\ncoefficients_si = [10.0, 0.0, 10.0, 0.0, 0.0, 0.0]\n";

const char* const kAssignments[] = {"wheelset.y_mm=5",
                                    "wheelset.z_mm=0.2",
                                    "wheelset.vertical_force_N=50e3",
                                    "case.regime=transient",
                                    "case.regime=none",
                                    "case.regime=shift",
                                    "case.history=continue",
                                    "case.history=start",
                                    "case.side=left",
                                    "rail.backend=spline",
                                    "wheel.flats=[{length_mm=60, depth_mm=0.9}]",
                                    "wheel.flats.0.depth_mm=1.2",
                                    "friction.coefficient=1e-3",
                                    "track.springs.stiffness_z_N_per_mm=1000",
                                    "contact.reference_surface=curved",
                                    "solver.tangential_model=fastsim",
                                    "nonsense",
                                    "",
                                    "=",
                                    "[[=1"};
const char* const kNames[] = {
    "fn", "pmax", "force_on_rail.fz_tr", "pressure", "traction_x", "temperature_1", "seconds", "why", ""};

[[noreturn]] void broken(const char* rule) {
  std::fprintf(stderr, "fuzz_c_calls: %s (%s)\n", rule, tm_message());
  std::abort();
}
void must(bool holds, const char* rule) {
  if (!holds) broken(rule);
}

/// Ends what takes too long, as a host would.
class Patience {
 public:
  Patience() : thread_([this] { wait(); }) { tm_set_cancel_flag(&flag_); }
  ~Patience() {
    tm_set_cancel_flag(nullptr);
    {
      const std::lock_guard lock(mutex_);
      done_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }

 private:
  void wait() {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, std::chrono::seconds(4), [this] { return done_; }))
      __atomic_store_n(const_cast<int*>(&flag_), 1, __ATOMIC_RELAXED);
  }
  volatile int flag_ = 0;
  bool done_ = false;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::thread thread_;
};

int heights(void* user, double u, const double* y, std::size_t n, double* z) {
  const int kind = *static_cast<int*>(user);
  for (std::size_t k = 0; k < n; ++k) z[k] = kind == 1 ? std::nan("") : 2.0 * y[k] * y[k] + 0.01 * u * u;
  return kind == 2 ? 1 : 0;
}

class Calls {
 public:
  Calls(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  ~Calls() {
    for (tm_case* c : cases_) tm_case_free(c);
    for (tm_surface* s : surfaces_) tm_surface_free(s);
    for (tm_pair* p : pairs_) tm_pair_free(p);
    for (tm_patch* p : patches_) tm_patch_free(p);
    for (tm_solution* s : solutions_) tm_solution_free(s);
    for (tm_state* s : states_) tm_state_free(s);
  }
  Calls(const Calls&) = delete;
  Calls& operator=(const Calls&) = delete;

  void run() {
    constexpr int kMost = 200;
    for (int i = 0; i < kMost && next_ < size_; ++i) {
      at_ = next_;
      next_ += kRecord;
      call(byte() % 31);
    }
  }

 private:
  static constexpr std::size_t kSlots = 3;
  template <class Handle>
  using Slots = std::array<Handle*, kSlots>;

  /// Of the record of this call; behind its end zeros, which mean what is usual.
  std::uint8_t byte() { return at_ < std::min(next_, size_) ? data_[at_++] : 0; }
  bool seldom() { return byte() >= 240; }
  /// Now and then any bit pattern, mostly something near what makes sense.
  double number() {
    const int kind = byte();
    if (kind >= 232) {
      std::uint64_t bits = 0;
      for (int i = 0; i < 8; ++i) bits = bits << 8 | byte();
      return treadmark::bit_cast<double>(bits);
    }
    constexpr double kSpecial[] = {0.0,
                                   -1.0,
                                   1.0,
                                   1e-3,
                                   -1e-3,
                                   1e300,
                                   1e-9,
                                   2e9,
                                   std::numeric_limits<double>::infinity(),
                                   0.46,
                                   3e-3,
                                   80e3,
                                   std::numeric_limits<double>::quiet_NaN()};
    return kSpecial[static_cast<std::size_t>(kind) % std::size(kSpecial)] * (1.0 + 0.01 * (byte() % 16));
  }
  std::size_t index() {
    const std::uint8_t i = byte();
    return i >= 240 ? std::numeric_limits<std::size_t>::max() : i % 3;
  }
  double radius() { return seldom() ? number() : 0.46; }
  const char* name() {
    const std::uint8_t i = byte();
    return i >= 240 ? nullptr : kNames[i % std::size(kNames)];
  }
  template <class Handle>
  Handle*& slot(Slots<Handle>& slots) {
    return slots[byte() % kSlots];
  }
  tm_body body() {
    const std::uint8_t i = byte();
    return static_cast<tm_body>(i >= 240 ? 7 : i % 2);
  }

  /// After a call that makes an object, which is made while the arguments are.
  template <class Handle>
  void keep(tm_status status, Handle*& made, Slots<Handle>& slots, void (*free_it)(Handle*)) {
    must((status > TM_FAILED) == (made == nullptr), "an object is there exactly when the call did not fail");
    must(status <= TM_FAILED || *tm_message() != '\0', "a failure says why");
    must(status != TM_INTERNAL, "nothing that a caller does is an error in Treadmark");
    if (made == nullptr) return;
    Handle*& place = slot(slots);
    free_it(place);
    place = made;
  }
  void checked(tm_status status) {
    must(status <= TM_FAILED || *tm_message() != '\0', "a failure says why");
    must(status != TM_INTERNAL, "nothing that a caller does is an error in Treadmark");
  }

  /// Small enough for a fuzzer.
  static void limit(tm_case* c) {
    tm_case_set_number(c, "discretisation.max_elements", 1000);
    for (const char* n : {"patch.mx", "patch.my"}) {
      double value = 0.0;
      if (tm_case_get_number(c, n, &value) == TM_OK && value > 12) tm_case_set_number(c, n, 12);
    }
  }

  void call(int which);
  void look_at(tm_solution* s);
  void some_surface();

  const std::uint8_t* data_;
  static constexpr std::size_t kRecord = 12;
  std::size_t size_, at_ = 0, next_ = 0;
  int solved_ = 0, represented_ = 0;
  Slots<tm_case> cases_{};
  Slots<tm_surface> surfaces_{};
  Slots<tm_pair> pairs_{};
  Slots<tm_patch> patches_{};
  Slots<tm_solution> solutions_{};
  Slots<tm_state> states_{};
};

void Calls::look_at(tm_solution* s) {
  const char* message = tm_solution_message(s);
  double value = 0.0;
  checked(tm_solution_number(s, name(), &value));
  must(std::strlen(message) < 10000, "a text that is lent stays");
  const std::size_t patch = index();
  checked(tm_patch_number(s, patch, name(), &value));
  int nx = 0, ny = 0;
  const tm_status found = tm_patch_grid(s, patch, &nx, &ny, nullptr, nullptr, nullptr, nullptr);
  checked(found);
  const double* field = nullptr;
  if (tm_patch_field(s, patch, name(), &field) == TM_OK && field != nullptr && found == TM_OK) {
    double sum = 0.0;
    for (int i = 0; i < nx * ny; ++i) sum += field[i];
    must(tm_solution_status(s) != TM_OK || std::isfinite(sum) || std::isnan(sum), "no field is infinite");
  }
  const char *remark = nullptr, *text = nullptr;
  checked(tm_solution_remark(s, index(), &remark, &text, nullptr, nullptr));
  must((remark == nullptr) == (text == nullptr), "a remark has name and text");
}

void Calls::some_surface() {
  tm_surface* made = nullptr;
  const std::size_t n = 30 - byte() % 31;
  std::vector<double> y(n), z(n);
  for (std::size_t i = 0; i < n; ++i) {
    y[i] = seldom() ? number() : 2e-3 * static_cast<double>(i) - 0.03;
    z[i] = seldom() ? number() : 2.0 * y[i] * y[i];
  }
  tm_status status = TM_OK;
  int kind = byte() % 8;
  switch (byte() % 4) {
    case 0:
      status = tm_surface_from_profile(body(), y.data(), z.data(), n, radius(), seldom() ? number() : 0.0, &made);
      break;
    case 1: {
      std::vector<double> u{0.0, 0.1, seldom() ? number() : 0.2};
      std::vector<double> ys, zs;
      for (std::size_t i = 0; i < u.size(); ++i)
        ys.insert(ys.end(), y.begin(), y.end()), zs.insert(zs.end(), z.begin(), z.end());
      status = tm_surface_from_slices(body(), u.data(), u.size(), ys.data(), zs.data(), n, radius(), &made);
      break;
    }
    case 2: {
      const double xyz[] = {0, 0, 0, 0.1, 0, 0, 0, 0.1, 0, 0.1, 0.1, seldom() ? number() : 0.0};
      const std::int32_t corners[] = {0, 2, 1, 1, 2, seldom() ? byte() - 128 : 3};
      status = tm_surface_from_triangles(body(), xyz, 4, corners, 2, radius(), &made);
      break;
    }
    default:
      status = tm_surface_from_function(body(), seldom() ? nullptr : heights, &kind, -0.1, seldom() ? number() : 0.1,
                                        byte() % 20, -0.02, 0.02, byte() % 20, number(), &made);
  }
  keep(status, made, surfaces_, tm_surface_free);
}

void Calls::call(int which) {
  tm_case* c = nullptr;
  tm_surface* surface = nullptr;
  tm_pair* pair = nullptr;
  tm_patch* patch = nullptr;
  tm_solution* solution = nullptr;
  tm_state* state = nullptr;
  double value = 0.0;
  constexpr int kMostSolved = 6, kMostRepresented = 1;
  switch (which) {
    case 0:
      return keep(tm_case_create(byte() % 3, &c), c, cases_, tm_case_free);
    case 1:
    case 2: {
      const std::string& text = which == 2 ? kPatch : kWheelRail;
      const std::size_t size = text.size() - (seldom() ? byte() : 0);
      return keep(tm_case_parse(text.data(), size, nullptr, seldom() ? 2 : 1, &c), c, cases_, tm_case_free);
    }
    case 3: {
      const std::size_t n = std::min<std::size_t>(byte(), size_ - next_);  // the bytes behind the record
      const char* text = reinterpret_cast<const char*>(data_ + next_);
      next_ += n;
      return keep(tm_case_parse(text, n, "", 1, &c), c, cases_, tm_case_free);
    }
    case 4:
      return keep(tm_case_copy(slot(cases_), &c), c, cases_, tm_case_free);
    case 5:
    case 6:
      return checked(tm_case_set(slot(cases_), seldom() ? nullptr : kAssignments[byte() % std::size(kAssignments)]));
    case 7:
    case 8: {
      const char* key = nullptr;
      if (tm_list(static_cast<tm_table>(0), byte() + 256u * (byte() % 2), &key, nullptr, nullptr) != TM_OK)
        key = name();
      return checked(tm_case_set_number(slot(cases_), key, number()));
    }
    case 9:
      return checked(tm_case_set_number_by_id(slot(cases_), static_cast<std::int8_t>(byte()) * 3, number()));
    case 10:
      return checked(tm_case_get_number(slot(cases_), name(), &value));
    case 11:
      return some_surface();
    case 12:
    case 13:
      return keep(tm_surface_of_case(slot(cases_), body(), &surface), surface, surfaces_, tm_surface_free);
    case 14:
      if (++represented_ > kMostRepresented) return;
      return keep(
          tm_surface_represent(slot(surfaces_), seldom() ? "marble" : "spline", seldom() ? number() : 5e-3, &surface),
          surface, surfaces_, tm_surface_free);
    case 15: {
      const double x[] = {number(), 0.0, 0.01}, y[] = {0.01, number(), -0.02}, origin[] = {number(), 0.0, 0.0};
      const double turned[] = {1, 0, 0, 0, number(), 0, 0, 0, 1};
      double z[3], dzdx[3];
      return checked(tm_surface_heights(slot(surfaces_), byte() % 2 == 0 ? nullptr : origin,
                                        byte() % 4 == 0 ? turned : nullptr, x, y, 3, byte() % 2 == 0 ? nullptr : z,
                                        dzdx, nullptr));
    }
    case 16:
    case 17: {
      const tm_surface *rail = slot(surfaces_), *wheel = surfaces_[(byte() + 1u) % kSlots];
      return keep(tm_pair_create(rail, wheel, &pair), pair, pairs_, tm_pair_free);
    }
    case 18:
      return keep(tm_pair_of_case(slot(cases_), &pair), pair, pairs_, tm_pair_free);
    case 19:
    case 20: {
      if (++solved_ > kMostSolved) return;
      tm_case* given = slot(cases_);
      tm_pair* with = slot(pairs_);
      limit(given);
      const tm_status status = tm_pair_solve(with, given, &solution);
      must(solution == nullptr || tm_solution_status(solution) == status, "the solution knows its status");
      return keep(status, solution, solutions_, tm_solution_free);
    }
    case 21:
      return checked(tm_pair_reset(slot(pairs_)));
    case 22:
      return keep(tm_pair_save(slot(pairs_), &state), state, states_, tm_state_free);
    case 23:
      return checked(tm_pair_restore(slot(pairs_), slot(states_)));
    case 24: {
      std::size_t size = 0;
      tm_state* from = slot(states_);
      if (tm_state_to_bytes(from, nullptr, &size) != TM_OK) return;
      std::vector<unsigned char> bytes(size);
      checked(tm_state_to_bytes(from, bytes.data(), &size));
      for (int i = byte() % 4; i > 0 && size > 0; --i) bytes[(byte() * 256u + byte()) % size] = byte();
      return keep(tm_state_from_bytes(bytes.data(), size - std::min<std::size_t>(size, byte() % 3), &state), state,
                  states_, tm_state_free);
    }
    case 25:
      return keep(tm_patch_create(&patch), patch, patches_, tm_patch_free);
    case 26:
    case 27: {
      if (++solved_ > kMostSolved) return;
      tm_case* given = slot(cases_);
      tm_patch* with = slot(patches_);
      limit(given);
      return keep(tm_patch_solve(with, given, &solution), solution, solutions_, tm_solution_free);
    }
    case 28:
      return look_at(slot(solutions_));
    case 29: {
      tm_case*& freed = slot(cases_);
      tm_case_free(freed);
      freed = nullptr;
      return;
    }
    default: {
      tm_surface*& freed = slot(surfaces_);
      tm_surface_free(freed);
      freed = nullptr;
      return;
    }
  }
}

}  // namespace

TREADMARK_FUZZ_TARGET(fuzz_c_calls) {
  const Patience patience;
  Calls(data, size).run();
  return 0;
}
