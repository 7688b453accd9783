// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/interfaces/fmi/model.hpp"

namespace treadmark::fmi {

std::unique_ptr<Model> open_vehicle(const std::filesystem::path&) { left_out("vehicle", "FMUs of vehicles"); }

}  // namespace treadmark::fmi
