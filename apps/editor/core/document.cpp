#include "editor/core/document.h"

#include "io/scenes/json_text.h"
#include "io/scenes/scene_file.h"
#include "scene/problems.h"

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

namespace weft::editor {
namespace {

/// The parts of a JSON pointer, unescaped.
std::vector<std::string> parts_of(std::string_view place) {
    std::vector<std::string> parts;
    while (!place.empty()) {
        place.remove_prefix(1);  // the slash
        const std::size_t end = std::min(place.find('/'), place.size());
        std::string part;
        for (std::size_t i = 0; i < end; ++i) {
            const bool escaped = place[i] == '~' && i + 1 < end;
            part += !escaped ? place[i] : place[++i] == '1' ? '/' : '~';
        }
        parts.push_back(std::move(part));
        place.remove_prefix(end);
    }
    return parts;
}

std::optional<std::size_t> index_of(const std::string& part) {
    std::size_t index = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), index);
    if (error != std::errc() || end != part.data() + part.size() || part.empty()) return {};
    return index;
}

bool is_of_a_list(const std::string& part) {
    return part == "-" || index_of(part).has_value();
}

/// Makes the object that a name or nothing stands for, or the list that `next` needs.
void open_up(Json& value, const std::string& key, const std::string& next) {
    if (value.is_string() && (key == "fabric" || key == "material")) value = Json{{"preset", value}};
    if (value.is_string() && key == "motion") value = Json::object();
    if (value.is_null()) value = is_of_a_list(next) ? Json::array() : Json::object();
}

/// The element or member `part`, made if it does not exist; null if it cannot exist.
Json* enter(Json& value, const std::string& part) {
    if (value.is_object()) return &value[part];
    if (!value.is_array()) return nullptr;
    if (part == "-") return &value.emplace_back();
    const auto index = index_of(part);
    return index && *index < value.size() ? &value[*index] : nullptr;
}

Error unreachable(const Edit& edit, const std::string& what) {
    return {edit.place, what};
}

Result<void> remove(Json& parent, const std::string& part, const Edit& edit) {
    if (parent.is_object()) {
        parent.erase(part);
        return {};
    }
    const auto index = index_of(part);
    if (!parent.is_array() || !index || *index >= parent.size())
        return unreachable(edit, "names nothing that can be removed");
    parent.erase(parent.begin() + static_cast<std::ptrdiff_t>(*index));
    return {};
}

/// Writes the names that unnamed objects got, and adds them to `given`.
template <class Named>
void write_names(Json& json, const char* key, const std::vector<Named>& all, std::map<std::string, bool>& given) {
    const auto list = json.find(key);
    if (list == json.end() || !list->is_array()) return;
    for (std::size_t i = 0; i < all.size() && i < list->size(); ++i) {
        Json& object = (*list)[i];
        if (object.value("name", "").empty()) given[all[i].name] = object.contains("name");
        object["name"] = all[i].name;
    }
}

void append(std::vector<Edit>& to, std::vector<Edit> more) {
    to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

// Lists of one length are compared element by element. Elements that only left or were only appended are edits of their
// own; any other list is one edit.
std::vector<Edit> list_difference(const Json& from, const Json& to, const std::string& place) {
    std::vector<Edit> edits;
    std::size_t same = 0, same_at_end = 0;
    while (same < std::min(from.size(), to.size()) && from[same] == to[same]) ++same;
    while (same + same_at_end < std::min(from.size(), to.size()) &&
           from[from.size() - 1 - same_at_end] == to[to.size() - 1 - same_at_end])
        ++same_at_end;
    if (from.size() == to.size()) {
        for (std::size_t i = same; i < from.size() - same_at_end; ++i)
            append(edits, difference(from[i], to[i], at(place, i)));
    } else if (same + same_at_end == to.size()) {
        for (std::size_t i = from.size() - same_at_end; i-- > same;) edits.push_back({at(place, i), {}});
    } else if (same == from.size()) {
        for (std::size_t i = same; i < to.size(); ++i) edits.push_back({place + "/-", to[i]});
    } else {
        edits.push_back({place, to});
    }
    return edits;
}

}  // namespace

