/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: Treadmark contributors
 * usage: fmu_host FOLDER
 * Opens the FMU unpacked in FOLDER, of version 3, with nothing but the C library and the official headers, and makes a few steps. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi3Functions.h"

static void say(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message) {
  (void)environment;
  fprintf(stderr, "%d %s: %s\n", (int)status, category, message);
}

/* The text between two others, the first of which comes after a third. */
static void between(const char *text, const char *after, const char *from, const char *to, char *out, size_t room) {
  const char *first = strstr(text, after), *last;
  if (first != NULL) first = strstr(first, from);
  if (first == NULL) exit(2);
  first += strlen(from);
  last = strstr(first, to);
  if (last == NULL || (size_t)(last - first) >= room) exit(2);
  memcpy(out, first, (size_t)(last - first));
  out[last - first] = '\0';
}

int main(int count, char **arguments) {
  static char text[1 << 20];
  char path[4096], token[100], number[20];
  if (count != 2) return 2;
  snprintf(path, sizeof path, "%s/modelDescription.xml", arguments[1]);
  FILE *file = fopen(path, "rb");
  if (file == NULL) return 2;
  text[fread(text, 1, sizeof text - 1, file)] = '\0';
  fclose(file);
  between(text, "<fmiModelDescription", "instantiationToken=\"", "\"", token, sizeof token);
  between(text, "name=\"force_on_wheelset\"", "valueReference=\"", "\"", number, sizeof number);
  const fmi3ValueReference force = (fmi3ValueReference)atoi(number);

  snprintf(path, sizeof path, "%s/binaries/x86_64-linux/treadmark.so", arguments[1]);
  void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  if (library == NULL) {
    fprintf(stderr, "%s\n", dlerror());
    return 1;
  }
#define FUNCTION(name)   \
  name##TYPE *name;      \
  *(void **)(&name) = dlsym(library, #name)
  FUNCTION(fmi3InstantiateCoSimulation);
  FUNCTION(fmi3EnterInitializationMode);
  FUNCTION(fmi3ExitInitializationMode);
  FUNCTION(fmi3DoStep);
  FUNCTION(fmi3GetFloat64);
  FUNCTION(fmi3Terminate);
  FUNCTION(fmi3FreeInstance);
  snprintf(path, sizeof path, "%s/resources/", arguments[1]);
  fmi3Instance instance = fmi3InstantiateCoSimulation("host", token, path, fmi3False, fmi3False, fmi3False, fmi3False,
                                                      NULL, 0, NULL, say, NULL);
  if (instance == NULL) return 1;
  if (fmi3EnterInitializationMode(instance, fmi3False, 0, 0, fmi3False, 0) != fmi3OK) return 1;
  if (fmi3ExitInitializationMode(instance) != fmi3OK) return 1;
  for (int i = 0; i < 3; ++i) {
    fmi3Boolean event, end, early;
    fmi3Float64 last, forces[3];
    if (fmi3DoStep(instance, 0.125 * i, 0.125, fmi3True, &event, &end, &early, &last) != fmi3OK) return 1;
    if (fmi3GetFloat64(instance, &force, 1, forces, 3) != fmi3OK) return 1;
    if (i == 2) printf("%.17g %.17g %.17g\n", forces[0], forces[1], forces[2]);
  }
  if (fmi3Terminate(instance) != fmi3OK) return 1;
  fmi3FreeInstance(instance);
  return dlclose(library);
}
