// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/app/fmu/model.hpp"

namespace treadmark::fmi {

enum class Version { fmi2 = 2, fmi3 = 3 };

/// The name of the shared library within an FMU.
inline constexpr const char* kModelIdentifier = "treadmark";

struct Description {
  std::string name;   ///< of the FMU
  std::string title;  ///< what it is, one line
  std::string token;  ///< token_of its resources
};

/// modelDescription.xml, from the table of variables.
std::string model_description(const Model& model, const Description& about, Version version);

/// The page for people, index.html.
std::string model_page(const Model& model, const Description& about, Version version);

}  // namespace treadmark::fmi
