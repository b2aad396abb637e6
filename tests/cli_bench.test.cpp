// weft bench: reports, comparisons and errors. Times are not tested.

#include "cli_fixture.h"

namespace {

namespace fs = std::filesystem;
using weft::Json;
using weft::Outcome;
using weft::read_file;

class CliBench : public weft::Cli {
  protected:
    Json bench(const std::string& arguments) {
        const Outcome outcome = weft("bench --quiet --warmup 2 --frames 5 --repeat 2 --json b.json " + arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
        EXPECT_EQ(outcome.out, "") << "--quiet";
        return Json::parse(read_file(folder_ / "b.json"));
    }
    Outcome compare(const std::string& arguments = "") {
        return weft("bench sheet.json --quiet --warmup 2 --frames 5 --repeat 2 --compare b.json " + arguments);
    }
};

// Labels: no-asan
TEST_F(CliBench, writes_every_figure) {
    const Json report = bench("sheet.json");
    EXPECT_EQ(report["weft_bench"], 1);
    for (const char* key : {"version", "compiler", "processor", "hardware_threads"}) EXPECT_TRUE(report.contains(key));
    ASSERT_EQ(report["scenes"].size(), 1u);
    const Json& s = report["scenes"][0];
    EXPECT_EQ(s["scene"], "sheet.json");
    EXPECT_EQ(s["backend"], "cpu");
    EXPECT_EQ(s["device"].get<std::string>().rfind(s["isa"].get<std::string>(), 0), 0u);
    EXPECT_EQ(s["threads"], 1);
    EXPECT_EQ(s["substeps"], 20);
    EXPECT_EQ(s["iterations"], 1);
    EXPECT_EQ(s["frame_rate"], 60);
    EXPECT_EQ(s["warmup"], 2);
    EXPECT_EQ(s["frames"], 5);
    EXPECT_EQ(s["runs"], 2);
    EXPECT_EQ(s["particles"], 120);
    EXPECT_EQ(s["triangles"], 2 * 11 * 9);
    EXPECT_EQ(s["constraints"].size(), 2u) << "no kind without rows";
    EXPECT_EQ(s["constraints"]["stretch"]["rows"], 11 * 10 + 12 * 9 + 11 * 9);
    EXPECT_EQ(s["constraints"]["moment"]["rows"], 11 * 8 + 10 * 9 + 11 * 9);
    for (const char* kind : {"stretch", "moment"}) EXPECT_GT(s["constraints"][kind]["ns_per_row"], 0);
    for (const char* key : {"median", "p95", "min", "max"}) EXPECT_GT(s["ms_per_frame"][key], 0);
    EXPECT_LE(s["ms_per_frame"]["min"], s["ms_per_frame"]["median"]);
    EXPECT_LE(s["ms_per_frame"]["p95"], s["ms_per_frame"]["max"]);
    EXPECT_EQ(s["run_medians_ms"].size(), 2u);
    EXPECT_GE(s["spread"], 0);
    for (const char* key : {"reference_ms", "ratio", "bytes_per_second"}) EXPECT_GT(s[key], 0);
    EXPECT_NEAR(s["ratio"], s["ms_per_frame"]["median"].get<double>() / s["reference_ms"].get<double>(), 1e-9);
    EXPECT_GT(report["memory"]["bytes_per_second"], 0);
    EXPECT_EQ(report["memory"]["threads"], 1);
    for (const char* stage : {"predict", "stretch", "moment", "contact", "velocities"})
        EXPECT_GT(s["stage_ms"][stage], 0);
    EXPECT_GT(s["load_ms"], 0);
    EXPECT_GT(s["first_frame_ms"], s["load_ms"]);
    EXPECT_GT(s["build_ms"], 0);
    EXPECT_LT(s["build_ms"], s["load_ms"]);
    EXPECT_EQ(s["build_part_ms"].size(), 7u);
    for (const char* part : {"topology", "rows", "coloring", "tables", "rest"}) EXPECT_GT(s["build_part_ms"][part], 0);
    EXPECT_NEAR(s["quality_seconds"], 7.0 / 60, 1e-9) << "all of a run that is shorter than 2 s";
    for (const char* key : {"stretch", "shear", "residual"}) {
        EXPECT_GT(s[key]["mean"], 0);
        EXPECT_LE(s[key]["mean"], s[key]["max"]);
    }
    EXPECT_EQ(s["reports"], Json::array());
    EXPECT_EQ(s["state_hash"], stats("--frames 7")["state_hash"]) << "what weft run comes to";
}

TEST_F(CliBench, averages_quality_over_the_last_two_seconds) {
    ASSERT_EQ(weft("bench sheet.json --quiet --substeps 1 --warmup 2 --seconds 3 --repeat 1 --json b.json").status, 0);
    const Json once = Json::parse(read_file(folder_ / "b.json"))["scenes"][0];
    EXPECT_NEAR(once["quality_seconds"], 2, 1e-9);
    // A longer warmup with fewer frames after it ends in the same state.
    const Outcome outcome =
        weft("bench sheet.json --substeps 1 --warmup 170 --frames 12 --repeat 1 --json b.json --compare b.json");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("% over the last 2.00 s"), std::string::npos) << outcome.out;
    const Json again = Json::parse(read_file(folder_ / "b.json"))["scenes"][0];
    for (const char* key : {"stretch", "shear", "residual", "quality_seconds"}) EXPECT_EQ(again[key], once[key]) << key;

