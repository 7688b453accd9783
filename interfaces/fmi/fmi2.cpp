// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/interfaces/fmi/instance.hpp"
#include "treadmark/interfaces/fmi/third_party/headers/fmi2Functions.h"

namespace treadmark::fmi {
namespace {

template <class Body>
fmi2Status call2(fmi2Component c, const char* function, unsigned modes, Body&& body) noexcept {
  return static_cast<fmi2Status>(call(c, function, modes, body));
}

/// What this FMU does not do, told.
fmi2Status refused2(fmi2Component c, const char* function, const char* why) noexcept {
  return call2(c, function, kAnyMode, [why](Instance&) { throw BadCall{why}; });
}

int digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = static_cast<char>(c | 0x20);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// The path of a URI of scheme file; a path by itself is one, too. Empty: neither.
std::string path_of(std::string_view uri) {
  constexpr std::string_view kScheme = "file:";  // in any letters
  const auto same = [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; };
  if (uri.size() >= kScheme.size() && ranges::equal(uri.substr(0, kScheme.size()), kScheme, same)) {
    uri.remove_prefix(5);
    if (uri.starts_with("//")) {
      uri.remove_prefix(2);
      if (uri.starts_with("localhost/")) uri.remove_prefix(9);
    }
  } else if (uri.starts_with('/')) {
    return std::string(uri);
  }
  if (!uri.starts_with('/')) return {};
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%' || i + 2 >= uri.size() || digit(uri[i + 1]) < 0 || digit(uri[i + 2]) < 0) {
      path += uri[i];
      continue;
    }
    path += static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2]));
    i += 2;
  }
  return path;
}

/// A text as the format of printf that prints it, for importers that show the format itself. '#' would begin a
/// reference to a variable.
std::string as_format(std::string_view text) {
  std::string format;
  for (const char c : text) {
    format += c;
    if (c == '%' || c == '#') format += c;
  }
  return format;
}

std::vector<std::uint32_t> elements(const Instance& i, const fmi2ValueReference* vr, std::size_t count,
                                    const void* values) {
  require(values != nullptr || count == 0, "the values are null");
  return i.scalars(vr, count, Instance::Arrays::elements);
}

}  // namespace
}  // namespace treadmark::fmi

using namespace treadmark::fmi;

