// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/kalker/solver_state.hpp"

#include "treadmark/solvers/kalker/history/history_archive.hpp"
#include "treadmark/solvers/kalker/normal/normal_solver.hpp"
#include "treadmark/solvers/kalker/tangential/tangential_solver.hpp"

namespace treadmark::kalker {

void write(const std::shared_ptr<const ContactSolver::State>& state, ByteWriter& out) {
  out.put(state != nullptr);
  if (!state) return;
  for (const ContactHistory* h : {&state->previous, &state->last}) write(*h, out);
  write(state->normal, out);
  out.put(state->sub_patches.size());
  for (const NormalStart& start : state->sub_patches) write(start, out);
  out.put(state->tangential.has_value());
  if (state->tangential) write(*state->tangential, out);
}

std::shared_ptr<const ContactSolver::State> read_solver_state(ByteReader& in) {
  if (!in.get<bool>()) return nullptr;
  auto state = std::make_shared<ContactSolver::State>();
  for (ContactHistory* h : {&state->previous, &state->last}) *h = read_history(in);
  state->normal = read_normal_start(in);
  // A count from damaged bytes may be anything: bytes end before memory does.
  for (auto left = in.get<std::size_t>(); left > 0; --left) state->sub_patches.push_back(read_normal_start(in));
  if (in.get<bool>()) state->tangential = read_tangential_start(in);
  return state;
}

}  // namespace treadmark::kalker
