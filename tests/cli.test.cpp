// The program as a user runs it: exit status, one-line errors, files.

#include "cli_fixture.h"

#include <algorithm>
#include <regex>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using weft::Cli;
using weft::Json;
using weft::Outcome;
using weft::read_file;

TEST_F(Cli, run_writes_everything_it_was_asked_for) {
    const Outcome outcome =
        weft("run sheet.json --frames 5 --out a.glb --out b.obj --out c.ply --out seq/%03d.obj --stats s.json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const char* file : {"a.glb", "b.obj", "c.ply", "s.json"})
        EXPECT_GT(fs::file_size(folder_ / file), 100u) << file;
    for (int i = 0; i <= 5; ++i) {  // frame 0 is the start
        EXPECT_TRUE(fs::exists(folder_ / "seq" / ("00" + std::to_string(i) + ".obj"))) << i;
    }
    EXPECT_FALSE(fs::exists(folder_ / "seq" / "006.obj"));
    EXPECT_NE(outcome.out.find("state hash"), std::string::npos);
    EXPECT_NE(outcome.err.find("simulating 5/5"), std::string::npos)
        << "plain progress lines where there is no terminal";
}

TEST_F(Cli, stats_have_every_figure) {
    const Json s = stats("--seconds 1");
    EXPECT_EQ(s["scene"], "sheet.json");
    EXPECT_EQ(s["backend"], "cpu");
    EXPECT_EQ(s["threads"], 1);
    EXPECT_EQ(s["frames"], 60);
    EXPECT_EQ(s["particles"], 120);
    EXPECT_EQ(s["triangles"], 2 * 11 * 9);
    EXPECT_EQ(s["constraints"]["stretch"], 11 * 10 + 12 * 9 + 11 * 9);
    EXPECT_EQ(s["constraints"]["moment"], 11 * 8 + 10 * 9 + 11 * 9);
    for (const char* key : {"median", "p95", "max"}) EXPECT_GT(s["ms_per_frame"][key], 0);
    EXPECT_LE(s["ms_per_frame"]["median"], s["ms_per_frame"]["max"]);
    for (const char* stage : {"predict", "stretch", "moment", "contact", "velocities"})
        EXPECT_GT(s["stage_ms"][stage], 0);
    for (const char* key : {"stretch", "shear", "residual"}) {
        EXPECT_GT(s[key]["mean"], 0);
        EXPECT_LE(s[key]["mean"], s[key]["max"]);
    }
    EXPECT_GT(s["stretch"]["p99"], 0);
    EXPECT_LE(s["stretch"]["p99"], s["stretch"]["max"]);
    EXPECT_GT(s["tension"]["mean"], 0);
    EXPECT_LE(s["tension"]["mean"], s["tension"]["max"]);
    EXPECT_LE(s["tension"]["max"], s["tension"]["worst"]["max"]);
    EXPECT_LE(s["tension"]["load"]["max"], s["tension"]["load"]["worst"]["max"]);
    EXPECT_EQ(s["tension"]["load"]["cloth"], "sheet");
    EXPECT_TRUE(s["tension"]["load"]["worst"]["frame"].is_number() && s["tension"]["particle"].is_number());
    EXPECT_GT(s["kinetic_energy"], 0);
    EXPECT_GT(s["mean_speed"], 0.01);
    EXPECT_GT(s["max_speed"], 0);
    EXPECT_TRUE(s["penetration"].contains("max") && s["penetration"].contains("count"));
    for (const char* key : {"self_contacts", "searches", "limited", "tangled"}) EXPECT_EQ(s[key], 0) << key;
    for (const char* key : {"triangles", "edges", "worst"}) EXPECT_TRUE(s["intersections"].contains(key)) << key;
    EXPECT_EQ(s["torn_edges"], 0);
    EXPECT_TRUE(s["unsolved"].is_null() && s["tear_room"].is_null()) << "no cloth tears";
    EXPECT_EQ(s["pieces"], 1);
    EXPECT_EQ(s["smallest_piece"]["part"], 1);
    EXPECT_EQ(s["reports"], Json::array());
    EXPECT_EQ(s["state_hash"].get<std::string>().size(), 16u);
    EXPECT_EQ(s["finite"], true);
    EXPECT_TRUE(s.contains("device"));
}

TEST_F(Cli, no_frames_export_and_measure_the_start) {
    const Outcome outcome = weft(
        "run sheet.json --frames 0 --out a.glb --out b.obj --out c.ply --out d.pc2 --out seq/%03d.obj --stats s.json "
        "--crossings every");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << "no progress";
    EXPECT_TRUE(outcome.out.starts_with("0 frames of 120 particles")) << outcome.out;
    for (const char* absent : {"nan", "ms per frame", "mean speed"})
        EXPECT_EQ(outcome.out.find(absent), std::string::npos) << outcome.out;
    for (const char* file : {"a.glb", "b.obj", "c.ply", "d.pc2", "seq/000.obj"})
        EXPECT_GT(fs::file_size(folder_ / file), 100u) << file;
    EXPECT_FALSE(fs::exists(folder_ / "seq/001.obj"));

    const Json s = Json::parse(read_file(folder_ / "s.json"));
    EXPECT_EQ(s["frames"], 0);
    for (const char* key : {"ms_per_frame", "stage_ms", "mean_speed"}) EXPECT_TRUE(s[key].is_null()) << key;
    for (const char* key : {"mean", "p99", "max"}) EXPECT_EQ(s["stretch"][key], 0) << key;
    EXPECT_EQ(s["max_speed"], 0);
    EXPECT_EQ(s["intersections"]["triangles"], 0);
    EXPECT_EQ(s["state_hash"].get<std::string>().size(), 16u);
    EXPECT_EQ(stats("--seconds 0")["state_hash"], s["state_hash"]);
    expect_usage_error("run sheet.json --frames 0 --contact-forces", "--contact-forces: gives the forces in the last");
}

TEST_F(Cli, names_the_substeps_that_cloth_which_tears_needs) {
    const auto run_with = [&](int substeps) {
        write("torn.json", R"({ "weft": 1, "solver": { "substeps": )" + std::to_string(substeps) +
                               R"( }, "cloths": [{ "tearing": "split", "transform": { "rotation": [90, 0, 0] },
                                  "mesh": { "grid": { "size": [1, 1], "resolution": [33, 33], "diagonal": "uniform" } },
                                  "pins": [{ "vertices": [0, 32] }] }] })");
        const Outcome outcome = weft("run torn.json --frames 30 --stats s.json");
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        const Json s = Json::parse(read_file(folder_ / "s.json"));
        EXPECT_EQ(outcome.out.find("substeps leave 10 %") != std::string::npos, s["unsolved"]["part"] > 0.1);
        EXPECT_LE(s["tear_room"], 33 * 33 / 8 + 256);
        EXPECT_GT(s["tear_room"], 256);
        return s["unsolved"];
    };
    const Json few = run_with(3), many = run_with(100);
    EXPECT_GT(few["part"], 0.1);
    EXPECT_GT(few["substeps"], 3);
    EXPECT_LT(many["part"], few["part"]);
}

