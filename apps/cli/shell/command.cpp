#include "cli/shell/command.h"

#include "scene/check.h"
#include "scene/nearest_name.h"
#include "scene/scene_keys.h"

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

// Adds the option of a solver parameter, such as --substeps 8, --method pbd, --hierarchy, --no-hierarchy.
Argument add_solver_option(Arguments arguments, const Parameter& option, ParameterValues& values) {
    const std::string key(option.key);
    std::string help(option.what);
    std::erase(help, '`');  // Markdown for docs/scene.md
    const auto set = [&values, key](const auto& value) { values.emplace_back(key, value); };
    if (option.kind == ParameterKind::flag) return arguments.add_switch(key, set, help);
    if (option.kind == ParameterKind::choice)
        return arguments.add_text("--" + key, set, help).called(std::string(option.choices));
    return arguments.add_number("--" + key, set, help).called("N");
}

}  // namespace

void add_common_options(Arguments arguments, Options& options) {
    arguments
        .add("--backend", options.backend, "where to simulate; auto takes a Vulkan GPU if there is one, else the CPU")
        .called("auto|cpu|vulkan")
        .with_default();
    arguments.add("--device", options.device, "Vulkan device: part of a name that `weft info` prints").called("NAME");
    arguments
        .add("--execution", options.execution, "how the Vulkan backend groups its dispatches; the result is the same")
        .called("auto|streamed|grouped|fused")
        .with_default();
    arguments.add("--threads", options.threads, "threads of the CPU backend, 1 to 256; the result is the same")
        .called("N")
        .with_default();
    arguments
        .add("--isa", options.isa,
             "instruction set of the CPU backend, as `weft info` prints it; the result is the same")
        .called("NAME");
    for (const Parameter& option : solver_keys)
        add_solver_option(arguments, option, options.solver).under("Solver options, in place of the scene's");
}

void add_length_options(Arguments arguments, Length& length, const std::string& verb) {
    const Argument frames = arguments.add("--frames", length.frames, "number of frames to " + verb).called("N");
    arguments.add("--seconds", length.seconds, "the same in seconds; 2 if neither is given")
        .called("S")
        .excludes(frames);
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
        std::snprintf(text, sizeof text, "must give %u to %.0f frames, got %g", least, max_frames, frames);
        return Error{name, text};
    }
    return static_cast<std::uint64_t>(frames);
}

}  // namespace weft::cli
