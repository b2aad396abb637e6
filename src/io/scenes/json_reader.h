// Typed access to one JSON object. The known keys come from parameter tables. All problems are recorded with their
// places; reading does not stop at the first.
#pragma once

#include "base/parameter.h"
#include "scene/problems.h"

#include <weft/vector.h>

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// A short description of a value for the end of a message: `a number`, `"soft"`, `a list of 3`.
std::string json_text(const nlohmann::json& value);

class ObjectReader {
  public:
    /// If `value` is not an object, reports it and reads it as an empty one.
    ObjectReader(const nlohmann::json& value, std::string pointer, Problems& problems);

    const std::string& pointer() const { return pointer_; }
    Problems& problems() { return problems_; }

    /// Makes the keys of `table` known and stores the given values in the struct at `base`. A value of a wrong type is
    /// reported and not stored; check.h checks the ranges.
    void values(std::span<const Parameter> table, void* base);
    /// Makes keys known that the caller reads itself: objects and lists.
    void know(std::span<const Parameter> table) { values(table, nullptr); }

    /// nullptr if the object does not have the key, which must be known.
    const nlohmann::json* find(std::string_view key) const;

    /// Calls `read` for the object under `key`, if there is one, and finishes it.
    void object(std::string_view key, const std::function<void(ObjectReader&)>& read);
    /// Calls `read` for every object of the list under `key`, if there is one, and finishes them.
    void objects(std::string_view key, const std::function<void(ObjectReader&)>& read);
    /// The list of indices under `key`; an entry that is not an index is reported and read as 0.
    std::vector<std::uint32_t> indices(std::string_view key);

    /// The list of numbers under `key`; what is no number is reported and read as 0.
    std::vector<float> numbers(std::string_view key);

    /// The list of points under `key`, each of three numbers; what is no point is reported and read as zeros.
    std::vector<Vec3> points(std::string_view key);

    /// The one of these keys that the object has; if it has none or several, reports a problem and returns an empty
    /// name.
    std::string_view one_of(std::span<const std::string_view> keys);
    std::string_view one_of(std::initializer_list<std::string_view> keys) { return one_of(std::span(keys)); }
    /// Reports keys of `table` that are given without `companion`, the key that they require.
    void only_with(std::string_view companion, std::span<const Parameter> table);

    /// Reports all keys that are still unknown.
    void finish();

  private:
    void value(const Parameter& parameter, const nlohmann::json& value, void* base);
    void numbers(const Parameter& parameter, const nlohmann::json& value, void* base);
    bool number(const Parameter& parameter, const nlohmann::json& value, const std::string& place, float& result);
    bool integer(const Parameter& parameter, const nlohmann::json& value, const std::string& place,
                 std::uint32_t& result);
    void choice(const Parameter& parameter, const nlohmann::json& value, void* base);
    bool has(std::string_view key) const;
    /// The list under `key`, or nullptr.
    const nlohmann::json* list(std::string_view key);

    const nlohmann::json* value_;
    bool given_;  ///< whether the value is an object
    std::string pointer_;
    Problems& problems_;
    std::vector<std::string_view> known_;
};

}  // namespace weft