TEST_F(Cli, contact_forces_are_the_force_on_each_collider) {
    write("sheet.json", R"({ "weft": 1, "cloths": [{ "fabric": { "density": 0.5 },
                                 "mesh": { "grid": { "size": [1, 1], "resolution": [8, 8] } },
                                 "transform": { "position": [0, 0.01, 0] } }],
                             "colliders": [{ "name": "scale", "plane": {} },
                                           { "name": "far away", "sphere": {}, "transform": { "position": [9, 9, 9] } }] })");
    const Json without = stats("--frames 60"), with = stats("--frames 60 --contact-forces");
    EXPECT_FALSE(without.contains("colliders"));
    EXPECT_EQ(without["state_hash"], with["state_hash"]);
    ASSERT_EQ(with["colliders"].size(), 2u);
    const Json &scale = with["colliders"][0], &other = with["colliders"][1];
    EXPECT_EQ(scale["name"], "scale");
    EXPECT_NEAR(scale["force"][1], -0.5 * 9.81, 0.01);
    EXPECT_NEAR(scale["force"][0], 0, 0.01);
    EXPECT_NEAR(scale["torque"][2], 0, 0.01);
    EXPECT_EQ(scale["contacts"], 64);
    EXPECT_EQ(other["name"], "far away");
    EXPECT_EQ(other["force"], Json::array({0.0, 0.0, 0.0}));
    EXPECT_EQ(other["contacts"], 0);
    const Outcome said = weft("run sheet.json --frames 60 --contact-forces");
    EXPECT_NE(said.out.find("on scale"), std::string::npos) << said.out;
    EXPECT_NE(said.out.find("64 contacts"), std::string::npos) << said.out;
    EXPECT_EQ(said.out.find("not counted"), std::string::npos) << said.out;
    EXPECT_EQ(scale["complete"], true);
}

