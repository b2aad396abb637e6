#include "editor/app/properties.h"

#include "editor/app/choice_words.h"
#include "editor/app/property_tables.h"
#include "editor/ui/expression.h"
#include "editor/ui/widgets/color.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/number.h"
#include "scene/check.h"
#include "scene/problems.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace weft::editor {
namespace {

std::string last_part(const std::string& place) {
    return place.substr(place.rfind('/') + 1);
}

/// `Density of sheet`.
std::string title_of(const Session& session, const std::string& place, std::string_view key) {
    std::string title = label_of_key(key);
    std::string owner = session.selected_name();
    if (owner.empty() && !place.empty()) owner = label_of_key(pattern_of(place).substr(1));
    return owner.empty() ? title : title + " of " + owner;
}

std::string value_text(const Json& value, std::string_view unit) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "on" : "off";
    if (value.is_number()) return format_number(value.get<double>(), unit);
    std::string text;
    for (const Json& one : value) text += (text.empty() ? "" : ", ") + format_number(one.get<double>());
    return unit.empty() ? text : text + " " + std::string(unit);
}

/// One row: the widget that fits the parameter.
class PropertyRow {
  public:
    PropertyRow(Ui& ui, Session& session, const std::string& place, const Property& property)
        : ui_(ui), session_(session), place_(place), property_(property), p_(*property.parameter) {}

    void show() {
        usual_ = default_of(property_);
        const auto value = value_of(*session_.document(), place_, property_);
        if (!value) return;
        value_ = *value;
        label_ = label_of_key(p_.key);
        const NumberRange range = range_of(p_);
        what_ = p_.what;
        std::erase(what_, '`');  // of the documentation
        field_ = {.name = p_.key, .label = label_, .what = what_};
        const bool has_range = p_.kind != ParameterKind::text && p_.kind != ParameterKind::choice;
        if (has_range) field_.range = describe(range);
        if (usual_ && !value_text(*usual_, p_.unit).empty()) field_.usual = value_text(*usual_, p_.unit);
        // A name has no default to go back to.
        field_.differs = usual_ && value_ != *usual_ && p_.key != "name";
        switch (p_.kind) {
            case ParameterKind::number:
            case ParameterKind::vector:
            case ParameterKind::integer:
                return numbers(range);
            case ParameterKind::angle_or_mesh:
                return angle_or_mesh(range);
            case ParameterKind::flag:
                return flag_row();
            case ParameterKind::choice:
                return choice_row();
            case ParameterKind::text:
                return text_row();
            case ParameterKind::object:
            case ParameterKind::list:
                return;
        }
    }

