// What a program understands on its command line. Only arguments.cpp includes CLI11, whose header takes seconds to
// compile.
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
    /// --help shows the value that it has now.
    Argument& with_default();
    /// Not together with the other one.
    Argument& excludes(const Argument& other);
    /// A list takes one value for each time that the option is given, not all that follow it.
    Argument& one_at_a_time();
    /// A list takes several values in one word, with this between them.
    Argument& separated_by(char separator);

  private:
    CLI::Option* option_;
};

/// The arguments of one command. Values are stored when the command line is parsed, and must live until then.
class Arguments {
  public:
    explicit Arguments(CLI::App& app) : app_(&app) {}

    /// `name` begins with dashes, or is that of a positional argument.
    Argument add(const std::string& name, std::string& value, const std::string& help);
    Argument add(const std::string& name, std::vector<std::string>& values, const std::string& help);
    Argument add(const std::string& name, std::uint32_t& value, const std::string& help);
    Argument add(const std::string& name, std::vector<std::uint32_t>& values, const std::string& help);
    Argument add(const std::string& name, std::int64_t& value, const std::string& help);
    Argument add(const std::string& name, double& value, const std::string& help);
    Argument add(const std::string& name, std::optional<double>& value, const std::string& help);
    /// True if it is given.
    Argument add(const std::string& name, bool& flag, const std::string& help);

    // Calls with what is given, and not at all if nothing is.
    Argument add_text(const std::string& name, std::function<void(const std::string&)> use, const std::string& help);
    Argument add_number(const std::string& name, std::function<void(double)> use, const std::string& help);
    /// --name and --no-name
    Argument add_switch(const std::string& name, std::function<void(bool)> use, const std::string& help);

    /// Stands below the options in --help.
    void footer(const std::string& text);

  private:
    CLI::App* app_;
};

/// A program, with commands or with arguments of its own.
class Program {
  public:
    Program(const std::string& description, const std::string& name);
    ~Program();

    Arguments arguments();
    Arguments add_command(const std::string& name, const std::string& help);
    /// Answers --version.
    void set_version(const std::string& text);
    /// One of the commands must be given.
    void require_command();

    /// Stores what the command line says. The exit status, if the program is to end now: after --help, or after wrong
    /// usage, of which `weft: error: …; see weft … --help` is printed.
    std::optional<int> parse(int argc, char** argv);
    /// The command that was given.
    std::string command() const;

  private:
    std::unique_ptr<CLI::App> app_;
};

}  // namespace weft::cli
