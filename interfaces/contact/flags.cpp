// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/interfaces/contact/flags.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/interfaces/contact/calls.hpp"
#include "treadmark/interfaces/contact/log.hpp"

namespace treadmark::contact {
namespace {

using Outside = FlagRow::Outside;
constexpr int kMost = std::numeric_limits<int>::max();

// keep: a value out of range leaves the flag alone.
constexpr FlagRow kFlagRows[] = {{Outside::clamp, CNTC_ic_config, 0, 5, 1},
                                 {Outside::clamp, CNTC_ic_pvtime, 0, 3, 2},
                                 {Outside::clamp, CNTC_ic_bound, 0, 6, 0},
                                 {Outside::clamp, CNTC_ic_tang, 0, 3, 3},
                                 {Outside::clamp, CNTC_ic_norm, 0, 1, 0},
                                 {Outside::clamp, CNTC_ic_force, 0, 3, 0},
                                 {Outside::keep, CNTC_ic_discns, 2, 9, 2},
                                 {Outside::keep, CNTC_ic_inflcf, 2, 4, 2},
                                 {Outside::clamp, CNTC_ic_exrhs, 0, 3, 0},
                                 {Outside::clamp, CNTC_ic_xflow, 0, kMost, 0},
                                 {Outside::clamp, CNTC_ic_iestim, 0, 3, 0},
                                 {Outside::clamp, CNTC_ic_output, 0, 5, 0},
                                 {Outside::clamp, CNTC_ic_flow, 0, 9, 1},
                                 {Outside::clamp, CNTC_ic_return, 0, 3, 1},
                                 {Outside::zero, CNTC_ic_matfil, 0, 2, 0},
                                 {Outside::clamp, CNTC_ic_sens, 0, 3, 1},
                                 {Outside::clamp, CNTC_ic_ifmeth, 0, 1, 0},
                                 {Outside::clamp, CNTC_ic_ifvari, 1, 4, 4},
                                 {Outside::clamp, CNTC_ic_sbsout, 0, 4, 0},
                                 {Outside::zero, CNTC_ic_sbsfil, 0, 2, 0},
                                 {Outside::raise, CNTC_ic_npomax, 100, 1000000, 20000},
                                 {Outside::clamp, CNTC_if_wrtinp, 0, 1, 0},
                                 {Outside::clamp, CNTC_if_timers, 0, 2, 0},
                                 {Outside::clamp, CNTC_if_ncase, 0, kMost, 0}};
static_assert(std::size(kFlagRows) == 24);

std::size_t row_of(int code) {
  return static_cast<std::size_t>(ranges::find(kFlagRows, code, &FlagRow::code) - std::begin(kFlagRows));
}

void set_units(Problem& p, int code) {
  if (!units_of(code, p.units)) return warn(fmt::format("WARNING: there are no units {}", code));
  if (code == CNTC_un_imper) warn("WARNING: imperial units are not available, CONTACT's are used");
}

void set_flag(Problem& p, int code, int value) {
  if (code == CNTC_ic_mater)
    return warn("ERROR: M (MATER) is set by cntc_setmaterialparameters, not by cntc_setflags; ignored");
  const std::size_t row = row_of(code);
  if (row == std::size(kFlagRows)) return warn(fmt::format("WARNING: the flag {} cannot be set", code));
  const FlagRow& flag = kFlagRows[row];
  if (value < flag.least || value > flag.greatest) {
    if (flag.outside == Outside::keep) return;
    if (flag.outside == Outside::raise)
      warn(fmt::format("WARNING: {} elements of a potential contact are taken as {}", value,
                       std::clamp(value, flag.least, flag.greatest)));
    value = flag.outside == Outside::zero ? 0 : std::clamp(value, flag.least, flag.greatest);
  }
  if (code == CNTC_ic_sbsout && value == 3) value = 2;
  if (code == CNTC_ic_force && p.module == 3) value = std::min(value, 2);
  if (code == CNTC_if_ncase) value = std::max(value, 1) - 1;  // that of the last one
  p.flags.at(code) = value;
}

int flag_of(const Problem& p, int patch, int code) {
  switch (code) {
    case CNTC_ic_frclaw:
      return p.friction_digit;
    case CNTC_ic_heat:
      return p.heat_digit;
    case CNTC_ic_mater:
      return p.material_digit;
    case CNTC_ic_force:
      return p.module == 1 && patch >= 0 ? 0 : p.flags[code];  // creepages of a patch are known
    case CNTC_ic_xflow:
      return p.flags[code] > 0 ? 1 : 0;
    default:
      return p.flags[code];
  }
}

bool can_be_asked(int code) {
  return code == CNTC_ic_frclaw || code == CNTC_ic_heat || code == CNTC_ic_mater ||
         (code != CNTC_if_timers && row_of(code) < std::size(kFlagRows));
}

void refuse_counts(const char* what, std::size_t ints, std::size_t reals) {
  throw Refusal{CNTC_err_input, fmt::format("{} integers and {} reals do not belong to G = {}", ints, reals, what)};
}

/// Treadmark's solvers stop when they are done; their own limits serve where a caller's are lower.
void set_solver(Problem& p, int g, std::span<const int> ints, std::span<const double> reals) {
  constexpr std::size_t kInts[] = {4, 0, 5, 5, 5, 5, 1}, kReals[] = {1, 0, 4, 4, 2, 8, 1};
  if (g < 0 || g > 6 || ints.size() != kInts[g] || reals.size() != kReals[g])
    refuse_counts(std::to_string(g).c_str(), ints.size(), reals.size());
  require_finite(reals, "rparam");
  if (g == 1 || g == 6) return;
  SolverSettings& s = p.given.solver;
  const SolverSettings usual;
  s.max_iterations = std::max(ints[0], usual.max_iterations);
  s.max_outer = std::max(ints[1], usual.max_outer);
  s.max_force = std::max(ints[2], usual.max_force);
  s.max_coupling = std::max(ints[3], 1);
  s.eps = std::max(reals[0], 1e-20);
  s.method = g == 2 ? SolverSettings::Method::sweeps : SolverSettings::Method::automatic;
  using First = SolverSettings::FirstSlip;
  s.first_slip = (g == 2 || g == 4) && ints[4] != 0 ? (ints[4] > 0 ? First::below : First::above) : First::last;
}

}  // namespace

std::span<const FlagRow> flag_rows() { return kFlagRows; }

Flags::Flags() {
  for (std::size_t i = 0; i < values_.size(); ++i) values_[i] = kFlagRows[i].initial;
}

int Flags::operator[](int code) const {
  const std::size_t row = row_of(code);
  return row < values_.size() ? values_[row] : 0;
}

int& Flags::at(int code) { return values_.at(row_of(code)); }

}  // namespace treadmark::contact

