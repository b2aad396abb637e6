#include "editor/core/script.h"

#include "io/files/buffered_file.h"

#include <cerrno>
#include <fstream>
#include <map>

namespace weft::editor {
namespace {

class Script {
  public:
    Script(Stage& stage, const std::function<void(const std::string&)>& say) : stage_(stage), say_(say) {}

    Result<void> line(const std::string& text) {
        const Json json = Json::parse(text, nullptr, false);
        if (json.is_discarded()) return Error{"", "is not JSON"};
        if (json.is_object() && json.contains("weft_log")) return {};
        if (json.is_object() && json.contains("end")) {
            if (!json["end"].is_number_unsigned()) return Error{"end", "must be a frame"};
            return advance_to(json["end"].get<std::uint64_t>());
        }
        const std::string what = json.is_object() ? json.value("do", "") : "";
        if (what == "say_hash" || what == "expect_hash") return hash(what, json.value("name", ""));
        auto action = action_from(json);
        if (!action) return action.errors();
        if (action->first)
            if (auto there = advance_to(*action->first); !there) return there;
        return stage_.apply(action->second);
    }

  private:
    Result<void> advance_to(std::uint64_t frame) {
        while (stage_.frame() < frame)
            if (auto stepped = stage_.step(); !stepped) return stepped;
        return {};
    }
    Result<void> hash(const std::string& what, const std::string& name) {
        const std::string now = stage_.hash();
        if (what == "say_hash") {
            hashes_[name] = now;
            if (say_) say_("frame " + std::to_string(stage_.frame()) + ", hash " + name + ": " + now);
            return {};
        }
        const auto known = hashes_.find(name);
        if (known == hashes_.end()) return Error{"name", "no hash was kept as \"" + name + "\""};
        if (known->second != now)
            return Error{"", "the hash is " + now + " and not \"" + name + "\", " + known->second};
        return {};
    }

    Stage& stage_;
    const std::function<void(const std::string&)>& say_;
    std::map<std::string, std::string> hashes_;
};

}  // namespace

Result<void> run_script(Stage& stage, const std::filesystem::path& file,
                        const std::function<void(const std::string&)>& say) {
    errno = 0;
    std::ifstream in(file);
    if (!in) return Error{file.string(), "cannot be opened: " + system_reason(errno)};
    Script script(stage, say);
    std::size_t number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        const std::size_t begin = line.find_first_not_of(" \t\r");
        if (begin == std::string::npos || line.compare(begin, 2, "//") == 0) continue;
        auto done = script.line(line);
        if (done) continue;
        Errors errors = done.errors();
        for (Error& error : errors)
            error.where =
                file.string() + ":" + std::to_string(number) + (error.where.empty() ? "" : ": " + error.where);
        return errors;
    }
    return {};
}

}  // namespace weft::editor
