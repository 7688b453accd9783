// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/interfaces/fmi/importer.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdarg>
#include <regex>
#include <stdexcept>

#include "treadmark/interfaces/fmi/third_party/headers/fmi2Functions.h"
#include "treadmark/interfaces/fmi/third_party/headers/fmi3Functions.h"

namespace treadmark::testing {
namespace {

void* open_library(const std::filesystem::path& file) {
  void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(dlerror());
  return library;
}

template <class Function>
Function* symbol(void* library, const char* name) {
  void* found = dlsym(library, name);
  if (found == nullptr) throw std::runtime_error(name);
  return reinterpret_cast<Function*>(found);
}

/// Many importers show the format itself: it has to be the whole message.
void log2(fmi2ComponentEnvironment to, fmi2String, fmi2Status, fmi2String, fmi2String format, ...) {
  EXPECT_STRNE(format, "%s");
  char text[4096];
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  *static_cast<std::string*>(to) += std::string(text) + '\n';
}

void log3(fmi3InstanceEnvironment to, fmi3Status, fmi3String, fmi3String message) {
  *static_cast<std::string*>(to) += std::string(message) + '\n';
}

// The functions of a version as members, by their own names.
#define FUNCTION(name) name##TYPE* name = symbol<name##TYPE>(library, #name)

class Importer2 final : public Importer {
 public:
  Importer2(const UnpackedFmu& fmu, const char* token, std::string* messages) : library(open_library(fmu.library)) {
    messages_ = messages == nullptr ? &own_messages_ : messages;
    const std::regex row(
        "<ScalarVariable name=\"([^\"]+?)(\\[\\d+\\])?\" valueReference=\"(\\d+)\"[^>]*><(Real|Integer)");
    for (std::sregex_iterator i(fmu.description.begin(), fmu.description.end(), row), end; i != end; ++i) {
      Known& known = variables_[(*i)[1]];
      known.references.push_back(static_cast<std::uint32_t>(std::stoul((*i)[3])));
      known.elements = known.references.size();
      known.integer = (*i)[4] == "Integer";
    }
    callbacks_ = {log2, nullptr, nullptr, nullptr, messages_};
    EXPECT_STREQ(fmi2GetVersion(), "2.0");
    EXPECT_STREQ(fmi2GetTypesPlatform(), "default");
    const std::string own = fmu.attribute("guid"),
                      uri = "file://" + std::regex_replace(fmu.resources.string(), std::regex(" "), "%20");
    instance = fmi2Instantiate("one", fmi2CoSimulation, token == nullptr ? own.c_str() : token, uri.c_str(),
                               &callbacks_, fmi2False, fmi2False);
  }
  ~Importer2() override { fmi2FreeInstance(instance); }

