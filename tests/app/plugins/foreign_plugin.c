/* SPDX-License-Identifier: Apache-2.0 */
/* As if it were built for another Treadmark: nothing more of it may be called. */
#include <stdlib.h>

const char* treadmark_plugin_abi(void) { return "plug-in 0 of Treadmark 0.0.1"; }
void treadmark_plugin_rows(void) { abort(); }
