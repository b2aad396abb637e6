#include "editor/app/export_dialog.h"

#include "editor/app/editor.h"
#include "editor/app/popups.h"
#include "editor/ui/expression.h"
#include "editor/ui/widgets/controls.h"
#include "editor/ui/widgets/number.h"

#include <algorithm>
#include <cmath>

namespace weft::editor {
namespace {

constexpr std::uint32_t largest_side = 16384;

struct SizePreset {
    std::string_view name, what;
    std::uint32_t width, height;
};
constexpr std::array<SizePreset, 5> sizes{{{"1280×720", "HD", 1280, 720},
                                           {"1920×1080", "Full HD", 1920, 1080},
                                           {"3840×2160", "4K", 3840, 2160},
                                           {"1080×1080", "square", 1080, 1080},
                                           {"own size", "width and height below", 0, 0}}};

std::string frames_text(std::uint64_t frames, double frame_rate) {
    return std::to_string(frames) + (frames == 1 ? " frame, " : " frames, ") + seconds_text(frames, frame_rate);
}

void choose_run(Ui& ui, ExportChoices& choices, const Published& now) {
    constexpr std::array<std::string_view, 2> runs{"recorded run", "new simulation"};
    constexpr std::array<std::string_view, 2> whats{"what you saw, with pulls, cuts and changes",
                                                    "the scene from frame 0, without what was done by hand"};
    const double rate = static_cast<double>(now.document->scene.frame_rate);
    std::size_t run = choices.recorded ? 0 : 1;
    (void)choice(ui, {.name = "run", .label = "Source", .what = "Which frames are exported"}, run, runs, {}, whats);
    choices.recorded = run == 0;
    if (!choices.recorded) {
        auto frames = static_cast<long long>(choices.simulated);
        (void)integer(ui, {.name = "frames", .label = "Frames", .what = "How many frames are simulated"}, frames,
                      {.min = 1, .max = 1e6, .integer = true});
        choices.simulated = static_cast<std::uint64_t>(frames);
        muted_text(ui, frames_text(choices.simulated, rate) +
                           ". Simulates again from frame 0, without what you pulled and cut by hand.");
        return;
    }
    const FrameRange all = frames_to_export(now);
    double ends[2] = {static_cast<double>(choices.frames.first), static_cast<double>(choices.frames.last)};
    constexpr std::array<std::string_view, 2> parts{"first", "last"};
    const NumberRange range{
        .min = static_cast<double>(all.first), .max = static_cast<double>(all.last), .integer = true};
    (void)vector(ui, {.name = "range", .label = "Frames", .what = "First and last frame of the film"}, ends, range, {},
                 parts);
    choices.frames.first = std::clamp(static_cast<std::uint64_t>(ends[0]), all.first, all.last);
    choices.frames.last = std::clamp(static_cast<std::uint64_t>(ends[1]), choices.frames.first, all.last);
    muted_text(ui, frames_text(choices.frames.last - choices.frames.first + 1, rate) +
                       ". Takes the recorded frames: pulls, cuts and changes are in them.");
}

void choose_size(Ui& ui, ExportChoices& choices) {
    std::array<std::string_view, sizes.size()> names{}, whats{};
    std::ranges::transform(sizes, names.begin(), &SizePreset::name);
    std::ranges::transform(sizes, whats.begin(), &SizePreset::what);
    std::size_t size = sizes.size() - 1;
    for (std::size_t i = 0; i + 1 < sizes.size(); ++i)
        if (sizes[i].width == choices.size[0] && sizes[i].height == choices.size[1]) size = i;
    if (choice(ui, {.name = "size", .label = "Size", .what = "Of the image, in pixels"}, size, names, {}, whats) !=
            Change::none &&
        sizes[size].width > 0)
        choices.size = {sizes[size].width, sizes[size].height};
    double sides[2] = {static_cast<double>(choices.size[0]), static_cast<double>(choices.size[1])};
    constexpr std::array<std::string_view, 2> parts{"width", "height"};
    (void)vector(ui, {.name = "pixels", .label = "Pixels"}, sides,
                 {.min = 16, .max = static_cast<double>(largest_side), .integer = true}, {}, parts);
    for (std::size_t i = 0; i < 2; ++i)
        choices.size[i] = static_cast<std::uint32_t>(std::clamp(sides[i], 16.0, static_cast<double>(largest_side)));
    // A video of this format has an even width and height.
    if (!export_format_lines()[choices.format].is_still)
        for (std::uint32_t& side : choices.size) side += side % 2;
}

void choose_overlays(Ui& ui, ExportChoices& choices, std::span<const Overlay* const> overlays) {
    if (overlays.empty()) return;
    std::string names;
    for (const Overlay* overlay : overlays) names += (names.empty() ? "" : ", ") + std::string(overlay->name);
    std::ranges::replace(names, '_', ' ');
    (void)flag(ui, {.name = "overlays", .label = "Overlays", .what = "Draws what the menu Overlays shows: " + names},
               choices.overlays);
    if (choices.overlays && exported_overlays(overlays, choices.recorded).size() < overlays.size())
        muted_text(ui, "What contact does is not recorded: choose a new simulation to see it.");
}

}  // namespace

std::vector<std::string> exported_overlays(std::span<const Overlay* const> overlays, bool recorded) {
    std::vector<std::string> drawn;
    for (const Overlay* overlay : overlays)
        if (!recorded || overlay->needs == OverlayNeeds::nothing) drawn.emplace_back(overlay->name);
    return drawn;
}

std::string seconds_text(std::uint64_t frames, double frame_rate) {
    return format_number(std::round(100 * static_cast<double>(frames) / frame_rate) / 100, "s");
}

void begin_export(ExportChoices& choices, const Published& now) {
    choices.frames = frames_to_export(now);
    choices.simulated = std::max<std::uint64_t>(now.last_recorded, 60);
}

ExportAnswer show_export_dialog(Ui& ui, ExportChoices& choices, const Published& now,
                                std::span<const Overlay* const> overlays) {
    const Theme& theme = ui.theme();
    Dialog dialog(ui, "export", "Export", ImVec2(theme.px(560), 0));
    choose_run(ui, choices, now);
    std::vector<std::string_view> endings, whats;
    for (const ExportFormatLine& line : export_format_lines())
        endings.push_back(line.ending), whats.push_back(line.what);
    (void)choice(ui, {.name = "format", .label = "Format"}, choices.format, endings, {}, whats);
    const ExportFormatLine& format = export_format_lines()[choices.format];
    muted_text(ui, std::string(format.ending) + ": " + std::string(format.what) + ".");
    if (format.is_image) {
        choose_size(ui, choices);
        if (!format.is_still) {
            const double most = static_cast<double>(now.document->scene.frame_rate);
            double rate = choices.frames_per_second > 0 ? std::min(choices.frames_per_second, most) : most;
            (void)number(ui,
                         {.name = "fps",
                          .label = "Frames per second",
                          .what = "Of the video; at most the frame "
                                  "rate of the scene"},
                         rate, {.min = 1, .max = most, .usual = most});
            choices.frames_per_second = rate < most ? rate : 0;
        }
        choose_overlays(ui, choices, overlays);
        muted_text(ui, "Shows the scene as the view does now.");
    }
    if (button(ui, "choose", {.icon = Icon::export_file, .text = "Choose a file …", .primary = true}))
        return ExportAnswer::choose_file;
    return next_button(ui, "cancel", {.text = "Cancel"}) ? ExportAnswer::cancel : ExportAnswer::none;
}

// --- The editor

void Editor::export_dialog(Ui& ui) {
    const ExportAnswer answer = show_export_dialog(ui, export_choices_, session_->now(), overlays_);
    if (answer == ExportAnswer::none) return;
    panel_ = Panel::none;
    if (answer == ExportAnswer::cancel) return;
    // The chosen ending comes first: it is added to a name without one.
    std::vector<std::string> endings;
    for (const ExportFormatLine& line : export_format_lines()) endings.emplace_back(line.ending);
    std::rotate(endings.begin(), endings.begin() + static_cast<std::ptrdiff_t>(export_choices_.format),
                endings.begin() + static_cast<std::ptrdiff_t>(export_choices_.format) + 1);
    const std::string name = "cloth" + endings.front();
    file_dialog_.ask({.title = "Export",
                      .action = "Export",
                      .endings = std::move(endings),
                      .for_writing = true,
                      .start = session_->document()->folder / name,
                      .chosen = [this](const std::filesystem::path& file) {
                          if (auto begun = start_export(file); !begun) session_->say("Export", begun.errors());
                      }});
}

Result<void> Editor::start_export(const std::filesystem::path& file) {
    const ExportChoices& choices = export_choices_;
    const ImageOptions images{
        .width = choices.size[0],
        .height = choices.size[1],
        .frames_per_second = choices.frames_per_second,
        .camera = view_.camera,
        .overlays = choices.overlays ? exported_overlays(overlays_, choices.recorded) : std::vector<std::string>()};
    if (choices.recorded) {
        export_ = std::make_unique<RecordedExport>(
            simulator_, RecordedExportOptions{.file = file,
                                              .frames = choices.frames,
                                              .images = images,
                                              .hidden = {marks_.hidden.begin(), marks_.hidden.end()}});
        return {};
    }
    auto job = SimulatedExport::start(*session_->document(),
                                      {.file = file, .frames = choices.simulated, .images = images, .program = {}});
    if (!job) return job.errors();
    export_ = std::move(*job);
    return {};
}

}  // namespace weft::editor
