#include "editor/ui/theme.h"

#include "editor/ui/typeface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace weft::editor {
namespace {

constexpr float em_at_100 = 15;  // pixels

// Latin, Greek, Cyrillic, punctuation, superscripts, letterlike symbols, arrows and mathematical operators.
constexpr std::array<ImWchar, 19> all_letters = {0x0020, 0x024F, 0x02B0, 0x02FF, 0x0370, 0x052F, 0x1E00,
                                                 0x1EFF, 0x2010, 0x205E, 0x2070, 0x209C, 0x20A0, 0x20BF,
                                                 0x2100, 0x21FF, 0x2200, 0x22FF, 0};
constexpr std::array<ImWchar, 11> few_letters = {0x0020, 0x017F, 0x0391, 0x03C9, 0x2010, 0x2027,
                                                 0x2070, 0x2089, 0x2190, 0x22FF, 0};

/// The em in pixels at which small letters are a whole number of pixels high, so that their edges are sharp.
float sharp_em(float wanted, const TypefaceMetrics& metrics) {
    return std::max(4.0f, std::round(wanted * metrics.x_height)) / metrics.x_height;
}

ImFont* add_font(ImFontAtlas& atlas, TypefaceStyle style, float em, const ImWchar* letters) {
    const std::span<const std::byte> file = typeface(style);
    const TypefaceMetrics metrics = metrics_of(file);
    ImFontConfig config;
    config.FontDataOwnedByAtlas = false;
    config.OversampleH = 1;
    config.OversampleV = 1;
    config.RasterizerMultiply = 1.1f;  // unhinted letters of this size are a little too thin
    config.PixelSnapH = true;          // whole pixels between letters: no blurred stems
    // ImGui takes the height of a line for the size.
    const float size = sharp_em(em, metrics) * metrics.line;
    return atlas.AddFontFromMemoryTTF(const_cast<std::byte*>(file.data()), static_cast<int>(file.size()), size, &config,
                                      letters);
}

struct IconPlace {
    Icon icon;
    int rectangle;
};

std::vector<IconPlace> reserve_icons(ImFontAtlas& atlas, ImFont* font, int side) {
    std::vector<IconPlace> places;
    const float below = std::round((atlas.ConfigData[0].SizePixels - static_cast<float>(side)) / 2);
    for (int i = 1; i < static_cast<int>(Icon::count); ++i) {
        const auto icon = static_cast<Icon>(i);
        places.push_back({icon, atlas.AddCustomRectFontGlyph(font, static_cast<ImWchar>(character_of(icon)), side, side,
                                                             static_cast<float>(side), ImVec2(0, below))});
    }
    return places;
}

void fill_icons(ImFontAtlas& atlas, const std::vector<IconPlace>& places, int side) {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    atlas.GetTexDataAsAlpha8(&pixels, &width, &height);
    for (const IconPlace& place : places) {
        const ImFontAtlasCustomRect& at = *atlas.GetCustomRectByIndex(place.rectangle);
        const std::vector<std::uint8_t> drawn = draw_icon(place.icon, static_cast<std::uint32_t>(side));
        for (int y = 0; y < side; ++y)
            std::copy_n(&drawn[static_cast<std::size_t>(y * side)], side, pixels + (at.Y + y) * width + at.X);
    }
}

// Gives all digits the same width, so that numbers do not jitter while they change.
void align_digits(ImFont* font) {
    float widest = 0;
    for (ImWchar digit = '0'; digit <= '9'; ++digit)
        if (const ImFontGlyph* glyph = font->FindGlyphNoFallback(digit)) widest = std::max(widest, glyph->AdvanceX);
    for (ImFontGlyph& glyph : font->Glyphs) {
        if (glyph.Codepoint < '0' || glyph.Codepoint > '9') continue;
        const float shift = std::floor((widest - glyph.AdvanceX) / 2);
        glyph.X0 += shift;
        glyph.X1 += shift;
        glyph.AdvanceX = widest;
    }
    font->BuildLookupTable();
}

void set_lengths(ImGuiStyle& style, const Theme& theme) {
    const auto px = [&](float length) { return theme.px(length); };
    style = ImGuiStyle();
    style.AntiAliasedLinesUseTex = false;
    style.WindowPadding = ImVec2(px(10), px(8));
    style.FramePadding = ImVec2(px(7), px(4));
    style.ItemSpacing = ImVec2(px(6), px(5));
    style.ItemInnerSpacing = ImVec2(px(6), px(4));
    style.CellPadding = ImVec2(px(4), px(3));
    style.IndentSpacing = px(16);
    style.ScrollbarSize = px(12);
    style.GrabMinSize = px(10);
    style.WindowRounding = 0;
    style.ChildRounding = 0;
    style.PopupRounding = px(5);
    style.FrameRounding = px(4);
    style.ScrollbarRounding = px(6);
    style.GrabRounding = px(3);
    style.TabRounding = px(4);
    style.WindowBorderSize = style.ChildBorderSize = 0;
    style.PopupBorderSize = px(1);
    style.FrameBorderSize = 0;
    style.WindowMinSize = ImVec2(px(16), px(16));
    style.MouseCursorScale = 1;
    style.DisplaySafeAreaPadding = ImVec2(0, 0);
}

void set_colors(ImGuiStyle& style, const Palette& colors) {
    const auto set = [&](std::initializer_list<ImGuiCol> which, ImVec4 color) {
        for (const ImGuiCol one : which) style.Colors[one] = color;
    };
    set({ImGuiCol_Text}, colors.text);
    set({ImGuiCol_TextDisabled}, colors.muted);
    set({ImGuiCol_WindowBg}, colors.panel);
    set({ImGuiCol_ChildBg, ImGuiCol_BorderShadow, ImGuiCol_ScrollbarBg, ImGuiCol_TableRowBg}, ImVec4(0, 0, 0, 0));
    set({ImGuiCol_PopupBg}, colors.popup);
    set({ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_TableBorderLight, ImGuiCol_TableBorderStrong}, colors.border);
    set({ImGuiCol_FrameBg, ImGuiCol_Button}, colors.field);
    set({ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered}, colors.field_hovered);
    set({ImGuiCol_FrameBgActive, ImGuiCol_ButtonActive, ImGuiCol_HeaderActive}, colors.field_active);
    set({ImGuiCol_Header}, between(colors.panel, colors.fill, 0.75f));
    set({ImGuiCol_TitleBg, ImGuiCol_TitleBgActive, ImGuiCol_TitleBgCollapsed, ImGuiCol_MenuBarBg, ImGuiCol_Tab,
         ImGuiCol_TableHeaderBg},
        colors.header);
    set({ImGuiCol_TabHovered}, colors.field_hovered);
    set({ImGuiCol_TabActive}, colors.field_active);
    set({ImGuiCol_ScrollbarGrab}, colors.field_active);
    set({ImGuiCol_ScrollbarGrabHovered, ImGuiCol_ScrollbarGrabActive}, colors.line);
    set({ImGuiCol_CheckMark, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive, ImGuiCol_SeparatorHovered,
         ImGuiCol_SeparatorActive, ImGuiCol_PlotLines, ImGuiCol_PlotHistogram, ImGuiCol_DragDropTarget},
        colors.accent_text);
    set({ImGuiCol_NavHighlight}, colors.focus);
    set({ImGuiCol_TextSelectedBg}, colors.fill);
    set({ImGuiCol_ModalWindowDimBg, ImGuiCol_NavWindowingDimBg}, ImVec4(0, 0, 0, 0.45f));
    set({ImGuiCol_ResizeGrip, ImGuiCol_ResizeGripHovered, ImGuiCol_ResizeGripActive}, ImVec4(0, 0, 0, 0));
    style.DisabledAlpha = 0.5f;
}

}  // namespace

