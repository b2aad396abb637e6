#include "cli/shell/command.h"

#include "scene/check.h"
#include "scene/nearest_name.h"
#include "scene/scene_keys.h"

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

namespace {

// --substeps 8, --method pbd, --hierarchy, --no-hierarchy.
void add_solver_option(CLI::App& command, const Parameter& option, ParameterValues& values) {
    const std::string key(option.key), what = std::string(option.what) + "; instead of the scene's";
    const auto set = [&values, key](const auto& value) { values.emplace_back(key, value); };
    if (option.kind == ParameterKind::flag)
        // add_flag would set an option that was not given, too.
        command.add_flag_function(
            "--" + key + ",!--no-" + key, [set](std::int64_t count) { set(count > 0); }, what);
    else if (option.kind == ParameterKind::choice)
        command.add_option_function<std::string>("--" + key, set, alternatives(choice_names(option)) + ": " + what);
    else
        command.add_option_function<double>("--" + key, set, what);
}

}  // namespace

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
    for (const Parameter& option : solver_keys) add_solver_option(command, option, options.solver);
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
