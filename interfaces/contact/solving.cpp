// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>

#include "treadmark/app/cases/contact_program/element_table.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/interfaces/contact/calls.hpp"
#include "treadmark/interfaces/contact/input_file.hpp"
#include "treadmark/interfaces/contact/log.hpp"
#include "treadmark/io/results/contact_program/write_mat.hpp"
#include "treadmark/io/results/contact_program/write_subs.hpp"

namespace treadmark::contact {
namespace {

/// Elements in contact along the border of the grid, counted as callers know it: a direction with fewer than three
/// elements has no border, unless both have so few.
int border_elements(const io::PatchFields& f) {
  const Grid2& g = f.grid;
  constexpr int kFew = 3;
  const bool few = g.nx < kFew && g.ny < kFew;
  int count = 0;
  for (int iy = 0; iy < g.ny; ++iy)
    for (int ix = 0; ix < g.nx; ++ix) {
      const bool at_end = (g.nx >= kFew || few) && (ix == 0 || ix == g.nx - 1);
      const bool at_side = (g.ny >= kFew || few) && (iy == 0 || iy == g.ny - 1);
      if ((at_end || at_side) && f.state[g.index(ix, iy)] != 0) ++count;
    }
  return count;
}

void solve_rail(Problem& p, const io::Case& c) {
  const auto& input = std::get<io::WheelRailCase>(c.content);
  const wheelrail::Geometry geometry = surfaces(p, input);
  if (!p.pair || p.geometry.rail != geometry.rail || p.geometry.wheel != geometry.wheel) {
    const auto history = p.pair ? p.pair->save() : nullptr;
    p.pair.emplace(geometry);
    p.pair->restore(history);
    p.geometry = geometry;
  }
  p.solution = p.pair->solve(app::to_problem(input, geometry.round_wheel));
  p.result = app::to_result(input, *p.solution);
}

/// What to tell of a solution of a wheel on a rail.
int code_of_rail(const Problem& p) {
  const bool force = p.flags[CNTC_ic_norm] == 1;
  switch (p.result->status) {
    case Status::ok:
      return 0;
    case Status::no_contact:
      return force ? CNTC_err_ftot : 0;
    case Status::failed:
      return force ? CNTC_err_ftot : CNTC_err_search;
    case Status::not_converged:
      for (const wheelrail::PatchSolution& patch : p.solution->patches) {
        if (patch.contact.normal.status != Status::ok) return CNTC_err_norm;
        if (patch.contact.tangential.status != Status::ok) return CNTC_err_tang;
      }
      return CNTC_err_tol;
  }
  return CNTC_err_other;
}

/// A patch without contact: callers ask for its forces and fields all the same.
io::PatchResult empty_patch(const io::BasicCase& c) {
  io::PatchResult r;
  r.approach = c.approach;
  r.xi = c.xi, r.eta = c.eta, r.phi = c.phi;
  io::PatchFields& f = r.fields;
  f.grid = {c.x0, c.y0, c.dx, c.dy, c.mx, c.my};
  f.state.assign(f.grid.size(), 0);
  f.pressure.assign(f.grid.size(), 0.0);
  if (const auto* gap = std::get_if<io::GapInput>(&c.geometry)) f.gap = app::gap_of_formula(*gap, f.grid);
  return r;
}

void solve_basic(Problem& p, const io::BasicCase& c) {
  p.result = p.basic.solve(c);
  if (p.result->status == Status::no_contact) p.result->patches = {empty_patch(c)};
}

int code_of_basic(const io::CaseResult& result) {
  switch (result.status) {
    case Status::ok:
      return result.patches.empty() ? 0 : border_elements(result.patches.front().fields);
    case Status::no_contact:
      return 0;
    case Status::not_converged:
      return CNTC_err_tang;
    case Status::failed:
      return CNTC_err_norm;
  }
  return CNTC_err_other;
}

std::string stem_of(const Problem& p) {
  const std::string stem = fmt::format("{}caddon_re{:03}", folders().out, p.element);
  return p.module == 1 ? stem : fmt::format("{}_cp{}", stem, p.number);
}

void write_tables(const Problem& p, const io::Case& c) {
  if (c.element_table == 0) return;
  for (std::size_t k = 0; k < p.result->patches.size(); ++k) {
    io::MatFileHead head = p.solution ? app::mat_head(std::get<io::WheelRailCase>(c.content), *p.solution, k, c.number)
                                      : app::mat_head(std::get<io::BasicCase>(c.content), c.number);
    if (const auto time = p.metadata.find(CNTC_mt_tim); time != p.metadata.end()) head.time = time->second;
    const int letter = p.module == 1 ? static_cast<int>(k) + 1 : 0;
    io::write_mat(io::case_file_name(stem_of(p), c.number, letter, "mat"), head, p.result->patches[k],
                  c.element_table > 1);
  }
}

void log_solution(const Problem& p, const io::Case& c, int code) {
  std::string text = fmt::format("case {} of result element {}", c.number, p.element);
  if (p.module == 3) text += fmt::format(", contact problem {}", p.number);
  text += fmt::format(": code {}, {} patches", code, p.result->patches.size());
  if (!p.result->message.empty()) text += "; " + p.result->message;
  for (const Remark& remark : p.result->remarks) text += "\n  " + remark.text;
  for (const io::PatchResult& patch : p.result->patches)
    text += fmt::format("\n  F_n {:.6g} N, F_x {:.6g} N, F_s {:.6g} N, approach {:.6g} mm, p_max {:.6g} MPa", patch.fn,
                        patch.fx, patch.fs, 1e3 * patch.approach, 1e-6 * patch.pmax);
  log(code < 0 || any_grave(p.result->remarks) ? Detail::warning : Detail::calls, text);
}

int solve(Problem& p) {
  constexpr int kCheckOnly = 2;
  p.result.reset();
  p.solution.reset();
  if (!p.previous && p.flags[CNTC_ic_pvtime] != 2)
    warn(fmt::format("WARNING: P (PVTIME) = {} of the first case is taken as 2", p.flags[CNTC_ic_pvtime]));
  io::Case c = compose(p);
  if (p.module == 1 && p.flags[CNTC_ic_return] >= kCheckOnly) {
    surfaces(p, std::get<io::WheelRailCase>(c.content));
    return 0;
  }
  p.flags.at(CNTC_if_ncase) = c.number;
  if (p.flags[CNTC_if_wrtinp] != 0) write_input(p, c);
  if (p.module == 1)
    solve_rail(p, c);
  else
    solve_basic(p, std::get<io::BasicCase>(c.content));
  const int code = p.module == 1 ? code_of_rail(p) : code_of_basic(*p.result);
  log_solution(p, c, code);
  if (code < 0 && code != CNTC_err_tol) {
    p.result.reset();
    p.solution.reset();
    return code;
  }
  write_tables(p, c);
  p.previous = std::move(c);
  return code;
}

int code_of(const Error& error) {
  switch (error.kind()) {
    case ErrorKind::configuration:
      return CNTC_err_input;
    case ErrorKind::input_data:
      return CNTC_err_profil;
    case ErrorKind::numerical:
      return CNTC_err_other;
  }
  return CNTC_err_other;
}

/// Marks a problem as being solved while it lives.
class Solving {
 public:
  explicit Solving(std::atomic<bool>& flag) : flag_(flag) {
    if (flag_.exchange(true)) throw Refusal{CNTC_err_busy, "the problem is being solved by another thread"};
  }
  ~Solving() { flag_ = false; }
  Solving(const Solving&) = delete;
  Solving& operator=(const Solving&) = delete;

