// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace treadmark::testing {

/// First violation of a JSON schema (the words $ref, type, enum, properties, required, additionalProperties, items,
/// minItems, maxItems), or empty. Any other word that restricts makes the check throw, so that nothing is passed over.
std::string first_violation(const nlohmann::json& value, const nlohmann::json& schema, const nlohmann::json& root,
                            const std::string& place = "");

}  // namespace treadmark::testing