TEST_F(Cli, contact_forces_say_if_contact_with_triangles_is_missing) {
    write("cube.obj",
          "v 0 -1 0\nv 1 -1 0\nv 1 -1 1\nv 0 -1 1\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\n"
          "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n");
    write("sheet.json",
          R"({ "weft": 1, "cloths": [{ "self_collision": "exact", "transform": { "position": [0.5, 0.01, 0.5] },
                                 "mesh": { "grid": { "size": [0.3, 0.3], "resolution": [8, 8] } } }],
                             "colliders": [{ "name": "cube", "mesh": { "file": "cube.obj", "resolution": 16, "contact": "surface" } },
                                           { "name": "ground", "plane": {}, "transform": { "position": [0, -1, 0] } }] })");
    const Json with = stats("--frames 20 --contact-forces");
    EXPECT_EQ(with["colliders"][0]["contacts"], 0);
    EXPECT_EQ(with["colliders"][0]["complete"], false);
    EXPECT_EQ(with["colliders"][1]["complete"], true);
    const Outcome said = weft("run sheet.json --frames 20 --contact-forces");
    EXPECT_NE(said.out.find("0 contacts; contact with its triangles is not counted"), std::string::npos) << said.out;
}

TEST_F(Cli, crossings_are_counted_in_the_last_frame_or_in_every_one) {
    // A tilted sheet flies through one that hangs by its corners.
    write("sheet.json", R"({ "weft": 1, "cloths": [
        { "mesh": { "grid": { "size": [0.4, 0.4], "resolution": [5, 5] } }, "pins": [{ "vertices": [0, 4, 20, 24] }] },
        { "mesh": { "grid": { "size": [0.4, 0.4], "resolution": [5, 5] } }, "velocity": [0, -15, 0],
          "transform": { "position": [0, 0.25, 0], "rotation": [30, 0, 0] } }] })");
    const Json within = stats("--frames 1"), after = stats("--frames 8"), every = stats("--frames 8 --crossings every");
    EXPECT_GT(within["intersections"]["triangles"], 0);
    EXPECT_EQ(within["intersections"]["worst"], within["intersections"]["triangles"]);
    EXPECT_EQ(after["intersections"]["triangles"], 0);
    EXPECT_EQ(after["intersections"]["worst"], 0) << "only the last frame is counted";
    EXPECT_EQ(every["intersections"]["triangles"], 0);
    EXPECT_GE(every["intersections"]["worst"], within["intersections"]["triangles"]);
    EXPECT_EQ(every["state_hash"], after["state_hash"]);
    EXPECT_EQ(after["intersections"]["order_lost"], 0) << "it may have fallen past the other sheet";
    EXPECT_EQ(every["intersections"]["order_lost"], 1);
    const Outcome said = weft("run sheet.json --frames 8 --crossings every");
    EXPECT_NE(said.out.find("crossings     0 pairs of triangles, at most "), std::string::npos) << said.out;
    EXPECT_EQ(weft("run sheet.json --frames 8").out.find("crossings"), std::string::npos);
    expect_usage_error("run sheet.json --crossings all", "--crossings: must be \"last\" or \"every\", got \"all\"");
}

TEST_F(Cli, sheets_that_changed_places_are_counted) {
    for (const std::string self_collision : {"off", "exact"}) {
        const std::string sheet =
            R"("mesh": { "grid": { "size": [0.4, 0.4], "resolution": [8, 8] } }, "self_collision": ")" +
            self_collision + '"';
        write("sheet.json", R"({ "weft": 1, "cloths": [{ )" + sheet + R"( },
            { )" + sheet + R"(, "transform": { "position": [0.02, 0.05, 0] }, "velocity": [0, -5, 0] },
            { )" + sheet + R"(, "transform": { "position": [0, 0.08, 0] } }] })");
        const std::size_t lost = self_collision == "off" ? 1 : 0;
        for (const std::string crossings : {"last", "every"}) {
            const Json s = stats("--frames 1 --crossings " + crossings);
            EXPECT_EQ(s["intersections"]["triangles"], 0) << self_collision;
            EXPECT_EQ(s["intersections"]["order_lost"], lost) << self_collision << ' ' << crossings;
        }
        EXPECT_EQ(stats("--frames 0")["intersections"]["order_lost"], 0);
        const Outcome said = weft("run sheet.json --frames 1");
        EXPECT_EQ(said.out.find("order lost    1 pair of cloths") != std::string::npos, lost == 1) << said.out;
    }
}

