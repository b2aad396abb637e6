// Declares and parses the command line. Only arguments.cpp includes CLI11, whose header takes seconds to compile.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace weft::cli {

/// An option or a positional argument that was declared.
class Argument {
  public:
    explicit Argument(CLI::Option& option) : option_(&option) {}

    Argument& required();
    /// --help shows the current value as the default.
    Argument& with_default();
    /// The two cannot be given together.
    Argument& excludes(const Argument& other);
    /// The name of the value in --help, such as FILE or N.
    Argument& called(const std::string& value);
    /// --help lists it under this heading.
    Argument& under(const std::string& heading);
    /// The option takes one value each time it is given, not all values that follow it.
    Argument& one_at_a_time();
    /// The option takes several values in one word, separated by this character.
    Argument& separated_by(char separator);

  private:
    CLI::Option* option_;
};

/// The arguments of one command. Values are stored when the command line is parsed, and must live until then.
class Arguments {
  public:
    explicit Arguments(CLI::App& app) : app_(&app) {}

    /// `name` begins with dashes, or is the name of a positional argument.
    Argument add(const std::string& name, std::string& value, const std::string& help);
    Argument add(const std::string& name, std::vector<std::string>& values, const std::string& help);
    Argument add(const std::string& name, std::uint32_t& value, const std::string& help);
    Argument add(const std::string& name, std::vector<std::uint32_t>& values, const std::string& help);
    Argument add(const std::string& name, std::int64_t& value, const std::string& help);
    Argument add(const std::string& name, double& value, const std::string& help);
    Argument add(const std::string& name, std::optional<double>& value, const std::string& help);
    /// Sets the flag to true if the option is given.
    Argument add(const std::string& name, bool& flag, const std::string& help);

    // Calls the function with the given value; never if the option is not given.
    Argument add_text(const std::string& name, std::function<void(const std::string&)> use, const std::string& help);
    Argument add_number(const std::string& name, std::function<void(double)> use, const std::string& help);
    /// --name and --no-name
    Argument add_switch(const std::string& name, std::function<void(bool)> use, const std::string& help);

    /// Text below the options in --help.
    void footer(const std::string& text);

  private:
    CLI::App* app_;
};

/// A program, with commands or with its own arguments.
class Program {
  public:
    Program(const std::string& description, const std::string& name);
    ~Program();

    Arguments arguments();
    Arguments add_command(const std::string& name, const std::string& help);
    /// The text that --version prints.
    void set_version(const std::string& text);
    /// One of the commands must be given.
    void require_command();

    /// Stores the values of the command line. Returns the exit status if the program is to end now: after --help, or
    /// after wrong usage, for which it has printed `weft: error: …; see weft … --help`.
    std::optional<int> parse(int argc, char** argv);
    /// The command that was given.
    std::string command() const;

  private:
    std::unique_ptr<CLI::App> app_;
};

}  // namespace weft::cli
