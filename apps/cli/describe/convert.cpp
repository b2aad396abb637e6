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
    // Creates and removes the file: an invalid name is a usage error, a full disk is not.
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
    Arguments arguments =
        program.add_command("convert", "Write a scene file anew: ordered keys, no defaults, no comments");
    auto options = std::make_shared<ConvertOptions>();
    arguments.add("scene", options->scene, "scene file").called("FILE").required();
    arguments.add("--out", options->output, "file to write, .json").called("FILE").required();
    arguments.add("--quiet", options->quiet, "print errors only");
    arguments.footer(
        "Keys are written in a fixed order, without default values and comments. File names are changed so that\n"
        "they are found from the folder of the new file.\n"
        "Example:\n  weft convert scenes/hanging_bunny.json --out bunny.json");
    return [options] { return convert(*options); };
}

}  // namespace weft::cli
