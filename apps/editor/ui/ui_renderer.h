// Draws the lists of Dear ImGui with a pipeline of our own, into a window or into an image in memory.
//
// ImGui's colors are sRGB-encoded, and it expects them to be blended as they are: its edges of text are made for that.
// So windows should have images that do not encode sRGB (SwapchainOptions::plain). Others work too; there, colors are
// blended in linear light and light text on dark ground looks bolder.
#pragma once

#include "base/image.h"
#include "editor/ui/dear_imgui.h"
#include "gpu/device.h"
#include "render/renderer.h"

#include <cstdint>
#include <memory>

namespace weft::editor {

/// An image that ImGui can show. 0 is none.
enum class UiImage : std::uint32_t { none };

ImTextureID texture_id(UiImage image);

class UiRenderer {
  public:
    /// Fails if the device's queue does not support drawing.
    static Result<UiRenderer> create(std::shared_ptr<gpu::Device> device);
    UiRenderer(UiRenderer&&) noexcept;
    UiRenderer& operator=(UiRenderer&&) noexcept;
    /// Waits until the device uses nothing of it.
    ~UiRenderer();

    const std::shared_ptr<gpu::Device>& device() const;

    /// Uploads the atlas and sets its texture. Call it again whenever the atlas is new.
    Result<void> set_fonts(ImFontAtlas& atlas);

    /// A transparent image until the first update.
    UiImage add_image();
    /// Replaces the content; the next frame shows it. An image of another size waits for the frames in flight.
    Result<void> update(UiImage image, const Image8& content);
    void remove(UiImage image);
    /// Changes whenever an image or the fonts change.
    std::uint64_t version() const;

    /// Records and submits a frame over `background` (sRGB-encoded). Returns the value that the device's timeline
    /// reaches when it is done. Waits for the frame before the last one.
    Result<std::uint64_t> draw(const ImDrawData& data, const render::Target& target, ImVec4 background,
                               gpu::BinarySemaphores window = {});
    /// Draws, waits and reads back.
    Result<Image8> picture(const ImDrawData& data, ImVec4 background);

  private:
    struct Impl;
    explicit UiRenderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace weft::editor
