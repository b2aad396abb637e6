#include "editor/ui/ui_renderer.h"

#include "gpu/commands.h"
#include "gpu/graphics_pipeline.h"
#include "gpu/render_pass.h"
#include "render/frame_slot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <string_view>
#include <utility>
#include <vector>

namespace weft::editor {
namespace {

#include "ui_shader_table.inc"

// Same layout as in ui.vert.
struct UiPush {
    std::uint64_t vertices = 0;
    float scale[2]{}, offset[2]{};
};
static_assert(sizeof(ImDrawVert) == 20, "ui.vert reads ImGui's own layout");

constexpr UiImage font_image{1};

const gpu::Shader& shader_named(std::string_view name) {
    return *std::ranges::find(ui_shader_table, name, &gpu::Shader::name);
}

bool encodes(VkFormat format) {
    return format == VK_FORMAT_R8G8B8A8_SRGB || format == VK_FORMAT_B8G8R8A8_SRGB ||
           format == VK_FORMAT_A8B8G8R8_SRGB_PACK32;
}

float decoded(float c) {
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

/// A pass and its pipelines, by format and final layout of the target.
struct Way {
    VkFormat format{};
    VkImageLayout after{};
    gpu::RenderPass pass;
    std::array<gpu::GraphicsPipeline, 5> pipelines;  // by Fill
};

/// How pixels get their color. A software device takes half the time for large areas without texture and blending.
enum class Fill : std::uint8_t {
    image,
    opaque_image,
    coverage,  // letters, and everything small
    solid,
    opaque_solid,
};

/// Triangles that are drawn by one command.
struct Piece {
    Fill fill{};
    UiImage image{};
    VkRect2D clip{};
    std::uint32_t first = 0, count = 0;  // indices
};

struct Texture {
    gpu::Image image;
    gpu::DescriptorSet set;
    std::array<gpu::Buffer, 2> staging;  // by slot
    bool fresh = false;                  // the staging buffer of the next slot has new content
    bool shown = false;                  // has content
    bool opaque = false;
};

/// Pixels of a clip rectangle within the target.
VkRect2D pixels_of(const ImVec4& clip, ImVec2 origin, VkExtent2D extent) {
    const auto clamped = [](float value, std::uint32_t most) {
        return static_cast<std::int32_t>(std::clamp(std::round(value), 0.0f, static_cast<float>(most)));
    };
    const std::int32_t x0 = clamped(clip.x - origin.x, extent.width), x1 = clamped(clip.z - origin.x, extent.width),
                       y0 = clamped(clip.y - origin.y, extent.height), y1 = clamped(clip.w - origin.y, extent.height);
    return {{x0, y0},
            {static_cast<std::uint32_t>(std::max(0, x1 - x0)), static_cast<std::uint32_t>(std::max(0, y1 - y0))}};
}

}  // namespace

ImTextureID texture_id(UiImage image) {
    return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(image));
}

struct UiRenderer::Impl {
    std::shared_ptr<gpu::Device> device;
    gpu::Sampler smooth, exact;
    std::vector<std::unique_ptr<Way>> ways;
    std::map<UiImage, Texture> textures;
    std::uint32_t last_image = static_cast<std::uint32_t>(font_image);
    std::array<render::FrameSlot, 2> slots;
    std::uint32_t next_slot = 0;
    std::uint64_t version = 0;
    std::vector<ImDrawVert> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<Piece> pieces;
    ImVec2 white;    // the place in the atlas whose coverage is 1
    gpu::Image own;  // of picture()
    gpu::Buffer read_back;

    ~Impl() { (void)wait_for_all(); }

