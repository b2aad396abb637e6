#include "cli/shell/command.h"

#include "io/files/buffered_file.h"

#include <unistd.h>
#include <weft/weft.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <new>

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
                    "Vulkan: auto, streamed, grouped, patched or fused; never changes the result on a device")
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

namespace {

// CLI11 answers a wrong word with several lines; the house says one.
int usage_error(const CLI::App& program, const CLI::ParseError& error) {
    std::string text = error.what();
    for (char& c : text) {
        if (c == '\n') c = ' ';
    }
    std::string command = "weft";
    for (const CLI::App* chosen : program.get_subcommands()) command += ' ' + chosen->get_name();
    std::cerr << "weft: error: " << text << "; see " << command << " --help\n";
    return exit_usage;
}

int run_program(int argc, char** argv) {
    CLI::App program{"weft: real-time cloth. Simulates a scene, exports it, and says how well it did.", "weft"};
    program.set_version_flag("--version", std::string("weft ") + version());
    program.require_subcommand(1);
    program.footer(
        "Examples:\n"
        "  weft run scenes/sheet_on_sphere.json --seconds 3 --out sheet.glb\n"
        "  weft run scenes/hanging_sheet.json --frames 120 --out frames/%04d.obj --stats stats.json\n"
        "  weft render scenes/hanging_bunny.json --out bunny.mp4\n"
        "  weft bench --json before.json\n"
        "  weft check scenes/hanging_bunny.json\n"
        "  weft info\n"
        "Exit status: 0 done, 1 failed while running, 2 wrong input or usage.");

    std::map<std::string, Command> commands;
    commands["run"] = add_run(program);
    commands["render"] = add_render(program);
    commands["bench"] = add_bench(program);
    commands["check"] = add_check(program);
    commands["info"] = add_info(program);

    if (argc > 1 && argv[1][0] != '-' && !commands.count(argv[1])) {
        std::string known;
        for (const auto& [name, command] : commands) known += (known.empty() ? "" : ", ") + name;
        std::cerr << "weft: error: unknown command '" << argv[1] << "'; there are " << known << '\n';
        return exit_usage;
    }
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
        return usage_error(program, error);
    }
    return commands.at(program.get_subcommands().front()->get_name())();
}

// What was printed may stand in a buffer still, and the file that it is sent to on a full disk.
int after_output(int code) {
    errno = 0;
    const bool written = std::fflush(stdout) == 0 && !std::ferror(stdout);
    if (written || errno == EPIPE) return code;  // who closes a pipe has read enough
    print_errors(
        {{"standard output", errno == 0 ? "cannot be written" : "cannot be written: " + system_reason(errno)}});
    return code == exit_done ? exit_failed : code;
}

}  // namespace
}  // namespace weft::cli

int main(int argc, char** argv) {
    // A file past the system's size limit is an error to report, not a reason to die.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    // As much as any command prints: the last flush then knows why output could not be written.
    static char buffer[1 << 18];
    if (!::isatty(STDOUT_FILENO)) std::setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
    try {
        return weft::cli::after_output(weft::cli::run_program(argc, argv));
    } catch (const std::bad_alloc&) {
        weft::cli::print_errors({{"", "out of memory"}});
    } catch (const std::exception& error) {
        weft::cli::print_errors({{"", error.what()}});
    }
    return weft::cli::exit_failed;
}
