// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/wheelrail/pair_state.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/history/history_archive.hpp"
#include "treadmark/solvers/kalker/solver_state.hpp"

namespace treadmark::wheelrail {

namespace {

/// Counts up with every change of what is written here or by the solvers below.
constexpr std::uint32_t kFormat = 3;

void put_all(ByteWriter& out, std::initializer_list<double> values) {
  for (const double value : values) out.put(value);
}

void get_all(ByteReader& in, std::initializer_list<double*> values) {
  for (double* value : values) {
    in.get(*value);
    if (!std::isfinite(*value)) refuse_saved_state("a number is not finite");
  }
}

void write(const Rectangle& r, ByteWriter& out) { put_all(out, {r.x_min, r.x_max, r.y_min, r.y_max}); }
void read(ByteReader& in, Rectangle& r) { get_all(in, {&r.x_min, &r.x_max, &r.y_min, &r.y_max}); }
void write(const Vec3& v, ByteWriter& out) { put_all(out, {v.x(), v.y(), v.z()}); }
void read(ByteReader& in, Vec3& v) { get_all(in, {&v.x(), &v.y(), &v.z()}); }

void write(const PatchMemory& m, ByteWriter& out) {
  out.put(m.id);
  write(m.box, out);
  kalker::write(m.history, out);
  write(m.force_C, out);
  kalker::write(m.solver, out);
}

PatchMemory read_patch(ByteReader& in) {
  PatchMemory m;
  in.get(m.id);
  read(in, m.box);
  m.history = kalker::read_history(in);
  if (m.history.empty()) refuse_saved_state("a patch has no elements");
  read(in, m.force_C);
  m.solver = kalker::read_solver_state(in);
  return m;
}

void write(const TangentialShare& share, ByteWriter& out) {
  write(share.box, out);
  out.put(share.normal_force);
  write(share.share, out);
}

TangentialShare read_share(ByteReader& in) {
  TangentialShare share;
  read(in, share.box);
  get_all(in, {&share.normal_force});
  read(in, share.share);
  return share;
}

void write(const Instant& instant, ByteWriter& out) {
  out.put(instant.patches.size());
  for (const PatchMemory& m : instant.patches) write(m, out);
  put_all(out, {instant.s, instant.stiffness, instant.end_slope});
  out.put(instant.shares.size());
  for (const TangentialShare& share : instant.shares) write(share, out);
  out.put(instant.next_id);
}

// A count from damaged bytes may be anything: bytes end before memory does.
Instant read_instant(ByteReader& in) {
  Instant instant;
  for (auto left = in.get<std::size_t>(); left > 0; --left) instant.patches.push_back(read_patch(in));
  get_all(in, {&instant.s, &instant.stiffness, &instant.end_slope});
  for (auto left = in.get<std::size_t>(); left > 0; --left) instant.shares.push_back(read_share(in));
  in.get(instant.next_id);
  return instant;
}

}  // namespace

void write(const std::shared_ptr<const Pair::State>& state, ByteWriter& out) {
  const Pair::State fresh, &written = state ? *state : fresh;
  ByteWriter content;
  write(written.previous, content);
  write(written.last, content);
  content.put(written.side);
  out.put(kFormat);
  out.put(check_sum(content.bytes()));
  out.put(std::span<const std::byte>(content.bytes()));
}

std::shared_ptr<const Pair::State> read_state(ByteReader& in) {
  if (const auto format = in.get<std::uint32_t>(); format != kFormat)
    throw Error(ErrorKind::input_data, fmt::format("a saved contact state has format {}, not {}", format, kFormat), {},
                "start anew, or go on with the version of the program that saved it");
  const auto expected = in.get<std::uint64_t>();
  std::vector<std::byte> bytes;
  in.get(bytes);
  if (check_sum(bytes) != expected) refuse_saved_state("its checksum differs");
  ByteReader content(bytes);
  auto state = std::make_shared<Pair::State>();
  state->previous = read_instant(content);
  state->last = read_instant(content);
  content.get(state->side);
  if (!content.at_end() || (state->side != Side::left && state->side != Side::right))
    refuse_saved_state("its parts do not fit");
  return state;
}

}  // namespace treadmark::wheelrail
