// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/fmu/variables.hpp"

#include <utility>

namespace treadmark::fmi {

bool depends(const Variable& output, const Variable& input) {
  return input.kind == Variable::Kind::input && (output.wheel < 0 || input.wheel < 0 || output.wheel == input.wheel);
}

std::uint32_t Variables::add(Variable variable) {
  const auto reference = variable.reference = static_cast<std::uint32_t>(owner_.size());
  owner_.insert(owner_.end(), variable.elements(), all_.size());
  all_.push_back(std::move(variable));
  return reference;
}

const Variable* Variables::of(std::uint32_t reference) const {
  return reference < owner_.size() ? &all_[owner_[reference]] : nullptr;
}

}  // namespace treadmark::fmi
