// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
/** The bundled worker as text; build.mjs makes it. */
declare module "live-worker" {
  const text: string;
  export default text;
}
