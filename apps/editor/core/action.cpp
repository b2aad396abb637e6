#include "editor/core/action.h"

#include "scene/nearest_name.h"

#include <array>
#include <type_traits>

namespace weft::editor {
namespace {

// The names of the alternatives of Action, in their order.
constexpr std::array<std::string_view, std::variant_size_v<Action>> kinds = {
    "change", "rename", "cut",  "grab",         "move_grab", "release", "reset",
    "seek",   "undo",   "redo", "undo_setting", "backend",   "saved",   "advance"};

Json to_json(Vec3 v) {
    return {number(v.x), number(v.y), number(v.z)};
}

Json to_json(const Edit& edit) {
    Json json{{"place", edit.place}};
    if (edit.value) json["value"] = *edit.value;
    return json;
}

/// Reads the members of one action. The first problem is kept.
class LineReader {
  public:
    explicit LineReader(const Json& line) : line_(line) {}

    void read(const char* key, std::string& value) {
        if (const Json* found = need(key, &Json::is_string, "text")) value = found->get<std::string>();
    }
    template <class Integer>
    requires std::is_integral_v<Integer>
    void read(const char* key, Integer& value) {
        if (const Json* found = need(key, &Json::is_number_unsigned, "a whole number, 0 or more"))
            value = found->get<Integer>();
    }
    void read(const char* key, float& value) {
        if (const Json* found = need(key, &Json::is_number, "a number")) value = found->get<float>();
    }
    void read(const char* key, bool& value) {
        if (const Json* found = need(key, &Json::is_boolean, "true or false")) value = found->get<bool>();
    }
    void read(const char* key, Vec3& value) {
        const Json* found = need(key, &Json::is_array, "three numbers");
        if (found) value = vector(*found, key);
    }
    void read(const char* key, std::vector<Vec3>& values) {
        const Json* found = need(key, &Json::is_array, "a list of points");
        if (!found) return;
        for (const Json& one : *found) values.push_back(vector(one, key));
    }
    void read(const char* key, std::vector<Edit>& edits) {
        const Json* found = need(key, &Json::is_array, "a list of edits");
        if (!found) return;
        for (const Json& one : *found) {
            if (!one.is_object() || !one.contains("place") || !one["place"].is_string()) {
                fail(key, "each edit must have a \"place\", a JSON pointer");
                return;
            }
            Edit edit{one["place"].get<std::string>(), {}};
            if (one.contains("value")) edit.value = one["value"];
            edits.push_back(std::move(edit));
        }
    }
    bool has(const char* key) const { return line_.contains(key); }
    void fail(const char* key, const std::string& what) {
        if (problem_.empty()) problem_.push_back({key, what});
    }
    const Errors& problem() const { return problem_; }

  private:
    const Json* need(const char* key, bool (Json::*is)() const noexcept, const char* what) {
        const auto found = line_.find(key);
        if (found == line_.end()) {
            fail(key, std::string("is missing; it must be ") + what);
        } else if (!((*found).*is)()) {
            fail(key, std::string("must be ") + what);
        } else {
            return &*found;
        }
        return nullptr;
    }
    Vec3 vector(const Json& json, const char* key) {
        const auto is_number = [](const Json& one) { return one.is_number(); };
        if (!json.is_array() || json.size() != 3 || !std::all_of(json.begin(), json.end(), is_number)) {
            fail(key, "must be three numbers");
            return {};
        }
        return {json[0].get<float>(), json[1].get<float>(), json[2].get<float>()};
    }

