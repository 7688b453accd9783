// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/thb/thb_space.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

namespace treadmark::spline {
namespace {

[[noreturn]] void refuse_hierarchy(std::string what) { throw Error(ErrorKind::input_data, std::move(what)); }

// rows of u times local times rows of v, transposed; T is a number or a point
template <class T, class Matrix>
void transform(T (&local)[kMostDegree + 1][kMostDegree + 1], const Matrix& of_u, const Matrix& of_v, int pu, int pv,
               const T& zero) {
  T half[kMostDegree + 1][kMostDegree + 1];
  for (std::size_t i = 0; i <= static_cast<std::size_t>(pu); ++i)
    for (std::size_t j = 0; j <= static_cast<std::size_t>(pv); ++j) {
      half[i][j] = zero;
      for (std::size_t k = 0; k <= static_cast<std::size_t>(pu); ++k) half[i][j] += of_u[i][k] * local[k][j];
    }
  for (std::size_t i = 0; i <= static_cast<std::size_t>(pu); ++i)
    for (std::size_t j = 0; j <= static_cast<std::size_t>(pv); ++j) {
      local[i][j] = zero;
      for (std::size_t k = 0; k <= static_cast<std::size_t>(pv); ++k) local[i][j] += of_v[j][k] * half[i][k];
    }
}

}  // namespace

ThbPiece over_range(const ThbPiece& piece, int degree_u, int degree_v, const ThbRange& from, const ThbRange& to) {
  const auto rows = [](int degree, double low, double high, double part_low, double part_high) {
    std::array<KnotWeights, kMostDegree + 1> out{};
    for (int k = 0; k <= degree; ++k) {
      double arguments[kMostDegree];
      for (int i = 0; i < degree; ++i) arguments[i] = i < degree - k ? part_low : part_high;
      out[static_cast<std::size_t>(k)] = bernstein_blossom(degree, arguments, low, high);
    }
    return out;
  };
  Vec3 local[kMostDegree + 1][kMostDegree + 1];
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) local[i][j] = piece[i][j];
  transform(local, rows(degree_u, from.u0, from.u1, to.u0, to.u1), rows(degree_v, from.v0, from.v1, to.v0, to.v1),
            degree_u, degree_v, Vec3(Vec3::Zero()));
  ThbPiece out{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) out[i][j] = local[i][j];
  return out;
}

ThbSpace::Direction ThbSpace::direction(const KnotLine& line, const KnotLine* coarser) {
  Direction d;
  const int n = line.intervals(), p = line.degree();
  d.to_bernstein.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    for (int k = 0; k <= p; ++k)
      d.to_bernstein[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] = line.bernstein(i, k);
  if (coarser == nullptr) return d;
  d.from_parent.resize(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) {
    const int parent = coarser->find(0.5 * (line.from(i) + line.to(i)));
    while (static_cast<int>(d.first_child.size()) <= parent) d.first_child.push_back(i);
    d.parent.push_back(parent);
    for (int k = 0; k <= p; ++k)
      d.from_parent[static_cast<std::size_t>(i)][static_cast<std::size_t>(k)] =
          coarser->blossom(parent, line.inner_knots(i, k));
  }
  d.first_child.push_back(n);
  return d;
}

ThbSpace::ThbSpace(std::vector<Level> levels) {
  if (levels.empty()) refuse_hierarchy("a hierarchy of splines needs a level");
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const Level* before = l > 0 ? &at(static_cast<int>(l) - 1).line : nullptr;
    if (before != nullptr && !(levels[l].u.holds(before->u) && levels[l].v.holds(before->v)))
      refuse_hierarchy(fmt::format("level {} of a hierarchy of splines does not hold the knots of level {}", l, l - 1));
    LevelData data(std::move(levels[l]));
    data.along_u = direction(data.line.u, before != nullptr ? &before->u : nullptr);
    data.along_v = direction(data.line.v, before != nullptr ? &before->v : nullptr);
    if (l + 1 < levels.size())
      data.divided.assign(
          static_cast<std::size_t>(data.line.u.intervals()) * static_cast<std::size_t>(data.line.v.intervals()), false);
    levels_.push_back(std::move(data));
  }
}

