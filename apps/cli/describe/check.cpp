#include "cli/shell/command.h"

#include "files/open_scene.h"
#include "io/meshes/mesh_file.h"
#include "scene/looks.h"

#include <filesystem>
#include <iostream>

namespace weft::cli {
namespace {

// Nothing moves by a picture, and what is drawn without one is marked: no error.
void warn_of_missing_pictures(const SceneDesc& scene, const std::string& scene_file) {
    for (const PictureFile& picture : picture_files(scene)) {
        const auto found = find_asset(picture.file, std::filesystem::path(scene_file).parent_path());
        if (!found) print_warning(scene_file + ": " + picture.place + ": " + found.error().message());
    }
}

}  // namespace

Command add_check(Program& program) {
    Arguments arguments = program.add_command("check", "every problem of a scene, each with its place");
    auto scene = std::make_shared<std::string>();
    arguments.add("scene", *scene, "scene file").required();
    arguments.footer("Example:\n  weft check scenes/hanging_bunny.json");
    return [scene] {
        auto session = open_scene(*scene, {});
        if (!session) {
            print_errors(session.errors());
            return exit_usage;
        }
        for (const std::string& note : session->notes()) print_warning(note);
        warn_of_missing_pictures(session->scene(), *scene);
        for (const ClothFrame& cloth : session->world().frame().cloths) {
            const ClothModel& model = *cloth.model;
            std::cout << *scene << ": cloth '" << model.name << "': " << model.particle_count << " particles ("
                      << model.pinned_count << " pinned), " << cloth.triangles.size() << " triangles";
            if (!model.binding.empty()) std::cout << ", drawn with " << cloth.render_mesh().triangles.size();
            for (const ConstraintTable& table : model.constraints) {
                std::cout << ", " << table.rows << ' ' << constraint_info(table.kind).name << " rows in "
                          << table.batches.size() << " batches";
                if (table.overflow()) std::cout << " (" << table.overflow() << " rows in the overflow)";
            }
            std::cout << '\n';
        }
        std::cout << *scene << ": ok\n";
        return exit_done;
    };
}

}  // namespace weft::cli
