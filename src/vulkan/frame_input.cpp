#include "vulkan/frame_input.h"

#include "physics/stretch/stretch_law.h"
#include "solver/plan/frame_numbers.h"
#include "vulkan/pose_in.h"

#include <algorithm>
#include <cstring>

namespace weft::vulkan {
namespace {

// Sizes of the GLSL layout.
static_assert(sizeof(FrameIn) == 128 && sizeof(PoseIn) == 64 && sizeof(WindIn) == 176 && sizeof(TargetIn) == 32 &&
              sizeof(GrabIn) == 64);

constexpr std::uint64_t report_bytes = WEFT_REPORT_WORDS * sizeof(std::uint32_t);

Vec4 with(Vec3 v, float w) {
    return {v.x, v.y, v.z, w};
}

WindIn wind_in(const WindNow& wind) {
    return {.n0 = with(wind.vectors[0], wind.gust),
            .n1 = with(wind.vectors[1], wind.gust_turns),
            .n2 = with(wind.vectors[2], wind.gust_per_meter),
            .noise_offset = with(wind.noise_offset, wind.scattered ? 1.0f : 0.0f),
            .position = with(wind.position, wind.strength),
            .axis_x = with(wind.axes.x, wind.edge.x),
            .axis_y = with(wind.axes.y, wind.edge.y),
            .axis_z = with(wind.axes.z, wind.edge.z),
            .s0 = wind.numbers[0],
            .s1 = wind.numbers[1],
            .s2 = wind.numbers[2],
            .per_border = wind.per_border,
            .turbulence = wind.turbulence,
            .noise_per_meter = wind.noise_per_meter,
            .noise_time = wind.noise_time,
            .kind = static_cast<std::uint32_t>(wind.kind),
            .shelter = wind.shelter,
            .unused0 = 0,
            .unused1 = 0,
            .unused2 = 0};
}

// Strain times rest length over lambda of stretch. Same factor as in tension_in() (solver/plan/tension.h).
float strain_per_lambda(const ClothModel& model, double substep_seconds) {
    const StretchMaterial material = softest_stretch(model);
    const double softest = std::min(material.stretch[0], material.stretch[1]);
    if (material.inextensible || !(softest > 0) || !(substep_seconds > 0)) return 0;
    return static_cast<float>(-1 / (substep_seconds * substep_seconds * StretchLaw(material).softest_spring()));
}

FrameIn frame_in(const ClothModel& model, const WorldPlan& plan, const StepInput& input, const ClothStep& cloth,
                 double substep_seconds, bool again, const ParticleAddresses& of_particles) {
    const FrameNumbers numbers = frame_numbers(model, plan, input.dt);
    const AirMaterial& air = model.fabric.air;
    return {.h = numbers.h,
            .inv_h = 1.0f / numbers.h,
            .inv_h2 = 1.0f / numbers.h / numbers.h,
            .max_speed = numbers.max_speed,
            .gravity_x = input.gravity.x,
            .gravity_y = input.gravity.y,
            .gravity_z = input.gravity.z,
            .viscous = numbers.viscous,
            .half_thickness = numbers.half_thickness,
            .depenetration = numbers.depenetration,
            .drag = 0.5f * input.air_density * air.drag,
            .lift = 0.5f * input.air_density * air.lift,
            .sine_lift = air.lift_model == LiftModel::sine ? 1.0f : 0.0f,
            .colliders = static_cast<std::uint32_t>(input.colliders.size()),
            .winds = static_cast<std::uint32_t>(input.winds.size()),
            .motions = cloth.motions,
            .strain_per_lambda = strain_per_lambda(model, substep_seconds),
            .again = again ? 1u : 0u,
            .substeps = plan.substeps,
            .tile_margin = numbers.tile_margin,
            .static_friction = model.fabric.contact.friction[0],
            .kinetic_friction = model.fabric.contact.friction[1],
            .nearest_of_faces = nearest_of_faces(numbers.half_thickness_range[1]),
            .circle_of_faces = circle_of_faces(model),
            .widest_face = widest_face(model),
            .surface_motion = input.surface_motion,
            .meets_surfaces = model.collision.meets_surfaces() ? 1u : 0u,
            .least_half_thickness = numbers.half_thickness_range[0],
            .weights = of_particles.weights,
            .thickness = of_particles.thickness};
}

}  // namespace

InputShape shape_of(const ClothModel& model, const WorldPlan& plan, const StepInput& input, const ClothStep& cloth) {
    return {plan.substeps,
            model.collision.surface ? 0 : static_cast<std::uint32_t>(input.colliders.size()),
            static_cast<std::uint32_t>(input.winds.size()),
            cloth.motions,
            static_cast<std::uint32_t>(cloth.targets.size()),
            static_cast<std::uint32_t>(cloth.grabs.size()),
            input.contact_forces && !input.colliders.empty(),
            !cloth.motion_bodies.empty()};
}

FrameInput::FrameInput(const InputShape& shape) {
    const std::uint64_t places = shape.substeps + std::uint64_t{1};
    const auto take = [&](std::uint64_t bytes) {
        const std::uint64_t at = bytes_;
        bytes_ += (bytes + 63) / 64 * 64;
        return at;
    };
    take(report_bytes);
    frame_ = take(sizeof(FrameIn));
    winds_ = take(shape.winds * sizeof(WindIn));
    motion_poses_ = take(places * shape.motions * sizeof(PoseIn));
    targets_ = take(shape.targets * sizeof(TargetIn));
    grabs_ = take(shape.grabs * sizeof(GrabIn));
    pull_bytes_ = std::uint64_t{shape.substeps} * shape.grabs * sizeof(Vec4);
    pulls_ = take(pull_bytes_);
}

void FrameInput::write(const ClothModel& model, const WorldPlan& plan, const StepInput& input, const ClothStep& cloth,
                       double substep_seconds, bool again, const ParticleAddresses& of_particles) {
    const auto put = [&](std::uint64_t at, const auto& value) { std::memcpy(host_ + at, &value, sizeof value); };
    put(0, std::uint32_t{report_none});
    put(frame_, frame_in(model, plan, input, cloth, substep_seconds, again, of_particles));
    for (std::size_t i = 0; i < input.winds.size(); ++i) put(winds_ + i * sizeof(WindIn), wind_in(input.winds[i]));
    for (std::size_t i = 0; i < cloth.motion_poses.size(); ++i)
        put(motion_poses_ + i * sizeof(PoseIn), pose_in(cloth.motion_poses[i]));
    for (std::size_t i = 0; i < cloth.targets.size(); ++i) {
        const KinematicTarget& target = cloth.targets[i];
        const std::uint32_t body = cloth.motion_bodies.empty() ? none : cloth.motion_bodies[target.motion];
        put(targets_ + i * sizeof(TargetIn), TargetIn{with(target.local, 0), target.particle, target.motion, body, 0});
    }
    for (std::size_t i = 0; i < cloth.grabs.size(); ++i) {
        const GrabStep& grab = cloth.grabs[i];
        put(grabs_ + i * sizeof(GrabIn),
            GrabIn{with(grab.from, grab.spring.max_force), with(grab.to, grab.spring.compliance),
                   with(grab.weights, grab.spring.damping), grab.triangle, 0, 0, 0});
    }
}

Result<FrameBuffers> FrameBuffers::create(gpu::Device& device, std::span<const InputShape> shapes,
                                          const std::string& name) {
    FrameBuffers self;
    std::uint64_t bytes = 0, read_back = shapes.size() * report_bytes;
    read_back = (read_back + sizeof(Vec4) - 1) / sizeof(Vec4) * sizeof(Vec4);
    for (const InputShape& shape : shapes) {
        self.inputs_.emplace_back(shape);
        self.offsets_.push_back(bytes);
        bytes += self.inputs_.back().bytes();
        self.pull_offsets_.push_back(read_back);
        read_back += self.inputs_.back().pull_bytes();
    }
    auto upload = device.memory().buffer(bytes, gpu::MemoryKind::upload, "frame of " + name + ", on its way");
    if (!upload) return upload.errors();
    auto buffer = device.memory().buffer(bytes, gpu::MemoryKind::device, "frame of " + name);
    if (!buffer) return buffer.errors();
    auto reports = device.memory().buffer(read_back, gpu::MemoryKind::readback, "reports of " + name);
    if (!reports) return reports.errors();
    self.upload_ = std::move(*upload);
    self.buffer_ = std::move(*buffer);
    self.reports_ = std::move(*reports);
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        self.inputs_[i].attach(self.upload_.mapped().data() + self.offsets_[i],
                               self.buffer_.address() + self.offsets_[i]);
    }
    return self;
}

void FrameBuffers::record_begin(gpu::Commands& commands) const {
    commands.copy(upload_, buffer_, buffer_.size());
}

void FrameBuffers::record_reports(gpu::Commands& commands, std::uint32_t report) const {
    for (const std::uint64_t offset : offsets_) commands.fill(buffer_, report, sizeof report, offset);
}

void FrameBuffers::read_pulls(std::size_t cloth, std::span<Vec4> pulls) const {
    if (!pulls.empty()) std::memcpy(pulls.data(), reports_.mapped().data() + pull_offsets_[cloth], pulls.size_bytes());
}

void FrameBuffers::record_end(gpu::Commands& commands) const {
    commands.barrier();
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
        commands.copy(buffer_, reports_, report_bytes, offsets_[i], i * report_bytes);
        if (const std::uint64_t bytes = inputs_[i].pull_bytes())
            commands.copy(buffer_, reports_, bytes, offsets_[i] + inputs_[i].first_pull(), pull_offsets_[i]);
    }
    commands.host_barrier();
}

}  // namespace weft::vulkan