// Labels: slow no-asan
TEST_F(Cli, the_state_does_not_depend_on_threads_or_instruction_set_but_on_substeps) {
    const Json one = stats("--frames 30"), four = stats("--frames 30 --threads 4"),
               scalar = stats("--frames 30 --isa scalar");
    EXPECT_EQ(one["state_hash"], four["state_hash"]);
    EXPECT_EQ(one["state_hash"], scalar["state_hash"]);
    EXPECT_EQ(four["threads"], 4);
    const Json finer = stats("--frames 30 --substeps 40");
    EXPECT_NE(one["state_hash"], finer["state_hash"]);
    EXPECT_LT(finer["residual"]["mean"], one["residual"]["mean"]);
    EXPECT_EQ(finer["substeps"], 40);
}

TEST_F(Cli, options_override_the_scene_s_solver_and_nothing_else_does) {
    EXPECT_EQ(stats("--frames 2")["solver"], "xpbd, lines, hierarchy");
    EXPECT_EQ(stats("--frames 2 --method pbd --projection jacobi --hierarchy")["solver"],
              "pbd, jacobi by gather, hierarchy");
    write("sheet.json", R"({ "weft": 1, "solver": { "method": "pbd", "projection": "jacobi", "hierarchy": true },
                             "cloths": [{ "mesh": { "grid": { "resolution": [40, 40] } }, "pins": [{ "vertices": [0] }] }] })");
    const Json as_written = stats("--frames 2");
    EXPECT_EQ(as_written["solver"], "pbd, jacobi by gather, hierarchy");
    EXPECT_GT(as_written["stage_ms"]["hierarchy"], 0);
    EXPECT_EQ(stats("--frames 2 --no-hierarchy --method xpbd")["solver"], "xpbd, jacobi by gather");
    EXPECT_EQ(stats("--frames 2 --no-hierarchy --accumulate fixed-point")["solver"], "pbd, jacobi by fixed-point");
    expect_usage_error("run sheet.json --method magic", "must be \"xpbd\" or \"pbd\", got \"magic\"");
}

TEST_F(Cli, wrong_usage_is_one_line_and_status_2) {
    expect_usage_error("", "subcommand");
    expect_usage_error("run", "scene");
    expect_usage_error("fly sheet.json", "fly");
    expect_usage_error("run sheet.json --frames -3", "--frames: must give 0 to 1000000 frames, got -3");
    expect_usage_error("run sheet.json --frames 1.5", "whole number");
    expect_usage_error("run sheet.json --seconds nan", "--seconds");
    expect_usage_error("run sheet.json --seconds 1e9", "--seconds");
    expect_usage_error("run sheet.json --frames 5 --seconds 1", "--frames");
    expect_usage_error("run sheet.json --threads 0", "threads: must be from 1 to 256, got 0");
    expect_usage_error("run sheet.json --substeps 0", "solver/substeps: must be ≥ 1, got 0");
    expect_usage_error("run sheet.json --backend gpu", "backend: must be \"auto\", \"cpu\" or \"vulkan\", got 'gpu'");
    expect_usage_error("run sheet.json --backend cpu --device arc",
                       "device: names a Vulkan device, and the backend is cpu");
    expect_usage_error("run sheet.json --isa nonsense", "instruction set 'nonsense': this machine has ");
    expect_usage_error("run sheet.json --isa mmx", "instruction set 'mmx'");
    expect_usage_error("run sheet.json --out film.avi", ".glb");
    expect_usage_error("run sheet.json --out %d%d.obj", "%d");
    expect_usage_error("run nowhere.json", "nowhere.json");
    expect_usage_error("check nowhere.json", "nowhere.json");
}

