// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/fmu/model.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::fmi {

std::unique_ptr<Model> open_vehicle(const std::filesystem::path&) { left_out("vehicle", "FMUs of vehicles"); }

}  // namespace treadmark::fmi