using namespace treadmark::contact;

void cntc_setflags(int* ire, int* icp, int* lenflg, int* params, int* values) {
  on_problem("cntc_setflags", ire, icp, For::whole, [&](Active& a) {
    const auto codes = array(params, lenflg, "params"), given = array(values, lenflg, "values");
    for (std::size_t i = 0; i < codes.size(); ++i) switch (codes[i]) {
        case 0:
          break;
        case CNTC_if_units:
          set_units(a.problem, given[i]);
          break;
        case CNTC_if_idebug:
        case CNTC_if_licdbg:
        case CNTC_if_openmp:
          set_global_flags(codes.subspan(i, 1), given.subspan(i, 1));
          break;
        default:
          set_flag(a.problem, codes[i], given[i]);
      }
  });
}

void cntc_getflags(int* ire, int* icp, int* nparam, int* iparam, int* values) {
  on_problem("cntc_getflags", ire, icp, For::any, [&](Active& a) {
    const auto codes = array(iparam, nparam, "iparam"), out = room(values, nparam, "values");
    if (a.problem.module == 1 && a.patch >= 0) a.result();
    for (std::size_t i = 0; i < codes.size() && i < out.size(); ++i) {
      if (codes[i] == 0) continue;
      if (can_be_asked(codes[i]))
        out[i] = flag_of(a.problem, a.patch, codes[i]);
      else
        warn(fmt::format("WARNING: the flag {} cannot be asked for", codes[i]));
    }
  });
}

void cntc_setmetadata(int* ire, int* icp, int* lenmta, int* params, double* values) {
  on_problem("cntc_setmetadata", ire, icp, For::whole, [&](Active& a) {
    const auto codes = array(params, lenmta, "params");
    const auto given = array(values, lenmta, "values");
    require_finite(given, "values");
    for (std::size_t i = 0; i < codes.size(); ++i) {
      const int code = codes[i];
      if (code == 0) continue;
      const bool whole = code >= CNTC_mt_run && code <= CNTC_mt_side;
      if (whole || (code >= CNTC_mt_tim && code <= CNTC_mt_sw))
        a.problem.metadata[code] = whole ? std::round(given[i]) : given[i];
      else
        warn(fmt::format("WARNING: there are no metadata {}", code));
    }
  });
}

void cntc_setsolverflags(int* ire, int* icp, int* gdigit, int* nints, int* iparam, int* nreals, double* rparam) {
  on_problem("cntc_setsolverflags", ire, icp, For::whole, [&](Active& a) {
    set_solver(a.problem, need(gdigit, "gdigit"), array(iparam, nints, "iparam"), array(rparam, nreals, "rparam"));
  });
}
