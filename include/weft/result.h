// Errors as return values. Errors inside a step are not returned; Simulation::reports() names them.
#pragma once

#include <cassert>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace weft {

/// The cause of a problem.
enum class Fault {
    input,    ///< the request: another file or another value can succeed
    machine,  ///< the machine: missing driver, not enough memory, lost device
};

/// One problem: the place (`scenes/flag.json: /cloths/0/fabric/density`) and what is wrong there
/// (`must be > 0 kg/m², got -1`). `where` may be empty. Neither ends in a newline.
struct Error {
    std::string where;
    std::string what;
    Fault fault = Fault::input;

    /// An error with Fault::machine.
    static Error of_machine(std::string where, std::string what) {
        return {std::move(where), std::move(what), Fault::machine};
    }
    /// `where: what`, or `what` if `where` is empty.
    std::string message() const { return where.empty() ? what : where + ": " + what; }
};

using Errors = std::vector<Error>;

/// A value, or at least one error. Call value() only if ok() is true, errors() and error() only if it is false.
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
    /// The first error.
    const Error& error() const { return errors().front(); }

  private:
    std::variant<T, Errors> state_;
};

/// Result of an action without a value: `return {};` means success.
template <>
class [[nodiscard]] Result<void> {
  public:
    Result() = default;
    Result(Error error) : errors_{std::move(error)} {}
    Result(Errors errors) : errors_(std::move(errors)) { assert(!errors_.empty()); }

    bool ok() const { return errors_.empty(); }
    explicit operator bool() const { return ok(); }

    const Errors& errors() const { return errors_; }
    const Error& error() const { return errors().front(); }

  private:
    Errors errors_;
};

}  // namespace weft