extern "C" {

const char* fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char* fmi2GetVersion(void) { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
  return call2(c, "fmi2SetDebugLogging", kAnyMode, [&](Instance& i) {
    require(categories != nullptr || nCategories == 0, "the categories are null");
    i.set_logging(loggingOn != fmi2False, {categories, nCategories});
  });
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation, const fmi2CallbackFunctions* functions, fmi2Boolean,
                              fmi2Boolean loggingOn) {
  try {
    if (instanceName == nullptr || functions == nullptr) return nullptr;
    Logger logger;
    if (functions->logger != nullptr)
      logger = [call_back = functions->logger, environment = functions->componentEnvironment,
                name = std::string(instanceName)](Outcome outcome, const char* category, const char* message) {
        call_back(environment, name.c_str(), static_cast<fmi2Status>(outcome), category, as_format(message).c_str());
      };
    const std::string resources = fmuResourceLocation == nullptr ? std::string() : path_of(fmuResourceLocation);
    if (fmuType != fmi2CoSimulation || resources.empty()) {
      if (logger)
        logger(Outcome::error, kCategories[0].name,
               resources.empty() ? "instantiation: the location of the resources is no URI of a folder, file:///..."
                                 : "instantiation: this FMU is for co-simulation");
      return nullptr;
    }
    return Instance::create(fmuGUID, resources, logger, loggingOn != fmi2False);
  } catch (...) {
    return nullptr;
  }
}

void fmi2FreeInstance(fmi2Component c) { delete static_cast<Instance*>(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real startTime, fmi2Boolean stopTimeDefined,
                               fmi2Real stopTime) {
  return call2(c, "fmi2SetupExperiment", kInstantiated,
               [&](Instance& i) { i.set_up(startTime, stopTimeDefined ? &stopTime : nullptr); });
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return call2(c, "fmi2EnterInitializationMode", kInstantiated, [](Instance& i) { i.enter_initialization(); });
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return call2(c, "fmi2ExitInitializationMode", kInitialization, [](Instance& i) { i.exit_initialization(); });
}

fmi2Status fmi2Terminate(fmi2Component c) {
  return call2(c, "fmi2Terminate", kStep, [](Instance& i) { i.terminate(); });
}

fmi2Status fmi2Reset(fmi2Component c) {
  return call2(c, "fmi2Reset", kAnyMode, [](Instance& i) { i.reset(); });
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Real value[]) {
  return call2(c, "fmi2GetReal", kAnyMode, [&](Instance& i) { i.get(elements(i, vr, nvr, value), false, value); });
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2Integer value[]) {
  return call2(c, "fmi2GetInteger", kAnyMode, [&](Instance& i) {
    std::vector<double> got(nvr);
    i.get(elements(i, vr, nvr, value), true, got.data());
    for (std::size_t k = 0; k < nvr; ++k) value[k] = static_cast<fmi2Integer>(got[k]);
  });
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Real value[]) {
  return call2(c, "fmi2SetReal", kInstantiated | kInitialization | kStep,
               [&](Instance& i) { i.set(elements(i, vr, nvr, value), false, value); });
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2Integer value[]) {
  return call2(c, "fmi2SetInteger", kInstantiated | kInitialization | kStep, [&](Instance& i) {
    const auto scalars = elements(i, vr, nvr, value);
    i.set(scalars, true, std::vector<double>(value, value + nvr).data());
  });
}

// There are no variables of these types.
#define TREADMARK_NO_SUCH_VARIABLES(function, type)                                               \
  fmi2Status function(fmi2Component c, const fmi2ValueReference[], size_t nvr, type) {            \
    return call2(c, #function, kAnyMode,                                                          \
                 [nvr](Instance&) { require(nvr == 0, "there are no variables of this type"); }); \
  }
TREADMARK_NO_SUCH_VARIABLES(fmi2GetBoolean, fmi2Boolean[])
TREADMARK_NO_SUCH_VARIABLES(fmi2GetString, fmi2String[])
TREADMARK_NO_SUCH_VARIABLES(fmi2SetBoolean, const fmi2Boolean[])
TREADMARK_NO_SUCH_VARIABLES(fmi2SetString, const fmi2String[])
#undef TREADMARK_NO_SUCH_VARIABLES

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* FMUstate) {
  return call2(c, "fmi2GetFMUstate", kAnyMode, [&](Instance& i) { get_state(i, FMUstate); });
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
  return call2(c, "fmi2SetFMUstate", kAnyMode, [&](Instance& i) { set_state(i, FMUstate); });
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* FMUstate) {
  return call2(c, "fmi2FreeFMUstate", kAnyMode, [&](Instance&) { free_state(FMUstate); });
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t* size) {
  return call2(c, "fmi2SerializedFMUstateSize", kAnyMode, [&](Instance&) { state_size(FMUstate, size); });
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[], size_t size) {
  return call2(c, "fmi2SerializeFMUstate", kAnyMode, [&](Instance&) { serialize(FMUstate, serializedState, size); });
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate* FMUstate) {
  return call2(c, "fmi2DeSerializeFMUstate", kAnyMode,
               [&](Instance& i) { deserialize(i, serializedState, size, FMUstate); });
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
                                        const fmi2ValueReference vKnown_ref[], size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
  return call2(c, "fmi2GetDirectionalDerivative", kInitialization | kStep, [&](Instance& i) {
    const auto unknowns = elements(i, vUnknown_ref, nUnknown, dvUnknown),
               knowns = elements(i, vKnown_ref, nKnown, dvKnown);
    i.derivative(unknowns, knowns, {dvKnown, nKnown}, dvUnknown);
  });
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference[], size_t, const fmi2Integer[],
                                       const fmi2Real[]) {
  return refused2(c, "fmi2SetRealInputDerivatives", "inputs are not interpolated");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference[], size_t, const fmi2Integer[],
                                        fmi2Real[]) {
  return refused2(c, "fmi2GetRealOutputDerivatives", "outputs have no derivatives by time");
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean) {
  return call2(c, "fmi2DoStep", kStep,
               [&](Instance& i) { return i.step(currentCommunicationPoint, communicationStepSize); });
}

fmi2Status fmi2CancelStep(fmi2Component c) { return refused2(c, "fmi2CancelStep", "steps are not asynchronous"); }

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind, fmi2Status*) {
  return refused2(c, "fmi2GetStatus", "steps are not asynchronous");
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real* value) {
  return call2(c, "fmi2GetRealStatus", kComputed, [&](Instance& i) {
    require(s == fmi2LastSuccessfulTime && value != nullptr, "only the last successful time can be asked for");
    *value = i.time();
  });
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind, fmi2Integer*) {
  return refused2(c, "fmi2GetIntegerStatus", "there is no such status");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean* value) {
  return call2(c, "fmi2GetBooleanStatus", kComputed, [&](Instance&) {
    require(s == fmi2Terminated && value != nullptr, "only the wish to terminate can be asked for");
    *value = fmi2False;
  });
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind, fmi2String*) {
  return refused2(c, "fmi2GetStringStatus", "steps are not asynchronous");
}

}  // extern "C"
