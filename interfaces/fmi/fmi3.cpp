// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <vector>

#include "treadmark/interfaces/fmi/instance.hpp"
#include "treadmark/interfaces/fmi/third_party/headers/fmi3Functions.h"

namespace treadmark::fmi {
namespace {

template <class Body>
fmi3Status call3(fmi3Instance instance, const char* function, unsigned modes, Body&& body) noexcept {
  return static_cast<fmi3Status>(call(instance, function, modes, body));
}

/// What this FMU does not do, told.
fmi3Status refused3(fmi3Instance instance, const char* function, const char* why) noexcept {
  return call3(instance, function, kAnyMode, [why](Instance&) { throw BadCall{why}; });
}

/// Of calls that may come without any variable.
fmi3Status none3(fmi3Instance instance, const char* function, std::size_t count) noexcept {
  return call3(instance, function, kAnyMode,
               [count](Instance&) { require(count == 0, "there are no variables of this type"); });
}

std::vector<std::uint32_t> arrays(const Instance& i, const fmi3ValueReference* references, std::size_t count,
                                  const void* values, std::size_t room) {
  auto all = i.scalars(references, count, Instance::Arrays::whole);
  require(all.size() == room, "the number of values is not that of the variables");
  require(values != nullptr || room == 0, "the values are null");
  return all;
}

}  // namespace
}  // namespace treadmark::fmi

using namespace treadmark::fmi;

extern "C" {

const char* fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[]) {
  return call3(instance, "fmi3SetDebugLogging", kAnyMode, [&](Instance& i) {
    require(categories != nullptr || nCategories == 0, "the categories are null");
    i.set_logging(loggingOn, {categories, nCategories});
  });
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean, fmi3Boolean loggingOn, fmi3Boolean,
                                         fmi3Boolean, const fmi3ValueReference[], size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback) {
  try {
    Logger logger;
    if (logMessage != nullptr)
      logger = [logMessage, instanceEnvironment](Outcome outcome, const char* category, const char* message) {
        logMessage(instanceEnvironment, static_cast<fmi3Status>(outcome), category, message);
      };
    const char* wrong = instanceName == nullptr              ? "instantiation: the name is null"
                        : resourcePath == nullptr            ? "instantiation: the path of the resources is null"
                        : nRequiredIntermediateVariables > 0 ? "instantiation: there are no intermediate variables"
                                                             : nullptr;
    if (wrong == nullptr) return Instance::create(instantiationToken, resourcePath, logger, loggingOn);
    if (logger) logger(Outcome::error, kCategories[0].name, wrong);
  } catch (...) {
  }
  return nullptr;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                          fmi3InstanceEnvironment, fmi3LogMessageCallback) {
  return nullptr;
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean, fmi3Boolean,
                                               fmi3InstanceEnvironment, fmi3LogMessageCallback, fmi3ClockUpdateCallback,
                                               fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback) {
  return nullptr;
}

void fmi3FreeInstance(fmi3Instance instance) { delete static_cast<Instance*>(instance); }

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean, fmi3Float64, fmi3Float64 startTime,
                                       fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
  return call3(instance, "fmi3EnterInitializationMode", kInstantiated, [&](Instance& i) {
    i.set_up(startTime, stopTimeDefined ? &stopTime : nullptr);
    i.enter_initialization();
  });
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
  return call3(instance, "fmi3ExitInitializationMode", kInitialization, [](Instance& i) { i.exit_initialization(); });
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
  return call3(instance, "fmi3Terminate", kStep, [](Instance& i) { i.terminate(); });
}

fmi3Status fmi3Reset(fmi3Instance instance) {
  return call3(instance, "fmi3Reset", kAnyMode, [](Instance& i) { i.reset(); });
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          fmi3Float64 values[], size_t nValues) {
  return call3(instance, "fmi3GetFloat64", kAnyMode, [&](Instance& i) {
    i.get(arrays(i, valueReferences, nValueReferences, values, nValues), false, values);
  });
}

fmi3Status fmi3GetInt32(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        fmi3Int32 values[], size_t nValues) {
  return call3(instance, "fmi3GetInt32", kAnyMode, [&](Instance& i) {
    const auto scalars = arrays(i, valueReferences, nValueReferences, values, nValues);
    std::vector<double> got(scalars.size());
    i.get(scalars, true, got.data());
    for (std::size_t k = 0; k < got.size(); ++k) values[k] = static_cast<fmi3Int32>(got[k]);
  });
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                          const fmi3Float64 values[], size_t nValues) {
  return call3(instance, "fmi3SetFloat64", kInstantiated | kInitialization | kStep, [&](Instance& i) {
    i.set(arrays(i, valueReferences, nValueReferences, values, nValues), false, values);
  });
}

