// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "treadmark/interfaces/contact/contact_addon.h"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {

/// A number whose address lives as long as the call.
struct Int {
  int value;
  operator int*() { return &value; }
};
struct Real {
  double value;
  operator double*() { return &value; }
};

struct Ints : std::vector<int> {
  using vector::vector;
  operator int*() { return data(); }
  Int count() const { return {static_cast<int>(size())}; }
};
struct Reals : std::vector<double> {
  using vector::vector;
  operator double*() { return data(); }
  Int count() const { return {static_cast<int>(size())}; }
};

/// The library between its start and its end; its files go into a folder of its own.
class Library {
 public:
  explicit Library(const std::string& work = "") {
    const std::string out = folder_.path().string();
    cntc_initializefirst(&version, &error, Int{0}, work.c_str(), out.c_str(), " ", Int{static_cast<int>(work.size())},
                         Int{static_cast<int>(out.size())}, Int{1});
  }
  ~Library() { cntc_finalizelast(); }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;

  const std::filesystem::path& folder() const { return folder_.path(); }
  std::string log() const;

  int version = -1, error = -1;

 private:
  TemporaryFolder folder_;
};

inline void set_flags(int ire, int icp, std::initializer_list<std::pair<int, int>> flags) {
  Ints codes, values;
  for (const auto& [code, value] : flags) {
    codes.push_back(code);
    values.push_back(value);
  }
  cntc_setflags(Int{ire}, Int{icp}, codes.count(), codes, values);
}

inline int flag(int ire, int icp, int code) {
  int value = -999;
  cntc_getflags(Int{ire}, Int{icp}, Int{1}, Int{code}, &value);
  return value;
}

inline int calculate(int ire, int icp) {
  int error = -999;
  cntc_calculate(Int{ire}, Int{icp}, &error);
  return error;
}

/// The answer of a getter of an array.
inline Reals answer(int count, void (*get)(int*, int*, int*, double*), int ire, int icp) {
  Reals out(static_cast<std::size_t>(count), -999.0);
  get(Int{ire}, Int{icp}, Int{count}, out);
  return out;
}

inline double value_of(void (*get)(int*, int*, double*), int ire, int icp) {
  double value = -999.0;
  get(Int{ire}, Int{icp}, &value);
  return value;
}

struct Triple {
  double a = -999.0, b = -999.0, c = -999.0;
};
inline Triple triple_of(void (*get)(int*, int*, double*, double*, double*), int ire, int icp) {
  Triple t;
  get(Int{ire}, Int{icp}, &t.a, &t.b, &t.c);
  return t;
}

struct Forces {
  double fn = -999.0, fx = -999.0, fy = -999.0, mz = -999.0;
};
inline Forces forces_of(int ire, int icp) {
  Forces f;
  cntc_getcontactforces(Int{ire}, Int{icp}, &f.fn, &f.fx, &f.fy, &f.mz);
  return f;
}

/// 4 x 4, [column][row].
inline std::vector<Reals> sensitivities_of(int ire, int icp) {
  Reals all(16, -999.0);
  cntc_getsensitivities(Int{ire}, Int{icp}, Int{4}, Int{4}, all);
  std::vector<Reals> columns;
  for (int k = 0; k < 4; ++k) columns.emplace_back(all.begin() + 4 * k, all.begin() + 4 * (k + 1));
  return columns;
}

/// Tolerances of the comparison with the library version of CONTACT.
inline constexpr double kForce = 0.005, kArea = 0.03, kCreepage = 0.005, kSensitivity = 0.05, kStress = 0.01;

}  // namespace treadmark::testing
