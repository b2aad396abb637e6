#include "cli/run/stats.h"

#include "io/files/atomic_file.h"
#include "scene/check.h"
#include "scene/nearest_name.h"
#include "scene/scene_keys.h"
#include "solver/measures/pieces.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace weft::cli {
namespace {

using Json = nlohmann::ordered_json;

Json mean_max(MeanMax value) {
    return {{"mean", value.mean}, {"max", value.max}};
}

Json axes(Vec3 v) {
    return Json::array({v.x, v.y, v.z});
}

// Whether all of its contact is recorded: contact with its triangles is not.
bool is_complete(const World& world, const Collider& collider) {
    return std::ranges::all_of(world.frame().cloths,
                               [&](const ClothFrame& cloth) { return shape_acts_on(collider, *cloth.model); });
}

// Of the last frame.
Json loads(const World& world) {
    Json list = Json::array();
    const ContactForces& contact_forces = world.contact_forces();
    for (std::size_t i = 0; i < contact_forces.colliders.size(); ++i) {
        const ColliderForce& load = contact_forces.colliders[i];
        list.push_back({{"name", world.collider(load.collider).name},
                        {"force", axes(load.force)},
                        {"torque", axes(load.torque)},
                        {"contacts", load.contacts},
                        {"complete", is_complete(world, world.collider(load.collider))}});
    }
    return list;
}

// `frame`: in which the penetration was measured.
Json deepest_place(const World& world, const Frame& names, const Penetration& penetration, std::uint64_t frame) {
    Json place = {{"frame", frame}, {"max", penetration.max}, {"count", penetration.count}};
    place["collider"] = nullptr, place["cloth"] = nullptr, place["position"] = nullptr;
    if (penetration.collider < world.colliders().size() && penetration.cloth < names.cloths.size()) {
        place["collider"] = world.colliders()[penetration.collider].name;
        place["cloth"] = names.cloths[penetration.cloth].model->name;
        place["position"] = axes(penetration.place);
    }
    return place;
}

Json passages_of(const World& world, const Frame& names, const Passages& passages) {
    Json json = {{"count", passages.count}, {"points", passages.points}, {"first", nullptr}};
    if (passages.first) {
        const Passages::Place& first = *passages.first;
        json["first"] = {{"frame", first.frame},
                         {"collider", world.colliders()[first.collider].name},
                         {"cloth", names.cloths[first.cloth].model->name},
                         {"position", axes(first.place)}};
    }
    return json;
}

Json place_json(const TensionSummary::Place& place, const Frame& names) {
    return {{"max", place.value}, {"cloth", names.cloths[place.at.cloth].model->name}, {"particle", place.at.particle}};
}

Json worst_json(const WorstTension& worst, const Frame& names) {
    if (!worst.place) return nullptr;
    Json json = {{"frame", worst.frame}};
    json.update(place_json(*worst.place, names));
    return json;
}

// Null where there is nothing to measure: inextensible cloth has no tension, and cloth without limits no load.
Json tension_json(const TensionSummary& last, const WorstTension& tension, const WorstTension& load,
                  const Frame& names) {
    Json json = {{"mean", nullptr}, {"max", nullptr}, {"cloth", nullptr}, {"particle", nullptr}};
    if (last.most) json.update(place_json(*last.most, names));
    if (last.mean) json["mean"] = *last.mean;
    json["worst"] = worst_json(tension, names);
    json["load"] = nullptr;
    if (last.load) {
        json["load"] = place_json(*last.load, names);
        json["load"]["worst"] = worst_json(load, names);
    }
    return json;
}

// Which part of the stretch the solver has not solved, and how many substeps would leave a tenth: the excess falls as
// 1/n^1.7 with n substeps (physics/tear/tear.md). Null if no cloth tears by itself.
Json unsolved_json(const World& world, const Frame& frame, const ClothMeasures& measures) {
    constexpr double wanted_part = 0.1, falls_as = 1.7;
    const auto tears = [](const ClothFrame& cloth) { return cloth.model->tear_law != nullptr; };
    if (std::ranges::none_of(frame.cloths, tears) || !(measures.strain.stretch.mean > 0)) return nullptr;
    const double part = std::min(measures.residual.mean / measures.strain.stretch.mean, 1.0);
    const double more = std::pow(std::max(part / wanted_part, 1.0), 1 / falls_as);
    return {{"part", part}, {"substeps", std::ceil(world.settings().solver.substeps * more)}};
}

// Particles that the cloth with the least room can still gain by tearing and cuts; null if no cloth can part.
Json tear_room(const Frame& frame) {
    Json least = nullptr;
    for (const ClothFrame& cloth : frame.cloths)
        if (cloth.model->tears && (least.is_null() || cloth.model->reserve < least.get<std::uint32_t>()))
            least = cloth.model->reserve;
    return least;
}

// The value that 99 % of the edges along warp and weft do not exceed. JSON shows a NaN as null.
double stretch_percentile(const Frame& frame, bool finite) {
    if (!finite) return std::nan("");
    std::vector<double> stretch;
    for (const ClothFrame& cloth : frame.cloths) collect_stretch(*cloth.model, cloth.positions, stretch);
    std::ranges::sort(stretch);
    return percentile(stretch, 0.99);
}

}  // namespace

