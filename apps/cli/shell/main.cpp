#include "cli/shell/command.h"

#include "io/files/buffered_file.h"

#include <unistd.h>
#include <weft/weft.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <map>
#include <new>

namespace weft::cli {

namespace {

int run_program(int argc, char** argv) {
    Program program("weft: real-time cloth. Simulates, draws, exports and measures scenes.", "weft");
    program.set_version(std::string("weft ") + version());
    program.require_command();
    program.arguments().footer(
        "Examples:\n"
        "  weft run scenes/sheet_on_sphere.json --seconds 3 --out sheet.glb\n"
        "  weft run scenes/hanging_sheet.json --frames 120 --out frames/%04d.obj --stats stats.json\n"
        "  weft render scenes/hanging_bunny.json --out bunny.mp4\n"
        "  weft edit scenes/flag.json\n"
        "  weft bench --json before.json\n"
        "  weft validate --case cantilever\n"
        "  weft check scenes/hanging_bunny.json\n"
        "  weft convert scenes/hanging_bunny.json --out bunny.json\n"
        "  weft info\n"
        "Exit status: 0 done, 1 failed while running, 2 wrong input or usage.");

    std::map<std::string, Command> commands;
    commands["run"] = add_run(program);
    commands["render"] = add_render(program);
    commands["edit"] = add_edit(program);
    commands["bench"] = add_bench(program);
    commands["validate"] = add_validate(program);
    commands["check"] = add_check(program);
    commands["convert"] = add_convert(program);
    commands["info"] = add_info(program);

    if (argc > 1 && argv[1][0] != '-' && !commands.count(argv[1])) {
        std::string known;
        for (const auto& [name, command] : commands) known += (known.empty() ? "" : ", ") + name;
        std::cerr << "weft: error: unknown command '" << argv[1] << "'; there are " << known << '\n';
        return exit_usage;
    }
    if (const auto status = program.parse(argc, argv)) return *status;
    return commands.at(program.command())();
}

// Flushes stdout, because buffered output may still fail, for example on a full disk.
int after_output(int code) {
    errno = 0;
    const bool written = std::fflush(stdout) == 0 && !std::ferror(stdout);
    if (written || errno == EPIPE) return code;  // a reader that closes the pipe has read enough
    print_errors(
        {{"standard output", errno == 0 ? "cannot be written" : "cannot be written: " + system_reason(errno)}});
    return code == exit_done ? exit_failed : code;
}

}  // namespace
}  // namespace weft::cli

int main(int argc, char** argv) {
    // Writing beyond the system's file size limit is reported as an error instead of ending the program.
    std::signal(SIGXFSZ, SIG_IGN);
    std::signal(SIGPIPE, SIG_IGN);
    // Large enough for the output of any command, so that only the last flush can fail and its reason is known.
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
