#include "editor/app/settings.h"

#include "editor/ui/theme.h"
#include "io/files/atomic_file.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>

namespace weft::editor {
namespace {

constexpr std::size_t most_recent = 12;

float within(const Json& json, const char* key, float usual, float least, float most) {
    const auto found = json.find(key);
    if (found == json.end() || !found->is_number()) return usual;
    const float value = found->get<float>();
    return std::isfinite(value) ? std::clamp(value, least, most) : usual;
}

}  // namespace

std::filesystem::path settings_file() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return std::filesystem::path(value ? value : "");
    };
    if (const auto config = variable("XDG_CONFIG_HOME"); !config.empty()) return config / "weft" / "editor.json";
    const auto home = variable("HOME");
    return home.empty() ? std::filesystem::path() : home / ".config" / "weft" / "editor.json";
}

Settings load_settings(const std::filesystem::path& file, std::string& problem) {
    Settings settings;
    std::error_code ignored;
    if (file.empty() || !std::filesystem::exists(file, ignored)) return settings;
    std::ifstream in(file);
    const Json json = Json::parse(in, nullptr, false);
    if (json.is_discarded() || !json.is_object()) {
        problem = file.string() + ": cannot be read; the defaults are used";
        return settings;
    }
    const auto text = [&](const char* key) {
        const auto found = json.find(key);
        return found != json.end() && found->is_string() ? found->get<std::string>() : std::string();
    };
    if (text("appearance") == "light") settings.appearance = Appearance::light;
    if (text("keys") == "source") settings.keys = FlyKeys::source;
    if (const auto found = json.find("fly_always"); found != json.end() && found->is_boolean())
        settings.fly_always = found->get<bool>();
    const float scale = within(json, "scale", 0, 0, most_scale);
    settings.scale = scale == 0 ? 0 : std::max(scale, least_scale);
    settings.left = within(json, "left", settings.left, 120, 600);
    settings.right = within(json, "right", settings.right, 200, 800);
    settings.pull_force = within(json, "pull_force", settings.pull_force, 0.01f, 1e6f);
    const auto texts = [&](const char* key, auto&& add) {
        const auto found = json.find(key);
        if (found == json.end() || !found->is_array()) return;
        for (const Json& one : *found)
            if (one.is_string()) add(one.get<std::string>());
    };
    texts("recent", [&](std::string one) {
        if (settings.recent.size() < most_recent) settings.recent.push_back(std::move(one));
    });
    texts("hints_done", [&](std::string one) { settings.hints_done.insert(std::move(one)); });
    return settings;
}

Result<void> save_settings(const Settings& settings, const std::filesystem::path& file) {
    if (file.empty()) return {};
    if (auto made = make_folder_of(file); !made) return made;
    const Json json{{"appearance", settings.appearance == Appearance::light ? "light" : "dark"},
                    {"scale", number(settings.scale)},
                    {"left", number(settings.left)},
                    {"right", number(settings.right)},
                    {"keys", settings.keys == FlyKeys::source ? "source" : "usual"},
                    {"fly_always", settings.fly_always},
                    {"pull_force", number(settings.pull_force)},
                    {"recent", settings.recent},
                    {"hints_done", settings.hints_done}};
    return write_atomically(file, [&](AtomicFile& out) { return out.write(json.dump(4) + "\n"); });
}

void add_recent(Settings& settings, const std::filesystem::path& file) {
    const std::string name = std::filesystem::absolute(file).lexically_normal().string();
    std::erase(settings.recent, name);
    settings.recent.insert(settings.recent.begin(), name);
    if (settings.recent.size() > most_recent) settings.recent.resize(most_recent);
}

}  // namespace weft::editor
