#include "cli/shell/command.h"

#include "io/exports/scene_export.h"
#include "io/files/atomic_file.h"
#include "io/scenes/scene_file.h"

#include <cstdio>
#include <filesystem>

namespace weft::cli {
namespace {

struct ConvertOptions {
    std::string scene, output;
    bool quiet = false;
};

int convert(const ConvertOptions& options) {
    if (std::filesystem::path(options.output).extension() != ".json") {
        print_errors({{"--out", "must end in .json, got " + options.output}});
        return exit_usage;
    }
    auto scene = load_scene(options.scene);
    if (!scene) {
        print_errors(scene.errors());
        return exit_usage;
    }
    // Made and gone again: a name that no file can have is the user's mistake, a full disk is not.
    if (const auto file = AtomicFile::create(options.output); !file) {
        print_errors(file.errors());
        return exit_usage;
    }
    const auto written =
        export_scene(std::move(*scene), std::filesystem::path(options.scene).parent_path(), options.output);
    if (!written) {
        print_errors(written.errors());
        return exit_failed;
    }
    for (const auto& file : *written)
        if (!options.quiet) std::printf("wrote %s\n", file.c_str());
    return exit_done;
}

}  // namespace

Command add_convert(Program& program) {
    Arguments arguments = program.add_command("convert", "a scene as weft understands it, written to another file");
    auto options = std::make_shared<ConvertOptions>();
    arguments.add("scene", options->scene, "scene file").required();
    arguments.add("--out", options->output, "file to write, .json").required();
    arguments.add("--quiet", options->quiet, "print errors only");
    arguments.footer(
        "Keys stand in one order, values that are the default are left out, and so are comments. Files that the\n"
        "scene names are found from the new file's folder.\n"
        "Example:\n  weft convert scenes/hanging_bunny.json --out bunny.json");
    return [options] { return convert(*options); };
}

}  // namespace weft::cli
