#include "cli/render/render_options.h"

#include "io/images/image_file.h"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string_view>

namespace weft::cli {
namespace {

constexpr std::uint32_t largest_side = 16384, most_samples = 256;

std::string number_text(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

// Parses all of the text as a number, or returns nothing.
template <class Number>
std::optional<Number> whole_number(std::string_view text) {
    Number value{};
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

Result<void> check_samples(std::int64_t samples) {
    const bool power = samples >= 1 && samples <= most_samples && (samples & (samples - 1)) == 0;
    if (power) return {};
    return Error{"--samples", "must be 1, 2, 4, 8, 16, 32, 64, 128 or 256, got " + std::to_string(samples)};
}

Result<void> check_outputs(const std::vector<std::string>& outputs) {
    std::set<std::filesystem::path> places;
    for (const std::string& output : outputs) {
        std::error_code ignored;
        if (!places.insert(std::filesystem::absolute(output, ignored).lexically_normal()).second)
            return Error{output, "two --out options name this file"};
    }
    return {};
}

}  // namespace

Result<PictureSize> parse_size(const std::string& text) {
    const Error wrong{"--size", "must be width x height, each from 1 to 16384, as in 1280x720, got '" + text + "'"};
    const std::size_t middle = text.find('x');
    if (middle == std::string::npos) return wrong;
    const auto width = whole_number<std::uint32_t>(std::string_view(text).substr(0, middle));
    const auto height = whole_number<std::uint32_t>(std::string_view(text).substr(middle + 1));
    for (const auto& side : {width, height})
        if (!side || *side < 1 || *side > largest_side) return wrong;
    if (std::uint64_t{*width} * *height > PictureLimits{}.pixels)
        return Error{"--size",
                     "must have at most " + std::to_string(PictureLimits{}.pixels) + " pixels, got '" + text + "'"};
    return PictureSize{*width, *height};
}

Result<Camera> parse_camera(const std::string& text) {
    const Error wrong{"--camera", "must be six or seven numbers, px,py,pz,tx,ty,tz[,fov], got '" + text + "'"};
    std::vector<float> numbers;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        std::string_view word = std::string_view(text).substr(at, comma - at);
        while (word.starts_with(' ')) word.remove_prefix(1);
        while (word.ends_with(' ')) word.remove_suffix(1);
        const auto number = whole_number<float>(word);
        if (!number || !std::isfinite(*number)) return wrong;
        numbers.push_back(*number);
        at = comma + 1;
    }
    if (numbers.size() != 6 && numbers.size() != 7) return wrong;
    Camera camera{.position = {numbers[0], numbers[1], numbers[2]}, .target = {numbers[3], numbers[4], numbers[5]}};
    if (numbers.size() == 7) camera.fov = numbers[6];
    for (const Parameter& parameter : camera_parameters) {
        const auto* values = reinterpret_cast<const float*>(reinterpret_cast<const char*>(&camera) + parameter.offset);
        for (unsigned i = 0; i < parameter.count; ++i) {
            if (values[i] >= parameter.min && values[i] <= parameter.max) continue;
            return Error{"--camera", std::string(parameter.key) + " must be from " + number_text(parameter.min) +
                                         " to " + number_text(parameter.max) + " " + std::string(parameter.unit) +
                                         ", got " + number_text(values[i])};
        }
    }
    if (length(camera.target - camera.position) <= 0)
        return Error{"--camera", "position and target must differ, got '" + text + "'"};
    return camera;
}

Result<RenderPlan> check_options(const RenderOptions& options) {
    Errors errors;
    const auto note = [&](const auto& result) {
        if (!result) errors.insert(errors.end(), result.errors().begin(), result.errors().end());
    };
    RenderPlan plan;
    const auto size = parse_size(options.size);
    note(size);
    if (size) plan.size = *size;
    if (!options.camera.empty()) {
        const auto camera = parse_camera(options.camera);
        note(camera);
        if (camera) plan.camera = *camera;
    }
    note(check_samples(options.samples));
    note(check_outputs(options.outputs));
    if (options.outputs.empty() && !options.window)
        errors.push_back({"--out", "is missing: give a file for the images, or --window to show them"});
    // Above this, the steps between float degrees become visible.
    constexpr double most_degrees = 36000;
    if (!(std::abs(options.orbit) <= most_degrees))
        errors.push_back({"--orbit", "must be from -36000 to 36000 degrees, got " + number_text(options.orbit)});
    if (!errors.empty()) return errors;
    return plan;
}

Result<double> film_rate(const RenderOptions& options, double frame_rate) {
    if (!options.fps) return frame_rate;
    if (*options.fps > 0 && *options.fps <= frame_rate) return *options.fps;
    return Error{"--fps", "must be more than 0 and at most " + number_text(frame_rate) +
                              ", the frame_rate of the scene, got " + number_text(*options.fps)};
}

}  // namespace weft::cli