fmi3Status fmi3SetInt32(fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences,
                        const fmi3Int32 values[], size_t nValues) {
  return call3(instance, "fmi3SetInt32", kInstantiated | kInitialization | kStep, [&](Instance& i) {
    const auto scalars = arrays(i, valueReferences, nValueReferences, values, nValues);
    i.set(scalars, true, std::vector<double>(values, values + nValues).data());
  });
}

// There are no variables of these types.
#define TREADMARK_NO_SUCH_VARIABLES(type)                                                                            \
  fmi3Status fmi3Get##type(fmi3Instance instance, const fmi3ValueReference[], size_t nValueReferences, fmi3##type[], \
                           size_t) {                                                                                 \
    return none3(instance, "fmi3Get" #type, nValueReferences);                                                       \
  }                                                                                                                  \
  fmi3Status fmi3Set##type(fmi3Instance instance, const fmi3ValueReference[], size_t nValueReferences,               \
                           const fmi3##type[], size_t) {                                                             \
    return none3(instance, "fmi3Set" #type, nValueReferences);                                                       \
  }
TREADMARK_NO_SUCH_VARIABLES(Float32)
TREADMARK_NO_SUCH_VARIABLES(Int8)
TREADMARK_NO_SUCH_VARIABLES(UInt8)
TREADMARK_NO_SUCH_VARIABLES(Int16)
TREADMARK_NO_SUCH_VARIABLES(UInt16)
TREADMARK_NO_SUCH_VARIABLES(UInt32)
TREADMARK_NO_SUCH_VARIABLES(Int64)
TREADMARK_NO_SUCH_VARIABLES(UInt64)
TREADMARK_NO_SUCH_VARIABLES(Boolean)
TREADMARK_NO_SUCH_VARIABLES(String)
#undef TREADMARK_NO_SUCH_VARIABLES

fmi3Status fmi3GetBinary(fmi3Instance instance, const fmi3ValueReference[], size_t nValueReferences, size_t[],
                         fmi3Binary[], size_t) {
  return none3(instance, "fmi3GetBinary", nValueReferences);
}

fmi3Status fmi3SetBinary(fmi3Instance instance, const fmi3ValueReference[], size_t nValueReferences, const size_t[],
                         const fmi3Binary[], size_t) {
  return none3(instance, "fmi3SetBinary", nValueReferences);
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState* FMUState) {
  return call3(instance, "fmi3GetFMUState", kAnyMode, [&](Instance& i) { get_state(i, FMUState); });
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
  return call3(instance, "fmi3SetFMUState", kAnyMode, [&](Instance& i) { set_state(i, FMUState); });
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState* FMUState) {
  return call3(instance, "fmi3FreeFMUState", kAnyMode, [&](Instance&) { free_state(FMUState); });
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t* size) {
  return call3(instance, "fmi3SerializedFMUStateSize", kAnyMode, [&](Instance&) { state_size(FMUState, size); });
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[],
                                 size_t size) {
  return call3(instance, "fmi3SerializeFMUState", kAnyMode,
               [&](Instance&) { serialize(FMUState, serializedState, size); });
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState* FMUState) {
  return call3(instance, "fmi3DeserializeFMUState", kAnyMode,
               [&](Instance& i) { deserialize(i, serializedState, size, FMUState); });
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns,
                                        const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
                                        size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity) {
  return call3(instance, "fmi3GetDirectionalDerivative", kInitialization | kStep, [&](Instance& i) {
    const auto outputs = arrays(i, unknowns, nUnknowns, sensitivity, nSensitivity),
               inputs = arrays(i, knowns, nKnowns, seed, nSeed);
    i.derivative(outputs, inputs, {seed, nSeed}, sensitivity);
  });
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean, fmi3Boolean* eventHandlingNeeded, fmi3Boolean* terminateSimulation,
                      fmi3Boolean* earlyReturn, fmi3Float64* lastSuccessfulTime) {
  return call3(instance, "fmi3DoStep", kStep, [&](Instance& i) {
    for (fmi3Boolean* flag : {eventHandlingNeeded, terminateSimulation, earlyReturn})
      require(flag != nullptr, "a place for an answer is null");
    require(lastSuccessfulTime != nullptr, "the place for the last successful time is null");
    *eventHandlingNeeded = *terminateSimulation = *earlyReturn = fmi3False;
    *lastSuccessfulTime = i.time();
    const Outcome outcome = i.step(currentCommunicationPoint, communicationStepSize);
    *lastSuccessfulTime = i.time();
    return outcome;
  });
}

// What this FMU does not do.
#define TREADMARK_REFUSED(function, why, ...) \
  fmi3Status function(fmi3Instance instance __VA_OPT__(, ) __VA_ARGS__) { return refused3(instance, #function, why); }
#define TREADMARK_REFERENCES const fmi3ValueReference[], size_t
#define TREADMARK_NO_EVENTS "there is no event mode"
#define TREADMARK_NO_CLOCKS "there are no clocks"
TREADMARK_REFUSED(fmi3EnterEventMode, TREADMARK_NO_EVENTS)
TREADMARK_REFUSED(fmi3EnterStepMode, TREADMARK_NO_EVENTS)
TREADMARK_REFUSED(fmi3EvaluateDiscreteStates, TREADMARK_NO_EVENTS)
TREADMARK_REFUSED(fmi3UpdateDiscreteStates, TREADMARK_NO_EVENTS, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                  fmi3Boolean*, fmi3Float64*)
TREADMARK_REFUSED(fmi3EnterConfigurationMode, "there are no structural parameters")
TREADMARK_REFUSED(fmi3ExitConfigurationMode, "there are no structural parameters")
TREADMARK_REFUSED(fmi3GetNumberOfVariableDependencies, "dependencies of elements are not told", fmi3ValueReference,
                  size_t*)
TREADMARK_REFUSED(fmi3GetVariableDependencies, "dependencies of elements are not told", fmi3ValueReference, size_t[],
                  fmi3ValueReference[], size_t[], fmi3DependencyKind[], size_t)
TREADMARK_REFUSED(fmi3GetAdjointDerivative, "there are no adjoint derivatives", TREADMARK_REFERENCES,
                  TREADMARK_REFERENCES, const fmi3Float64[], size_t, fmi3Float64[], size_t)
TREADMARK_REFUSED(fmi3GetOutputDerivatives, "outputs have no derivatives by time", TREADMARK_REFERENCES,
                  const fmi3Int32[], fmi3Float64[], size_t)
TREADMARK_REFUSED(fmi3GetClock, TREADMARK_NO_CLOCKS, TREADMARK_REFERENCES, fmi3Clock[])
TREADMARK_REFUSED(fmi3SetClock, TREADMARK_NO_CLOCKS, TREADMARK_REFERENCES, const fmi3Clock[])
TREADMARK_REFUSED(fmi3GetIntervalDecimal, TREADMARK_NO_CLOCKS, TREADMARK_REFERENCES, fmi3Float64[],
                  fmi3IntervalQualifier[])
TREADMARK_REFUSED(fmi3GetIntervalFraction, TREADMARK_NO_CLOCKS, TREADMARK_REFERENCES, fmi3UInt64[], fmi3UInt64[],
                  fmi3IntervalQualifier[])
TREADMARK_REFUSED(fmi3GetShiftDecimal, TREADMARK_NO_CLOCKS, TREADMARK_REFERENCES, fmi3Float64[])
TREADMARK_REFUSED(fmi3GetShiftFraction, TREADMARK_NO_CLOCKS, TREADMARK_REFERENCES, fmi3UInt64[], fmi3UInt64[])
TREADMARK_REFUSED(fmi3SetIntervalDecimal, TREADMARK_NO_CLOCKS, TREADMARK_REFERENCES, const fmi3Float64[])
TREADMARK_REFUSED(fmi3SetIntervalFraction, TREADMARK_NO_CLOCKS, TREADMARK_REFERENCES, const fmi3UInt64[],
                  const fmi3UInt64[])
TREADMARK_REFUSED(fmi3SetShiftDecimal, TREADMARK_NO_CLOCKS, TREADMARK_REFERENCES, const fmi3Float64[])
TREADMARK_REFUSED(fmi3SetShiftFraction, TREADMARK_NO_CLOCKS, TREADMARK_REFERENCES, const fmi3UInt64[],
                  const fmi3UInt64[])
#undef TREADMARK_REFUSED
#undef TREADMARK_REFERENCES
#undef TREADMARK_NO_EVENTS
#undef TREADMARK_NO_CLOCKS

}  // extern "C"
