// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/plugins/plugin.hpp"
#include "treadmark/tests/conformance/wrong_backends.hpp"

TREADMARK_PLUGIN() { treadmark::testing::register_wrong_backends(); }
