// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <list>

#include "treadmark/solvers/kalker/tangential/compliance.hpp"

namespace treadmark::kalker {

/// The coefficients used last. References stay valid until kCapacity other boxes were asked for.
class ComplianceCache {
 public:
  static constexpr std::size_t kCapacity = 12;

  Compliance& get(const ComplianceKey& key) {
    for (auto it = boxes_.begin(); it != boxes_.end(); ++it)
      if (it->key() == key) {
        boxes_.splice(boxes_.begin(), boxes_, it);
        return boxes_.front();
      }
    boxes_.emplace_front(key);
    if (boxes_.size() > kCapacity) boxes_.pop_back();
    return boxes_.front();
  }

 private:
  std::list<Compliance> boxes_;
};

}  // namespace treadmark::kalker