    Result<void> wait_for_all() { return device->submitted() > 0 ? device->wait(device->submitted()) : Result<void>(); }
    Result<void> wait_for_slot() {
        const std::uint64_t before = slots[next_slot].submitted;
        return before > 0 ? device->wait(before) : Result<void>();
    }
    Result<Way*> way_to(VkFormat format, VkImageLayout after);
    Result<void> put(UiImage id, VkFormat format, std::uint32_t width, std::uint32_t height,
                     std::span<const std::uint8_t> bytes);
    void gather(const ImDrawData& data, VkExtent2D extent);
    Fill fill_of(UiImage id, const Texture& texture, const std::uint32_t (&corners)[3]) const;
    void add_triangle(const std::uint32_t (&corners)[3], Fill fill, UiImage id, const VkRect2D& clip);
    void record_uploads(gpu::Commands& commands);
    void record_lists(gpu::Commands& commands, const ImDrawData& data, const Way& way, VkExtent2D extent,
                      std::uint64_t vertices_at, std::uint64_t indices_at);
    Result<std::uint64_t> draw(const ImDrawData& data, const render::Target& target, ImVec4 background,
                               gpu::BinarySemaphores window);
};

Result<Way*> UiRenderer::Impl::way_to(VkFormat format, VkImageLayout after) {
    for (const auto& one : ways)
        if (one->format == format && one->after == after) return one.get();
    auto way = std::make_unique<Way>();
    way->format = format;
    way->after = after;
    const gpu::Attachment attachment{.format = format, .after = after};
    auto pass = gpu::RenderPass::create(*device, {&attachment, 1}, "user interface");
    if (!pass) return pass.errors();
    way->pass = std::move(*pass);
    for (const Fill fill : {Fill::image, Fill::opaque_image, Fill::coverage, Fill::solid, Fill::opaque_solid}) {
        const bool opaque = fill == Fill::opaque_image || fill == Fill::opaque_solid;
        const bool solid = fill == Fill::solid || fill == Fill::opaque_solid;
        const std::uint32_t constants[] = {encodes(format), fill == Fill::coverage};
        auto made = gpu::GraphicsPipeline::create(
            *device, way->pass,
            {shader_named(solid ? "ui_solid_vert" : "ui_vert"), shader_named(solid ? "ui_solid_frag" : "ui_frag")},
            {.blend = opaque ? gpu::Blend::none : gpu::Blend::over}, constants);
        if (!made) return made.errors();
        way->pipelines[static_cast<std::size_t>(fill)] = std::move(*made);
    }
    ways.push_back(std::move(way));
    return ways.back().get();
}

// Writes the content to the staging buffer of the next frame, which copies it. Makes the image again if its size is
// new.
Result<void> UiRenderer::Impl::put(UiImage id, VkFormat format, std::uint32_t width, std::uint32_t height,
                                   std::span<const std::uint8_t> bytes) {
    Texture& texture = textures[id];
    const gpu::ImageDesc& old = texture.image.desc();
    if (!texture.image || old.width != width || old.height != height) {
        if (auto idle = wait_for_all(); !idle) return idle;
        texture = {};
        auto way = ways.empty() ? way_to(VK_FORMAT_R8G8B8A8_UNORM, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL)
                                : Result<Way*>(ways.front().get());
        if (!way) return way.errors();
        auto image = gpu::Image::create(*device,
                                        {.width = width,
                                         .height = height,
                                         .format = format,
                                         .usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT},
                                        "user interface");
        if (!image) return image.errors();
        // Letters lie on whole pixels, and a software device takes less time for one texel than for four.
        const gpu::BoundImage bound{0, image->view(), (id == font_image ? exact : smooth).handle()};
        auto set = gpu::DescriptorSet::create(*device, (*way)->pipelines.front().set_layout(0), {&bound, 1});
        if (!set) return set.errors();
        texture.image = std::move(*image);
        texture.set = std::move(*set);
    }
    gpu::Buffer& staging = texture.staging[next_slot];
    if (auto done = wait_for_slot(); !done) return done;
    if (!staging) {
        auto made = device->memory().buffer(bytes.size(), gpu::MemoryKind::upload, "upload of the user interface");
        if (!made) return made.errors();
        staging = std::move(*made);
    }
    std::memcpy(staging.mapped().data(), bytes.data(), bytes.size());
    texture.fresh = true;
    ++version;
    return {};
}

// One vertex array and one array of 32-bit indices for all lists, divided into pieces.
void UiRenderer::Impl::gather(const ImDrawData& data, VkExtent2D extent) {
    vertices.clear();
    indices.clear();
    pieces.clear();
    vertices.reserve(static_cast<std::size_t>(data.TotalVtxCount));
    indices.reserve(static_cast<std::size_t>(data.TotalIdxCount));
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        const auto base = static_cast<std::uint32_t>(vertices.size());
        vertices.insert(vertices.end(), list.VtxBuffer.begin(), list.VtxBuffer.end());
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.UserCallback || command.ElemCount == 0) continue;
            const VkRect2D clip = pixels_of(command.ClipRect, data.DisplayPos, extent);
            const auto id = static_cast<UiImage>(reinterpret_cast<std::uintptr_t>(command.GetTexID()));
            const auto texture = textures.find(id);
            if (clip.extent.width == 0 || clip.extent.height == 0) continue;
            if (texture == textures.end() || !(texture->second.shown || texture->second.fresh)) continue;
            const ImDrawIdx* from = list.IdxBuffer.Data + command.IdxOffset;
            for (unsigned k = 0; k + 2 < command.ElemCount; k += 3) {
                const std::uint32_t first = base + command.VtxOffset;
                const std::uint32_t corners[] = {first + from[k], first + from[k + 1], first + from[k + 2]};
                add_triangle(corners, fill_of(id, texture->second, corners), id, clip);
            }
        }
    }
}

