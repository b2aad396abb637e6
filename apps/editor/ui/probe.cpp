#include "editor/ui/probe.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <system_error>

namespace weft::editor {
namespace {

std::string json_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (static_cast<unsigned char>(c) < 0x20) {
            char code[8];
            std::snprintf(code, sizeof code, "\\u%04x", static_cast<unsigned>(c));
            out += code;
        } else {
            out += c;
        }
    }
    return out + '"';
}

std::string json_number(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", static_cast<double>(value));
    return text;
}

}  // namespace

void Probe::begin_frame() {
    widgets_.clear();
    scopes_.clear();
}

std::string Probe::path(std::string_view name) const {
    std::string whole;
    for (const std::string& scope : scopes_) whole += scope + '/';
    return whole + std::string(name);
}

void Probe::add(std::string_view name, const ImRect& box, const ImRect& clip, bool enabled, bool focused,
                std::string_view value) {
    ImRect shown = box;
    shown.ClipWithFull(clip);
    const bool visible = shown.GetWidth() >= 1 && shown.GetHeight() >= 1;
    const ImRect& place = visible ? shown : box;
    widgets_[path(name)] = {place.Min.x, place.Min.y, place.GetWidth(), place.GetHeight(),
                            visible,     enabled,     focused,          std::string(value)};
}

const ProbedWidget* Probe::find(std::string_view path) const {
    const auto found = widgets_.find(std::string(path));
    return found == widgets_.end() ? nullptr : &found->second;
}

std::string Probe::json() const {
    const auto flag = [](bool value) { return value ? "true" : "false"; };
    std::string text = "{\"window\": {\"width\": " + json_number(width) + ", \"height\": " + json_number(height) +
                       ", \"scale\": " + json_number(scale) + "},\n\"frames\": " + std::to_string(frames) +
                       ", \"settled\": " + std::to_string(settled) + ", \"idle\": " + flag(idle) +
                       ", \"changes\": " + std::to_string(changes) +
                       ", \"pointer\": {\"x\": " + json_number(pointer_x) + ", \"y\": " + json_number(pointer_y) +
                       "},\n\"widgets\": {";
    const char* between = "\n";
    for (const auto& [name, one] : widgets_) {
        text += between + json_text(name) + ": {\"x\": " + json_number(one.x) + ", \"y\": " + json_number(one.y) +
                ", \"width\": " + json_number(one.width) + ", \"height\": " + json_number(one.height) +
                ", \"visible\": " + flag(one.visible) + ", \"enabled\": " + flag(one.enabled) +
                ", \"focused\": " + flag(one.focused) + ", \"value\": " + json_text(one.value) + "}";
        between = ",\n";
    }
    return text + "\n}}\n";
}

Result<void> Probe::write(const std::filesystem::path& file) const {
    std::filesystem::path part = file;
    part += ".part";
    std::ofstream out(part, std::ios::binary);
    out << json();
    out.close();
    if (!out) return Error::of_machine(part.string(), "cannot be written");
    std::error_code failed;
    std::filesystem::rename(part, file, failed);
    if (failed) return Error::of_machine(file.string(), "cannot be replaced: " + failed.message());
    return {};
}

}  // namespace weft::editor
