#include "cli/shell/command.h"

#include "collide/crossings.h"
#include "files/open_scene.h"
#include "io/meshes/mesh_file.h"
#include "scene/materials.h"
#include "solver/measures/bending_share.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

namespace weft::cli {
namespace {

/// Prints warnings about one scene file and counts them.
class Warnings {
  public:
    explicit Warnings(std::string scene_file) : scene_file_(std::move(scene_file)) {}

    /// For texts that name the file themselves.
    void print(const std::string& text) {
        print_warning(text);
        ++count_;
    }
    void add(const std::string& text) { print(scene_file_ + ": " + text); }

    /// `, 2 warnings`; empty if there were none.
    std::string count_text() const {
        if (count_ == 0) return "";
        return ", " + std::to_string(count_) + (count_ == 1 ? " warning" : " warnings");
    }

  private:
    std::string scene_file_;
    unsigned count_ = 0;
};

// A missing image is a warning: it does not affect the simulation, and rendering marks the surface.
void warn_of_missing_pictures(const SceneDesc& scene, const std::string& scene_file, Warnings& warnings) {
    for (const PictureFile& picture : picture_files(scene)) {
        const auto found = find_asset(picture.file, std::filesystem::path(scene_file).parent_path());
        if (!found) warnings.add(picture.place + ": " + found.error().message());
    }
}

Vec3 size_of(const ClothFrame& cloth) {
    Bounds bounds;
    for (const Vec4& position : cloth.positions) bounds.include(position.xyz());
    return bounds.size();
}

/// Three significant digits.
std::string rounded(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

// Most cloths of these sizes come from files in centimeters or millimeters.
void warn_of_size(const std::string& cloth, double largest, Warnings& warnings) {
    constexpr double large = 20, small = 0.02;  // m
    if (largest >= small && largest <= large) return;
    warnings.add("cloth '" + cloth + "' is " + rounded(largest) +
                 " m in size; if its file is in centimeters, give the mesh \"scale\": 0.01");
}

// With more iterations, or with other methods, it depends on the number of constraints that hold a particle.
void warn_of_bending(const ClothFrame& cloth, const SceneDesc& scene, Warnings& warnings) {
    const SolverDesc& solver = scene.solver;
    if (solver.method != Method::xpbd || solver.projection == Projection::jacobi || solver.iterations > 1) return;
    const auto share = [&](double substeps) {
        return bending_share(*cloth.model, cloth.positions, 1 / (double{scene.frame_rate} * substeps));
    };
    constexpr double little = 0.9, enough = 0.95, most_substeps = 10000;
    const double now = share(solver.substeps);
    if (now >= little) return;
    double substeps = solver.substeps;
    while (substeps < most_substeps && share(substeps) < enough) substeps = std::ceil(1.1 * substeps);
    warnings.add("cloth '" + cloth.model->name + "' bends with " + rounded(100 * now) +
                 " % of its stiffness: edges of " + rounded(1000 * cloth.model->mean_edge) + " mm are short for " +
                 std::to_string(solver.substeps) + " substeps; " + rounded(substeps) + " substeps give " +
                 rounded(100 * share(substeps)) + " %");
}

// Contact between cloths takes crossings apart, which looks odd at the start of a film. Particles that push each other
// apart resolve some crossings and not others.
void warn_of_crossings(const Frame& frame, Warnings& warnings) {
    std::vector<Vec3> positions;
    std::vector<Triangle> triangles;
    std::vector<const ClothFrame*> cloth_of;  // by position
    for (const ClothFrame& cloth : frame.cloths) {
        if (cloth.model->collision.with_cloth == SelfCollision::off) continue;
        const auto first = static_cast<std::uint32_t>(positions.size());
        for (const Vec4& position : cloth.positions) positions.push_back(position.xyz());
        cloth_of.resize(positions.size(), &cloth);
        for (const Triangle t : cloth.triangles) triangles.push_back({first + t[0], first + t[1], first + t[2]});
    }
    const auto can_cross = [&](std::uint32_t p, std::uint32_t q) {
        const ClothFrame &a = *cloth_of[p], &b = *cloth_of[q];
        return &a == &b || can_collide(a.model->collision, b.model->collision);
    };
    const bool exact = std::ranges::any_of(frame.cloths, [](const ClothFrame& cloth) {
        return cloth.model->collision.with_cloth == SelfCollision::exact;
    });
    const std::uint64_t crossings = count_crossings(positions, triangles, can_cross).triangles;
    if (crossings == 0) return;
    warnings.add("cloth with self_collision crosses itself or other cloth at the start, at " +
                 std::to_string(crossings) + " pairs of triangles; " +
                 (exact ? "it is taken apart within seconds" : "it may stay crossed there"));
}

}  // namespace

Command add_check(Program& program) {
    Arguments arguments = program.add_command("check", "Print every error of a scene file");
    auto scene = std::make_shared<std::string>();
    arguments.add("scene", *scene, "scene file").called("FILE").required();
    arguments.footer("Example:\n  weft check scenes/hanging_bunny.json");
    return [scene] {
        auto session = open_scene(*scene, {});
        if (!session) {
            print_errors(session.errors());
            return exit_usage;
        }
        Warnings warnings(*scene);
        for (const std::string& note : session->notes()) warnings.print(note);
        warn_of_missing_pictures(session->scene(), *scene, warnings);
        for (const ClothFrame& cloth : session->world().frame().cloths) {
            const ClothModel& model = *cloth.model;
            const Vec3 size = size_of(cloth);
            std::cout << *scene << ": cloth '" << model.name << "': " << model.particle_count << " particles ("
                      << model.pinned_count << " pinned), " << cloth.triangles.size() << " triangles, "
                      << rounded(size.x) << " × " << rounded(size.y) << " × " << rounded(size.z) << " m, mean edge "
                      << rounded(1000 * model.mean_edge) << " mm";
            warn_of_size(model.name, std::max({size.x, size.y, size.z}), warnings);
            if (!model.binding.empty()) std::cout << ", drawn with " << cloth.render_mesh().triangles.size();
            for (const ConstraintTable& table : model.constraints) {
                if (table.rows == 0) continue;
                std::cout << ", " << table.rows << ' ' << constraint_info(table.kind).name << " constraints";
            }
            std::cout << '\n';
            warn_of_bending(cloth, session->scene(), warnings);
        }
        warn_of_crossings(session->world().frame(), warnings);
        std::cout << *scene << ": ok" << warnings.count_text() << '\n';
        return exit_done;
    };
}

}  // namespace weft::cli
