// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/interfaces/fmi/instance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <utility>

#include "treadmark/app/version.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::fmi {
namespace {

constexpr const char *kErrorCategory = kCategories[0].name, *kDiscardCategory = kCategories[1].name,
                     *kAllCategory = kCategories[2].name;
constexpr std::uint32_t kStateFormat = 2;

/// The message of the exception that is being handled, to the logger. Nothing gets past it.
void tell(const Logger& logger, const char* function) noexcept {
  const auto say = [&](const char* what) {
    if (logger) logger(Outcome::error, kErrorCategory, fmt::format("{}: {}", function, what).c_str());
  };
  try {
    try {
      throw;
    } catch (const BadCall& wrong) {
      say(wrong.what.c_str());
    } catch (const std::bad_alloc&) {
      say("there is not enough memory");
    } catch (const std::exception& error) {
      say(error.what());
    } catch (...) {
      say("an unknown error");
    }
  } catch (...) {  // no memory for the message, or a logger in C++ that throws
  }
}

}  // namespace

void require(bool right, const char* what) {
  if (!right) throw BadCall{what};
}

Instance* Instance::create(const char* token, const std::filesystem::path& resources, const Logger& logger,
                           bool tells_all) {
  try {
    std::unique_ptr<Instance> made(new Instance);
    made->token_ = token_of(resources);
    require(token != nullptr && made->token_ == token,
            "the token is not that of modelDescription.xml, or the resources are not those of this FMU");
    made->model_ = open_model(resources);
    made->logger_ = logger;
    made->tells_all_ = tells_all;
    made->log(Outcome::ok, kAllCategory,
              fmt::format("Treadmark {} ({}), {}", app::version(), app::git_revision(), app::build_description()));
    return made.release();
  } catch (...) {
    tell(logger, "instantiation");
    return nullptr;
  }
}

void Instance::log(Outcome outcome, const char* category, const std::string& message) const {
  if (logger_ && (tells_all_ || category != kAllCategory)) logger_(outcome, category, message.c_str());
}

void Instance::set_logging(bool on, std::span<const char* const> categories) {
  bool all = categories.empty();
  for (const char* name : categories) {
    require(name != nullptr, "a category is null");
    const auto found =
        ranges::find_if(kCategories, [&](const Category& c) { return std::string_view(c.name) == name; });
    require(found != std::end(kCategories), "there is no such category");
    all = all || found->name == kAllCategory;
  }
  if (all) tells_all_ = on;
}

void Instance::set_up(double start_time, const double* stop_time) {
  require(std::isfinite(start_time), "the start time is not finite");
  require(stop_time == nullptr || (std::isfinite(*stop_time) && *stop_time >= start_time),
          "the stop time lies before the start time");
  time_ = start_time;
  stop_time_ = stop_time == nullptr ? std::numeric_limits<double>::infinity() : *stop_time;
}

void Instance::compute_start() {
  if (computed_) return;
  if (const Report report = model_->start(time_); report.status != Status::ok)
    throw Error(ErrorKind::numerical, report.message);
  computed_ = true;
}

void Instance::exit_initialization() {
  compute_start();
  mode_ = kStep;
}

void Instance::reset() {
  model_->reset();
  mode_ = kInstantiated;
  time_ = 0.0;
  stop_time_ = std::numeric_limits<double>::infinity();
  computed_ = false;
}

std::vector<std::uint32_t> Instance::scalars(const std::uint32_t* references, std::size_t count, Arrays arrays) const {
  require(references != nullptr || count == 0, "the value references are null");
  std::vector<std::uint32_t> all;
  for (std::size_t i = 0; i < count; ++i) {
    const Variable* variable = model_->variables().of(references[i]);
    if (variable == nullptr || (arrays == Arrays::whole && variable->reference != references[i]))
      throw BadCall{fmt::format("there is no variable of value reference {}", references[i])};
    const std::uint32_t elements = arrays == Arrays::whole ? variable->elements() : 1;
    for (std::uint32_t k = 0; k < elements; ++k) all.push_back(references[i] + k);
  }
  return all;
}

