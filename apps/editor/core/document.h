// The document of the editor: a scene as JSON, as its file has it, and as values.
#pragma once

#include "scene/scene_desc.h"

#include <weft/result.h>

#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace weft::editor {

using Json = nlohmann::json;

/// One change of a scene's JSON.
struct Edit {
    /// JSON pointer (RFC 6901) of the value. `-` in place of an index appends to a list. Objects and lists on the way
    /// that do not exist are made; a name that stands for an object (`"fabric": "silk"`) becomes that object.
    std::string place;
    std::optional<Json> value = {};  ///< nullopt: the key or the element is removed
    friend bool operator==(const Edit&, const Edit&) = default;
};

/// What a scene file held when it was opened or saved.
struct FileText {
    std::string text;
    Json json;  ///< the value of `text`
};
using FileTextPtr = std::shared_ptr<const FileText>;

/// Immutable. All cloths and colliders have names, in the JSON too.
struct Document {
    std::filesystem::path file = {};    ///< empty: not saved yet
    std::filesystem::path folder = {};  ///< in which the scene's files are searched
    Json json;
    SceneDesc scene;
    FileTextPtr original = {};  ///< of `file`; null: never saved, or not known
    /// Names that objects without one got, which a saved file does not have. True: the file has an empty name.
    std::map<std::string, bool> given_names = {};
};
using DocumentPtr = std::shared_ptr<const Document>;

/// Reads a scene file. Fails with all problems, each with its place.
Result<DocumentPtr> open_document(const std::filesystem::path& file);
/// `where` of errors is a JSON pointer.
Result<DocumentPtr> make_document(Json json, const std::filesystem::path& file, const std::filesystem::path& folder,
                                  FileTextPtr original = {}, std::map<std::string, bool> given_names = {});
/// Null if the text is not that of a JSON value.
FileTextPtr make_file_text(std::string text);
/// The same document, saved in the file. Names of files in the scene still refer to its folder.
DocumentPtr saved_in(const Document& document, const std::filesystem::path& file, FileTextPtr text);

/// Applies the edits in order. Fails on a place that cannot be reached, and on a scene that does not pass its checks,
/// with all problems; `where` of errors is a JSON pointer.
Result<DocumentPtr> edited(const Document& document, std::span<const Edit> edits);

/// Applies one edit to a JSON value.
Result<void> apply(Json& json, const Edit& edit);

/// The value at a JSON pointer; null if there is none.
const Json* find(const Json& json, const std::string& place);

/// The edits that lead from one value to the other, as few and as small as their structure allows.
std::vector<Edit> difference(const Json& from, const Json& to, const std::string& place = {});

/// The number that a scene file has for this value: the shortest text that reads back as the same float.
Json number(float value);

}  // namespace weft::editor
