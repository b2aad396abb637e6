// What the subcommands share.
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

/// What the program says with its exit status of these.
int exit_code(const Errors& errors);
/// `weft: error: …`, a line each, on stderr.
void print_errors(const Errors& errors);
void print_warning(const std::string& text);

/// --backend, --threads, … with their checks.
void add_common_options(Arguments arguments, Options& options);

/// How much simulated time: one of the two, or neither.
struct Length {
    std::optional<double> frames, seconds;
};
/// --frames and --seconds; `verb` is what happens to them.
void add_length_options(Arguments arguments, Length& length, const std::string& verb);
Result<std::uint64_t> frame_count(const Length& length, double frame_seconds, unsigned least = 1);

/// Fails where the device was lost in the step, and warns, once, of cloth that was held.
Result<Done> check_step(const Frame& frame, bool& warned);

/// A subcommand: adds itself to the program and returns what to run if it is the one chosen.
using Command = std::function<int()>;
Command add_run(Program& program);
Command add_render(Program& program);
Command add_check(Program& program);
Command add_convert(Program& program);
Command add_bench(Program& program);
Command add_info(Program& program);

}  // namespace weft::cli