double percentile(const std::vector<double>& sorted, double fraction) {
    if (sorted.empty()) return 0;
    const auto rank = static_cast<std::size_t>(std::ceil(fraction * static_cast<double>(sorted.size())));
    return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

double median(const std::vector<double>& sorted) {
    if (sorted.empty()) return 0;
    const std::size_t half = sorted.size() / 2;
    return sorted.size() % 2 ? sorted[half] : 0.5 * (sorted[half - 1] + sorted[half]);
}

double median_of(std::vector<double> values) {
    std::ranges::sort(values);
    return median(values);
}

Result<CountCrossings> read_crossings(const std::string& word) {
    constexpr std::array<std::string_view, 2> names = {"last", "every"};
    if (word == names[0]) return CountCrossings::last;
    if (word == names[1]) return CountCrossings::every;
    return Error{"--crossings", "must be " + alternatives(names) + ", got " + in_quotes(word)};
}

RunStatistics::RunStatistics(const SceneWorld& session, std::uint64_t frames, CountCrossings crossings,
                             MeasurePenetration penetration)
    : frame_seconds_(session.frame_seconds()),
      count_crossings_(crossings),
      measure_penetration_(penetration),
      order_(sheet_poses(session.world().frame())) {
    const double last_second = std::min(static_cast<double>(frames), 1 / frame_seconds_);
    snapshot_frame_ = frames - static_cast<std::uint64_t>(last_second + 0.5);
    if (snapshot_frame_ == 0) snapshot_ = positions_of(session.world().frame());
    step_ms_.reserve(frames);
    if (measure_penetration_ == MeasurePenetration::every)
        passages_.add(session.world().frame(), session.world().colliders());
}

void WorstTension::add(const std::optional<TensionSummary::Place>& of_frame, std::uint64_t index) {
    if (!of_frame || (place && !(of_frame->value > place->value))) return;
    place = of_frame;
    frame = index;
}

void RunStatistics::add_tension(const Frame& frame) {
    tension_ = tension_meter_.measure(frame);
    worst_tension_.add(tension_->most, frame.index);
    worst_load_.add(tension_->load, frame.index);
}

void RunStatistics::add(const World& world) {
    const Frame& frame = world.summary();
    step_ms_.push_back(frame.step_ms);
    for (std::uint32_t stage = 0; stage < stage_count; ++stage) stage_ms_[stage] += frame.stage_ms[stage];
    reports_ |= frame.reports;
    cloth_contacts_.add(frame.cloth_contacts);
    if (!tangled_at_ && frame.tangled_at) {
        tangled_at_ = frame.tangled_at;
        tangled_frame_ = frame.index;
    }
    if (count_crossings_ == CountCrossings::every) {
        crossings_ = count_intersections(world.frame(), world.colliders());
        worst_crossings_ = std::max(worst_crossings_, crossings_->triangles);
        order_.add(sheet_poses(world.frame()));
    }
    if (measure_penetration_ == MeasurePenetration::every) {
        penetration_ = penetration_search_.measure(world.frame(), world.colliders());
        if (penetration_->max > worst_penetration_.max) {
            worst_penetration_ = *penetration_;
            worst_penetration_frame_ = frame.index;
        }
        passages_.add(world.frame(), world.colliders());
        add_tension(world.frame());
    }
    if (frame.index == snapshot_frame_) {
        snapshot_ = positions_of(world.frame());
        snapshot_time_ = frame.time;
    }
}

double RunStatistics::mean_speed(const Frame& frame) const {
    const double elapsed = frame.time - snapshot_time_;
    return elapsed > 0 ? mean_displacement(snapshot_, frame) / elapsed : 0;
}

// Between the start and the last frame, a sheet may have gone around another one. So only those that lie on each other
// count.
std::size_t RunStatistics::order_lost(const Frame& frame) const {
    if (count_crossings_ == CountCrossings::every) return order_.lost();
    SheetOrder order = order_;
    order.add(sheet_poses(frame), stack_distance(frame));
    return order.lost();
}

// null if there are none.
Json bodies_json(const World& world) {
    std::size_t count = 0;
    std::array<double, 3> momentum{}, angular{};
    double energy = 0, fastest = 0;
    for (const Collider& collider : world.colliders()) {
        if (!collider.body) continue;
        const BodyMass& mass = collider.body->mass;
        const BodyState& state = collider.body->state;
        const std::array<double, 3> x{state.place.x, state.place.y, state.place.z};
        const std::array<double, 3> v{state.velocity.x, state.velocity.y, state.velocity.z};
        const std::array<double, 3> spin{state.spin.x, state.spin.y, state.spin.z};
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
            momentum[i] += double{mass.mass} * v[i];
            angular[i] += double{mass.mass} * (x[j] * v[k] - x[k] * v[j]) + spin[i];
        }
        energy += kinetic_energy(state, mass);
        fastest = std::max(fastest, std::hypot(v[0], v[1], v[2]));
        ++count;
    }
    if (count == 0) return nullptr;
    return {{"count", count},
            {"momentum", momentum},
            {"angular_momentum", angular},
            {"kinetic_energy", energy},
            {"max_speed", fastest}};
}