Fill UiRenderer::Impl::fill_of(UiImage id, const Texture& texture, const std::uint32_t (&corners)[3]) const {
    const ImDrawVert &a = vertices[corners[0]], &b = vertices[corners[1]], &c = vertices[corners[2]];
    const bool opaque = (a.col & b.col & c.col) >> IM_COL32_A_SHIFT == 255;
    if (id != font_image) return opaque && texture.opaque ? Fill::opaque_image : Fill::image;
    // Changing the pipeline takes as long as some thousand pixels.
    constexpr float large = 4000;
    const auto is_white = [&](const ImDrawVert& v) { return v.uv.x == white.x && v.uv.y == white.y; };
    const float area =
        std::abs((b.pos.x - a.pos.x) * (c.pos.y - a.pos.y) - (c.pos.x - a.pos.x) * (b.pos.y - a.pos.y)) / 2;
    if (area < large || !is_white(a) || !is_white(b) || !is_white(c)) return Fill::coverage;
    return opaque ? Fill::opaque_solid : Fill::solid;
}

void UiRenderer::Impl::add_triangle(const std::uint32_t (&corners)[3], Fill fill, UiImage id, const VkRect2D& clip) {
    const auto same = [&](const Piece& last) {
        return last.fill == fill && last.image == id && last.clip.offset.x == clip.offset.x &&
               last.clip.offset.y == clip.offset.y && last.clip.extent.width == clip.extent.width &&
               last.clip.extent.height == clip.extent.height;
    };
    if (pieces.empty() || !same(pieces.back()))
        pieces.push_back({fill, id, clip, static_cast<std::uint32_t>(indices.size()), 0});
    indices.insert(indices.end(), corners, corners + 3);
    pieces.back().count += 3;
}