  int enter_initialization(double start_time, std::optional<double> stop_time) override {
    const int status = fmi2SetupExperiment(instance, fmi2False, 0.0, start_time, stop_time ? fmi2True : fmi2False,
                                           stop_time.value_or(0.0));
    return status == fmi2OK ? fmi2EnterInitializationMode(instance) : status;
  }
  int exit_initialization() override { return fmi2ExitInitializationMode(instance); }
  int step(double from, double length) override { return fmi2DoStep(instance, from, length, fmi2True); }
  int terminate() override { return fmi2Terminate(instance); }
  int reset() override { return fmi2Reset(instance); }
  int set_reals(const std::vector<std::uint32_t>& vr, const std::vector<double>& values) override {
    return fmi2SetReal(instance, vr.data(), vr.size(), values.data());
  }
  int get_reals(const std::vector<std::uint32_t>& vr, std::vector<double>& values) override {
    return fmi2GetReal(instance, vr.data(), vr.size(), values.data());
  }
  int get_integers(const std::vector<std::uint32_t>& vr, std::vector<int>& values) override {
    return fmi2GetInteger(instance, vr.data(), vr.size(), values.data());
  }
  int save(void** state) override { return fmi2GetFMUstate(instance, state); }
  int restore(void* state) override { return fmi2SetFMUstate(instance, state); }
  int free_state(void** state) override { return fmi2FreeFMUstate(instance, state); }
  int to_bytes(void* state, std::string& bytes) override {
    std::size_t size = 0;
    const int status = fmi2SerializedFMUstateSize(instance, state, &size);
    bytes.resize(size);
    return status == fmi2OK ? fmi2SerializeFMUstate(instance, state, bytes.data(), size) : status;
  }
  int from_bytes(const std::string& bytes, void** state) override {
    return fmi2DeSerializeFMUstate(instance, bytes.data(), bytes.size(), state);
  }
  int derivative(const std::vector<std::uint32_t>& unknowns, const std::vector<std::uint32_t>& knowns,
                 const std::vector<double>& seed, std::vector<double>& sensitivity) override {
    return fmi2GetDirectionalDerivative(instance, unknowns.data(), unknowns.size(), knowns.data(), knowns.size(),
                                        seed.data(), sensitivity.data());
  }
  std::vector<int> without_instance() override {
    double value = 0.0;
    const fmi2ValueReference reference = 1;
    void* state = nullptr;
    fmi2FreeInstance(nullptr);
    return {fmi2SetupExperiment(nullptr, fmi2False, 0.0, 0.0, fmi2False, 0.0),
            fmi2EnterInitializationMode(nullptr),
            fmi2DoStep(nullptr, 0.0, 1.0, fmi2True),
            fmi2GetReal(nullptr, &reference, 1, &value),
            fmi2SetReal(nullptr, &reference, 1, &value),
            fmi2GetFMUstate(nullptr, &state),
            fmi2Terminate(nullptr),
            fmi2Reset(nullptr)};
  }
  std::vector<int> for_nothing() override {
    const fmi2ValueReference reference = 1;
    fmi2Boolean flag = fmi2False;
    fmi2Integer order = 1;
    double value = 0.0;
    return {fmi2GetBoolean(instance, &reference, 1, &flag), fmi2CancelStep(instance),
            fmi2GetRealOutputDerivatives(instance, &reference, 1, &order, &value),
            fmi2GetReal(instance, nullptr, 1, &value), fmi2GetReal(instance, &reference, 1, nullptr)};
  }

  void* library;
  fmi2CallbackFunctions callbacks_{};
  fmi2Component instance = nullptr;
  FUNCTION(fmi2GetVersion);
  FUNCTION(fmi2GetTypesPlatform);
  FUNCTION(fmi2Instantiate);
  FUNCTION(fmi2FreeInstance);
  FUNCTION(fmi2SetupExperiment);
  FUNCTION(fmi2EnterInitializationMode);
  FUNCTION(fmi2ExitInitializationMode);
  FUNCTION(fmi2DoStep);
  FUNCTION(fmi2Terminate);
  FUNCTION(fmi2Reset);
  FUNCTION(fmi2SetReal);
  FUNCTION(fmi2GetReal);
  FUNCTION(fmi2GetInteger);
  FUNCTION(fmi2GetFMUstate);
  FUNCTION(fmi2SetFMUstate);
  FUNCTION(fmi2FreeFMUstate);
  FUNCTION(fmi2SerializedFMUstateSize);
  FUNCTION(fmi2SerializeFMUstate);
  FUNCTION(fmi2DeSerializeFMUstate);
  FUNCTION(fmi2GetDirectionalDerivative);
  FUNCTION(fmi2GetBoolean);
  FUNCTION(fmi2CancelStep);
  FUNCTION(fmi2GetRealOutputDerivatives);
};

class Importer3 final : public Importer {
 public:
  Importer3(const UnpackedFmu& fmu, const char* token, std::string* messages) : library(open_library(fmu.library)) {
    messages_ = messages == nullptr ? &own_messages_ : messages;
    const std::regex row(
        "<(Float64|Int32) name=\"([^\"]+)\" valueReference=\"(\\d+)\"[^>]*?(/>|><Dimension start=\"(\\d+)\"/>)");
    for (std::sregex_iterator i(fmu.description.begin(), fmu.description.end(), row), end; i != end; ++i) {
      Known& known = variables_[(*i)[2]];
      known.references = {static_cast<std::uint32_t>(std::stoul((*i)[3]))};
      known.elements = (*i)[5].matched ? std::stoul((*i)[5]) : 1;
      known.integer = (*i)[1] == "Int32";
    }
    EXPECT_STREQ(fmi3GetVersion(), "3.0");
    const std::string own = fmu.attribute("instantiationToken"), path = fmu.resources.string() + '/';
    instance = fmi3InstantiateCoSimulation("one", token == nullptr ? own.c_str() : token, path.c_str(), fmi3False,
                                           fmi3False, fmi3False, fmi3False, nullptr, 0, messages_, log3, nullptr);
  }
  ~Importer3() override { fmi3FreeInstance(instance); }