std::size_t ThbSpace::index(const ThbCell& c) const {
  return static_cast<std::size_t>(c.iu) * static_cast<std::size_t>(v(c.level).intervals()) +
         static_cast<std::size_t>(c.iv);
}

bool ThbSpace::divided(const ThbCell& c) const {
  const auto& flags = at(c.level).divided;
  return !flags.empty() && flags[index(c)];
}

ThbCell ThbSpace::parent(const ThbCell& c) const {
  return {c.level - 1, at(c.level).along_u.parent[static_cast<std::size_t>(c.iu)],
          at(c.level).along_v.parent[static_cast<std::size_t>(c.iv)]};
}

bool ThbSpace::exists(const ThbCell& c) const { return c.level == 0 || divided(parent(c)); }

void ThbSpace::divide(const ThbCell& c) {
  if (c.level + 1 == levels() || divided(c)) return;
  const KnotLine &lu = u(c.level), &lv = v(c.level);
  for (int du = -1; du <= 1; ++du)
    for (int dv = -1; dv <= 1; ++dv) {
      ThbCell near{c.level, c.iu + du, c.iv + dv};
      if (lu.closed()) near.iu = (near.iu + lu.intervals()) % lu.intervals();
      if (lv.closed()) near.iv = (near.iv + lv.intervals()) % lv.intervals();
      if (near.iu < 0 || near.iv < 0 || near.iu >= lu.intervals() || near.iv >= lv.intervals()) continue;
      if (!exists(near)) divide(parent(near));
    }
  levels_[static_cast<std::size_t>(c.level)].divided[index(c)] = true;
}

void ThbSpace::divide_alone(const ThbCell& c) {
  if (c.level + 1 >= levels() || !exists(c))
    refuse_hierarchy(fmt::format("a cell of level {} of a hierarchy of splines is divided that is not there", c.level));
  levels_[static_cast<std::size_t>(c.level)].divided[index(c)] = true;
}

std::uint64_t ThbSpace::key(int level, int fu, int fv) const {
  return static_cast<std::uint64_t>(fu) * static_cast<std::uint64_t>(v(level).functions()) +
         static_cast<std::uint64_t>(fv);
}

std::size_t ThbSpace::number(int level, int fu, int fv) const {
  const LevelData& data = at(level);
  const std::uint64_t wanted = key(level, fu, fv);
  const auto at_row = [&](int k) {
    return data.active.begin() + static_cast<std::ptrdiff_t>(data.row[static_cast<std::size_t>(k)]);
  };
  const auto end = at_row(fu + 1), found = std::lower_bound(at_row(fu), end, wanted);
  if (found == end || *found != wanted) return kNone;
  return data.first + static_cast<std::size_t>(found - data.active.begin());
}

ThbSpace::Function ThbSpace::function(std::size_t number) const {
  int level = levels() - 1;
  while (at(level).first > number) --level;
  const std::uint64_t k = at(level).active[number - at(level).first];
  const auto across = static_cast<std::uint64_t>(v(level).functions());
  return {level, static_cast<int>(k / across), static_cast<int>(k % across)};
}

bool ThbSpace::inside(int level, int fu, int fv) const {
  if (level == 0) return true;
  const KnotLine::Support su = u(level).support(fu), sv = v(level).support(fv);
  for (int iu = su.first; iu <= su.last; ++iu)
    for (int iv = sv.first; iv <= sv.last; ++iv)
      if (!exists({level, u(level).folded(iu), v(level).folded(iv)})) return false;
  return true;
}

