// The dialog that asks what to export.
#pragma once

#include "editor/app/recorded_export.h"
#include "editor/ui/ui.h"
#include "view/overlays.h"

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace weft::editor {

/// What the user has chosen. Kept for the next export of the session.
struct ExportChoices {
    bool recorded = true;           ///< false: simulate anew from frame 0
    FrameRange frames = {};         ///< to export, of the recorded ones
    std::uint64_t simulated = 120;  ///< frames
    std::size_t format = 0;         ///< of export_format_lines()
    std::array<std::uint32_t, 2> size{1280, 720};
    double frames_per_second = 0;  ///< 0: those of the scene
    bool overlays = true;          ///< images show those of the view
};

/// When the dialog opens: takes all frames that are recorded.
void begin_export(ExportChoices& choices, const Published& now);

enum class ExportAnswer : std::uint8_t { none, choose_file, cancel };
/// `overlays`: of the view.
ExportAnswer show_export_dialog(Ui& ui, ExportChoices& choices, const Published& now,
                                std::span<const Overlay* const> overlays);
/// Names of those that an export can draw. What contact does in a step is not recorded.
std::vector<std::string> exported_overlays(std::span<const Overlay* const> overlays, bool recorded);

/// `2.4 s`
std::string seconds_text(std::uint64_t frames, double frame_rate);

}  // namespace weft::editor
