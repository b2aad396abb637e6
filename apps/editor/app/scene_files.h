// Scenes on disk: the first scene, the gallery, saving.
#pragma once

#include "editor/core/document.h"

#include <weft/result.h>

#include <filesystem>
#include <string>
#include <vector>

namespace weft::editor {

/// What the editor shows first: silk that falls over a ball in a breeze.
DocumentPtr first_document();
/// A floor and nothing else.
DocumentPtr new_document();

/// A scene that comes with the program.
struct GalleryScene {
    std::string name;   ///< the file's name
    std::string group;  ///< the folder's name; empty: the folder of scenes itself
    std::filesystem::path file;
};
/// The scenes of the source tree or of the installed program, by group and name.
std::vector<GalleryScene> gallery();

/// Whether the file is the document's and holds another text than when it was opened or saved.
bool changed_on_disk(const Document& document, const std::filesystem::path& file);

/// Writes the document and returns what the file holds now. If the document was read from a file, its text stays as it
/// is but for what has changed, with its comments. Objects without a name there stay without unless they were renamed
/// or something refers to them. Names of mesh and image files are adjusted to the new folder. A scene without cloths
/// can be saved, although `weft run` needs one.
///
/// Fails if the file has changed on disk, unless `overwrite_changed`.
Result<FileTextPtr> save_document(const Document& document, const std::filesystem::path& file,
                                  bool overwrite_changed = false);

}  // namespace weft::editor