void ThbSpace::settle() {
  cells_.clear();
  functions_ = 0;
  std::vector<ThbCell> present;
  for (int iu = 0; iu < u(0).intervals(); ++iu)
    for (int iv = 0; iv < v(0).intervals(); ++iv) present.push_back({0, iu, iv});
  for (int l = 0; l < levels(); ++l) {
    LevelData& data = levels_[static_cast<std::size_t>(l)];
    data.active.clear();
    std::vector<ThbCell> next;
    for (const ThbCell& cell : present) {
      if (divided(cell)) {
        const LevelData& finer = at(l + 1);
        const auto iu = static_cast<std::size_t>(cell.iu), iv = static_cast<std::size_t>(cell.iv);
        for (int ku = finer.along_u.first_child[iu]; ku < finer.along_u.first_child[iu + 1]; ++ku)
          for (int kv = finer.along_v.first_child[iv]; kv < finer.along_v.first_child[iv + 1]; ++kv)
            next.push_back({l + 1, ku, kv});
        continue;
      }
      cells_.push_back(cell);
      for (int ku = 0; ku <= data.line.u.degree(); ++ku)
        for (int kv = 0; kv <= data.line.v.degree(); ++kv)
          data.active.push_back(key(l, data.line.u.function(cell.iu, ku), data.line.v.function(cell.iv, kv)));
    }
    std::sort(data.active.begin(), data.active.end());
    data.active.erase(std::unique(data.active.begin(), data.active.end()), data.active.end());
    const auto across = static_cast<std::uint64_t>(data.line.v.functions());
    std::erase_if(data.active, [&](std::uint64_t k) {
      return !inside(l, static_cast<int>(k / across), static_cast<int>(k % across));
    });
    data.row.assign(static_cast<std::size_t>(data.line.u.functions()) + 1, 0);
    for (const std::uint64_t k : data.active) ++data.row[static_cast<std::size_t>(k / across) + 1];
    std::partial_sum(data.row.begin(), data.row.end(), data.row.begin());
    data.first = functions_;
    functions_ += data.active.size();
    present = std::move(next);
  }
}

void ThbSpace::require_support() const {
  std::vector<std::size_t> count(levels_.size(), 0);
  for (const ThbCell& cell : cells_) ++count[static_cast<std::size_t>(cell.level)];
  for (std::size_t l = 1; l < levels_.size(); ++l)
    if (count[l] > 0 && levels_[l].active.empty())
      throw Error(
          ErrorKind::input_data,
          fmt::format("level {} of a hierarchy of splines has {} cells, but no function lies in them", l, count[l]), {},
          fmt::format("divide as many neighbours as functions are wide: {} x {} of its cells", u(0).degree() + 1,
                      v(0).degree() + 1));
}

ThbCell ThbSpace::cell_at(double at_u, double at_v) const {
  ThbCell cell{0, u(0).find(at_u), v(0).find(at_v)};
  while (divided(cell)) cell = {cell.level + 1, u(cell.level + 1).find(at_u), v(cell.level + 1).find(at_v)};
  return cell;
}

std::vector<ThbCell> ThbSpace::path(const ThbCell& cell) const {
  std::vector<ThbCell> out{cell};
  while (out.back().level > 0) out.push_back(parent(out.back()));
  std::reverse(out.begin(), out.end());
  return out;
}

ThbPiece ThbSpace::piece(const ThbCell& cell, const std::vector<Vec3>& coefficients, bool not_truncated) const {
  const int pu = u(0).degree(), pv = v(0).degree();
  const Vec3 zero = Vec3::Zero();
  Vec3 local[kMostDegree + 1][kMostDegree + 1];
  for (auto& row : local)
    for (Vec3& x : row) x = zero;
  for (const ThbCell& on : path(cell)) {
    const LevelData& data = at(on.level);
    const auto iu = static_cast<std::size_t>(on.iu), iv = static_cast<std::size_t>(on.iv);
    if (on.level > 0) transform(local, data.along_u.from_parent[iu], data.along_v.from_parent[iv], pu, pv, zero);
    // What a function has that lies in divided cells alone does not matter: finer ones replace all of it.
    for_window(on, [&](int ku, int kv, std::size_t n) {
      local[ku][kv] = not_truncated ? Vec3(local[ku][kv] + coefficients[n]) : coefficients[n];
    });
  }
  const LevelData& data = at(cell.level);
  transform(local, data.along_u.to_bernstein[static_cast<std::size_t>(cell.iu)],
            data.along_v.to_bernstein[static_cast<std::size_t>(cell.iv)], pu, pv, zero);
  ThbPiece out{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) out[i][j] = local[i][j];
  return out;
}