  private:
    /// Call it after the widget: arguments are evaluated in any order.
    void store(Change change, Json value) {
        if (change == Change::none) return;
        Edit edit{place_ + "/" + std::string(p_.key), std::move(value)};
        if (usual_ && edit.value == usual_) edit.value.reset();
        session_.change(title_of(session_, place_, p_.key), {std::move(edit)}, change);
    }
    Json as_json(double value) const {
        return p_.kind == ParameterKind::integer ? Json(static_cast<std::uint64_t>(std::llround(std::max(0.0, value))))
                                                 : number(static_cast<float>(value));
    }
    void numbers(const NumberRange& range) {
        if (p_.count == 1) {
            NumberRange with_usual = range;
            if (usual_) with_usual.usual = usual_->get<double>();
            if (p_.kind == ParameterKind::integer && p_.max == std::numeric_limits<std::uint32_t>::max())
                return bit_set();
            if (p_.kind == ParameterKind::integer) {
                auto whole = value_.get<long long>();
                const Change change = integer(ui_, field_, whole, with_usual);
                store(change, as_json(static_cast<double>(whole)));
            } else {
                double one = value_.get<double>();
                const Change change = editor::number(ui_, field_, one, with_usual);
                store(change, as_json(one));
            }
            return;
        }
        std::vector<double> values, usual;
        for (const Json& one : value_) values.push_back(one.get<double>());
        if (usual_)
            for (const Json& one : *usual_) usual.push_back(one.get<double>());
        Change change{};
        if (p_.above_hint == color_hint && p_.count == 3) {
            Vec3 linear{static_cast<float>(values[0]), static_cast<float>(values[1]), static_cast<float>(values[2])};
            std::optional<Vec3> usual_color;
            if (usual.size() == 3)
                usual_color =
                    Vec3{static_cast<float>(usual[0]), static_cast<float>(usual[1]), static_cast<float>(usual[2])};
            change = color(ui_, field_, linear, usual_color);
            values = {linear.x, linear.y, linear.z};
        } else {
            NumberRange whole = range;
            whole.integer = p_.kind == ParameterKind::integer;
            const auto parts = parts_of(place_, p_);
            const bool linked = !parts.empty() && parts.front() == "warp";
            change = linked ? linked_vector(ui_, field_, values, whole, usual, parts)
                            : vector(ui_, field_, values, whole, usual, parts);
        }
        Json list = Json::array();
        for (const double one : values) list.push_back(as_json(one));
        store(change, std::move(list));
    }
    // An integer that may have any value is a set of bits.
    void bit_set() {
        auto set = value_.get<std::uint32_t>();
        std::optional<std::uint32_t> usual;
        if (usual_) usual = usual_->get<std::uint32_t>();
        field_.range = {};
        const Change change = bits(ui_, field_, set, usual);
        store(change, set);
    }
    void angle_or_mesh(const NumberRange& range) {
        bool of_mesh = value_.is_string();
        const std::string name = std::string(p_.key) + "_of_mesh", label = "Angle as built";
        const Field own{.name = name, .label = label, .what = what_};
        if (const Change change = flag(ui_, own, of_mesh); change != Change::none)
            return store(change, of_mesh ? Json("mesh") : Json(180));
        if (of_mesh) return;
        double degrees = value_.get<double>();
        const Change change = angle(ui_, field_, degrees, range);
        store(change, as_json(degrees));
    }
    void flag_row() {
        bool on = value_.get<bool>();
        std::optional<bool> usual;
        if (usual_) usual = usual_->get<bool>();
        const Change change = flag(ui_, field_, on, usual);
        store(change, on);
    }
    void choice_row() {
        const std::vector<std::string_view> names = choice_names(p_);
        const auto number_of = [&](const Json& name) {
            return static_cast<std::size_t>(std::ranges::find(names, name.get<std::string>()) - names.begin());
        };
        std::size_t chosen = std::min(number_of(value_), names.size() - 1);
        std::optional<std::size_t> usual;
        if (usual_) usual = number_of(*usual_);
        const Change change = choice(ui_, field_, chosen, names, usual, choice_words(p_));
        store(change, std::string(names[chosen]));
    }
    void text_row() {
        const std::vector<std::string> known = names_for(*session_.document(), place_, p_.key);
        std::string value = value_.get<std::string>();
        if (known.empty()) {
            const Change change = text(ui_, field_, value);
            if (p_.key == "name" && change == Change::finished && pattern_of(place_).find("/*") != std::string::npos) {
                if (!value.empty() && value != value_.get<std::string>()) session_.post(Rename{place_, value});
                return;
            }
            return store(change, value);
        }
        std::vector<std::string_view> names(known.begin(), known.end());
        for (std::string_view& name : names)
            if (name.empty()) name = "none";
        std::size_t chosen = static_cast<std::size_t>(std::ranges::find(known, value) - known.begin());
        chosen = std::min(chosen, names.size() - 1);
        const std::vector<std::string> words = preset_words(place_, known);
        const std::vector<std::string_view> whats(words.begin(), words.end());
        const Change change = choice(ui_, field_, chosen, names, {}, whats);
        if (change == Change::none) return;
        // A preset replaces values that were made for another one.
        if (p_.key == "preset")
            return session_.change(title_of(session_, place_, last_part(place_)), {{place_, known[chosen]}}, change);
        store(change, known[chosen]);
    }

    Ui& ui_;
    Session& session_;
    const std::string place_;
    const Property& property_;
    const Parameter& p_;
    std::optional<Json> usual_;
    Json value_;
    std::string label_, what_;
    Field field_;
};

/// Replaces the alternative that an object has by another one, with its defaults.
void choose_alternative(Ui& ui, Session& session, const std::string& place, const PropertyGroup& group) {
    const Json* object = find(session.document()->json, place);
    std::size_t chosen = 0;
    for (std::size_t i = 0; i < group.one_of.size(); ++i)
        if (object && object->is_object() && object->contains(std::string(group.one_of[i]))) chosen = i;
    const std::size_t before = chosen;
    const Field field{.name = "kind", .label = "Kind", .what = "what it is made of"};
    const Change change = choice(ui, field, chosen, group.one_of);
    if (change == Change::none || chosen == before) return;
    const std::string_view key = group.one_of[chosen];
    Json value = Json::object();
    if (key == "vertices") value = Json{0};
    if (const auto groups = names_for(*session.document(), place, key); key == "group" && !groups.empty())
        value = groups.front();
    if (key == "points") value = Json{{0, 0, 0}, {0.1, 0, 0}};
    if (key == "color") value = Json{1, 0, 0};
    if (key == "channel") value = "red";
    if (key == "file") value = "stanford-bunny.obj";
    if (key == "mesh" || key == "convex") value = Json{{"file", "bunny.obj"}};
    if (key == "box" && pattern_of(place).find("/pins") != std::string::npos)
        value = Json{{"min", {-0.5, 0, -0.5}}, {"max", {0.5, 1, 0.5}}};
    session.change(title_of(session, place, key),
                   {{place + "/" + std::string(group.one_of[before]), {}}, {place + "/" + std::string(key), value}});
}

