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
    std::string name;  ///< as in the file, or the file's name
    std::filesystem::path file;
};
/// The scenes of the source tree or of the installed program, by name.
std::vector<GalleryScene> gallery();

/// Writes the document. A file that the document was read from keeps what has not changed, comments too. Names of mesh
/// and image files are adjusted to the new folder. Fails without cloths.
Result<void> save_document(const Document& document, const std::filesystem::path& file);

}  // namespace weft::editor