  int enter_initialization(double start_time, std::optional<double> stop_time) override {
    return fmi3EnterInitializationMode(instance, fmi3False, 0.0, start_time, stop_time.has_value(),
                                       stop_time.value_or(0.0));
  }
  int exit_initialization() override { return fmi3ExitInitializationMode(instance); }
  int step(double from, double length) override {
    bool event = true, end = true, early = true;
    double last = -1.0;
    const int status = fmi3DoStep(instance, from, length, fmi3True, &event, &end, &early, &last);
    if (status == fmi3OK) {
      EXPECT_FALSE(event || end || early);
      EXPECT_EQ(last, from + length);
    }
    return status;
  }
  int terminate() override { return fmi3Terminate(instance); }
  int reset() override { return fmi3Reset(instance); }
  int set_reals(const std::vector<std::uint32_t>& vr, const std::vector<double>& values) override {
    return fmi3SetFloat64(instance, vr.data(), vr.size(), values.data(), values.size());
  }
  int get_reals(const std::vector<std::uint32_t>& vr, std::vector<double>& values) override {
    return fmi3GetFloat64(instance, vr.data(), vr.size(), values.data(), values.size());
  }
  int get_integers(const std::vector<std::uint32_t>& vr, std::vector<int>& values) override {
    return fmi3GetInt32(instance, vr.data(), vr.size(), values.data(), values.size());
  }
  int save(void** state) override { return fmi3GetFMUState(instance, state); }
  int restore(void* state) override { return fmi3SetFMUState(instance, state); }
  int free_state(void** state) override { return fmi3FreeFMUState(instance, state); }
  int to_bytes(void* state, std::string& bytes) override {
    std::size_t size = 0;
    const int status = fmi3SerializedFMUStateSize(instance, state, &size);
    bytes.resize(size);
    return status == fmi3OK ? fmi3SerializeFMUState(instance, state, reinterpret_cast<fmi3Byte*>(bytes.data()), size)
                            : status;
  }
  int from_bytes(const std::string& bytes, void** state) override {
    return fmi3DeserializeFMUState(instance, reinterpret_cast<const fmi3Byte*>(bytes.data()), bytes.size(), state);
  }
  int derivative(const std::vector<std::uint32_t>& unknowns, const std::vector<std::uint32_t>& knowns,
                 const std::vector<double>& seed, std::vector<double>& sensitivity) override {
    return fmi3GetDirectionalDerivative(instance, unknowns.data(), unknowns.size(), knowns.data(), knowns.size(),
                                        seed.data(), seed.size(), sensitivity.data(), sensitivity.size());
  }
  std::vector<int> without_instance() override {
    double value = 0.0;
    bool flags[3] = {};
    const fmi3ValueReference reference = 1;
    void* state = nullptr;
    fmi3FreeInstance(nullptr);
    EXPECT_EQ(fmi3InstantiateModelExchange("one", "", "", fmi3False, fmi3False, nullptr, nullptr), nullptr);
    return {fmi3EnterInitializationMode(nullptr, fmi3False, 0.0, 0.0, fmi3False, 0.0),
            fmi3DoStep(nullptr, 0.0, 1.0, fmi3True, flags, flags + 1, flags + 2, &value),
            fmi3GetFloat64(nullptr, &reference, 1, &value, 1),
            fmi3SetFloat64(nullptr, &reference, 1, &value, 1),
            fmi3GetFMUState(nullptr, &state),
            fmi3Terminate(nullptr),
            fmi3Reset(nullptr)};
  }
  std::vector<int> for_nothing() override {
    const fmi3ValueReference reference = 1;
    bool flag = false;
    double value = 0.0;
    fmi3Int32 order = 1;
    return {fmi3GetBoolean(instance, &reference, 1, &flag, 1),
            fmi3EnterEventMode(instance),
            fmi3EnterConfigurationMode(instance),
            fmi3GetOutputDerivatives(instance, &reference, 1, &order, &value, 1),
            fmi3GetFloat64(instance, nullptr, 1, &value, 1),
            fmi3GetFloat64(instance, &reference, 1, nullptr, 1),
            fmi3DoStep(instance, 0.0, 1e-3, fmi3True, nullptr, nullptr, nullptr, nullptr)};
  }

