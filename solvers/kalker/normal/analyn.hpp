// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/model/contact/material.hpp"
#include "treadmark/solvers/kalker/normal/interpenetration.hpp"

namespace treadmark::kalker {

/// Pressures [Pa] of a modified ANALYN (Sichani, Enblom & Berg 2014): each row of elements is a cut through a Hertzian
/// contact with the curvatures found in that row, and ends where that contact ends. Exact for Hertzian geometry up to
/// the grid. Conventions::contact: a row is deepest at an element. Returned: a field of the grid's size. There must be
/// contact.
std::vector<double> analyn_pressure(const Interpenetration& overlap, const CombinedMaterial& material,
                                    Conventions conventions);

}  // namespace treadmark::kalker