void Instance::get(std::span<const std::uint32_t> scalars, bool integers, double* out) {
  bool outputs = false;
  for (const std::uint32_t scalar : scalars) {
    const Variable& variable = *model_->variables().of(scalar);
    if (variable.integer != integers)
      throw BadCall{fmt::format("{} is {}", variable.name, integers ? "no integer" : "an integer")};
    outputs = outputs || variable.kind == Variable::Kind::output;
  }
  if (outputs) {
    require(mode_ != kInstantiated, "there are no outputs before the initialization");
    if (mode_ == kInitialization) compute_start();
  }
  model_->values()[0] = time_;
  for (std::size_t i = 0; i < scalars.size(); ++i) out[i] = model_->values()[scalars[i]];
}

void Instance::set(std::span<const std::uint32_t> scalars, bool integers, const double* values) {
  for (std::size_t i = 0; i < scalars.size(); ++i) {
    const Variable& variable = *model_->variables().of(scalars[i]);
    const auto refuse = [&](const char* why) { throw BadCall{fmt::format("{} {}", variable.name, why)}; };
    if (!variable.settable()) refuse("cannot be set");
    if (variable.integer != integers) refuse("is of another type");
    if (variable.kind == Variable::Kind::parameter && mode_ == kStep) refuse("is fixed after the initialization");
    if (!std::isfinite(values[i])) refuse("must be finite");
  }
  for (std::size_t i = 0; i < scalars.size(); ++i) model_->values()[scalars[i]] = values[i];
  if (mode_ == kInitialization) computed_ = false;
}

void Instance::derivative(std::span<const std::uint32_t> outputs, std::span<const std::uint32_t> inputs,
                          std::span<const double> seed, double* out) {
  require(model_->differentiable(), "this FMU has no directional derivatives");
  for (const std::uint32_t scalar : outputs) {
    const Variable& variable = *model_->variables().of(scalar);
    if (variable.kind != Variable::Kind::output || variable.integer)
      throw BadCall{variable.name + " is no output with derivatives"};
  }
  for (const std::uint32_t scalar : inputs)
    if (const Variable& variable = *model_->variables().of(scalar); variable.kind != Variable::Kind::input)
      throw BadCall{variable.name + " is no input"};
  for (const double value : seed) require(std::isfinite(value), "the seed is not finite");
  if (mode_ == kInitialization) compute_start();
  ranges::copy(model_->derivative(outputs, inputs, seed), out);
}

Outcome Instance::step(double from, double length) {
  require(std::isfinite(from) && std::isfinite(length), "time and step must be finite");
  require(length > 0.0, "the step must be positive");
  const double tolerance = 1e-9 * std::max({1.0, std::abs(from), std::abs(time_)});
  if (std::abs(from - time_) > tolerance)
    throw BadCall{fmt::format("the step starts at {}, but this FMU stands at {}", from, time_)};
  if (from + length > stop_time_ + tolerance)
    throw BadCall{fmt::format("the step ends at {}, behind the stop time {}", from + length, stop_time_)};
  const Report report = model_->step(time_, from + length);
  if (report.status != Status::ok) {
    log(Outcome::discard, kDiscardCategory, report.message);
    return Outcome::discard;
  }
  time_ = from + length;
  return Outcome::ok;
}

SavedState Instance::save() const {
  ByteWriter out;
  out.put(kStateFormat);
  out.put(token_);
  out.put(mode_);
  out.put(time_);
  out.put(stop_time_);
  out.put(computed_);
  model_->save(out);
  return {out.bytes()};
}

void Instance::check(std::span<const std::byte> bytes) const {
  ByteReader in(bytes);
  std::string token;
  if (in.get<std::uint32_t>() != kStateFormat) refuse_saved_state("it has another format");
  in.get(token);
  if (token != token_) refuse_saved_state("it belongs to another FMU");
}