  void* library;
  fmi3Instance instance = nullptr;
  FUNCTION(fmi3GetVersion);
  FUNCTION(fmi3InstantiateCoSimulation);
  FUNCTION(fmi3FreeInstance);
  FUNCTION(fmi3EnterInitializationMode);
  FUNCTION(fmi3ExitInitializationMode);
  FUNCTION(fmi3DoStep);
  FUNCTION(fmi3Terminate);
  FUNCTION(fmi3Reset);
  FUNCTION(fmi3SetFloat64);
  FUNCTION(fmi3GetFloat64);
  FUNCTION(fmi3GetInt32);
  FUNCTION(fmi3GetFMUState);
  FUNCTION(fmi3SetFMUState);
  FUNCTION(fmi3FreeFMUState);
  FUNCTION(fmi3SerializedFMUStateSize);
  FUNCTION(fmi3SerializeFMUState);
  FUNCTION(fmi3DeserializeFMUState);
  FUNCTION(fmi3GetDirectionalDerivative);
  FUNCTION(fmi3InstantiateModelExchange);
  FUNCTION(fmi3GetBoolean);
  FUNCTION(fmi3EnterEventMode);
  FUNCTION(fmi3EnterConfigurationMode);
  FUNCTION(fmi3GetOutputDerivatives);
};
#undef FUNCTION

}  // namespace

std::string UnpackedFmu::attribute(const std::string& name) const {
  std::smatch found;
  return std::regex_search(description, found, std::regex(" " + name + "=\"([^\"]*)\"")) ? found[1].str() : "";
}

std::unique_ptr<Importer> Importer::open(const UnpackedFmu& fmu, const char* token, std::string* messages) {
  if (fmu.version == 2) {
    auto made = std::make_unique<Importer2>(fmu, token, messages);
    if (made->instance != nullptr) return made;
  } else {
    auto made = std::make_unique<Importer3>(fmu, token, messages);
    if (made->instance != nullptr) return made;
  }
  return nullptr;
}

int Importer::set(const std::string& name, double value) { return set_reals(variables_.at(name).references, {value}); }

std::vector<double> Importer::get(const std::string& name) {
  const Known& known = variables_.at(name);
  std::vector<double> values(known.elements);
  if (known.integer) {
    std::vector<int> integers(known.elements);
    EXPECT_EQ(get_integers(known.references, integers), kOk) << name << ' ' << messages();
    values.assign(integers.begin(), integers.end());
  } else {
    EXPECT_EQ(get_reals(known.references, values), kOk) << name << ' ' << messages();
  }
  return values;
}

int Importer::initialize(double start_time, std::optional<double> stop_time) {
  const int status = enter_initialization(start_time, stop_time);
  return status == kOk ? exit_initialization() : status;
}

}  // namespace treadmark::testing
