// Every command of README and docs is run, with few frames and small images.
#include "cli_fixture.h"

#include <regex>
#include <set>
#include <sstream>
#include <vector>

namespace {

namespace fs = std::filesystem;

struct DocCommand {
    std::string page, arguments;
};

/// Indented lines that begin with `weft `.
std::vector<DocCommand> doc_commands() {
    std::vector<fs::path> pages{fs::path(WEFT_SOURCE_DIR) / "README.md"};
    for (const auto& entry : fs::directory_iterator(fs::path(WEFT_SOURCE_DIR) / "docs"))
        if (entry.path().extension() == ".md") pages.push_back(entry.path());
    std::vector<DocCommand> commands;
    for (const fs::path& page : pages) {
        std::istringstream lines(weft::read_file(page));
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with("    weft ")) continue;
            commands.push_back({page.filename(), line.substr(9, line.find('#', 9) - 9)});
        }
    }
    return commands;
}

std::string replaced(const std::string& text, const char* pattern, const std::string& by) {
    return std::regex_replace(text, std::regex(pattern), by);
}

/// The command with few frames and small images; empty if it needs a display or files that a test does not have.
std::string shortened(std::string arguments) {
    if (arguments.starts_with("edit")) return {};  // tests/editor drives it
    for (const char* absent : {"--window", "nvidia", "COMMAND", "--backend vulkan"})
        if (arguments.find(absent) != std::string::npos) return {};
    arguments = replaced(arguments, " --(seconds|frames|warmup|repeat|size|samples|fps|build)( [0-9.x]+)+", "");
    arguments = replaced(arguments, "\\b(SCENE|(my_)?scene\\.json)", "scenes/hanging_sheet.json");
    arguments = replaced(arguments, "FILE.json", "file.json");
    if (arguments.starts_with("run ")) arguments += " --frames 1 --quiet";
    if (arguments.starts_with("render ")) arguments += " --frames 1 --quiet --size 64x36 --samples 1";
    if (arguments.starts_with("bench"))
        arguments += (arguments.find("scenes/") == std::string::npos ? " sheet.json" : "") +
                     std::string(" --warmup 0 --frames 2 --repeat 1 --quiet");
    return arguments;
}

class CliDocs : public weft::Cli {};

// Labels: slow no-asan
TEST_F(CliDocs, every_command_of_the_pages_runs) {
    fs::create_directory_symlink(fs::path(WEFT_SOURCE_DIR) / "scenes", folder_ / "scenes");
    fs::create_directory_symlink(fs::path(WEFT_SOURCE_DIR) / "bench", folder_ / "bench");
    std::set<std::string> run;
    for (const DocCommand& command : doc_commands()) {
        const std::string arguments = shortened(command.arguments);
#ifndef WEFT_VULKAN
        if (arguments.starts_with("render")) continue;
#endif
        if (arguments.empty() || !run.insert(arguments).second) continue;
        const weft::Outcome outcome = weft(arguments);
        EXPECT_EQ(outcome.status, 0) << command.page << ": weft " << command.arguments << "\nrun as: weft " << arguments
                                     << '\n'
                                     << outcome.err;
    }
    EXPECT_GT(run.size(), 25u);
}

}  // namespace