void UiRenderer::Impl::record_uploads(gpu::Commands& commands) {
    commands.drawing_barrier();
    for (auto& [id, texture] : textures) {
        if (!texture.fresh) continue;
        commands.transition(texture.image,
                            texture.shown ? VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL : VK_IMAGE_LAYOUT_UNDEFINED,
                            VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        commands.copy_to_image(texture.staging[next_slot], 0, texture.image);
        commands.transition(texture.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                            VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
        texture.fresh = false;
        texture.shown = true;
    }
}

void UiRenderer::Impl::record_lists(gpu::Commands& commands, const ImDrawData& data, const Way& way, VkExtent2D extent,
                                    std::uint64_t vertices_at, std::uint64_t indices_at) {
    UiPush push;
    push.vertices = vertices_at;
    push.scale[0] = 2 / static_cast<float>(extent.width);
    push.scale[1] = 2 / static_cast<float>(extent.height);
    push.offset[0] = -1 - data.DisplayPos.x * push.scale[0];
    push.offset[1] = -1 - data.DisplayPos.y * push.scale[1];
    const gpu::GraphicsPipeline* bound = nullptr;
    UiImage shown = UiImage::none;
    for (const Piece& piece : pieces) {
        const gpu::GraphicsPipeline& pipeline = way.pipelines[static_cast<std::size_t>(piece.fill)];
        if (bound != &pipeline) {
            commands.bind(pipeline);
            commands.push(std::as_bytes(std::span(&push, 1)));
            shown = UiImage::none;
        }
        bound = &pipeline;
        const bool textured = piece.fill != Fill::solid && piece.fill != Fill::opaque_solid;
        if (textured && std::exchange(shown, piece.image) != piece.image)
            commands.bind(0, textures.at(piece.image).set);
        commands.scissor(piece.clip);
        gpu::BufferRange range = slots[next_slot].range(indices_at);
        range.offset += piece.first * sizeof(std::uint32_t);
        commands.draw_indexed(range, piece.count);
    }
}

Result<std::uint64_t> UiRenderer::Impl::draw(const ImDrawData& data, const render::Target& target, ImVec4 background,
                                             gpu::BinarySemaphores window) {
    auto way = way_to(target.format, target.after);
    if (!way) return way.errors();
    if (auto done = wait_for_slot(); !done) return done.errors();
    render::FrameSlot& slot = slots[next_slot];
    auto frame = gpu::Framebuffer::create(*device, (*way)->pass, {&target.view, 1}, target.width, target.height);
    if (!frame) return frame.errors();
    slot.target = std::move(*frame);
    gather(data, {target.width, target.height});
    const std::uint64_t bytes = render::FrameSlot::room_for(vertices.size() * sizeof(ImDrawVert)) +
                                render::FrameSlot::room_for(indices.size() * sizeof(std::uint32_t)) + 64;
    if (auto begun = slot.begin(*device, bytes, VK_BUFFER_USAGE_INDEX_BUFFER_BIT); !begun) return begun.errors();
    const std::uint64_t vertices_at = slot.put(std::span<const ImDrawVert>(vertices)),
                        indices_at = slot.put(std::span<const std::uint32_t>(indices));
    gpu::Commands& commands = *slot.commands;
    record_uploads(commands);
    VkClearValue clear{};
    const float colors[] = {background.x, background.y, background.z};
    for (int i = 0; i < 3; ++i) clear.color.float32[i] = encodes(target.format) ? decoded(colors[i]) : colors[i];
    clear.color.float32[3] = 1;
    commands.begin_pass((*way)->pass, slot.target, {&clear, 1});
    record_lists(commands, data, **way, {target.width, target.height}, vertices_at, indices_at);
    commands.end_pass();
    if (auto ended = commands.end(); !ended) return ended.errors();
    auto submitted = commands.submit({}, window);
    if (!submitted) return submitted;
    slot.submitted = *submitted;
    next_slot = 1 - next_slot;
    return submitted;
}

// --- Public functions

UiRenderer::UiRenderer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
UiRenderer::UiRenderer(UiRenderer&&) noexcept = default;
UiRenderer& UiRenderer::operator=(UiRenderer&&) noexcept = default;
UiRenderer::~UiRenderer() = default;

Result<UiRenderer> UiRenderer::create(std::shared_ptr<gpu::Device> device) {
    if (!device->draws()) return Error::of_machine(device->info().name, "has no graphics queue; choose another device");
    auto impl = std::make_unique<Impl>();
    impl->device = std::move(device);
    for (const VkFilter filter : {VK_FILTER_LINEAR, VK_FILTER_NEAREST}) {
        auto sampler = gpu::Sampler::create(*impl->device, {.filter = filter,
                                                            .address_u = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE,
                                                            .address_v = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE});
        if (!sampler) return sampler.errors();
        (filter == VK_FILTER_LINEAR ? impl->smooth : impl->exact) = std::move(*sampler);
    }
    return UiRenderer(std::move(impl));
}

const std::shared_ptr<gpu::Device>& UiRenderer::device() const {
    return impl_->device;
}

Result<void> UiRenderer::set_fonts(ImFontAtlas& atlas) {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    atlas.GetTexDataAsAlpha8(&pixels, &width, &height);
    atlas.SetTexID(texture_id(font_image));
    impl_->white = atlas.TexUvWhitePixel;
    const auto bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return impl_->put(font_image, VK_FORMAT_R8_UNORM, static_cast<std::uint32_t>(width),
                      static_cast<std::uint32_t>(height), {pixels, bytes});
}

UiImage UiRenderer::add_image() {
    const UiImage id{++impl_->last_image};
    impl_->textures.try_emplace(id);
    return id;
}

Result<void> UiRenderer::update(UiImage image, const Image8& content) {
    if (!impl_->textures.contains(image) || content.width == 0 || content.height == 0) return {};
    auto done = impl_->put(image, VK_FORMAT_R8G8B8A8_UNORM, content.width, content.height, content.rgba);
    if (!done) return done;
    bool opaque = true;
    for (std::size_t i = 3; i < content.rgba.size(); i += 4) opaque &= content.rgba[i] == 255;
    impl_->textures[image].opaque = opaque;
    return done;
}

std::uint64_t UiRenderer::version() const {
    return impl_->version;
}

void UiRenderer::remove(UiImage image) {
    (void)impl_->wait_for_all();
    impl_->textures.erase(image);
}

Result<std::uint64_t> UiRenderer::draw(const ImDrawData& data, const render::Target& target, ImVec4 background,
                                       gpu::BinarySemaphores window) {
    return impl_->draw(data, target, background, window);
}

Result<Image8> UiRenderer::picture(const ImDrawData& data, ImVec4 background) {
    Impl& self = *impl_;
    const auto width = static_cast<std::uint32_t>(data.DisplaySize.x),
               height = static_cast<std::uint32_t>(data.DisplaySize.y);
    if (width == 0 || height == 0) return Error{"user interface", "an image needs a size"};
    const std::uint64_t bytes = std::uint64_t{width} * height * 4;
    if (!self.own || self.own.desc().width != width || self.own.desc().height != height) {
        if (auto idle = self.wait_for_all(); !idle) return idle.errors();
        auto image =
            gpu::Image::create(*self.device,
                               {.width = width,
                                .height = height,
                                .format = VK_FORMAT_R8G8B8A8_UNORM,
                                .usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT},
                               "picture of the user interface");
        if (!image) return image.errors();
        auto buffer = self.device->memory().buffer(bytes, gpu::MemoryKind::readback, "picture of the user interface");
        if (!buffer) return buffer.errors();
        self.own = std::move(*image);
        self.read_back = std::move(*buffer);
    }
    const render::Target target{.view = self.own.view(),
                                .format = self.own.desc().format,
                                .width = width,
                                .height = height,
                                .after = VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    const auto drawn = self.draw(data, target, background, {});
    if (!drawn) return drawn.errors();
    const auto copied = gpu::run_once(*self.device, [&](gpu::Commands& commands) {
        commands.copy_from_image(self.own, self.read_back);
        commands.host_barrier();
    });
    if (!copied) return copied.errors();
    const auto mapped = self.read_back.as<std::uint8_t>();
    return Image8{width, height, {mapped.begin(), mapped.begin() + static_cast<std::ptrdiff_t>(bytes)}};
}

}  // namespace weft::editor