TEST_F(Cli, no_output_overwrites_what_the_scene_reads) {
    write("disc.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n");
    const std::string mesh = read_file(folder_ / "disc.obj");
    write("disc.json", R"({ "weft": 1, "cloths": [{ "mesh": { "file": "disc.obj" } }] })");
    const std::string scene = read_file(folder_ / "disc.json");
    for (const char* output : {"--out disc.pc2", "--out disc.obj", "--stats disc.json"}) {
        const Outcome outcome = weft("run disc.json --frames 1 --quiet " + std::string(output));
        EXPECT_EQ(outcome.status, 2) << output;
        EXPECT_NE(outcome.err.find(", which the scene reads; choose another name"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(read_file(folder_ / "disc.obj"), mesh);
    EXPECT_EQ(read_file(folder_ / "disc.json"), scene);
    EXPECT_EQ(weft("run disc.json --frames 1 --quiet --out out.pc2").status, 0);
}

TEST_F(Cli, pins_and_meshes_are_checked_against_the_mesh) {
    write("tri.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nv 5 5 5\nf 1 3 2\n");
    const auto scene = [&](const std::string& pins) {
        write("tri.json",
              R"({ "weft": 1, "cloths": [{ "name": "t", "mesh": { "file": "tri.obj" }, "pins": [)" + pins + "] }] }");
    };
    scene(R"({ "vertices": [2] })");
    EXPECT_EQ(weft("check tri.json").status, 0);
    EXPECT_NE(weft("check tri.json").err.find("1 vertices that no triangle uses"), std::string::npos);
    scene(R"({ "vertices": [2, 9] })");
    expect_usage_error("check tri.json",
                       "tri.json: /cloths/0/pins/0/vertices/1: must be a vertex of the mesh, 0 to 3, got 9");
    scene(R"({ "vertices": [3] })");
    expect_usage_error("check tri.json", "/cloths/0/pins/0/vertices/0: vertex 3 belongs to no triangle");
    scene(R"({ "box": { "min": [7, 7, 7], "max": [8, 8, 8] } })");
    expect_usage_error("check tri.json", "/cloths/0/pins/0/box: no vertex lies in it");
    scene(R"({ "color": [1, 0, 0] })");
    expect_usage_error("check tri.json", "/cloths/0/pins/0/color: the mesh has no vertex colors");
    fs::remove(folder_ / "tri.obj");
    expect_usage_error("check tri.json", "/cloths/0/mesh/file: ");
}

TEST_F(Cli, a_failed_export_is_status_1_and_leaves_nothing) {
    const Outcome full = weft("run sheet.json --frames 20 --quiet --out film.glb", "ulimit -f 20;");
    EXPECT_EQ(full.status, 1);
    EXPECT_EQ(full.err.rfind("weft: error: ", 0), 0u) << full.err;
    EXPECT_FALSE(fs::exists(folder_ / "film.glb"));
    for (const auto& entry : fs::directory_iterator(folder_)) {
        EXPECT_EQ(entry.path().filename().string().rfind(".weft", 0), std::string::npos) << entry.path();
    }
}

TEST_F(Cli, figures_that_cannot_be_written_are_an_error_before_the_run_or_after_it) {
    expect_usage_error("run sheet.json --stats nowhere/s.json",
                       "nowhere/s.json: cannot be written: No such file or directory");
    expect_usage_error("run sheet.json --stats .", ".: cannot be written: it is a folder");
    expect_usage_error("run sheet.json --stats /dev/full", "/dev/full: cannot be written: it is not a regular file");
#if !defined(__SANITIZE_THREAD__)  // the sanitizer writes a file of its own, which the limit forbids
    for (const char* command : {"run sheet.json --frames 2 --quiet --stats s.json",
                                "bench sheet.json --frames 2 --warmup 0 --repeat 1 --json s.json"}) {
        write("s.json", "earlier");
        const Outcome full = weft(command, "ulimit -f 0;");
        EXPECT_EQ(full.status, 1) << command;
        EXPECT_EQ(read_file(folder_ / "s.json"), "earlier");
    }
#endif
    for (const auto& entry : fs::directory_iterator(folder_))
        EXPECT_EQ(entry.path().filename().string().rfind(".weft", 0), std::string::npos) << entry.path();
}

TEST_F(Cli, a_full_disk_behind_standard_output_is_an_error) {
    for (const char* command : {"info", "info --json", "info --schema", "check sheet.json", "run sheet.json --frames 2",
                                "bench sheet.json --frames 2 --warmup 0 --repeat 1"}) {
        const Outcome full = weft(std::string(command) + " >/dev/full 2>err.txt; echo $? >status.txt; exec true");
        EXPECT_EQ(read_file(folder_ / "status.txt"), "1\n") << command;
        EXPECT_NE(read_file(folder_ / "err.txt")
                      .find("weft: error: standard output: cannot be written: No space left on device\n"),
                  std::string::npos)
            << command << ": " << read_file(folder_ / "err.txt");
    }
    weft("info --schema 2>err.txt | true");
    EXPECT_EQ(read_file(folder_ / "err.txt"), "") << "who closes a pipe has read enough";
}

TEST_F(Cli, a_folder_that_is_missing_is_made_if_it_can_be) {
    EXPECT_EQ(weft("run sheet.json --frames 2 --quiet --out new/deep/a.obj --out new/er/%d.ply").status, 0);
    EXPECT_TRUE(fs::exists(folder_ / "new/deep/a.obj"));
    EXPECT_TRUE(fs::exists(folder_ / "new/er/2.ply"));
    expect_usage_error("run sheet.json --frames 2 --out /proc/weft/a.obj",
                       "/proc/weft/a.obj: its folder cannot be made");
    expect_usage_error("run sheet.json --frames 2 --out sheet.json/a.glb", "sheet.json/a.glb: ");
}

TEST_F(Cli, what_is_no_scene_is_one_line_and_status_2) {
    write("empty.json", "");
    write("short.json", R"({ "weft": 1, "cloths": [{ "mesh": { "gri)");
    write("garbage.json", std::string("\x7f"
                                      "ELF\x02\x01\0\xff\xfe\n\0\r\n\x80",
                                      14));
    for (const char* command : {"check", "run", "bench"}) {
        expect_usage_error(std::string(command) + " empty.json", "empty.json: is empty");
        expect_usage_error(std::string(command) + " short.json", "short.json: line 1, column 4");
        expect_usage_error(std::string(command) + " garbage.json", "garbage.json: line 1, column 1: ");
        expect_usage_error(std::string(command) + " .", ".: is a folder, not a scene file");
    }
}

TEST_F(Cli, a_point_cache_comes_with_its_mesh_and_both_are_named) {
    const Outcome outcome = weft("run sheet.json --frames 5 --out film.pc2");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(fs::file_size(folder_ / "film.pc2"), 32u + 6 * 120 * 12);
    EXPECT_NE(outcome.out.find("wrote film.pc2\nwrote film.obj\n"), std::string::npos) << outcome.out;
    expect_usage_error("run sheet.json --frames 5 --out film.pc2 --out ./film.obj",
                       "./film.obj: would write ./film.obj, and so would film.pc2");
}

TEST_F(Cli, large_exports_are_announced_and_impossible_ones_refused_before_the_run) {
    expect_usage_error("run sheet.json --frames 1000000 --out film.glb", "GiB for 1000001 frames");
    // 12 KiB per frame: the size must be computed before the run, which would take hours.
    const auto free_bytes = fs::space(folder_).available;
    if (free_bytes < (std::uint64_t{10} << 30)) {
        expect_usage_error("run sheet.json --frames 1000000 --out f/%d.obj", " are free there");
    } else {
        write("large.json", R"({ "weft": 1, "cloths": [{ "mesh": { "grid": { "resolution": [200, 200] } } }] })");
        // 40,000 vertices: 6 MiB of text a frame, 6 TiB in all.
        if (free_bytes < (std::uint64_t{5} << 40)) {
            expect_usage_error("run large.json --frames 1000000 --out f/%d.obj", " are free there");
        }
    }
    EXPECT_FALSE(fs::exists(folder_ / "film.glb"));

    // A million frames of 1.4 KB are worth a warning. The run is killed after 2 s.
    EXPECT_EQ(weft("run sheet.json --frames 3 --quiet --out film.pc2").err, "");
    const Outcome announced = weft("run sheet.json --frames 1000000 --quiet --out film.pc2", "timeout 2");
    EXPECT_NE(announced.err.find("weft: warning: the exports will take up to 1.3 GiB: film.pc2"), std::string::npos)
        << announced.err;
}

TEST_F(Cli, info_lists_what_there_is) {
    const Outcome text = weft("info");
    EXPECT_EQ(text.status, 0);
    for (const char* word : {"scalar", ".glb", ".pc2", ".fbx", "cotton", "chiffon"}) {
        EXPECT_NE(text.out.find(word), std::string::npos) << word;
    }
    std::istringstream lines(text.out);
    for (std::string line; std::getline(lines, line);) {
        const auto characters = std::ranges::count_if(line, [](unsigned char c) { return (c & 0xc0) != 0x80; });
        EXPECT_TRUE(characters <= 100 || line.find("Vulkan") != std::string::npos) << line;  // drivers' names are long
    }
    // Long texts are wrapped.
    const std::string words = std::regex_replace(text.out, std::regex(R"(\s+)"), " ");
    const Json info = Json::parse(weft("info --json").out);
    EXPECT_EQ(info["instruction_sets"].back(), "scalar");
    for (const Json& fabric : info["fabrics"]) {
        if (fabric["name"] == "cotton") {
            EXPECT_EQ(fabric["density"], 0.14);
            EXPECT_EQ(fabric["strength"], Json::array({320, 320}));
            EXPECT_EQ(fabric["breaking_force"], 3900);
            EXPECT_EQ(fabric["breaking_elongation"], 0.08);
        }
        EXPECT_GT(fabric["tongue_tear_force"], 0) << fabric;
        EXPECT_NE(words.find(fabric["tearing_source"].get<std::string>()), std::string::npos) << fabric;
    }
    EXPECT_EQ(info["fabric_units"]["density"], "kg/m²");
    EXPECT_EQ(info["fabric_units"]["tear_energy"], "J/m");
    EXPECT_EQ(info["fabric_units"]["breaking_force"], "N/m");
    EXPECT_EQ(info["material_units"]["thread_spacing"], "mm");
    ASSERT_FALSE(info["materials"].empty());
    for (const Json& material : info["materials"]) {
        EXPECT_NE(text.out.find("\n  " + material["name"].get<std::string>() + ' '), std::string::npos) << material;
        EXPECT_NE(words.find(material["what"].get<std::string>()), std::string::npos) << material;
        EXPECT_EQ(material["color"].size(), 3u);
        EXPECT_TRUE(material["weave"].is_string() && material["color_map"].is_string()) << material;
        if (material["name"] == "velvet") {
            EXPECT_GT(material["velvet"], 0);
        }
    }
    EXPECT_EQ(Json::parse(weft("info --schema").out)["title"], "weft scene");
    expect_usage_error("info --schema --json", "--schema");
    EXPECT_EQ(weft("--version").out.rfind("weft ", 0), 0u);
    EXPECT_EQ(weft("--help").status, 0);
    EXPECT_NE(weft("run --help").out.find("Examples:"), std::string::npos);
}

#ifdef WEFT_VULKAN

// Labels: no-asan
TEST_F(Cli, runs_on_vulkan_and_says_so) {
    const Json on_cpu = stats("--frames 3 --backend cpu"), on_vulkan = stats("--frames 3 --backend vulkan");
    EXPECT_EQ(on_vulkan["backend"], "vulkan");
    EXPECT_EQ(on_cpu["backend"], "cpu");
    EXPECT_NEAR(on_vulkan["kinetic_energy"].get<double>(), on_cpu["kinetic_energy"].get<double>(), 1e-6);
    const Json info = Json::parse(weft("info --json").out);
    ASSERT_FALSE(info["vulkan_devices"].empty());
    EXPECT_NE(on_vulkan["device"].get<std::string>().find(info["vulkan_devices"][0]["name"].get<std::string>()),
              std::string::npos);
}

// Labels: no-asan
TEST_F(Cli, stats_say_the_same_on_vulkan) {
    const Json on_cpu = stats("--frames 3 --backend cpu"), on_vulkan = stats("--frames 3 --backend vulkan");
    const auto keys = [](const Json& object) {
        std::vector<std::string> names;
        for (const auto& [name, value] : object.items()) names.push_back(name);
        return names;
    };
    EXPECT_EQ(keys(on_vulkan), keys(on_cpu));
    const auto expect_near = [&](const Json& a, const Json& b, const std::string& what) {
        EXPECT_NEAR(a.get<double>(), b.get<double>(), 1e-3 * b.get<double>() + 1e-9) << what;
    };
    for (const char* key : {"stretch", "shear", "residual"}) {
        EXPECT_EQ(keys(on_vulkan[key]), keys(on_cpu[key]));
        for (const char* of : {"mean", "max"}) expect_near(on_vulkan[key][of], on_cpu[key][of], std::string(key) + of);
        EXPECT_GT(on_vulkan[key]["mean"], 0) << key;
    }
    for (const char* key : {"kinetic_energy", "max_speed", "mean_speed"}) expect_near(on_vulkan[key], on_cpu[key], key);
    for (const char* key : {"finite", "reports", "constraints", "particles", "solver", "intersections"})
        EXPECT_EQ(on_vulkan[key], on_cpu[key]) << key;
}

TEST_F(Cli, names_what_vulkan_lacks_with_status_1) {
    const auto expect_failure = [&](const std::string& arguments, const std::string& before, const std::string& says) {
        const Outcome outcome = weft("run sheet.json --frames 2 --quiet " + arguments, before);
        EXPECT_EQ(outcome.status, 1) << outcome.err;
        EXPECT_EQ(outcome.err.rfind("weft: error: ", 0), 0u) << outcome.err;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    };
    std::filesystem::create_directories(folder_ / "broken");
    write("broken/libvulkan.so.1", "no library");
    write("broken/libvulkan.so", "no library");
    const std::string no_loader = "LD_LIBRARY_PATH=" + (folder_ / "broken").string();
    const std::string no_driver = "VK_ICD_FILENAMES=/nowhere.json VK_DRIVER_FILES=/nowhere.json";
    expect_failure("--backend vulkan", no_loader, "install libvulkan1");
    expect_failure("--backend vulkan", no_driver, "mesa-vulkan-drivers");
    expect_failure("--backend vulkan --device voodoo", "", "device 'voodoo': there is none; there are '");
    expect_failure("--device voodoo", "",
                   "device 'voodoo': there is none");  // a device that is named has no substitute

    // `auto` falls back to the CPU.
    for (const std::string& before : {no_loader, no_driver, std::string()}) {
        const Outcome outcome = weft("run sheet.json --frames 2 --quiet", before);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(weft("info", before).status, 0);
    }
}

#endif

TEST_F(Cli, convert_writes_the_scene_that_it_read) {
    const std::string hash = stats("--frames 3")["state_hash"];
    const Outcome outcome = weft("convert sheet.json --out copy.json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "wrote copy.json\n");
    const std::string text = read_file(folder_ / "copy.json");
    EXPECT_EQ(text.find("quick"), std::string::npos) << "comments are not kept";
    EXPECT_EQ(text.find("\"size\""), std::string::npos) << "nor are values that are the default";
    // In another folder, over itself.
    fs::create_directories(folder_ / "sub");
    EXPECT_EQ(weft("convert copy.json --out sub/sheet.json --quiet").out, "");
    EXPECT_EQ(read_file(folder_ / "sub/sheet.json"), text);
    fs::rename(folder_ / "sub/sheet.json", folder_ / "sheet.json");
    EXPECT_EQ(stats("--frames 3")["state_hash"], hash);
    EXPECT_EQ(weft("convert sheet.json --out sheet.json").status, 0);
    EXPECT_EQ(read_file(folder_ / "sheet.json"), text);
}

TEST_F(Cli, convert_says_what_is_wrong_and_leaves_nothing_behind) {
    expect_usage_error("convert sheet.json", "--out");
    expect_usage_error("convert sheet.json --out copy.yaml", "--out: must end in .json, got copy.yaml");
    expect_usage_error("convert nothing.json --out copy.json", "nothing.json: cannot be opened");
    write("wrong.json", R"({ "weft": 1, "cloths": [{ "fabrik": 1 }] })");
    expect_usage_error("convert wrong.json --out copy.json", "did you mean \"fabric\"?");
    const std::string before = read_file(folder_ / "sheet.json");
    expect_usage_error("convert sheet.json --out none/copy.json",
                       "none/copy.json: cannot be written: No such file or directory");
    for (const char* output : {"copy.json", "sheet.json"})
        EXPECT_EQ(weft("convert sheet.json --out " + std::string(output), "ulimit -f 0;").status, 1) << output;
    EXPECT_EQ(read_file(folder_ / "sheet.json"), before);
    for (const auto& entry : fs::directory_iterator(folder_)) {
        const std::string name = entry.path().filename();
        EXPECT_TRUE(name != "copy.json" && name.rfind(".weft", 0) != 0) << name;
    }
}

}  // namespace