    // A report of an older version, which lacks this key.
    Json former = bench("sheet.json --substeps 1");
    former["scenes"][0].erase("quality_seconds");
    write("b.json", former.dump());
    const std::string text = compare("--substeps 1").out;
    EXPECT_NE(text.find("seconds of stretch 0.12 (before 0.08)"), std::string::npos) << text;
}

TEST_F(CliBench, counts_the_bytes_that_a_frame_moves) {
    const auto scene = [&](const std::string& arguments) { return bench("sheet.json " + arguments)["scenes"][0]; };
    const auto per_row = [](const Json& s, const char* kind) {
        return s["constraints"][kind]["bytes_per_row"].get<double>();
    };
    // Row by row, no two rows of a batch share a particle: indices, fields, and particles in and out. A few rows that
    // have found no batch may.
    const std::string plain = "--no-hierarchy --projection ";
    const Json rows = scene(plain + "gauss-seidel");
    EXPECT_DOUBLE_EQ(per_row(rows, "stretch"), 2 * 4 + 4 * 4 + 2 * 16 * 2);
    // The multiplier is written, and two shifts of the rest angle are read. Then the coupling with four others reads
    // them and moves the shifts.
    const double of_moment = 4 * 4 + 4 * 4 + 4 * 16 * 2 + 3 * 4 + (4 + 7 + 1 + 2 + 2) * 4;
    EXPECT_NEAR(per_row(rows, "moment"), of_moment, 0.5);
    // Of two iterations the first writes lambda and the second reads and writes it.
    EXPECT_DOUBLE_EQ(per_row(scene(plain + "gauss-seidel --iterations 2"), "stretch"), 88 + 4 * 3 / 2.0);
    // Side by side, a share and corrections are added; particles are read once and not moved.
    const double corrections = 2 * 4 + 4 * 4 + 4 + 2 * 16;
    EXPECT_DOUBLE_EQ(per_row(scene(plain + "jacobi"), "stretch"), corrections + 120 * 16 / (11 * 10 + 12 * 9 + 99.0));
    // Along a line, rows share the particles between them.
    const Json lines = scene("");
    EXPECT_GT(per_row(lines, "stretch"), 2 * 4 + 4 * 4 + 16 * 2);
    EXPECT_LT(per_row(lines, "stretch"), 88 - 20);

    // A frame: 20 times what moves particles, what is between them and what they may touch; then damping and normals.
    // The velocities of all substeps but the last are one pass with the next prediction.
    const double moves = 120 * 16 * (8 + 6 / 20.0 + 2), all_rows = 317 * 88.0 + 277 * of_moment;
    const double damping = 317 * (24 + 2 * 48) + 277 * (32 + 4 * 48);
    const double surface = 4 * (198 * (12 + 16) + 120 * 16) + 198 * 16;  // smooth_faces reads triangles too
    const double expected = 20 * (moves + all_rows) + damping + surface;
    EXPECT_NEAR(rows["bytes_per_frame"], expected, 0.001 * expected);
    EXPECT_DOUBLE_EQ(rows["working_set_bytes"], 120 * 64 + 317 * 24 + 277 * (32 + 4 + (4 + 7 + 2) * 4));
    for (const char* stage : {"predict", "stretch", "moment", "contact", "velocities", "damp", "surface"})
        EXPECT_GT(rows["stage_reference_ms"][stage], 0) << stage;
}

TEST_F(CliBench, takes_options_and_several_scenes) {
    fs::copy(folder_ / "sheet.json", folder_ / "other.json");
    const Json report = bench("sheet.json other.json --threads 2 --substeps 10 --iterations 2 --isa scalar");
    ASSERT_EQ(report["scenes"].size(), 2u);
    EXPECT_EQ(report["scenes"][1]["scene"], "other.json");
    EXPECT_EQ(report["scenes"][0]["state_hash"], report["scenes"][1]["state_hash"]);
    for (const Json& s : report["scenes"]) {
        EXPECT_EQ(s["threads"], 2);
        EXPECT_EQ(s["substeps"], 10);
        EXPECT_EQ(s["iterations"], 2);
        EXPECT_EQ(s["isa"], "scalar");
    }
}

TEST_F(CliBench, prints_tables_and_has_scenes_of_its_own) {
    const Outcome outcome = weft("bench --frames 1 --warmup 0 --repeat 1 --substeps 1");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const char* text : {"sheet 32 ", "sheet 64 ", "sheet 128 ", "sheet 256 ", "65536", "median", "state hash"}) {
        EXPECT_NE(outcome.out.find(text), std::string::npos) << text << " in\n" << outcome.out;
    }
    EXPECT_NE(outcome.err.find("measuring sheet 256 2/2"), std::string::npos) << outcome.err;
    EXPECT_NE(weft("bench --help").out.find("Examples:"), std::string::npos);
}