std::vector<ThbSpace::Column> ThbSpace::columns(const ThbCell& cell) const {
  const int pu = u(0).degree(), pv = v(0).degree();
  struct Local {
    std::size_t function;
    double x[kMostDegree + 1][kMostDegree + 1] = {};
  };
  std::vector<Local> all;
  for (const ThbCell& on : path(cell)) {
    const LevelData& data = at(on.level);
    const auto iu = static_cast<std::size_t>(on.iu), iv = static_cast<std::size_t>(on.iv);
    if (on.level > 0)
      for (Local& one : all) transform(one.x, data.along_u.from_parent[iu], data.along_v.from_parent[iv], pu, pv, 0.0);
    const std::size_t before = all.size();
    for_window(on, [&](int ku, int kv, std::size_t n) {
      for (std::size_t k = 0; k < before; ++k) all[k].x[ku][kv] = 0.0;
      Local& unit = all.emplace_back();
      unit.function = n;
      unit.x[ku][kv] = 1.0;
    });
  }
  const LevelData& data = at(cell.level);
  std::vector<Column> out;
  for (Local& one : all) {
    transform(one.x, data.along_u.to_bernstein[static_cast<std::size_t>(cell.iu)],
              data.along_v.to_bernstein[static_cast<std::size_t>(cell.iv)], pu, pv, 0.0);
    Column column{one.function, {}};
    double most = 0.0;
    for (int i = 0; i <= pu; ++i)
      for (int j = 0; j <= pv; ++j) {
        column.b[std::size_t{kMostDegree + 1} * static_cast<std::size_t>(i) + static_cast<std::size_t>(j)] =
            one.x[i][j];
        most = std::max(most, one.x[i][j]);
      }
    if (most > 0.0) out.push_back(column);
  }
  return out;
}

Vec3 ThbSpace::coefficient(const ThbCell& cell, int ku, int kv, const ThbPiece& piece) const {
  const KnotLine &lu = u(cell.level), &lv = v(cell.level);
  const KnotWeights wu = bernstein_blossom(lu.degree(), lu.inner_knots(cell.iu, ku), lu.from(cell.iu), lu.to(cell.iu));
  const KnotWeights wv = bernstein_blossom(lv.degree(), lv.inner_knots(cell.iv, kv), lv.from(cell.iv), lv.to(cell.iv));
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) sum += wu[i] * wv[j] * piece[i][j];
  return sum;
}

std::vector<Vec3> ThbSpace::refined(const std::vector<Vec3>& coefficients, const ThbSpace& finer) const {
  return finer.coefficients([&](const ThbCell& cell) {
    ThbCell own = cell;
    while (!exists(own)) own = parent(own);
    return over_range(piece(own, coefficients), u(0).degree(), v(0).degree(), range(own), finer.range(cell));
  });
}

ThbRange ThbSpace::range(const ThbCell& c) const {
  return {u(c.level).from(c.iu), u(c.level).to(c.iu), v(c.level).from(c.iv), v(c.level).to(c.iv)};
}

std::size_t ThbSpace::memory_bytes() const {
  std::size_t bytes = cells_.capacity() * sizeof(ThbCell);
  for (const LevelData& l : levels_) bytes += l.divided.size() / 8 + l.active.capacity() * sizeof(std::uint64_t);
  return bytes;
}

}  // namespace treadmark::spline