/// `place`: the motion of a collider.
void choose_motion(Ui& ui, Session& session, const std::string& place) {
    const std::string collider = place.substr(0, place.rfind('/'));
    const Document& document = *session.document();
    const std::size_t before = motion_of(document, collider);
    std::size_t chosen = before;
    const Field field{.name = "kind",
                      .label = "Kind",
                      .what = "it stays, moves by keys, or is a body that gravity and what it touches move"};
    const auto motions = motions_of(document, collider);
    std::vector<std::string_view> whats = motion_words();
    whats.resize(motions.size());
    const Change change = choice(ui, field, chosen, motions, 0, whats);
    if (change == Change::none || chosen == before) return;
    session.change(title_of(session, place, "motion"), change_motion(document, collider, chosen));
}

}  // namespace

bool Properties::open(Ui& ui, const std::string& place, const std::string& label, bool at_first) {
    const auto [known, added] = open_.try_emplace(pattern_of(place), at_first);
    return section(ui, last_part(place), label, known->second);
}

void Properties::show(Ui& ui, Session& session) {
    const std::string place = session.selected();
    if (place.empty()) {
        ImGui::PushTextWrapPos();
        muted_text(ui, "Nothing is selected. Click an object in the view or in the list.");
        ImGui::PopTextWrapPos();
        return;
    }
    const Ui::Scope scope(ui, place.substr(1));
    // The scene itself: its lists and objects have cards of their own.
    if (place == "/.") {
        for (const Property& property : properties_of(*session.document(), "").values)
            if (property.key() != "weft") PropertyRow(ui, session, "", property).show();
        return;
    }
    object(ui, session, place, 0);
}

void Properties::object(Ui& ui, Session& session, const std::string& place, int depth) {
    const PropertyGroup group = properties_of(*session.document(), place);
    if (pattern_of(place) == "/colliders/*/motion")
        choose_motion(ui, session, place);
    else if (!group.one_of.empty())
        choose_alternative(ui, session, place, group);
    for (const Property& property : group.values) PropertyRow(ui, session, place, property).show();
    for (const ChildProperty& child : group.children) {
        const std::string below = at(place, child.key());
        const std::string label = label_of_key(child.key());
        if (child.is_list) list(ui, session, below, label, depth);
        // Absent objects are shown closed: opening one does not change the scene, a change of a value makes it.
        else if (open(ui, below, label, depth == 0 && (child.key() == "transform" || child.key() == "fabric"))) {
            const Ui::Scope scope(ui, child.key());
            object(ui, session, below, depth + 1);
        }
    }
    if (group.seldom.empty() || !open(ui, at(place, "more"), "More", false)) return;
    for (const Property& property : group.seldom) PropertyRow(ui, session, place, property).show();
}

void Properties::list(Ui& ui, Session& session, const std::string& place, const std::string& label, int depth) {
    const Json* all = find(session.document()->json, place);
    const std::size_t count = all && all->is_array() ? all->size() : 0;
    if (!open(ui, place, label + " (" + std::to_string(count) + ")", false)) return;
    const Ui::Scope scope(ui, last_part(place));
    const bool of_objects = count > 0 && all->front().is_object();
    if (!of_objects && count > 0) {
        std::string values;
        for (std::size_t i = 0; i < std::min<std::size_t>(count, 12); ++i) values += (i ? ", " : "") + (*all)[i].dump();
        muted_text(ui, values + (count > 12 ? ", …" : ""));
    }
    for (std::size_t i = 0; of_objects && i < count; ++i) {
        const std::string one = at(place, i);
        const Ui::Scope element(ui, std::to_string(i));
        if (button(ui, "remove", {.icon = Icon::trash, .what = "Remove this one", .flat = true}))
            return session.change("Remove " + label_of_key(last_part(place)), {{one, {}}});
        ImGui::SameLine();
        const auto [known, added] = open_.try_emplace(one, count == 1);
        if (section(ui, "section", label + " " + std::to_string(i + 1), known->second))
            object(ui, session, one, depth + 1);
    }
    const auto fresh = new_element(*session.document(), place);
    if (fresh && button(ui, "add", {.icon = Icon::add, .text = "Add", .what = "Add one", .flat = true}))
        session.change("Add to " + label, {{place + "/-", *fresh}});
}

}  // namespace weft::editor
