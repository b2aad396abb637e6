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

// --substeps 8, --method pbd, --hierarchy, --no-hierarchy.
void add_solver_option(Arguments arguments, const Parameter& option, ParameterValues& values) {
    const std::string key(option.key), help = std::string(option.what) + "; instead of the scene's";
    const auto set = [&values, key](const auto& value) { values.emplace_back(key, value); };
    if (option.kind == ParameterKind::flag)
        arguments.add_switch(key, set, help);
    else if (option.kind == ParameterKind::choice)
        arguments.add_text("--" + key, set, alternatives(choice_names(option)) + ": " + help);
    else
        arguments.add_number("--" + key, set, help);
}

}  // namespace

void add_common_options(Arguments arguments, Options& options) {
    arguments.add("--backend", options.backend, "auto, cpu or vulkan").with_default();
    arguments.add("--device", options.device, "Vulkan device: part of its name, see weft info");
    arguments
        .add("--execution", options.execution,
             "Vulkan: auto, streamed, grouped or fused; never changes the result on a device")
        .with_default();
    arguments.add("--threads", options.threads, "threads in all, 1 to 256; never changes the result").with_default();
    arguments.add("--isa", options.isa, "instruction set, see weft info; never changes the result");
    for (const Parameter& option : solver_keys) add_solver_option(arguments, option, options.solver);
}

void add_length_options(Arguments arguments, Length& length, const std::string& verb) {
    const Argument frames = arguments.add("--frames", length.frames, "how many frames to " + verb);
    arguments.add("--seconds", length.seconds, "how many seconds instead (default 2)").excludes(frames);
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

}  // namespace weft::cli
