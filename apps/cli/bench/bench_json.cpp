#include "cli/bench/bench_report.h"

#include "io/scenes/json_reader.h"
#include "io/scenes/json_text.h"
#include "scene/problems.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>
#include <concepts>
#include <fstream>
#include <system_error>

namespace weft::cli {
namespace {

using Json = nlohmann::ordered_json;
using nlohmann::json;

constexpr std::uint64_t report_format = 1;

Json scene_json(const SceneFigures& scene) {
    const auto mean_max = [](const MeanMax& value) { return Json{{"mean", value.mean}, {"max", value.max}}; };
    Json constraints = Json::object(), stages = Json::object(), references = Json::object(), parts = Json::object();
    for (const ConstraintFigures& constraint : scene.constraints) {
        Json& out = constraints[constraint.name];
        out = {{"rows", constraint.rows},
               {"ns_per_row", constraint.ns_per_row},
               {"bytes_per_row", constraint.bytes_per_row},
               {"reference_ns_per_row", constraint.reference_ns_per_row}};
        if (const auto ratio = constraint.ratio()) out["ratio"] = *ratio;
    }
    for (const StageFigures& stage : scene.stages) {
        stages[stage.name] = stage.ms;
        references[stage.name] = stage.reference_ms;
    }
    for (const PartFigures& part : scene.build) parts[part.name] = part.ms;

    Json out;
    out["scene"] = scene.name;
    out["backend"] = scene.backend;
    out["device"] = scene.device;
    out["isa"] = scene.isa;
    out["threads"] = scene.threads;
    out["solver"] = scene.solver;
    out["substeps"] = scene.substeps;
    out["iterations"] = scene.iterations;
    out["frame_rate"] = scene.frame_rate;
    out["warmup"] = scene.warmup;
    out["frames"] = scene.frames;
    out["runs"] = scene.runs;
    out["timed_frames"] = scene.timed_frames;
    out["particles"] = scene.particles;
    out["triangles"] = scene.triangles;
    out["constraints"] = constraints;
    out["ms_per_frame"] = {
        {"median", scene.ms.median}, {"p95", scene.ms.p95}, {"min", scene.ms.min}, {"max", scene.ms.max}};
    out["run_medians_ms"] = scene.run_medians;
    if (const auto between_runs = spread(scene)) out["spread"] = *between_runs;
    out["reference_ms"] = scene.reference.ms;
    if (const auto ratio = scene.ratio()) out["ratio"] = *ratio;
    out["bytes_per_frame"] = scene.reference.bytes_per_frame;
    out["working_set_bytes"] = scene.reference.working_set;
    out["bytes_per_second"] = scene.reference.bandwidth;
    out["stage_ms"] = stages;
    out["stage_reference_ms"] = references;
    out["load_ms"] = scene.load_ms;
    out["build_ms"] = scene.build_ms;
    out["build_part_ms"] = parts;
    out["first_frame_ms"] = scene.first_frame_ms;
    out["quality_seconds"] = scene.quality_seconds;
    out["stretch"] = mean_max(scene.stretch);
    out["shear"] = mean_max(scene.shear);
    out["residual"] = mean_max(scene.residual);
    if (scene.bytes_per_particle) out["bytes_per_particle"] = *scene.bytes_per_particle;
    out["device_bytes_per_particle"] = scene.device_bytes_per_particle;
    out["reports"] = scene.reports;
    out["state_hash"] = scene.state_hash;
    return out;
}

Json edges_json(const EdgeFigures& edges) {
    Json out;
    out["scene"] = edges.name;
    out["triangles"] = edges.triangles;
    out["cpu_ms"] = edges.cpu_ms;
    out["device_ms"] = edges.wall_ms;
    out["device_work_ms"] = edges.device_ms;
    return out;
}

/// One object of a report. A value that is missing or has a wrong type is a problem and stays unchanged.
class Fields {
  public:
    Fields(const json& object, std::string pointer, Problems& problems)
        : object_(object), pointer_(std::move(pointer)), problems_(problems) {
        if (!object_.is_object()) problems_.add(pointer_, "must be an object, got " + json_text(object_));
    }

    void get(const char* key, std::string& to) {
        read(key, to, "a text", [](const json& v) { return v.is_string(); });
    }
    void get(const char* key, double& to) {
        read(key, to, "a number", [](const json& v) { return v.is_number(); });
    }
    void get(const char* key, std::uint64_t& to) {
        read(key, to, "a whole number ≥ 0", [](const json& v) { return v.is_number_unsigned(); });
    }
    void get(const char* key, std::vector<double>& to) {
        if (const json* list = array(key)) {
            for (std::size_t i = 0; i < list->size(); ++i) {
                const json& element = (*list)[i];
                if (element.is_number()) {
                    to.push_back(element.get<double>());
                } else {
                    problems_.add(at(at(pointer_, key), i), "must be a number, got " + json_text(element));
                }
            }
        }
    }
    void get(const char* key, MeanMax& to) {
        if (auto fields = object(key)) fields->get("mean", to.mean), fields->get("max", to.max);
    }

    bool has(const char* key) const { return object_.is_object() && object_.contains(key); }
    std::optional<Fields> object(const std::string& key) {
        const json* value = find(key);
        if (!value) return {};
        return Fields(*value, at(pointer_, key), problems_);
    }
    const json* array(const std::string& key) {
        const json* value = find(key);
        if (!value || value->is_array()) return value;
        problems_.add(at(pointer_, key), "must be a list, got " + json_text(*value));
        return nullptr;
    }
    std::vector<std::string> keys() const {
        std::vector<std::string> names;
        if (object_.is_object()) {
            for (const auto& [name, value] : object_.items()) names.push_back(name);
        }
        return names;
    }