Result<void> apply(Json& json, const Edit& edit) {
    if (!edit.place.empty() && edit.place.front() != '/')
        return unreachable(edit, "must be a JSON pointer, which begins with \"/\"");
    const std::vector<std::string> parts = parts_of(edit.place);
    if (parts.empty()) {
        if (!edit.value) return unreachable(edit, "the scene itself cannot be removed");
        json = *edit.value;
        return {};
    }
    Json* value = &json;
    std::string key;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        open_up(*value, key, parts[i]);
        if (i + 1 == parts.size() && !edit.value) return remove(*value, parts[i], edit);
        value = enter(*value, parts[i]);
        if (!value) return unreachable(edit, "names nothing in this scene");
        key = parts[i];
    }
    *value = *edit.value;
    return {};
}

const Json* find(const Json& json, const std::string& place) {
    const Json* value = &json;
    for (const std::string& part : parts_of(place)) {
        if (value->is_object()) {
            const auto member = value->find(part);
            if (member == value->end()) return nullptr;
            value = &*member;
        } else {
            const auto index = index_of(part);
            if (!value->is_array() || !index || *index >= value->size()) return nullptr;
            value = &(*value)[*index];
        }
    }
    return value;
}

std::vector<Edit> difference(const Json& from, const Json& to, const std::string& place) {
    if (from == to) return {};
    if (from.is_array() && to.is_array()) {
        const auto is_nested = [](const Json& list) {
            return std::ranges::any_of(list, [](const Json& one) { return one.is_structured(); });
        };
        if (is_nested(from) || is_nested(to)) return list_difference(from, to, place);
    }
    if (!from.is_object() || !to.is_object()) return {{place, to}};
    std::vector<Edit> edits;
    for (const auto& [key, value] : from.items())
        if (!to.contains(key)) edits.push_back({at(place, key), {}});
    for (const auto& [key, value] : to.items()) {
        const auto old = from.find(key);
        if (old == from.end())
            edits.push_back({at(place, key), value});
        else
            append(edits, difference(*old, value, at(place, key)));
    }
    return edits;
}

Json number(float value) {
    return Json::parse(number_text(value), nullptr, false);
}

Result<DocumentPtr> make_document(Json json, const std::filesystem::path& file, const std::filesystem::path& folder,
                                  FileTextPtr original, std::map<std::string, bool> given_names) {
    auto scene = read_scene(json, {});
    if (!scene) return scene.errors();
    auto document = std::make_shared<Document>();
    document->file = file;
    document->folder = folder;
    document->json = std::move(json);
    document->scene = std::move(*scene);
    document->original = std::move(original);
    document->given_names = std::move(given_names);
    write_names(document->json, "cloths", document->scene.cloths, document->given_names);
    write_names(document->json, "colliders", document->scene.colliders, document->given_names);
    return DocumentPtr(std::move(document));
}

FileTextPtr make_file_text(std::string text) {
    Problems problems;
    auto json = parse_json(text, problems);
    if (!json || !problems.none()) return {};
    return std::make_shared<const FileText>(FileText{std::move(text), std::move(*json)});
}

DocumentPtr saved_in(const Document& document, const std::filesystem::path& file, FileTextPtr text) {
    auto saved = std::make_shared<Document>(document);
    saved->file = file;
    if (saved->folder.empty()) saved->folder = file.parent_path();
    saved->original = std::move(text);
    return saved;
}

Result<DocumentPtr> open_document(const std::filesystem::path& file) {
    auto text = read_scene_text(file);
    if (!text) return text.errors();
    Problems problems;
    auto json = parse_json(*text, problems);
    if (!json || !problems.none()) return std::move(problems).take(file.string());
    auto original = std::make_shared<const FileText>(FileText{std::move(*text), *json});
    auto document = make_document(std::move(*json), file, file.parent_path(), std::move(original));
    if (document) return document;
    Errors errors = document.errors();
    for (Error& error : errors) error.where = file.string() + (error.where.empty() ? "" : ": ") + error.where;
    return errors;
}

Result<DocumentPtr> edited(const Document& document, std::span<const Edit> edits) {
    Json json = document.json;
    for (const Edit& edit : edits)
        if (auto applied = apply(json, edit); !applied) return applied.errors();
    return make_document(std::move(json), document.file, document.folder, document.original, document.given_names);
}

}  // namespace weft::editor