    const Json& line_;
    Errors problem_;
};

struct Writer {
    Json& json;
    void operator()(const ChangeScene& a) const {
        json["label"] = a.label;
        json["edits"] = Json::array();
        for (const Edit& edit : a.edits) json["edits"].push_back(to_json(edit));
        if (a.gesture != 0) json["gesture"] = a.gesture;
    }
    void operator()(const Rename& a) const { json["place"] = a.place, json["name"] = a.name; }
    void operator()(const Cut& a) const {
        json["cloth"] = a.cloth;
        json["points"] = Json::array();
        for (const Vec3 point : a.points) json["points"].push_back(to_json(point));
        if (a.at_start) json["at_start"] = true;
    }
    void operator()(const Grab& a) const {
        json["cloth"] = a.cloth;
        json["triangle"] = a.point.triangle;
        json["weights"] = to_json(a.point.weights);
        json["to"] = to_json(a.to);
        json["max_force"] = number(a.max_force);
    }
    void operator()(const MoveGrab& a) const { json["to"] = to_json(a.to); }
    void operator()(const Seek& a) const { json["frame"] = a.frame; }
    void operator()(const UndoSetting& a) const { json["step"] = a.step; }
    void operator()(const UseBackend& a) const { json["backend"] = a.backend, json["threads"] = a.threads; }
    void operator()(const Saved& a) const { json["file"] = a.file, json["text"] = a.text; }
    void operator()(const Advance& a) const { json["frames"] = a.frames; }
    template <class Plain>
    void operator()(const Plain&) const {}
};

struct Reader {
    LineReader& line;
    void operator()(ChangeScene& a) const {
        if (line.has("label")) line.read("label", a.label);
        line.read("edits", a.edits);
        if (line.has("gesture")) line.read("gesture", a.gesture);
    }
    void operator()(Rename& a) const { line.read("place", a.place), line.read("name", a.name); }
    void operator()(Cut& a) const {
        line.read("cloth", a.cloth);
        line.read("points", a.points);
        if (line.has("at_start")) line.read("at_start", a.at_start);
    }
    void operator()(Grab& a) const {
        line.read("cloth", a.cloth);
        line.read("triangle", a.point.triangle);
        line.read("weights", a.point.weights);
        line.read("to", a.to);
        line.read("max_force", a.max_force);
    }
    void operator()(MoveGrab& a) const { line.read("to", a.to); }
    void operator()(Seek& a) const { line.read("frame", a.frame); }
    void operator()(UndoSetting& a) const { line.read("step", a.step); }
    void operator()(UseBackend& a) const { line.read("backend", a.backend), line.read("threads", a.threads); }
    void operator()(Saved& a) const { line.read("file", a.file), line.read("text", a.text); }
    void operator()(Advance& a) const { line.read("frames", a.frames); }
    template <class Plain>
    void operator()(Plain&) const {}
};

template <std::size_t... Number>
Action make_kind(std::size_t kind, std::index_sequence<Number...>) {
    Action action;
    ((Number == kind ? (void)(action = std::variant_alternative_t<Number, Action>()) : void()), ...);
    return action;
}

}  // namespace

std::string_view kind_of(const Action& action) {
    return kinds[action.index()];
}

std::string to_line(const TimedAction& timed) {
    Json json{{"at", timed.at}, {"do", kind_of(timed.action)}};
    std::visit(Writer{json}, timed.action);
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Result<std::pair<std::optional<std::uint64_t>, Action>> action_from(const Json& json) {
    if (!json.is_object()) return Error{"", "must be an object such as {\"do\": \"advance\", \"frames\": 10}"};
    LineReader line(json);
    std::string name;
    line.read("do", name);
    if (!line.problem().empty()) return line.problem();
    const auto kind = static_cast<std::size_t>(std::ranges::find(kinds, name) - kinds.begin());
    if (kind == kinds.size()) {
        const std::string_view near = nearest_name(name, kinds);
        return Error{"do", "names no action, got \"" + name + "\"" +
                               (near.empty() ? "" : "; did you mean \"" + std::string(near) + "\"?")};
    }
    Action action = make_kind(kind, std::make_index_sequence<std::variant_size_v<Action>>());
    std::visit(Reader{line}, action);
    std::optional<std::uint64_t> at;
    if (line.has("at")) line.read("at", at.emplace());
    if (!line.problem().empty()) return line.problem();
    return std::pair(at, std::move(action));
}

}  // namespace weft::editor
