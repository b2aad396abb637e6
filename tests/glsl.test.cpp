// Each kernel compiles as GLSL: the test writes a compute shader around it and runs glslc.

#include "physics/constraint.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace weft {
namespace {

namespace fs = std::filesystem;

class Glsl : public testing::Test {
  protected:
    Glsl() : folder_(fs::temp_directory_path() / ("weft_glsl_" + std::to_string(::getpid()))) {
        fs::create_directories(folder_);
    }
    ~Glsl() override { fs::remove_all(folder_); }

    /// The output of glslc; empty if the shader with this body in main() compiles without a warning.
    std::string compile(const std::string& main_body, const std::string& before_main = "") {
        const fs::path shader = folder_ / "kernel.comp", log = folder_ / "log.txt";
        std::ofstream(shader) << "#version 450\n"
                                 "layout(local_size_x = 64) in;\n"
                                 "#include \"physics/kernels.glsl\"\n"
                                 "layout(std430, binding = 0) buffer Particles { vec4 x[]; };\n"
                                 "layout(std430, binding = 1) buffer Numbers { float n[]; };\n"
                              << before_main << "\nvoid main() {\n    uint i = gl_GlobalInvocationID.x;\n"
                              << "    Step h = Step(n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8] > 0.0);\n"
                              << main_body << "}\n";
        const std::string command = std::string(GLSLC) + " --target-env=vulkan1.2 -Werror -O -I" + WEFT_SOURCE_DIR +
                                    "/src " + shader.string() + " -o " + (folder_ / "kernel.spv").string() + " >" +
                                    log.string() + " 2>&1";
        const int status = std::system(command.c_str());
        std::ifstream in(log);
        std::string text((std::istreambuf_iterator<char>(in)), {});
        if (status != 0 && text.empty()) text = "glslc failed with status " + std::to_string(status);
        return text;
    }