Json RunStatistics::gather(const SceneWorld& session, const std::string& scene_file) const {
    const World& world = session.world();
    const Frame& frame = world.frame();
    std::uint64_t particles = 0, triangles = 0;
    Json constraints = Json::object();
    for (const ClothFrame& cloth : frame.cloths) {
        particles += cloth.model->particle_count;
        triangles += cloth.triangles.size();
        for (const ConstraintTable& table : cloth.model->constraints) {
            const std::string name(constraint_info(table.kind).name);
            constraints[name] = constraints.value(name, std::uint64_t{0}) + table.rows;
        }
    }
    std::vector<double> sorted = step_ms_;
    std::sort(sorted.begin(), sorted.end());
    // Without a frame there is no time per frame and no displacement: null.
    const bool stepped = !step_ms_.empty();
    Json per_frame, stages, mean_speed_of_end;
    if (stepped) {
        per_frame = {{"median", median(sorted)}, {"p95", percentile(sorted, 0.95)}, {"max", percentile(sorted, 1)}};
        const auto frames = static_cast<double>(step_ms_.size());
        for (std::uint32_t stage = 0; stage < stage_count; ++stage)
            stages[std::string(stage_name(stage))] = stage_ms_[stage] / frames;
        mean_speed_of_end = mean_speed(frame);
    }
    const ClothMeasures measures = world.measure();
    const Penetration penetration =
        penetration_ ? *penetration_ : penetration_search_.measure(frame, world.colliders());
    const bool worst_before = worst_penetration_.max > penetration.max;
    const TensionSummary tension = tension_ ? *tension_ : TensionMeter().measure(frame);
    WorstTension worst_tension = worst_tension_, worst_load = worst_load_;
    worst_tension.add(tension.most, frame.index);
    worst_load.add(tension.load, frame.index);
    const Intersections crossings = crossings_ ? *crossings_ : count_intersections(frame, world.colliders());

    Json stats;
    stats["scene"] = scene_file;
    stats["backend"] = world.backend().name();
    stats["device"] = world.backend().device();
    stats["threads"] = world.backend().threads();
    stats["solver"] = solver_text(world.settings());
    stats["substeps"] = world.settings().solver.substeps;
    stats["iterations"] = world.settings().solver.iterations;
    stats["frames"] = step_ms_.size();
    stats["particles"] = particles;
    stats["triangles"] = triangles;
    stats["constraints"] = constraints;
    stats["ms_per_frame"] = per_frame;
    stats["stage_ms"] = stages;
    stats["stretch"] = mean_max(measures.strain.stretch);
    stats["stretch"]["p99"] = stretch_percentile(frame, measures.finite);
    stats["shear"] = mean_max(measures.strain.shear);
    stats["residual"] = {{"mean", measures.residual.mean}, {"max", measures.residual.max}};
    stats["tension"] = tension_json(tension, worst_tension, worst_load, frame);
    stats["tear_room"] = tear_room(frame);
    stats["unsolved"] = unsolved_json(world, frame, measures);
    stats["kinetic_energy"] = measures.kinetic_energy;
    stats["mean_speed"] = mean_speed_of_end;
    stats["max_speed"] = measures.max_speed;
    stats["bodies"] = bodies_json(world);
    stats["penetration"] = {
        {"max", penetration.max},
        {"at_most", penetration.at_most},
        {"count", penetration.count},
        {"samples", penetration.samples},
        {"worst", worst_before ? deepest_place(world, frame, worst_penetration_, worst_penetration_frame_)
                               : deepest_place(world, frame, penetration, frame.index)}};
    stats["passed"] = passages_of(world, frame, passages_.passages());
    if (world.settings().contact_forces) stats["colliders"] = loads(world);
    stats["self_contacts"] = cloth_contacts_.contacts;
    stats["searches"] = cloth_contacts_.searches;
    stats["limited"] = cloth_contacts_.limited;
    stats["tangled"] = cloth_contacts_.tangled;
    stats["tangled_first"] = nullptr;
    if (tangled_at_) {
        stats["tangled_first"] = {{"frame", tangled_frame_},
                                  {"cloth", frame.cloths[tangled_at_->cloth].model->name},
                                  {"particle", tangled_at_->particle}};
    }
    stats["intersections"] = {{"triangles", crossings.triangles},
                              {"edges", crossings.edges},
                              {"worst", std::max(worst_crossings_, crossings.triangles)},
                              {"order_lost", order_lost(frame)}};
    const Pieces pieces = find_pieces(frame);
    stats["torn_edges"] = pieces.torn_edges;
    stats["pieces"] = pieces.count;
    stats["smallest_piece"] = nullptr;
    if (pieces.count > 0)
        stats["smallest_piece"] = {{"cloth", frame.cloths[pieces.smallest.cloth].model->name},
                                   {"triangles", pieces.smallest.triangles},
                                   {"part", pieces.smallest.part}};
    stats["reports"] = report_names(reports_);
    stats["state_hash"] = world.state_hash();
    stats["finite"] = measures.finite;
    return stats;
}

