// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include "treadmark/core/parts.hpp"

/// At the beginning of a test that asks for a part which this build may leave out: the test is skipped then.
#define TREADMARK_NEEDS(part)        \
  if (::treadmark::has_part(part)) { \
  } else                             \
    GTEST_SKIP() << ::treadmark::left_out_message(part, "what this test needs")