 private:
  std::atomic<bool>& flag_;
};

void timed_solve(Problem& p, int* ierror) {
  const auto wall = std::chrono::steady_clock::now();
  const std::clock_t cpu = std::clock();
  int code = CNTC_err_other;
  try {
    code = solve(p);
  } catch (const Error& error) {
    p.result.reset();
    p.solution.reset();
    throw Refusal{code_of(error), error.what()};
  }
  const double share = 1.0 / static_cast<double>(std::max<std::size_t>(1, p.result ? p.result->patches.size() : 1));
  const double cpu_s = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC,
               wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  const std::size_t patches = p.result ? std::max<std::size_t>(1, p.result->patches.size()) : 1;
  for (std::size_t k = 0; k < patches; ++k) {
    Stopwatch& watch = p.times[static_cast<int>(k)];
    watch.cpu += cpu_s * share;
    watch.wall += wall_s * share;
  }
  put(ierror, code);
}

void calculate(const char* function, const int* ire, const int* icp, For what, int* ierror) noexcept {
  guarded(function, ierror, [&] {
    Active a = activate(ire, icp, what, false);
    const Solving solving(a.problem.solving);
    const std::lock_guard lock(a.problem.mutex);
    timed_solve(a.problem, ierror);
  });
}

/// Where callers know no other code for it.
void hide_misuse(int* ierror) {
  if (ierror != nullptr && *ierror <= bad_element) *ierror = CNTC_err_icp;
}

// Below the surface.

constexpr std::size_t kMostBlocks = 10;
constexpr double kMostPlaces = 9999.0;

std::vector<double> lengths(std::span<const double> values, double unit) {
  require_finite(values, "coordinates");
  if (static_cast<double>(values.size()) > kMostPlaces || values.empty())
    throw Refusal{CNTC_err_input, "a block needs 1 to 9999 coordinates a direction"};
  std::vector<double> out;
  for (const double value : values) out.push_back(value * unit);
  return out;
}

/// Numbers of elements from 1, as indices from 0, sorted, each once.
std::vector<int> indices(std::span<const double> values) {
  require_finite(values, "element numbers");
  std::vector<int> out;
  for (const double value : values)
    if (value >= 1.0 && value <= 1e6) out.push_back(to_whole<int>(std::round(value)) - 1);
  ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  if (out.empty() || static_cast<double>(out.size()) > kMostPlaces)
    throw Refusal{CNTC_err_input, "a block needs 1 to 9999 element numbers a direction"};
  return out;
}

std::vector<int> range(std::span<const double> values) {
  require_finite(values, "element numbers");
  if (values.size() < 3) throw Refusal{CNTC_err_input, "a range of elements has first, step and last number"};
  std::vector<double> list;
  const double step = std::max(1.0, std::round(values[1]));
  for (double i = std::max(1.0, values[0]); i <= values[2] && static_cast<double>(list.size()) <= kMostPlaces;
       i += step)
    list.push_back(i);
  return indices(list);
}

io::SubsurfaceInput::Block block_of(int kind, std::span<const double> x, std::span<const double> y,
                                    std::span<const double> z, double unit) {
  constexpr int kRange = 2, kList = 3, kDepths = 4, kFree = 9;
  if (kind < 1 || kind == kDepths || kind == 8 || kind > kFree)
    throw Refusal{CNTC_err_input, fmt::format("there is no ISUBS = {}", kind)};
  io::SubsurfaceInput::Block block;
  block.at_elements = kind != kFree;
  if (kind == kFree) {
    block.x = lengths(x, unit);
    block.y = lengths(y, unit);
  } else if (kind % kDepths == kRange) {
    block.columns = range(x);
    block.rows = range(y);
  } else if (kind % kDepths == kList) {
    block.columns = indices(x);
    block.rows = indices(y);
  }
  if (kind > kDepths) {
    block.z = lengths(z, unit);
    return block;
  }
  constexpr double kThinnest = 1e-12;  // [m]
  require_finite(z, "z");
  if (z.size() < 3 || !(z[0] >= 1.0 && z[0] <= kMostPlaces))
    throw Refusal{CNTC_err_input, "planes have number, first depth and step"};
  const double step = std::max(z[2] * unit, kThinnest);
  for (int k = 0; k < to_whole<int>(std::round(z[0])); ++k) block.z.push_back(z[1] * unit + k * step);
  return block;
}

const SubsurfaceBlocks& blocks_for(const Problem& p, int patch) {
  const auto own = p.blocks_of_patch.find(patch);
  return p.module == 1 && own != p.blocks_of_patch.end() ? own->second : p.blocks;
}

Material material_of(const io::Case& c) {
  return std::visit([](const auto& content) { return content.material; }, c.content);
}

/// Points of a block in each direction: those that were computed, else those that will be.
std::array<int, 3> block_size(const Problem& p, int patch, int number) {
  const SubsurfaceBlocks& blocks = blocks_for(p, patch);
  if (number < 1 || static_cast<std::size_t>(number) > blocks.size()) return {-1, -1, -1};
  const std::size_t k = static_cast<std::size_t>(number) - 1;
  const io::PatchResult* r = patch_result(p, patch);
  if (r != nullptr && k < r->subsurface.size()) return {r->subsurface[k].nx, r->subsurface[k].ny, r->subsurface[k].nz};
  const io::SubsurfaceInput::Block& block = blocks[k];
  const auto size = [](const auto& list) { return static_cast<int>(list.size()); };
  if (!block.at_elements) return {size(block.x), size(block.y), size(block.z)};
  const Grid2 grid = r != nullptr ? r->fields.grid : Grid2{0.0, 0.0, 1.0, 1.0, p.given.basic.mx, p.given.basic.my};
  const auto there = [](const std::vector<int>& list, int count) {
    return list.empty() ? count : static_cast<int>(ranges::count_if(list, [&](int i) { return i < count; }));
  };
  return {there(block.columns, grid.nx), there(block.rows, grid.ny), size(block.z)};
}

void solve_below(Problem& p, int patch) {
  if (!p.result || !p.previous) throw Refusal{CNTC_err_icp, "there is no solution"};
  io::PatchResult& r = p.result->patches.at(static_cast<std::size_t>(patch));
  kalker::ContactSolution tractions;
  tractions.pressure = r.fields.pressure;
  tractions.traction_x = r.fields.traction_x;
  tractions.traction_y = r.fields.traction_s;
  std::vector<io::SubsurfaceBlock> found;
  r.subsurface.clear();
  const SubsurfaceBlocks& blocks = blocks_for(p, patch);
  for (const io::SubsurfaceInput::Block& block : blocks) {
    constexpr double kMostBelow = 1e7;
    const auto size = block_size(p, patch, static_cast<int>(&block - blocks.data()) + 1);
    if (1.0 * size[0] * size[1] * size[2] > kMostBelow) throw Refusal{CNTC_err_input, "a block has too many points"};
    r.subsurface.clear();
    app::add_subsurface({{block}, false, false}, material_of(*p.previous), r.fields.grid, tractions, r,
                        {r.reference_x, r.reference_s});
    found.push_back(r.subsurface.empty() ? io::SubsurfaceBlock{} : std::move(r.subsurface.front()));
  }
  r.subsurface = std::move(found);
  const int file = p.flags[CNTC_ic_sbsfil];
  if (file == 0 || r.subsurface.empty()) return;
  io::write_subs(io::case_file_name(stem_of(p), p.previous->number, p.module == 1 ? patch + 1 : 0, "subs"),
                 r.subsurface, file == 2);
}

/// A column of the table of results.
double subsurface_number(const io::SubsurfaceValue& v, int column, const Units& u) {
  const auto vector = [&](const Vec3& of, int first) { return of[column - first]; };
  constexpr double kUnknown = -999.0;
  if (column >= 1 && column <= 3) return vector(v.point, 1) / u.length;
  if (column >= 4 && column <= 6) return vector(v.displacement, 4) / u.length;
  if (column == 7) return v.hydrostatic / u.stress();
  if (column == 8) return v.von_mises / u.stress();
  if (column == 9) return v.tresca / u.stress();
  if (column >= 10 && column <= 12) return vector(v.principal, 10) / u.stress();
  if (column >= 13 && column <= 21) return v.stress((column - 13) % 3, (column - 13) / 3) / u.stress();
  return kUnknown;
}

}  // namespace
}  // namespace treadmark::contact