  private:
    const json* find(const std::string& key) {
        if (!object_.is_object()) return nullptr;  // already reported
        const auto found = object_.find(key);
        if (found != object_.end()) return &*found;
        problems_.add(at(pointer_, key), "is missing");
        return nullptr;
    }
    template <class T>
    void read(const char* key, T& to, const std::string& kind, bool (*fits)(const json&)) {
        const json* value = find(key);
        if (!value) return;
        if (fits(*value)) {
            to = value->get<T>();
        } else {
            problems_.add(at(pointer_, key), "must be " + kind + ", got " + json_text(*value));
        }
    }

    const json& object_;
    std::string pointer_;
    Problems& problems_;
};

// Reads only what a comparison needs.
SceneFigures scene_of(Fields fields) {
    SceneFigures scene;
    fields.get("scene", scene.name);
    fields.get("backend", scene.backend);
    fields.get("device", scene.device);
    fields.get("isa", scene.isa);
    fields.get("threads", scene.threads);
    fields.get("solver", scene.solver);
    fields.get("substeps", scene.substeps);
    fields.get("iterations", scene.iterations);
    fields.get("frame_rate", scene.frame_rate);
    fields.get("warmup", scene.warmup);
    fields.get("frames", scene.frames);
    fields.get("runs", scene.runs);
    fields.get("particles", scene.particles);
    fields.get("triangles", scene.triangles);
    if (auto constraints = fields.object("constraints")) {
        for (const std::string& name : constraints->keys()) {
            ConstraintFigures& constraint = scene.constraints.emplace_back();
            constraint.name = name;
            if (auto figures = constraints->object(name)) {
                figures->get("rows", constraint.rows);
                figures->get("ns_per_row", constraint.ns_per_row);
            }
        }
    }
    if (auto ms = fields.object("ms_per_frame")) ms->get("median", scene.ms.median);
    if (fields.has("reference_ms")) fields.get("reference_ms", scene.reference.ms);
    fields.get("run_medians_ms", scene.run_medians);
    if (fields.has("quality_seconds")) {
        fields.get("quality_seconds", scene.quality_seconds);
    } else if (scene.frame_rate > 0) {  // older reports have no quality_seconds; it was this value
        scene.quality_seconds = std::min(static_cast<double>(scene.frames) / scene.frame_rate, 1.0);
    }
    fields.get("stretch", scene.stretch);
    fields.get("state_hash", scene.state_hash);
    return scene;
}

EdgeFigures edges_of(Fields fields) {
    EdgeFigures edges;
    fields.get("scene", edges.name);
    fields.get("triangles", edges.triangles);
    fields.get("cpu_ms", edges.cpu_ms);
    fields.get("device_ms", edges.wall_ms);
    fields.get("device_work_ms", edges.device_ms);
    return edges;
}

BenchReport report_of(const json& root, Problems& problems) {
    BenchReport report;
    if (!root.is_object() || !root.contains("weft_bench")) {
        problems.add("", "is not a report of weft bench");
        return report;
    }
    if (root["weft_bench"] != report_format) {
        problems.add("/weft_bench",
                     "must be " + std::to_string(report_format) + ", the format that this program writes");
        return report;
    }
    Fields fields(root, "", problems);
    fields.get("version", report.version);
    fields.get("compiler", report.compiler);
    fields.get("processor", report.processor);
    fields.get("hardware_threads", report.hardware_threads);
    if (const json* scenes = fields.array("scenes")) {
        for (std::size_t i = 0; i < scenes->size(); ++i) {
            report.scenes.push_back(scene_of(Fields((*scenes)[i], at("/scenes", i), problems)));
        }
    }
    if (const json* edges = fields.has("edges_and_hinges") ? fields.array("edges_and_hinges") : nullptr) {
        for (std::size_t i = 0; i < edges->size(); ++i)
            report.edges.push_back(edges_of(Fields((*edges)[i], at("/edges_and_hinges", i), problems)));
    }
    return report;
}

Result<std::string> read_text(const std::filesystem::path& path) {
    const std::string name = path.string();
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) return Error{name, "is a folder, not a report"};
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) return Error{name, "cannot be opened: " + std::generic_category().message(errno)};
    std::string text;
    char piece[1 << 14];
    while (file && text.size() <= max_json_bytes) {
        file.read(piece, sizeof piece);
        text.append(piece, static_cast<std::size_t>(file.gcount()));
    }
    if (file.bad()) return Error{name, "cannot be read"};
    return text;
}

}  // namespace

Json to_json(const BenchReport& report) {
    Json out;
    out["weft_bench"] = report_format;
    out["version"] = report.version;
    out["compiler"] = report.compiler;
    out["processor"] = report.processor;
    out["hardware_threads"] = report.hardware_threads;
    out["memory"] = {{"threads", report.memory.threads},
                     {"bytes", report.memory.bytes},
                     {"bytes_per_second", report.memory.bandwidth}};
    out["scenes"] = Json::array();
    for (const SceneFigures& scene : report.scenes) out["scenes"].push_back(scene_json(scene));
    for (const EdgeFigures& edges : report.edges) out["edges_and_hinges"].push_back(edges_json(edges));
    return out;
}

Result<BenchReport> read_report(const std::filesystem::path& file) {
    const auto text = read_text(file);
    if (!text) return text.errors();
    Problems problems;
    const auto root = parse_json(*text, problems);
    BenchReport report;
    if (root && problems.none()) report = report_of(*root, problems);
    if (!problems.none()) return std::move(problems).take(file.string());
    return report;
}

}  // namespace weft::cli
