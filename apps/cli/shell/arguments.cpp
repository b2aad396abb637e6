#include "cli/shell/arguments.h"

#include "cli/shell/command.h"
#include "cli/shell/text.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <utility>

namespace weft::cli {
namespace {

// CLI11 reports wrong usage in several lines; this program prints one.
int usage_error(const CLI::App& program, const CLI::ParseError& error) {
    std::string text = error.what();
    for (char& c : text) {
        if (c == '\n') c = ' ';
    }
    std::string command = program.get_name();
    for (const CLI::App* chosen : program.get_subcommands()) command += ' ' + chosen->get_name();
    std::cerr << "weft: error: " << text << "; see " << command << " --help\n";
    return exit_usage;
}

// Wraps the text to fit beside the column of names, within 100 characters.
std::string beside_name(const std::string& help) {
    return wrapped(help, 68);
}

}  // namespace

Argument& Argument::required() {
    option_->required();
    return *this;
}
Argument& Argument::with_default() {
    option_->capture_default_str();
    return *this;
}
Argument& Argument::excludes(const Argument& other) {
    option_->excludes(other.option_);
    return *this;
}
Argument& Argument::called(const std::string& value) {
    option_->type_name(value);
    return *this;
}
Argument& Argument::under(const std::string& heading) {
    option_->group(heading);
    return *this;
}
Argument& Argument::one_at_a_time() {
    option_->allow_extra_args(false);
    return *this;
}
Argument& Argument::separated_by(char separator) {
    option_->delimiter(separator);
    return *this;
}

Argument Arguments::add(const std::string& name, std::string& value, const std::string& help) {
    return Argument(*app_->add_option(name, value, beside_name(help)));
}
Argument Arguments::add(const std::string& name, std::vector<std::string>& values, const std::string& help) {
    return Argument(*app_->add_option(name, values, beside_name(help)));
}
Argument Arguments::add(const std::string& name, std::uint32_t& value, const std::string& help) {
    return Argument(*app_->add_option(name, value, beside_name(help)));
}
Argument Arguments::add(const std::string& name, std::vector<std::uint32_t>& values, const std::string& help) {
    return Argument(*app_->add_option(name, values, beside_name(help)));
}
Argument Arguments::add(const std::string& name, std::int64_t& value, const std::string& help) {
    return Argument(*app_->add_option(name, value, beside_name(help)));
}
Argument Arguments::add(const std::string& name, double& value, const std::string& help) {
    return Argument(*app_->add_option(name, value, beside_name(help)));
}
Argument Arguments::add(const std::string& name, std::optional<double>& value, const std::string& help) {
    return Argument(*app_->add_option(name, value, beside_name(help)));
}
Argument Arguments::add(const std::string& name, bool& flag, const std::string& help) {
    return Argument(*app_->add_flag(name, flag, beside_name(help)));
}

Argument Arguments::add_text(const std::string& name, std::function<void(const std::string&)> use,
                             const std::string& help) {
    return Argument(*app_->add_option_function<std::string>(name, std::move(use), beside_name(help)));
}
Argument Arguments::add_number(const std::string& name, std::function<void(double)> use, const std::string& help) {
    return Argument(*app_->add_option_function<double>(
        name, [use = std::move(use)](const double& value) { use(value); }, beside_name(help)));
}
Argument Arguments::add_switch(const std::string& name, std::function<void(bool)> use, const std::string& help) {
    return Argument(*app_->add_flag_function(
        "--" + name + ",!--no-" + name, [use = std::move(use)](std::int64_t count) { use(count > 0); },
        beside_name(help)));
}

void Arguments::footer(const std::string& text) {
    app_->footer(text);
}

Program::Program(const std::string& description, const std::string& name)
    : app_(std::make_unique<CLI::App>(description, name)) {}
Program::~Program() = default;

Arguments Program::arguments() {
    return Arguments(*app_);
}
Arguments Program::add_command(const std::string& name, const std::string& help) {
    return Arguments(*app_->add_subcommand(name, help));
}
void Program::set_version(const std::string& text) {
    app_->set_version_flag("--version", text);
}
void Program::require_command() {
    app_->require_subcommand(1);
}

std::optional<int> Program::parse(int argc, char** argv) {
    try {
        app_->parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app_->exit(error);  // --help, --version
        return usage_error(*app_, error);
    }
    return std::nullopt;
}

std::string Program::command() const {
    return app_->get_subcommands().front()->get_name();
}

}  // namespace weft::cli
