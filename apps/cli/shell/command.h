// Declarations that the subcommands share.
#pragma once

#include "cli/shell/arguments.h"

#include <weft/result.h>
#include <weft/simulation.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace weft {
struct Frame;
}

namespace weft::cli {

enum ExitCode : int { exit_done = 0, exit_failed = 1, exit_usage = 2 };

/// The exit status of the program for these errors.
int exit_code(const Errors& errors);
/// Prints `weft: error: …`, one line per error, on stderr.
void print_errors(const Errors& errors);
void print_warning(const std::string& text);

/// Adds --backend, --threads, … and their checks.
void add_common_options(Arguments arguments, Options& options);

/// An amount of simulated time: frames, seconds, or neither.
struct Length {
    std::optional<double> frames, seconds;
};
/// Adds --frames and --seconds; `verb` completes their help text.
void add_length_options(Arguments arguments, Length& length, const std::string& verb);
Result<std::uint64_t> frame_count(const Length& length, double frame_seconds, unsigned least = 1);

/// Fails if the device was lost in the step. Warns, once per run, if non-finite values reset a cloth to the frame
/// before.
Result<void> check_step(const Frame& frame, bool& warned);

/// A subcommand: adds itself to the program and returns the function that runs it.
using Command = std::function<int()>;
Command add_run(Program& program);
Command add_render(Program& program);
Command add_edit(Program& program);
Command add_check(Program& program);
Command add_convert(Program& program);
Command add_bench(Program& program);
Command add_validate(Program& program);
Command add_info(Program& program);

}  // namespace weft::cli
