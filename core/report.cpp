// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/report.hpp"

namespace treadmark {

std::string_view to_string(Status status) {
  switch (status) {
    case Status::ok:
      return "ok";
    case Status::no_contact:
      return "no_contact";
    case Status::not_converged:
      return "not_converged";
    case Status::failed:
      return "failed";
  }
  return "failed";
}

}  // namespace treadmark