std::string solver_text(const WorldSettings& settings) {
    const auto name = [](std::string_view key, auto value) {
        const auto names = choice_names(*std::ranges::find(solver_keys, key, &Parameter::key));
        return std::string(names[static_cast<std::size_t>(value)]);
    };
    const Projection projection = resolve(settings.solver.projection, settings.solver.method);
    return name("method", settings.solver.method) + ", " + name("projection", projection) +
           (projection == Projection::jacobi ? " by " + name("accumulate", settings.solver.accumulate) : "") +
           (settings.solver.hierarchy ? ", hierarchy" : "");
}

Result<void> write_stats(const Json& stats, const std::filesystem::path& file) {
    return write_atomically(file, [&](AtomicFile& out) { return out.write(stats.dump(2) + '\n'); });
}

void print_summary(const Json& s) {
    const auto number = [&](const char* group, const char* key) { return s[group][key].get<double>(); };
    std::printf("%llu frames of %llu particles, %llu triangles on %s (%s, %u thread%s)\n",
                s["frames"].get<unsigned long long>(), s["particles"].get<unsigned long long>(),
                s["triangles"].get<unsigned long long>(), s["backend"].get<std::string>().c_str(),
                s["device"].get<std::string>().c_str(), s["threads"].get<unsigned>(),
                s["threads"].get<unsigned>() == 1 ? "" : "s");
    const bool stepped = s["frames"].get<std::uint64_t>() > 0;
    if (stepped)
        std::printf("  ms per frame  median %.3f, p95 %.3f, max %.3f (%u substeps of %u)\n",
                    number("ms_per_frame", "median"), number("ms_per_frame", "p95"), number("ms_per_frame", "max"),
                    s["substeps"].get<unsigned>(), s["iterations"].get<unsigned>());
    std::printf("  stretch       mean %.3f %%, p99 %.3f %%, max %.3f %%\n", 100 * number("stretch", "mean"),
                100 * number("stretch", "p99"), 100 * number("stretch", "max"));
    std::printf("  residual      mean %.3f %%, max %.3f %%\n", 100 * number("residual", "mean"),
                100 * number("residual", "max"));
    if (const Json& tension = s["tension"]; !tension["max"].is_null()) {
        std::printf("  tension       mean %.3g N/m, max %.3g N/m", tension["mean"].get<double>(),
                    tension["max"].get<double>());
        if (const Json& load = tension["load"]; !load.is_null())
            std::printf(", at most %.3g of the strength, in cloth '%s'", load["max"].get<double>(),
                        load["cloth"].get<std::string>().c_str());
        std::printf("\n");
    }
    if (const Json& unsolved = s["unsolved"]; !unsolved.is_null() && unsolved["part"].get<double>() > 0.1)
        std::printf(
            "  warning       %.0f %% of the stretch is unsolved and counts as load; about %.0f substeps leave 10 %%\n",
            100 * unsolved["part"].get<double>(), unsolved["substeps"].get<double>());
    // An opening inside the cloth can need three particles.
    if (const Json& room = s["tear_room"]; !room.is_null() && room.get<std::uint32_t>() < 3)
        std::printf("  warning       a cloth has no room for more particles, so it tears no further\n");
    if (const auto torn = s["torn_edges"].get<unsigned long long>(); torn > 0) {
        const Json& smallest = s["smallest_piece"];
        std::printf("  torn          %llu edges, %llu pieces, the smallest of %llu triangles (%.3g %% of '%s')\n", torn,
                    s["pieces"].get<unsigned long long>(), smallest["triangles"].get<unsigned long long>(),
                    100 * smallest["part"].get<double>(), smallest["cloth"].get<std::string>().c_str());
    }
    std::printf("  penetration   max %.3g mm", 1000 * number("penetration", "max"));
    if (const Json& worst = s["penetration"]["worst"]; !worst["collider"].is_null())
        std::printf(", worst %.3g mm in frame %llu, in collider '%s'", 1000 * worst["max"].get<double>(),
                    worst["frame"].get<unsigned long long>(), worst["collider"].get<std::string>().c_str());
    std::printf("\n");
    if (const Json& first = s["passed"]["first"]; !first.is_null())
        std::printf("  passed        %llu times, first in frame %llu: cloth '%s' and collider '%s'\n",
                    s["passed"]["count"].get<unsigned long long>(), first["frame"].get<unsigned long long>(),
                    first["cloth"].get<std::string>().c_str(), first["collider"].get<std::string>().c_str());
    if (stepped) std::printf("  mean speed    %.3g m/s\n", s["mean_speed"].get<double>());
    const auto count = [&](const char* key) { return s[key].get<unsigned long long>(); };
    if (count("searches") > 0)
        std::printf("  self contact  %llu contacts, %llu searches, %llu limited, %llu tangled\n",
                    count("self_contacts"), count("searches"), count("limited"), count("tangled"));
    if (const Json& first = s["tangled_first"]; !first.is_null())
        std::printf("  tangled       first in frame %llu, at particle %u of cloth '%s'\n",
                    first["frame"].get<unsigned long long>(), first["particle"].get<unsigned>(),
                    first["cloth"].get<std::string>().c_str());
    if (const auto worst = s["intersections"]["worst"].get<unsigned long long>(); worst > 0)
        std::printf("  crossings     %llu pairs of triangles, at most %llu in a counted frame\n",
                    s["intersections"]["triangles"].get<unsigned long long>(), worst);
    if (const auto lost = s["intersections"]["order_lost"].get<unsigned long long>(); lost > 0)
        std::printf("  order lost    %llu pair%s of cloths: one passed through the other\n", lost,
                    lost == 1 ? "" : "s");
    if (s.contains("colliders")) {
        for (const Json& load : s["colliders"]) {
            const auto axis = [&](const char* of, std::size_t k) { return load[of][k].get<double>(); };
            std::printf("  on %-10s force %.3g, %.3g, %.3g N, torque %.3g, %.3g, %.3g N m, %u contacts%s\n",
                        load["name"].get<std::string>().c_str(), axis("force", 0), axis("force", 1), axis("force", 2),
                        axis("torque", 0), axis("torque", 1), axis("torque", 2), load["contacts"].get<unsigned>(),
                        load["complete"].get<bool>() ? "" : "; contact with its triangles is not counted");
        }
    }
    std::string reports;
    for (const Json& report : s["reports"]) reports += (reports.empty() ? "" : ", ") + report.get<std::string>();
    if (!reports.empty()) std::printf("  reports       %s\n", reports.c_str());
    std::printf("  state hash    %s\n", s["state_hash"].get<std::string>().c_str());
}

}  // namespace weft::cli