  private:
    fs::path folder_;
};

std::string list(std::uint32_t arity, const std::string& prefix) {
    std::string text;
    for (std::uint32_t k = 0; k < arity; ++k) text += (k ? ", " : "") + prefix + std::to_string(k);
    return text;
}

std::string shader_for(const ConstraintInfo& info, const std::string& type) {
    std::string text;
    for (std::uint32_t k = 0; k < info.arity; ++k) {
        const std::string s = std::to_string(k), at = "x[" + std::to_string(info.arity) + "*i+" + s + "]";
        text +=
            "    vec3 p" + s + " = " + at + ".xyz; float w" + s + " = " + at + ".w; vec3 v" + s + " = p" + s + ";\n";
    }
    text += "    " + type + "Row row;\n";
    std::uint32_t field = 3;
    for (std::string_view name : info.fields)
        text += "    row." + std::string(name) + " = n[" + std::to_string(field++) + "];\n";
    const std::string name(info.name);
    for (std::uint32_t k = 0; k < info.lambdas; ++k) {
        const std::string s = std::to_string(k);
        text += "    float lambda" + s + " = n[i+" + s + "];\n";
    }
    text += "    project_" + name + "(" + list(info.arity, "p") + ", " + list(info.arity, "w") + ", " +
            list(info.lambdas, "lambda") + ", row, h);\n";
    if (info.damped)
        text += "    damp_" + name + "(" + list(info.arity, "v") + ", " + list(info.arity, "p") + ", " +
                list(info.arity, "w") + ", row, n[1]);\n";
    for (std::uint32_t k = 0; k < info.lambdas; ++k) {
        const std::string s = std::to_string(k);
        text += "    n[i+" + s + "] = lambda" + s + ";\n";
    }
    for (std::uint32_t k = 0; k < info.arity; ++k) {
        text += "    x[" + std::to_string(info.arity) + "*i+" + std::to_string(k) + "].xyz = p" + std::to_string(k) +
                " + v" + std::to_string(k) + ";\n";
    }
    return text;
}

TEST_F(Glsl, every_constraint_compiles) {
#define WEFT_CONSTRAINT(name, Name, particles, moved, lambdas, source, damping) \
    EXPECT_EQ(compile(shader_for(constraint_info(ConstraintKind::name), #Name)), "") << #name;
#include "physics/constraints.def"
#undef WEFT_CONSTRAINT
}

TEST_F(Glsl, grabs_compile) {
    EXPECT_EQ(
        compile(
            "    GrabRow row = GrabRow(grab_target(x[0].xyz, x[1].xyz, n[0], n[1]), x[2].xyz, n[2], n[3], n[4], n[5],\n"
            "                          n[6], n[7], n[8]);\n"
            "    vec4 a = x[i], b = x[i + 1], c = x[i + 2];\n"
            "    vec3 lambda = x[3].xyz;\n"
            "    take_hold(a.xyz, a.w, n[9], row.c0, x[4].xyz, row, h);\n"
            "    project_grab(a.xyz, b.xyz, c.xyz, x[5].xyz, x[6].xyz, x[7].xyz, a.w, b.w, c.w, lambda, row, h);\n"
            "    x[i] = a + b + c + vec4(lambda, 0);\n"),
        "");
}

TEST_F(Glsl, every_collider_shape_compiles) {
#define WEFT_SHAPE(name, Name)                                                                                    \
    EXPECT_EQ(                                                                                                    \
        compile("    vec3 normal;\n    vec3 p = x[i].xyz;\n    ContactBody b;\n"                                  \
                "    b.rx = x[0].xyz; b.ry = x[1].xyz; b.rz = x[2].xyz; b.position = x[3].xyz;\n"                 \
                "    b.rx0 = b.rx; b.ry0 = b.ry; b.rz0 = b.rz; b.position0 = b.position;\n"                       \
                "    b.static_friction = n[0]; b.kinetic_friction = n[1]; b.half_thickness = n[2];\n"             \
                "    b.depenetration = n[3];\n    ContactSum sum = ContactSum(vec3(0), 0.0);\n"                   \
                "    ShapeNumbers s = ShapeNumbers(n[0], n[1], n[2], n[3], ShapeBlocks(uvec2(0)));\n"             \
                "    vec3 local = to_body(b, p);\n"                                                               \
                "    float gap = distance_" #name "(local, s, normal);\n"                                         \
                "    project_contact(p, x[i + 1].xyz, x[i].w, sum, gap, gap, normal, carried_by(b, local), b);\n" \
                "    x[i] = vec4(p + sum.friction, sum.push);\n"),                                                \
        "")                                                                                                       \
        << #name;
#include "physics/contact/shapes.def"
#undef WEFT_SHAPE
}

TEST_F(Glsl, lines_compile) {
    EXPECT_EQ(
        compile(
            "    LineRow before = line_start();\n"
            "    StretchRow row = StretchRow(n[0], n[1], n[2], n[4]);\n"
            "    LineRow now = eliminate_stretch(before, x[i].xyz, x[i + 1].xyz, x[i].w, x[i + 1].w, n[3], row, h);\n"
            "    x[i].xyz += now.n * substitute_stretch(now, before.factor);\n"),
        "");
}

TEST_F(Glsl, tension_compiles) {
    EXPECT_EQ(compile("    TearSide side = TearSide(n[0], n[1], n[2], n[3], n[4], n[5]);\n"
                      "    TearCoupling q = TearCoupling(n[0], n[1], n[2], n[3], n[4], n[5]);\n"
                      "    TearFlat laid = lay_flat(x[i].xyz, x[i + 1].xyz, x[i + 2].xyz, side, side);\n"
                      "    PlaneStress s = springs_stress(laid, side, side, side);\n"
                      "    s = add_stress(s, coupling_stress(laid, side, side, side, q), 1);\n"
                      "    Tension t = principal_tension(turn_stress(s, n[5], n[6]));\n"
                      "    float k = side_stiffness(side, n[5], n[6], t.x, t.y) +\n"
                      "              coupling_stiffness(side, side, side, q, n[5], n[6], t.x, t.y);\n"
                      "    float limit = inverse_cut_limit(k, n[7], n[8]);\n"
                      "    x[i] = vec4(t.most, t.least, inverse_strength(t.x, t.y, n[9], n[10]), limit);\n"),
              "");
}

TEST_F(Glsl, every_wind_compiles) {
#define WEFT_WIND(name, Name)                                                                                          \
    EXPECT_EQ(                                                                                                         \
        compile("    WindNumbers w = WindNumbers(x[0].xyz, x[1].xyz, x[2].xyz, n[0], n[1], n[2]);\n"                   \
                "    WindLife life = WindLife(n[0], n[1], n[2], n[3], n[4], n[5], n[6], x[3].xyz);\n"                  \
                "    WindBounds b = WindBounds(x[0].xyz, x[1].xyz, x[2].xyz, x[3].xyz, n[0], n[1]);\n"                 \
                "    x[i].xyz = live_wind(flow_" #name "(x[i].xyz, w), float(i), life) * wind_share(x[i].xyz, b);\n"), \
        "")                                                                                                            \
        << #name;
#include "physics/air/winds.def"
#undef WEFT_WIND
}

TEST_F(Glsl, air_and_tangents_compile) {
    EXPECT_EQ(compile("    vec3 dv = air_velocity_change(x[0].xyz, x[1].xyz, n[0], AirFabric(n[1], n[2], n[3]), h.h);\n"
                      "    Motion m = Motion(x[i + 1].xyz, x[i + 2].xyz, x[i + 3].xyz);\n"
                      "    push_by_air(m, dv, x[i].w);\n"
                      "    x[i].xyz = m.v + m.v_dropped;\n"),
              "");
    EXPECT_EQ(compile("    float hand;\n"
                      "    TangentFrame f = face_tangents(x[0].xyz, x[1].xyz, x[2].xyz, n[0], n[1], n[2], n[3]);\n"
                      "    vec3 t = unit_tangent(f, x[3].xyz, hand);\n    x[i] = vec4(t, hand);\n"),
              "");
}

TEST_F(Glsl, integration_and_normals_compile) {
    EXPECT_EQ(compile("    vec3 p = x[i].xyz;\n    Motion m = Motion(x[i + 1].xyz, x[i + 2].xyz, x[i + 3].xyz);\n"
                      "    bool capped = predict(p, m, x[i].w, vec3(0, -9.81, 0), n[3], h);\n"
                      "    capped = update_velocity(m, p, x[i].xyz, x[i].w, n[3], h) || capped;\n"
                      "    vec3 normal = unit_normal(face_normal(x[0].xyz, x[1].xyz, x[2].xyz));\n"
                      "    x[i] = vec4(p + m.v + m.x_dropped + m.v_dropped + normal, capped ? 1.0 : 0.0);\n"),
              "");
}

TEST_F(Glsl, a_shader_that_is_wrong_is_refused) {
    EXPECT_NE(compile("    no_such_function(h);\n"), "");
}

}  // namespace
}  // namespace weft