void Instance::restore(const SavedState& state) {
  check(state.bytes);
  ByteReader in(state.bytes);
  in.get<std::uint32_t>();
  std::string token;
  in.get(token);
  const auto mode = in.get<Mode>();
  const double time = in.get<double>(), stop_time = in.get<double>();
  const bool computed = in.get<bool>();
  if ((mode != kInstantiated && mode != kInitialization && mode != kStep && mode != kTerminated) ||
      !std::isfinite(time) || std::isnan(stop_time))
    refuse_saved_state("it is of no mode or time");
  const SavedState before = save();
  try {
    model_->restore(in);
  } catch (...) {
    ByteReader back(before.bytes);
    back.get<std::uint32_t>();
    back.get(token);
    back.get<Mode>();
    back.get<double>();
    back.get<double>();
    back.get<bool>();
    model_->restore(back);
    throw;
  }
  mode_ = mode, time_ = time, stop_time_ = stop_time, computed_ = computed;
}

Outcome call(void* instance, const char* function, unsigned modes, Outcome (*body)(Instance&, void*),
             void* data) noexcept {
  if (instance == nullptr) return Outcome::error;
  auto& it = *static_cast<Instance*>(instance);
  try {
    if ((it.mode() & modes) == 0) {
      const char* where = it.mode() == kInstantiated     ? "before the initialization"
                          : it.mode() == kInitialization ? "during the initialization"
                          : it.mode() == kStep           ? "after the initialization"
                                                         : "after the end";
      throw BadCall{fmt::format("not allowed {}", where)};
    }
    return body(it, data);
  } catch (...) {
    tell([&](Outcome outcome, const char* category, const char* message) { it.log(outcome, category, message); },
         function);
    return Outcome::error;
  }
}

void get_state(Instance& instance, void** state) {
  require(state != nullptr, "the place for the state is null");
  auto made = std::make_unique<SavedState>(instance.save());
  if (*state == nullptr)
    *state = made.release();
  else
    *static_cast<SavedState*>(*state) = std::move(*made);
}

void set_state(Instance& instance, const void* state) {
  require(state != nullptr, "the state is null");
  instance.restore(*static_cast<const SavedState*>(state));
}

void free_state(void** state) {
  if (state == nullptr) return;
  delete static_cast<SavedState*>(*state);
  *state = nullptr;
}

void state_size(const void* state, std::size_t* size) {
  require(state != nullptr && size != nullptr, "state and size must not be null");
  *size = static_cast<const SavedState*>(state)->bytes.size() + sizeof(std::uint64_t);
}

void serialize(const void* state, void* bytes, std::size_t size) {
  require(state != nullptr && bytes != nullptr, "state and bytes must not be null");
  const auto& from = static_cast<const SavedState*>(state)->bytes;
  const std::uint64_t sum = check_sum(from);
  require(size >= from.size() + sizeof sum, "there is not enough room for the state");
  std::memcpy(bytes, from.data(), from.size());
  std::memcpy(static_cast<std::byte*>(bytes) + from.size(), &sum, sizeof sum);
}

void deserialize(const Instance& instance, const void* bytes, std::size_t size, void** state) {
  require(bytes != nullptr && state != nullptr, "bytes and state must not be null");
  const std::span<const std::byte> all(static_cast<const std::byte*>(bytes), size);
  std::uint64_t sum = 0;
  if (size < sizeof sum) refuse_saved_state("it ends too early");
  const auto content = all.first(size - sizeof sum);
  instance.check(content);
  std::memcpy(&sum, content.data() + content.size(), sizeof sum);
  if (check_sum(content) != sum) refuse_saved_state("its check sum differs");
  auto made = std::make_unique<SavedState>(SavedState{{content.begin(), content.end()}});
  *state = made.release();
}

}  // namespace treadmark::fmi