using namespace treadmark::contact;

void cntc_calculate(int* ire, int* icp, int* ierror) {
  calculate("cntc_calculate", ire, icp, For::whole, ierror);
  hide_misuse(ierror);
}

void cntc_calculate1(int* ire, int* ierror) { calculate("cntc_calculate1", ire, nullptr, For::rail, ierror); }

void cntc_calculate3(int* ire, int* icp, int* ierror) { calculate("cntc_calculate3", ire, icp, For::basic, ierror); }

void subs_addblock(int* ire, int* icp, int* iblk, int* isubs, int* npx, int* npy, int* npz, double* x, double* y,
                   double* z) {
  on_problem("subs_addblock", ire, icp, For::any, [&](Active& a) {
    Problem& p = a.problem;
    const bool of_patch = p.module == 1 && a.patch >= 0;
    const int number = need(iblk, "iblk");
    if (number == 0) {
      if (of_patch)
        p.blocks_of_patch.erase(a.patch);
      else
        p.blocks.clear();
      return;
    }
    auto block =
        block_of(need(isubs, "isubs"), array(x, npx, "x"), array(y, npy, "y"), array(z, npz, "z"), p.units.length);
    SubsurfaceBlocks& blocks = of_patch ? p.blocks_of_patch[a.patch] : p.blocks;
    if (number < 1 || static_cast<std::size_t>(number) > std::min(kMostBlocks, blocks.size() + 1))
      throw Refusal{CNTC_err_input, fmt::format("there cannot be a block {} after {} blocks", number, blocks.size())};
    blocks.resize(static_cast<std::size_t>(number) - 1);
    blocks.push_back(std::move(block));
  });
}

