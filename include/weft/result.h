// Errors at loading time: where and what, as values. Stepping never fails this way; it sets report bits (frame.h).
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace weft {

/// What a problem lies with.
enum class Fault {
    input,    ///< what was asked for: another file, another value will do
    machine,  ///< what it was to be done with: a driver that is missing, memory, a device that is lost
};

/// One problem: the place (`scenes/flag.json: /cloths/0/fabric/density`) and what is wrong there
/// (`must be > 0 kg/m², got -1`). `where` may be empty. Neither ends in a newline.
struct Error {
    std::string where;
    std::string what;
    Fault fault = Fault::input;

    static Error of_machine(std::string where, std::string what) {
        return {std::move(where), std::move(what), Fault::machine};
    }
    std::string message() const { return where.empty() ? what : where + ": " + what; }
};

using Errors = std::vector<Error>;

/// A value, or every problem that stood in its way (at least one).
template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::move(value)) {}
    Result(Error error) : state_(Errors{std::move(error)}) {}
    Result(Errors errors) : state_(std::move(errors)) { assert(!std::get<Errors>(state_).empty()); }

    bool ok() const { return std::holds_alternative<T>(state_); }
    explicit operator bool() const { return ok(); }

    T& value() & { return std::get<T>(state_); }
    const T& value() const& { return std::get<T>(state_); }
    T&& value() && { return std::get<T>(std::move(state_)); }
    T& operator*() & { return value(); }
    const T& operator*() const& { return value(); }
    T&& operator*() && { return std::move(*this).value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }

    const Errors& errors() const { return std::get<Errors>(state_); }
    /// The first problem.
    const Error& error() const { return errors().front(); }

  private:
    std::variant<T, Errors> state_;
};

/// For actions that return nothing: `return Done{};`
struct Done {};

}  // namespace weft
