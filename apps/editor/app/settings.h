// Settings of the editor that last from session to session.
#pragma once

#include "editor/app/view_panel.h"
#include "editor/ui/palette.h"

#include <weft/result.h>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace weft::editor {

struct Settings {
    Appearance appearance = Appearance::dark;
    float scale = 0;                ///< of the user interface; 0: as the system asks
    float left = 230, right = 340;  ///< widths of the panels, pixels at 100 %
    FlyKeys keys = FlyKeys::usual;
    bool fly_always = false;          ///< without the right button
    float pull_force = 5;             ///< N
    std::vector<std::string> recent;  ///< scene files, newest first
    std::set<std::string> hints_done;
};

/// $XDG_CONFIG_HOME/weft/editor.json or ~/.config/weft/editor.json; empty if neither is set.
std::filesystem::path settings_file();
/// Settings that cannot be read are the defaults; `problem` then says why, unless there is no file.
Settings load_settings(const std::filesystem::path& file, std::string& problem);
Result<void> save_settings(const Settings& settings, const std::filesystem::path& file);
/// Puts a file first among the recent ones.
void add_recent(Settings& settings, const std::filesystem::path& file);

}  // namespace weft::editor
