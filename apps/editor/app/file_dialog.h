// A dialog that asks for a file: recent files, a folder to look through, a path to type or paste.
#pragma once

#include "editor/ui/ui.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace weft::editor {

struct FileQuestion {
    std::string title;
    std::string action = "Open";       ///< text of the button
    std::vector<std::string> endings;  ///< `.json`; empty: all files
    std::vector<std::string> recent = {};
    bool for_writing = false;  ///< asks before a file is overwritten, and adds the first ending if there is none
    std::filesystem::path start = {};
    std::function<void(const std::filesystem::path&)> chosen;
};

class FileDialog {
  public:
    void ask(FileQuestion question);
    bool is_open() const { return open_; }
    void close() { open_ = false; }
    /// Draws it, if it is open.
    void show(Ui& ui);

  private:
    struct Entry {
        std::string name;
        bool is_folder = false;
    };
    void enter(const std::filesystem::path& folder);
    void finish();

    FileQuestion question_;
    bool open_ = false, appearing_ = false;
    std::filesystem::path folder_;
    std::vector<Entry> entries_;
    std::string path_, problem_, overwrite_;
};

}  // namespace weft::editor