void subs_calculate(int* ire, int* icp, int* ierror) {
  guarded("subs_calculate", ierror, [&] {
    Active a = activate(ire, icp, For::any, false);
    const Solving solving(a.problem.solving);
    const std::lock_guard lock(a.problem.mutex);
    if (a.patch < 0) {
      if (!a.problem.result) throw Refusal{CNTC_err_icp, "there is no solution"};
      for (std::size_t k = 0; k < a.problem.result->patches.size(); ++k) solve_below(a.problem, static_cast<int>(k));
    } else {
      a.result();
      solve_below(a.problem, a.patch);
    }
    put(ierror, 0);
  });
  hide_misuse(ierror);
}

void subs_getblocksize(int* ire, int* icp, int* iblk, int* nx, int* ny, int* nz) {
  on_problem("subs_getblocksize", ire, icp, For::patch, [&](Active& a) {
    const auto size = block_size(a.problem, a.patch, need(iblk, "iblk"));
    put(nx, size[0]);
    put(ny, size[1]);
    put(nz, size[2]);
  });
}

void subs_getresults(int* ire, int* icp, int* iblk, int* lenarr, int* ncol, int* icol, double* values) {
  on_problem("subs_getresults", ire, icp, For::patch, [&](Active& a) {
    const auto columns = array(icol, ncol, "icol");
    const std::size_t rows = room(values, lenarr, "values").size();
    const int number = need(iblk, "iblk");
    const auto& blocks = a.result().subsurface;
    if (number < 1 || static_cast<std::size_t>(number) > blocks.size())
      throw Refusal{CNTC_err_icp, fmt::format("there are no results of block {}", number)};
    const auto& points = blocks[static_cast<std::size_t>(number) - 1].values;
    for (std::size_t k = 0; k < columns.size(); ++k)
      for (std::size_t i = 0; i < rows && i < points.size(); ++i)
        values[k * rows + i] = subsurface_number(points[i], columns[k], a.problem.units);
  });
}
