// Records a frame.
#include "render/renderer_impl.h"

#include <algorithm>
#include <map>

namespace weft::render {
namespace {

constexpr VkClearValue clear_depth{.depthStencil = {1, 0}};

// Same layout as in shaders (frame.data.h).
struct Push {
    std::uint64_t items = 0, unused = 0;
    glm::vec4 numbers{0};
};
constexpr std::uint32_t uniform_set = 2;
struct BoundsPush {
    std::uint64_t object = 0, bounds = 0;
    std::uint32_t count = 0, unused = 0;
};
struct SunPush {
    std::uint64_t frame = 0, bounds = 0, light = 0;
    float texels = 0, unused = 0;
};

std::vector<shading::LineData> line_data(std::span<const Line> lines) {
    std::vector<shading::LineData> data;
    data.reserve(lines.size());
    for (const Line& line : lines) {
        data.push_back({{line.from.x, line.from.y, line.from.z, line.width},
                        {line.to.x, line.to.y, line.to.z, 0},
                        {line.color.x, line.color.y, line.color.z, line.color.w}});
    }
    return data;
}

}  // namespace

Placed Renderer::Impl::place(FrameSlot& slot, const Drawing& drawing) {
    Placed placed;
    FrameShape shape{targets.width, targets.height, {0, 0}, 0, has_environment};
    for (std::uint32_t pass = 0; pass <= repeats; ++pass) {
        shape.number = pass;
        shape.jitter = pass < repeats ? jitter_of(pass, repeats) : glm::vec2(0);
        placed.frames.push_back(slot.put_uniform(frame_data(drawing, surroundings, shape)));
    }
    std::map<MaterialId, std::uint32_t> placed_materials;
    const auto material = [&](MaterialId id) {
        const auto [entry, is_new] = placed_materials.try_emplace(id);
        if (is_new) entry->second = slot.put_uniform(materials.data(id));
        return entry->second;
    };
    for (const Object& object : drawing.objects)
        placed.objects.push_back({slot.put_uniform(object_data(object)), material(object.material)});
    for (const Ground& ground : drawing.grounds)
        placed.grounds.push_back({slot.put_uniform(ground_data(ground, drawing.camera)), material(ground.material)});
    placed.lines = slot.put(std::span<const shading::LineData>(line_data(drawing.lines)));
    placed.lines_on_top = slot.put(std::span<const shading::LineData>(line_data(drawing.lines_on_top)));
    std::vector<shading::PointData> points;
    for (const Point& p : drawing.points) {
        points.push_back(
            {{p.position.x, p.position.y, p.position.z, p.size}, {p.color.x, p.color.y, p.color.z, p.color.w}});
    }
    placed.points = slot.put(std::span<const shading::PointData>(points));
    std::vector<shading::FlatData> corners;
    for (const FlatVertex& v : drawing.flat)
        corners.push_back({{v.x, v.y, 0, 0}, {v.color.x, v.color.y, v.color.z, v.color.w}});
    placed.flat = slot.put(std::span<const shading::FlatData>(corners));
    return placed;
}

Result<void> Renderer::Impl::bind_uniforms(FrameSlot& slot) {
    const VkBuffer buffer = slot.buffer().handle();
    const gpu::BoundUniform uniforms[] = {{0, buffer, sizeof(shading::FrameData)},
                                          {1, buffer, sizeof(shading::ObjectData)},
                                          {2, buffer, sizeof(shading::MaterialData)},
                                          {3, light.handle(), sizeof(shading::LightData)}};
    return take(gpu::DescriptorSet::create(*device, pipelines.lit[0].set_layout(uniform_set), {}, uniforms),
                slot.uniforms);
}

void Renderer::Impl::push(gpu::Commands& commands, std::uint32_t frame, Uniforms of) {
    const std::uint32_t offsets[] = {frame, of.object, of.material, 0};
    commands.bind(uniform_set, slots[next_slot].uniforms, offsets);
}

void Renderer::Impl::push(gpu::Commands& commands, std::uint32_t frame, std::uint64_t items, glm::vec4 numbers) {
    push(commands, frame);
    const Push values{items, 0, numbers};
    commands.push(std::as_bytes(std::span(&values, 1)));
}

void Renderer::Impl::draw_surface(gpu::Commands& commands, const Object& object) {
    commands.draw_indexed(object.surface.triangles, 3 * object.surface.triangle_count);
}

// The bounds of all shadow casters are computed on the device, because the host may not have the positions.
void Renderer::Impl::record_sun(gpu::Commands& commands, const Drawing& drawing, const Placed& placed) {
    const std::uint64_t uniforms = slots[next_slot].buffer().address();
    commands.drawing_barrier();
    commands.fill(bounds, 0xffffffffu, 12, 0);
    commands.fill(bounds, 0, 12, 12);
    commands.barrier();
    commands.bind(*pipelines.bounds);
    for (std::size_t i = 0; i < drawing.objects.size(); ++i) {
        const Object& object = drawing.objects[i];
        if (!object.casts_shadow || object.surface.vertex_count == 0) continue;
        const BoundsPush values{uniforms + placed.objects[i].object, bounds.address(), object.surface.vertex_count};
        commands.push(std::as_bytes(std::span(&values, 1)).first(20));
        commands.dispatch(std::min(64u, (object.surface.vertex_count + 63) / 64));
    }
    commands.barrier();
    commands.bind(*pipelines.sun);
    const SunPush values{uniforms + placed.frames[0], bounds.address(), light.address(),
                         static_cast<float>(shadow_side)};
    commands.push(std::as_bytes(std::span(&values, 1)).first(28));
    commands.dispatch(1);
    commands.drawing_barrier();
}

void Renderer::Impl::record_shadow(gpu::Commands& commands, const Drawing& drawing, const Placed& placed) {
    commands.begin_pass(passes.shadow, shadow_frame, {&clear_depth, 1});
    for (std::size_t i = 0; i < drawing.objects.size() && drawing.lighting.sun.intensity > 0; ++i) {
        const Object& object = drawing.objects[i];
        if (!object.casts_shadow || object.surface.triangle_count == 0) continue;
        commands.bind(is_sheer(object) ? pipelines.shadow_sheer : pipelines.shadow);
        push(commands, placed.frames[0], placed.objects[i]);
        draw_surface(commands, object);
    }
    commands.end_pass();
}

void Renderer::Impl::record_occlusion(gpu::Commands& commands, const Drawing& drawing, const Placed& placed,
                                      std::size_t pass) {
    const bool wanted = !draft && drawing.lighting.ambient_occlusion > 0;
    commands.begin_pass(passes.depth, targets.depth_frame, {&clear_depth, 1});
    if (wanted) {
        commands.bind(pipelines.depth);
        for (std::size_t i = 0; i < drawing.objects.size(); ++i) {
            if (is_sheer(drawing.objects[i]) || drawing.objects[i].surface.triangle_count == 0) continue;
            push(commands, placed.frames[pass], placed.objects[i]);
            draw_surface(commands, drawing.objects[i]);
        }
        commands.bind(pipelines.ground_depth);
        for (const Uniforms& ground : placed.grounds) {
            push(commands, placed.frames[pass], ground);
            commands.draw(6);
        }
    }
    commands.end_pass();
    const auto full = [&](const gpu::Framebuffer& into, const gpu::GraphicsPipeline& pipeline,
                          const gpu::DescriptorSet& images) {
        commands.begin_pass(passes.occlusion, into, {&clear_nothing, 1});
        if (wanted) {
            commands.bind(pipeline);
            commands.bind(0, images);
            push(commands, placed.frames[pass]);
            commands.draw(3);
        }
        commands.end_pass();
    };
    full(targets.occlusion_frame, pipelines.occlusion, depth_set);
    full(targets.smooth_frame, pipelines.occlusion_smooth, occlusion_set);
}

void Renderer::Impl::record_lit(gpu::Commands& commands, const Drawing& drawing, const Placed& placed,
                                std::size_t pass) {
    const std::uint32_t frame = placed.frames[pass];
    const VkClearValue clear[] = {clear_nothing, clear_depth};
    commands.begin_pass(passes.lit, targets.lit_frame, clear);
    if (drawing.background == Background::sky) {
        commands.bind(pipelines.background);
        commands.bind(0, background_set);
        push(commands, frame);
        commands.draw(3);
    }
    const auto surfaces = [&](const gpu::GraphicsPipeline& pipeline) {
        commands.bind(pipeline);
        commands.bind(0, scene_set);
        for (std::size_t i = 0; i < drawing.objects.size(); ++i) {
            const Object& object = drawing.objects[i];
            if (is_sheer(object) || object.surface.triangle_count == 0) continue;
            commands.bind(1, materials.images(object.material));
            push(commands, frame, placed.objects[i]);
            draw_surface(commands, object);
        }
    };
    if (drawing.two_passes) {
        surfaces(pipelines.lit[1]);
        surfaces(pipelines.lit[2]);
    } else {
        surfaces(pipelines.lit[0]);
    }
    commands.bind(pipelines.ground);
    commands.bind(0, scene_set);
    for (std::size_t i = 0; i < drawing.grounds.size(); ++i) {
        commands.bind(1, materials.images(drawing.grounds[i].material));
        push(commands, frame, placed.grounds[i]);
        commands.draw(6);
    }
    if (draft) draw_sheer(commands, drawing, placed, pass);
    if (!drawing.lines.empty()) {
        constexpr float nearer = 2e-5f;  // of the depth range: about a tenth of a millimeter
        commands.bind(pipelines.line);
        push(commands, frame, placed.lines, {nearer, 0, 0, 0});
        commands.draw(6 * static_cast<std::uint32_t>(drawing.lines.size()));
    }
    commands.end_pass();
}

void Renderer::Impl::draw_sheer(gpu::Commands& commands, const Drawing& drawing, const Placed& placed,
                                std::size_t pass) {
    const auto surfaces = [&](const gpu::GraphicsPipeline& pipeline) {
        commands.bind(pipeline);
        commands.bind(0, scene_set);
        for (std::size_t i = 0; i < drawing.objects.size(); ++i) {
            const Object& object = drawing.objects[i];
            if (!is_sheer(object) || object.surface.triangle_count == 0) continue;
            commands.bind(1, materials.images(object.material));
            push(commands, placed.frames[pass], placed.objects[i]);
            draw_surface(commands, object);
        }
    };
    if (drawing.two_passes) {
        surfaces(pipelines.sheer[1]);
        surfaces(pipelines.sheer[2]);
    } else {
        surfaces(pipelines.sheer[0]);
    }
}

void Renderer::Impl::record_sheer(gpu::Commands& commands, const Drawing& drawing, const Placed& placed,
                                  std::size_t pass) {
    const VkClearValue clear[] = {clear_nothing, clear_nothing, clear_depth};
    commands.begin_pass(passes.sheer, targets.sheer.frame, clear);
    draw_sheer(commands, drawing, placed, pass);
    commands.end_pass();
}

void Renderer::Impl::record_resolve(gpu::Commands& commands, const Placed& placed, std::size_t pass, bool sheer) {
    commands.begin_pass(pass == 0 ? passes.first : passes.further, targets.display_frame, {&clear_nothing, 1});
    commands.bind(sheer ? pipelines.resolve_sheer : pipelines.resolve);
    commands.bind(0, sheer ? sheer_set : resolve_set);
    push(commands, placed.frames[pass], 0, {1 / static_cast<float>(repeats), 0, 0, 0});
    commands.draw(3);
    commands.end_pass();
}

void Renderer::Impl::record_top(gpu::Commands& commands, const Drawing& drawing, const Placed& placed) {
    if (drawing.lines_on_top.empty() && drawing.points.empty() && drawing.flat.empty()) return;
    commands.begin_pass(passes.top, targets.display_frame, {&clear_nothing, 1});
    const auto add = [&](const gpu::GraphicsPipeline& pipeline, std::uint64_t data, std::size_t vertices) {
        if (vertices == 0) return;
        commands.bind(pipeline);
        push(commands, placed.frames.back(), data, glm::vec4(0));
        commands.draw(static_cast<std::uint32_t>(vertices));
    };
    add(pipelines.line_on_top, placed.lines_on_top, 6 * drawing.lines_on_top.size());
    add(pipelines.point, placed.points, 6 * drawing.points.size());
    add(pipelines.flat, placed.flat, drawing.flat.size());
    commands.end_pass();
}

void Renderer::Impl::record(gpu::Commands& commands, const Drawing& drawing, const Placed& placed, bool sheer) {
    record_sun(commands, drawing, placed);
    record_shadow(commands, drawing, placed);
    for (std::size_t pass = 0; pass < repeats; ++pass) {
        // A draft has no occlusion, but images that shaders name must have been written once.
        if (!draft || !targets.cleared) record_occlusion(commands, drawing, placed, pass);
        targets.cleared = true;
        record_lit(commands, drawing, placed, pass);
        if (draft) continue;
        if (sheer) record_sheer(commands, drawing, placed, pass);
        record_resolve(commands, placed, pass, sheer);
    }
    record_top(commands, drawing, placed);
}

Result<void> Renderer::Impl::record_target(gpu::Commands& commands, FrameSlot& slot, const Target& target,
                                           const Presenting& onto, const Placed& placed) {
    auto frame = gpu::Framebuffer::create(*device, onto.pass, {&target.view, 1}, target.width, target.height);
    if (auto made = take(std::move(frame), slot.target); !made) return made;
    commands.begin_pass(onto.pass, slot.target, {&clear_nothing, 1});
    commands.bind(onto.pipeline);
    commands.bind(0, display_set);
    push(commands, placed.frames.back());
    commands.draw(3);
    commands.end_pass();
    return {};
}

}  // namespace weft::render
