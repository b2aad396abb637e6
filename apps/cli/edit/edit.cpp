// weft edit: the editor.
#include "cli/shell/command.h"

#ifdef WEFT_EDITOR
#include "editor/app/editor.h"
#include "editor/app/scene_files.h"
#include "editor/core/action_log.h"
#include "editor/core/script.h"

#include <iostream>
#endif

#include <memory>

namespace weft::cli {

#ifdef WEFT_EDITOR
namespace {

struct EditOptions {
    std::string scene, script, record, probe;
    std::vector<std::uint32_t> size;
    double scale = 0, frames_per_second = 0;
    bool no_settings = false;
    Options simulation;
};

// Plays a script without a window.
Result<void> play_script(const EditOptions& options) {
    editor::DocumentPtr document = editor::first_document();
    if (!options.scene.empty()) {
        auto opened = editor::open_document(options.scene);
        if (!opened) return opened.errors();
        document = *opened;
    } else if (auto log = editor::read_log(options.script)) {
        document = log->head.document;  // a recorded session says what it began with
    }
    auto stage = editor::Stage::open(document, {.simulation = options.simulation});
    if (!stage) return stage.errors();
    auto played =
        editor::run_script(*stage, options.script, [](const std::string& line) { std::cout << line << '\n'; });
    if (!played) return played;
    std::cout << "frame " << stage->frame() << ", state_hash " << stage->world().world().state_hash() << '\n';
    return {};
}

int run_edit(const EditOptions& options) {
    Result<void> done;
    if (!options.script.empty()) {
        done = play_script(options);
    } else {
        editor::EditorOptions editor{.scene = options.scene,
                                     .simulation = options.simulation,
                                     .probe = options.probe,
                                     .record = options.record,
                                     .scale = static_cast<float>(options.scale),
                                     .keep_settings = !options.no_settings};
        if (options.size.size() == 2) editor.width = options.size[0], editor.height = options.size[1];
        if (options.frames_per_second > 0) editor.least_frame = 1 / options.frames_per_second;
        done = editor::edit(editor);
    }
    if (done) return exit_done;
    print_errors(done.errors());
    return exit_code(done.errors());
}

}  // namespace
#endif

Command add_edit(Program& program) {
    [[maybe_unused]] Arguments command = program.add_command("edit", "Open the editor");
#ifdef WEFT_EDITOR
    const auto options = std::make_shared<EditOptions>();
    command.add("scene", options->scene, "Scene file; without it, silk falls over a ball");
    command.add("--script", options->script, "Play a file of actions without a window, and print the state hash");
    command.add("--record", options->record, "Write the actions of the session to this file");
    command.add("--size", options->size, "Width and height of the window in pixels");
    command.add("--scale", options->scale, "Scale of the user interface, 0.75 to 3");
    command.add("--probe", options->probe, "Write the places of all widgets to this file in each frame, for tests");
    command.add("--slow", options->frames_per_second,
                "At most so many frames of the user interface per second, for tests");
    command.add("--no-settings", options->no_settings, "Neither read nor write settings and logs of sessions");
    add_common_options(command, options->simulation);
    command.footer("Press H in the window for keys and mouse.");
    return [options] { return run_edit(*options); };
#else
    return [] {
        print_errors({{"", "this build has no editor; build with -D WEFT_VULKAN=ON -D WEFT_EDITOR=ON"}});
        return int{exit_failed};
    };
#endif
}

}  // namespace weft::cli
