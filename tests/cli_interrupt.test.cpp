// Ctrl-C, and the signal of `timeout`, which comes twice.

#include "cli/shell/interrupt.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace {

using weft::cli::EndOnSignal;

TEST(EndOnSignal, takes_two_signals_at_once_as_one_request) {
    for (const int number : {SIGINT, SIGTERM}) {
        const EndOnSignal end;
        EXPECT_FALSE(end.asked());
        std::raise(number);
        EXPECT_TRUE(end.asked());
        std::raise(number);
        EXPECT_TRUE(end.asked());
    }
}

TEST(EndOnSignal, a_later_second_signal_ends_the_program) {
    for (const int number : {SIGINT, SIGTERM}) {
        const auto signal_twice = [number] {
            const EndOnSignal end;
            std::raise(number);
            std::this_thread::sleep_for(std::chrono::milliseconds(600));
            std::raise(number);
        };
        EXPECT_EXIT(signal_twice(), testing::KilledBySignal(number), "");
    }
}

TEST(EndOnSignal, leaves_what_handled_signals_before) {
    const auto before = std::signal(SIGTERM, SIG_IGN);
    {
        const EndOnSignal end;
        std::raise(SIGTERM);  // stays ignored
        EXPECT_FALSE(end.asked());
    }
    EXPECT_EQ(std::signal(SIGTERM, before), SIG_IGN);
}

}  // namespace