TEST_F(CliBench, builds_sheets_with_tethers_and_coarse_levels) {
    const Json report = bench("--build 20 33");
    ASSERT_EQ(report["scenes"].size(), 2u);
    EXPECT_EQ(report["scenes"][0]["scene"], "build 20");
    EXPECT_EQ(report["scenes"][1]["particles"], 33 * 33);
    EXPECT_EQ(report["scenes"][1]["constraints"]["tether"]["rows"], 2 * (33 * 33 - 2));
    for (const Json& s : report["scenes"]) {
        for (const char* part : {"topology", "tethers", "hierarchy"}) EXPECT_GT(s["build_part_ms"][part], 0);
        EXPECT_GT(s["stage_ms"]["hierarchy"], 0);
    }
    expect_usage_error("bench --build 4", "--build: must be from 8 to 2048, got 4");
}

#ifdef WEFT_VULKAN
TEST_F(CliBench, finds_edges_on_vulkan_too) {
    const Outcome outcome = weft("bench --backend vulkan --build 20 33 --frames 1 --warmup 0 --repeat 1 --substeps 1");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::size_t table = outcome.out.find("\nms for edges and hinges ");
    ASSERT_NE(table, std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("\nbuild 20 ", table), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find(" 2048 ", table), std::string::npos) << "triangles of 33 x 33\n" << outcome.out;
    EXPECT_EQ(weft("bench --backend cpu --build 20 --frames 1 --warmup 0 --repeat 1").out.find("edges and hinges"),
              std::string::npos);
}

// Labels: no-asan
TEST_F(CliBench, writes_and_compares_what_vulkan_takes) {
    const std::string build = " --build 20 33 --substeps 1 --backend ";
    const Json report = bench(build + "vulkan");
    ASSERT_EQ(report["edges_and_hinges"].size(), 2u);
    const Json& edges = report["edges_and_hinges"][1];
    EXPECT_EQ(edges["scene"], "build 33");
    EXPECT_EQ(edges["triangles"], 2 * 32 * 32);
    for (const char* key : {"cpu_ms", "device_ms"}) EXPECT_GT(edges[key], 0) << key;
    EXPECT_LE(edges["device_work_ms"], edges["device_ms"]);
    for (const Json& s : report["scenes"]) {
        EXPECT_GT(s["device_bytes_per_particle"], 64) << "blocks of four floats";
        EXPECT_GT(s["constraints"]["stretch"]["bytes_per_row"], 20);
        EXPECT_EQ(s["reference_ms"], 0) << "the processor's says nothing of a device";
        EXPECT_FALSE(s.contains("ratio"));
    }

    const auto compared = [&](const std::string& backend) {
        const Outcome outcome =
            weft("bench --quiet --warmup 2 --frames 5 --repeat 2 --compare b.json" + build + backend);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome.out;
    };
    const std::string again = compared("vulkan"), on_cpu = compared("cpu");
    const std::size_t table = again.find("\nedges and hinges, now / before ");
    ASSERT_NE(table, std::string::npos) << again;
    EXPECT_NE(again.find("\nbuild 33 ", table), std::string::npos) << again;
    EXPECT_EQ(on_cpu.find("edges and hinges"), std::string::npos) << on_cpu;
    EXPECT_NE(on_cpu.find("settings differ: backend cpu (before vulkan)"), std::string::npos) << on_cpu;

    Json broken = report;
    broken["edges_and_hinges"][0].erase("cpu_ms");
    write("b.json", broken.dump());
    expect_usage_error("bench --build 20 --backend cpu --compare b.json", "/edges_and_hinges/0/cpu_ms");
    const Json plain = bench(build + "cpu");
    EXPECT_FALSE(plain.contains("edges_and_hinges"));
    EXPECT_EQ(plain["scenes"][0]["device_bytes_per_particle"], 0);
}
#endif

