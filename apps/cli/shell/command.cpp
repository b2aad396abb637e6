#include "cli/shell/command.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

namespace weft::cli {

int exit_code(const Errors& errors) {
    const bool machine = std::ranges::any_of(errors, [](const Error& error) { return error.fault == Fault::machine; });
    return machine ? exit_failed : exit_usage;
}

void print_errors(const Errors& errors) {
    for (const Error& error : errors) std::cerr << "weft: error: " << error.message() << '\n';
}

void print_warning(const std::string& text) {
    std::cerr << "weft: warning: " << text << '\n';
}

void add_common_options(CLI::App& command, Options& options) {
    command.add_option("--backend", options.backend, "auto, cpu or vulkan")->capture_default_str();
    command.add_option("--device", options.device, "Vulkan device: part of its name, see weft info");
    command
        .add_option("--execution", options.execution,
                    "Vulkan: auto, streamed, grouped or fused; never changes the result on a device")
        ->capture_default_str();
    command.add_option("--threads", options.threads, "threads in all, 1 to 256; never changes the result")
        ->capture_default_str();
    command.add_option("--isa", options.isa, "instruction set, see weft info; never changes the result");
    command.add_option("--substeps", options.substeps, "per frame, instead of the scene's");
    command.add_option("--iterations", options.iterations, "per substep, instead of the scene's");
    // add_flag would set an option that was not given, too.
    command.add_flag_function(
        "--hierarchy,!--no-hierarchy", [&options](std::int64_t count) { options.hierarchy = count > 0; },
        "coarse levels first, or not, whatever the scene says");
    command.add_option("--method", options.method, "xpbd or pbd, instead of the scene's");
    command.add_option("--projection", options.projection,
                       "auto, lines, gauss-seidel or jacobi, instead of the scene's");
    command.add_option("--accumulate", options.accumulate,
                       "gather or fixed-point, instead of the scene's; with jacobi");
}

void add_length_options(CLI::App& command, Length& length, const std::string& verb) {
    auto* frames = command.add_option("--frames", length.frames, "how many frames to " + verb);
    command.add_option("--seconds", length.seconds, "how many seconds instead (default 2)")->excludes(frames);
}

Result<std::uint64_t> frame_count(const Length& length, double frame_seconds, unsigned least) {
    constexpr double default_seconds = 2, max_frames = 1e6;
    double frames = std::round(length.seconds.value_or(default_seconds) / frame_seconds);
    if (length.frames) {
        frames = *length.frames;
        if (frames != std::floor(frames)) return Error{"--frames", "must be a whole number"};
    }
    const std::string name = length.frames ? "--frames" : "--seconds";
    if (!(frames >= least && frames <= max_frames)) {
        char text[96];
        std::snprintf(text, sizeof text, "must come to %u to %.0f frames, got %g", least, max_frames, frames);
        return Error{name, text};
    }
    return static_cast<std::uint64_t>(frames);
}

// CLI11 answers a wrong word with several lines; the house says one.
int usage_error(const CLI::App& program, const CLI::ParseError& error) {
    std::string text = error.what();
    for (char& c : text) {
        if (c == '\n') c = ' ';
    }
    std::string command = program.get_name();
    for (const CLI::App* chosen : program.get_subcommands()) command += ' ' + chosen->get_name();
    std::cerr << "weft: error: " << text << "; see " << command << " --help\n";
    return exit_usage;
}

}  // namespace weft::cli
