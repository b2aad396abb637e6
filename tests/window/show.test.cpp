// `weft render --window` with simulated user input.
#include "user_input.h"

#include <gmock/gmock.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace weft {
namespace {

/// The running program.
class Program {
  public:
    explicit Program(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), WEFT_PROGRAM);
        std::vector<char*> words;
        for (std::string& argument : arguments) words.push_back(argument.data());
        words.push_back(nullptr);
        process_ = ::fork();
        if (process_ == 0) {
            ::execv(WEFT_PROGRAM, words.data());
            ::_exit(127);
        }
    }
    ~Program() {
        if (ended()) return;
        ::kill(process_, SIGKILL);
        ::waitpid(process_, nullptr, 0);
    }
    bool ended() {
        int status = 0;
        if (!exit_ && ::waitpid(process_, &status, WNOHANG) == process_)
            exit_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
        return exit_.has_value();
    }
    int exit() const { return *exit_; }

  private:
    pid_t process_ = 0;
    std::optional<int> exit_;
};

bool until(const std::function<bool()>& so) {
    for (int i = 0; i < 3000; ++i) {
        if (so()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    return false;
}

std::unique_ptr<UserInput> input_at(const std::string& title) {
    std::unique_ptr<UserInput> input;
    (void)until([&] {
        try {
            input = std::make_unique<UserInput>(title);
        } catch (const std::runtime_error&) {
        }
        return input != nullptr;
    });
    return input;
}

const std::string scene = WEFT_SOURCE_DIR "/scenes/hanging_sheet.json";

class ShowTest : public testing::Test {
  protected:
    void begin(std::vector<std::string> more = {}, const std::string& shown = scene) {
        std::vector<std::string> arguments = {"render", shown, "--window", "--size", "320x200", "--samples", "1"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        program.emplace(arguments);
    }
    void press(const std::string& key) {
        input->key(key, true);
        input->key(key, false);
    }
    bool titled(const std::string& part) {
        return until([&] { return input->title().find(part) != std::string::npos; });
    }

    std::optional<Program> program;
    std::unique_ptr<UserInput> input;
};

TEST_F(ShowTest, runs_pauses_starts_again_and_closes_by_key) {
    begin();
    input = input_at("weft: ");
    ASSERT_TRUE(input);
    EXPECT_TRUE(titled(" fps, ")) << input->title();
    EXPECT_TRUE(titled(" ms per step"));
    press("space");
    EXPECT_TRUE(titled("paused")) << input->title();
    press("r");
    press("space");
    EXPECT_TRUE(until([&] { return input->title().find("paused") == std::string::npos; }));
    for (const char* overlay : {"1", "2", "3", "4", "5", "6", "7", "8", "8", "1"}) press(overlay);
    input->resize(400, 300);
    input->button(3, true);
    input->point_at(50, 60);
    input->button(3, false);
    EXPECT_FALSE(program->ended());
    press("Escape");
    ASSERT_TRUE(until([&] { return program->ended(); }));
    EXPECT_EQ(program->exit(), 0);
}

TEST_F(ShowTest, closes_when_somebody_asks_for_it) {
    begin();
    input = input_at("weft: ");
    ASSERT_TRUE(input);
    input->ask_to_close();
    ASSERT_TRUE(until([&] { return program->ended(); }));
    EXPECT_EQ(program->exit(), 0);
}

TEST_F(ShowTest, closes_when_so_much_is_simulated) {
    begin({"--frames", "5"});
    ASSERT_TRUE(until([&] { return program->ended(); }));
    EXPECT_EQ(program->exit(), 0);
}

TEST_F(ShowTest, follows_where_the_scene_has_no_camera) {
    const std::filesystem::path file = std::filesystem::temp_directory_path() / "weft_show_falls.json";
    std::ofstream(file) << R"({ "weft": 1, "cloths": [{ "name": "sheet",
        "mesh": { "grid": { "size": [1, 1], "resolution": [9, 9] } } }] })";
    begin({}, file);
    input = input_at("weft: ");
    ASSERT_TRUE(input);
    EXPECT_TRUE(titled(" fps, ")) << input->title();
    input->button(1, true);
    input->point_at(50, 60);
    input->button(1, false);
    press("r");
    EXPECT_FALSE(program->ended());
    press("Escape");
    ASSERT_TRUE(until([&] { return program->ended(); }));
    EXPECT_EQ(program->exit(), 0);
    std::filesystem::remove(file);
}

TEST_F(ShowTest, goes_on_with_every_overlay_from_the_start) {
    begin({"--frames", "3", "--overlay", "contacts"});
    ASSERT_TRUE(until([&] { return program->ended(); }));
    EXPECT_EQ(program->exit(), 0);
}

}  // namespace
}  // namespace weft
