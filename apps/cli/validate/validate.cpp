// weft validate: physics against known solutions.
#include "validate/validation.h"

#include "cli/shell/command.h"
#include "cli/shell/interrupt.h"
#include "io/files/atomic_file.h"
#include "scene/nearest_name.h"

#include <weft/weft.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <variant>

namespace weft::cli {
namespace {

using Json = nlohmann::ordered_json;

struct ValidateOptions {
    Options simulation;
    std::vector<std::string> cases;
    std::string json;
    bool quick = false, list = false;
};

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

const char* sign_of(Bound bound) {
    return bound == Bound::near ? "" : bound == Bound::at_most ? "≤ " : "≥ ";
}

// What the error is a part of does not matter if the reference is 0.
std::string error_of(const ValidationCheck& check) {
    if (check.bound != Bound::near) return "";
    if (check.expected == 0) return number(check.measured - check.expected);
    char text[32];
    std::snprintf(text, sizeof text, "%+.3g %%", 100 * (check.measured / check.expected - 1));
    return text;
}

void print(const ValidationCheck& check) {
    const std::string unit = check.unit.empty() ? "" : ' ' + check.unit;
    std::string expected = sign_of(check.bound) + number(check.expected);
    if (check.bound == Bound::near) expected += " ± " + number(check.tolerance);
    const std::string error = error_of(check);
    std::printf("  %s  %s: %s%s, expected %s%s%s%s\n", check.passes() ? "pass" : "FAIL", check.what.c_str(),
                number(check.measured).c_str(), unit.c_str(), expected.c_str(), unit.c_str(), error.empty() ? "" : ", ",
                error.c_str());
    std::fflush(stdout);
}

// JSON has no NaN.
Json json_of(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json json_of(const ValidationResult& result) {
    const ValidationCase& one = *find_validation_case(result.name);
    Json out;
    out["name"] = result.name;
    out["title"] = one.title;
    out["source"] = one.source;
    if (!one.shortfall.empty()) out["shortfall"] = one.shortfall;
    out["pass"] = result.passes();
    out["seconds"] = result.seconds;
    if (!result.problem.empty()) out["problem"] = result.problem;
    out["checks"] = Json::array();
    for (const ValidationCheck& check : result.checks) {
        constexpr const char* bounds[] = {"near", "at most", "at least"};
        Json& to = out["checks"].emplace_back();
        to["what"] = check.what;
        to["unit"] = check.unit;
        to["measured"] = json_of(check.measured);
        to["expected"] = json_of(check.expected);
        to["bound"] = bounds[static_cast<int>(check.bound)];
        if (check.bound == Bound::near) to["tolerance"] = json_of(check.tolerance);
        to["pass"] = check.passes();
        for (const auto& [name, value] : check.settings)
            std::visit([&, key = std::string(name)](const auto& v) { to["settings"][key] = v; }, value);
        if (check.ms_per_frame > 0) to["ms_per_frame"] = check.ms_per_frame;
        if (!check.outline.empty()) to["outline"] = check.outline;
    }
    return out;
}

// Rewritten after each case, so that an interrupted run keeps what it has done.
Result<void> write_json(const ValidateOptions& options, const std::vector<ValidationResult>& results, bool complete) {
    if (options.json.empty()) return {};
    Json out;
    out["weft"] = version();
    out["backend"] = options.simulation.backend;
    out["quick"] = options.quick;
    out["complete"] = complete;
    out["pass"] = complete && std::ranges::all_of(results, &ValidationResult::passes);
    out["cases"] = Json::array();
    for (const ValidationResult& result : results) out["cases"].push_back(json_of(result));
    return write_atomically(options.json, [&](AtomicFile& file) { return file.write(out.dump(2) + '\n'); });
}

Result<std::vector<const ValidationCase*>> chosen(const std::vector<std::string>& names) {
    std::vector<const ValidationCase*> cases;
    if (names.empty())
        for (const ValidationCase& one : validation_cases()) cases.push_back(&one);
    std::vector<std::string_view> known;
    for (const ValidationCase& one : validation_cases()) known.push_back(one.name);
    Errors errors;
    for (const std::string& name : names) {
        if (const ValidationCase* one = find_validation_case(name)) {
            cases.push_back(one);
        } else {
            errors.push_back(
                {"--case", "unknown case '" + name + "'" + suggestion(name, known) + "; --list prints all"});
        }
    }
    if (!errors.empty()) return errors;
    return cases;
}

int validate(const ValidateOptions& options) {
    if (options.list) {
        for (const ValidationCase& one : validation_cases())
            std::printf("%-18s %.*s (%.*s)\n", std::string(one.name).c_str(), static_cast<int>(one.title.size()),
                        one.title.data(), static_cast<int>(one.source.size()), one.source.data());
        return exit_done;
    }
    const auto cases = chosen(options.cases);
    if (!cases) {
        print_errors(cases.errors());
        return exit_usage;
    }
    std::vector<ValidationResult> results;
    if (auto written = write_json(options, results, false); !written) {
        print_errors(written.errors());
        return exit_code(written.errors());
    }
    const EndOnSignal end;
    Validation validation(options.simulation, options.quick);
    // A case can take minutes, so it ends at the check after the signal.
    validation.on_check = [&end](const ValidationCheck& check) {
        print(check);
        if (end.asked()) throw std::runtime_error("interrupted");
    };
    std::size_t failed = 0;
    for (const ValidationCase* one : *cases) {
        if (end.asked()) break;
        std::printf("%s: %s\n", std::string(one->name).c_str(), std::string(one->title).c_str());
        results.push_back(run_case(*one, validation));
        const ValidationResult& result = results.back();
        if (!result.problem.empty()) print_errors({{std::string(one->name), result.problem}});
        failed += !result.passes();
        if (!result.passes() && result.problem.empty() && !one->shortfall.empty())
            std::printf("  why: %s\n", std::string(one->shortfall).c_str());
        std::printf("  %.1f s\n", result.seconds);
        const bool complete = results.size() == cases->size() && !end.asked();
        if (auto written = write_json(options, results, complete); !written) {
            print_errors(written.errors());
            return exit_code(written.errors());
        }
    }
    std::size_t checks = 0, missed = 0;
    for (const ValidationResult& result : results) {
        checks += result.checks.size();
        missed += static_cast<std::size_t>(
            std::ranges::count_if(result.checks, [](const auto& check) { return !check.passes(); }));
    }
    std::printf("%zu of %zu checks pass, in %zu of %zu cases\n", checks - missed, checks, results.size(),
                cases->size());
    return failed == 0 && results.size() == cases->size() && !end.asked() ? exit_done : exit_failed;
}

}  // namespace

Command add_validate(Program& program) {
    const auto options = std::make_shared<ValidateOptions>();
    Arguments command = program.add_command("validate", "Compare physics with known solutions");
    command.add("--case", options->cases, "Only this case; may be given several times").called("NAME").one_at_a_time();
    command.add("--list", options->list, "Print the cases and the sources of their reference values");
    command.add("--json", options->json, "Write the results to this file, after each case").called("FILE");
    command.add("--quick", options->quick, "Fewer resolutions and settings, a minute in all");
    command
        .add("--backend", options->simulation.backend,
             "where to simulate; auto takes a Vulkan GPU if there is one, else the CPU")
        .called("auto|cpu|vulkan")
        .with_default();
    command.add("--device", options->simulation.device, "Vulkan device: part of a name that `weft info` prints")
        .called("NAME");
    command.footer("Exit status: 0 all checks pass, 1 one fails or the run was interrupted, 2 wrong input or usage.");
    return [options] { return validate(*options); };
}

}  // namespace weft::cli