float Theme::px(float length) const {
    return std::max(1.0f, std::round(length * scale));
}

Theme make_theme(ImGuiContext& context, Appearance appearance, float scale) {
    Theme theme;
    theme.appearance = appearance;
    theme.scale = std::clamp(scale, least_scale, most_scale);
    theme.colors = palette(appearance);
    ImGuiIO& io = context.IO;
    ImFontAtlas& atlas = *io.Fonts;
    atlas.Clear();
    atlas.Flags |= ImFontAtlasFlags_NoBakedLines;  // these would need a sampler that interpolates
    atlas.TexGlyphPadding = 1;
    const float em = em_at_100 * theme.scale;
    const int side = static_cast<int>(std::round(1.2f * em));
    theme.icon_side = static_cast<float>(side);
    theme.body = add_font(atlas, TypefaceStyle::regular, em, all_letters.data());
    theme.strong = add_font(atlas, TypefaceStyle::strong, em, few_letters.data());
    theme.small = add_font(atlas, TypefaceStyle::regular, 0.87f * em, few_letters.data());
    const std::vector<IconPlace> places = reserve_icons(atlas, theme.body, side);
    atlas.Build();
    fill_icons(atlas, places, side);
    for (ImFont* font : {theme.body, theme.strong, theme.small}) {
        align_digits(font);
        font->FontSize = std::round(font->FontSize);  // lines on whole pixels; the letters keep their size
    }
    io.FontDefault = theme.body;
    set_lengths(context.Style, theme);
    set_colors(context.Style, theme.colors);
    return theme;
}

}  // namespace weft::editor