// Labels: no-asan
TEST_F(CliBench, compares_with_a_former_report) {
    bench("sheet.json");
    const Outcome same = compare();
    EXPECT_EQ(same.status, 0) << same.err;
    EXPECT_EQ(same.out.rfind("compared with b.json\nratios are now / before ", 0), 0u) << same.out;
    EXPECT_NE(same.out.find("\nsheet.json "), std::string::npos) << same.out;
    EXPECT_NE(same.out.find(" 1.000 "), std::string::npos) << "the stretch of both\n" << same.out;
    EXPECT_NE(same.out.find("settings, scenes and results are the same"), std::string::npos) << same.out;

    EXPECT_NE(same.out.find("x reference now"), std::string::npos) << same.out;
    const std::string threads = compare("--threads 2").out;
    EXPECT_NE(threads.find("sheet.json: settings differ: threads 2 (before 1)\n"), std::string::npos) << threads;
    EXPECT_EQ(threads.find("result differs"), std::string::npos) << threads;
    const std::string finer = compare("--substeps 40").out;
    EXPECT_NE(finer.find("settings differ: substeps 40 (before 20)\n"), std::string::npos) << finer;
    EXPECT_NE(finer.find("sheet.json: the result differs: state "), std::string::npos) << finer;

    // The report replaces the file that it is compared with.
    EXPECT_EQ(compare("--json b.json").status, 0);
    fs::rename(folder_ / "sheet.json", folder_ / "new.json");
    const Outcome other = weft("bench new.json --quiet --frames 1 --compare b.json");
    EXPECT_EQ(other.status, 0) << other.err;
    EXPECT_NE(other.out.find("new.json: nothing to compare with: not in b.json"), std::string::npos) << other.out;
    EXPECT_NE(other.out.find("sheet.json: not measured now: in b.json only"), std::string::npos) << other.out;
}

TEST_F(CliBench, refuses_what_is_no_report) {
    const auto refused = [&](const std::string& text, const std::string& says) {
        write("b.json", text);
        expect_usage_error("bench sheet.json --compare b.json", "b.json: " + says);
    };
    refused("no report", "line 1, column 2: ");
    refused("", "is empty");
    refused("[1, 2]", "is not a report of weft bench");
    refused(R"({ "frames": 3 })", "is not a report of weft bench");
    refused(R"({ "weft_bench": 2 })", "/weft_bench: must be 1");
    expect_usage_error("bench sheet.json --compare nowhere.json", "nowhere.json: cannot be opened: No such file");
    expect_usage_error("bench sheet.json --compare .", ".: is a folder");

    Json report = bench("sheet.json");
    report["scenes"][0]["ms_per_frame"]["median"] = "fast";
    refused(report.dump(), "/scenes/0/ms_per_frame/median: must be a number, got \"fast\"");
    report["scenes"][0] = 7;
    refused(report.dump(), "/scenes/0: must be an object, got ");
    report["scenes"] = Json::object();
    refused(report.dump(), "/scenes: must be a list, got ");
    report.erase("scenes");
    refused(report.dump(), "/scenes: is missing");
}

TEST_F(CliBench, wrong_usage_is_one_line_and_status_2) {
    expect_usage_error("bench nowhere.json", "nowhere.json");
    expect_usage_error("bench sheet.json nowhere.json", "nowhere.json");
    expect_usage_error("bench --threads 0", "threads: must be from 1 to 256, got 0");
    expect_usage_error("bench sheet.json --isa mmx", "instruction set 'mmx'");
    expect_usage_error("bench sheet.json --repeat 0", "--repeat: must be from 1 to 1000, got 0");
    expect_usage_error("bench sheet.json --warmup 1000001", "--warmup: must be from 0 to 1000000");
    expect_usage_error("bench sheet.json --warmup -1", "--warmup");
    expect_usage_error("bench sheet.json --frames 0", "--frames: must give 1 to 1000000 frames, got 0");
    expect_usage_error("bench sheet.json --frames 5 --seconds 1", "--frames");
    expect_usage_error("bench sheet.json --json nowhere/b.json", "nowhere/b.json");
}

}  // namespace
