// A folder with a small scene, and the program run in it as a user runs it.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace weft {

using Json = nlohmann::json;

struct Outcome {
    int status;
    std::string out, err;
};

inline std::string read_file(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

class Cli : public testing::Test {
  protected:
    Cli() : folder_(std::filesystem::temp_directory_path() / ("weft_cli_" + std::to_string(::getpid()))) {
        std::filesystem::remove_all(folder_);
        std::filesystem::create_directories(folder_);
        write("sheet.json", R"({
            "weft": 1,  // small and quick
            "cloths": [{ "name": "sheet", "mesh": { "grid": { "size": [1, 1], "resolution": [12, 10] } },
                         "transform": { "position": [0, 0.4, 0] }, "pins": [{ "vertices": [0, 11] }] }],
            "colliders": [{ "name": "ball", "sphere": { "radius": 0.3 } }]
        })");
    }
    ~Cli() override { std::filesystem::remove_all(folder_); }

    void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

    Outcome weft(const std::string& arguments, const std::string& before = "") {
        const std::filesystem::path err = folder_ / "stderr.txt", out = folder_ / "stdout.txt";
        const std::string command = "cd " + folder_.string() + " && " + before + " " + WEFT_PROGRAM + " " + arguments +
                                    " >" + out.string() + " 2>" + err.string();
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
    }

    /// Wrong input: status 2, and on stderr exactly one line that says this.
    void expect_usage_error(const std::string& arguments, const std::string& says) {
        const Outcome outcome = weft(arguments);
        EXPECT_EQ(outcome.status, 2) << arguments;
        EXPECT_EQ(outcome.err.rfind("weft: error: ", 0), 0u) << outcome.err;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << arguments << ": " << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    }

    Json stats(const std::string& arguments) {
        const Outcome outcome = weft("run sheet.json --quiet --stats stats.json " + arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        EXPECT_EQ(outcome.out, "") << "--quiet";
        return Json::parse(read_file(folder_ / "stats.json"));
    }

    std::filesystem::path folder_;
};

}  // namespace weft
