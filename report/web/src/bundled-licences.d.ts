// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

/** Made by build.mjs: the packages of which the bundle holds code. */
declare module "bundled-licences" {
  const licences: { name: string; version: string; licence: string; text: string }[];
  export default licences;
}
