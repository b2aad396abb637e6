#include "editor/view/view_thread.h"

#include "editor/view/enlarge.h"
#include "editor/view/outline.h"
#include "editor/view/view_quality.h"
#include "io/images/pictures_beside.h"
#include "solver/world/collider_mesh.h"
#include "view/scene_view.h"
#include "vulkan/interop.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <array>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace weft::editor {
namespace {

using Clock = std::chrono::steady_clock;

bool contains(const std::vector<std::string>& names, const std::string& name) {
    return std::ranges::find(names, name) != names.end();
}

// Index of the first quality on a processor: it shows something soon.
constexpr std::size_t begin_without_gpu = 3;

/// The frame of a square on a plane, around the point that the camera looks at.
void add_plane(Coverage& coverage, const Collider& plane, const Camera& camera) {
    const Vec3 normal = plane.pose.rotation * Vec3{plane.numbers[0], plane.numbers[1], plane.numbers[2]};
    const float offset = plane.numbers[3] + dot(normal, plane.pose.position);
    const Vec3 middle = camera.target + normal * (offset - dot(normal, camera.target));
    const Vec3 x = normalized(cross(std::abs(normal.z) < 0.9f ? Vec3{0, 0, 1} : Vec3{1, 0, 0}, normal));
    const Vec3 y = cross(normal, x);
    const float outer = 0.5f * length(camera.position - camera.target), inner = 0.98f * outer;
    std::vector<Vec3> corners;
    for (const float side : {outer, inner}) {
        for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
            corners.push_back(middle + (x * static_cast<float>(a) + y * static_cast<float>(b)) * side);
    }
    std::vector<Triangle> triangles;
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t next = (i + 1) % 4;
        triangles.push_back({i, next, 4 + next});
        triangles.push_back({i, 4 + next, 4 + i});
    }
    coverage.add(corners, triangles);
}

struct Selection {
    std::vector<std::string> cloths, colliders;
    friend bool operator==(const Selection&, const Selection&) = default;
};
Selection selection_of(const ViewRequest& request) {
    return {request.selected_cloths, request.selected_colliders};
}
/// Whether the requests are equal except for the selection.
bool same_scene(const ViewRequest& a, ViewRequest b) {
    b.selected_cloths = a.selected_cloths;
    b.selected_colliders = a.selected_colliders;
    return a == b;
}

void outline(const ViewRequest& request, const Selection& selection, Image8& image) {
    if (image.rgba.empty() || selection == Selection{}) return;
    Coverage coverage(request.camera, image.width, image.height);
    const Frame& frame = request.world->frame();
    for (std::size_t i = 0; i < frame.cloths.size(); ++i) {
        if (!contains(selection.cloths, request.world->model(i)->name)) continue;
        const RenderMesh& mesh = frame.cloths[i].render_mesh();
        coverage.add(mesh.positions, mesh.triangles);
    }
    for (const Collider& collider : request.world->colliders()) {
        if (!contains(selection.colliders, collider.name)) continue;
        TriangleMesh mesh = mesh_of(collider);
        for (Vec3& p : mesh.positions) p = to_world(collider.pose, p);
        if (mesh.triangles.empty()) {
            add_plane(coverage, collider, request.camera);
        } else {
            coverage.add(mesh.positions, mesh.triangles);
        }
    }
    coverage.outline(image);
}

/// An image before its outlines.
struct Drawn {
    ViewRequest request;
    std::shared_ptr<const ViewImage> image;
};

/// Views of one device, one per kind of quality, made when first used.
class Views {
  public:
    Views(std::shared_ptr<gpu::Device> device, std::uint32_t samples) : device_(std::move(device)), samples_(samples) {}

    const gpu::Device& device() const { return *device_; }
    /// Whether the last image was the first of its view, which took longer than later ones will.
    bool began() const { return began_; }

    Result<Image8> draw(const ViewRequest& request, const Quality& quality) {
        if (folder_ != request.folder) views_ = {};  // other images may have the same names there
        folder_ = request.folder;
        std::optional<SceneView>& view = views_[quality.draft];
        began_ = !view;
        if (!view) {
            const ViewSources sources{
                .surface = {}, .read_picture = pictures_beside(folder_), .read_light = lights_beside(folder_)};
            auto made = SceneView::create(
                device_, *request.scene, *request.world,
                {.samples = samples_, .draft = quality.draft, .overlays = {}, .legends = false}, sources);
            if (!made) return made.errors();
            view.emplace(std::move(*made));
        }
        view->set_overlays(request.overlays);
        view->set_hidden(request.hidden);
        view->set_paint(request.paint);
        const auto part = [&](std::uint32_t pixels) { return std::max(1u, pixels * quality.percent / 100); };
        auto image =
            view->picture(*request.scene, *request.world, request.camera, part(request.width), part(request.height));
        if (!image) return image;
        if (quality.draft) *image = without_steps(*image);  // it has one sample per pixel
        if (quality.percent < 100) *image = enlarged(*image, request.width, request.height);
        return image;
    }
    const std::vector<std::string>& notes(const Quality& quality) const { return views_[quality.draft]->notes(); }
    const std::vector<Legend>& legends(const Quality& quality) const { return views_[quality.draft]->legends(); }

  private:
    std::shared_ptr<gpu::Device> device_;
    std::uint32_t samples_;
    bool began_ = false;
    std::filesystem::path folder_;
    std::array<std::optional<SceneView>, 2> views_;  // by Quality::draft
};

// The simulation comes first. Threads that a software driver starts for this thread's device have its priority too.
void lower_priority() {
#ifdef __linux__
    constexpr int nice = 5;
    (void)::setpriority(PRIO_PROCESS, static_cast<id_t>(::gettid()), nice);
#endif
}

}  // namespace

struct ViewThread::Impl {
    explicit Impl(ViewThreadOptions o) : options(std::move(o)), quality(options.target_ms) {
        if (!options.open_device) {
            options.open_device = [] { return make_vulkan_device({.software = true}); };
        }
    }

    void run();
    void run_outlines();
    std::shared_ptr<const ViewImage> drawn(const ViewRequest& request, std::uint64_t number, bool best);
    Result<void> draw(const ViewRequest& request, bool best, ViewImage& result);

    ViewThreadOptions options;

    mutable std::mutex mutex;
    std::condition_variable changed;
    // Under the mutex:
    ViewRequest newest;
    std::uint64_t number = 0, images = 0;  // of the newest request; made so far
    std::uint64_t scene = 0;               // another one if more than the selection has changed
    std::shared_ptr<const Drawn> drawn_image;
    std::shared_ptr<const ViewImage> image;
    bool stop = false, failed = false;

    // Of the thread:
    std::optional<Views> views;
    ViewQuality quality;

    std::thread thread, outlines;
};

Result<void> ViewThread::Impl::draw(const ViewRequest& request, bool best, ViewImage& result) {
    // Memory of the host may run out as well.
    try {
        if (!views) {
            auto device = options.open_device();
            if (!device) return device.errors();
            quality = ViewQuality(options.target_ms, (*device)->info().is_gpu() ? 0 : begin_without_gpu);
            views.emplace(std::move(*device), options.samples);
        }
        const Quality with = best ? qualities.front() : quality.moving();
        result.percent = with.percent;
        result.draft = with.draft;
        const Clock::time_point begin = Clock::now();
        auto made = views->draw(request, with);
        result.ms = std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
        if (!made) return made.errors();
        if (!views->began()) best ? quality.best_took(result.ms) : quality.took(result.ms);
        result.image = std::move(*made);
        result.notes = views->notes(with);
        result.legends = views->legends(with);
        return {};
    } catch (const std::exception& error) {
        return Error{"view", error.what()};
    }
}

std::shared_ptr<const ViewImage> ViewThread::Impl::drawn(const ViewRequest& request, std::uint64_t of, bool best) {
    auto result = std::make_shared<ViewImage>();
    result->camera = request.camera;
    result->frame = request.world->frame().index;
    result->number = of;
    if (auto made = draw(request, best, *result); !made) {
        result->errors = made.errors();
        views.reset();
    }
    return result;
}

void ViewThread::Impl::run() {
    lower_priority();
    std::uint64_t shown = 0;  // the scene that was drawn last
    bool is_best = true;      // and whether it was drawn in the best quality
    Clock::time_point changed_at{};
    std::unique_lock lock(mutex);
    while (!stop) {
        const bool is_new = scene != shown;
        if (failed || (!is_new && is_best)) {
            changed.wait(lock);
            continue;
        }
        if (is_new) {
            changed_at = Clock::now();
        } else if (Clock::now() < changed_at + options.settled) {
            changed.wait_until(lock, changed_at + options.settled);
            continue;
        }
        shown = scene;
        const ViewRequest request = newest;
        const std::uint64_t of = number;
        if (!request.world || !request.scene || request.width == 0 || request.height == 0) {
            is_best = true;
            continue;
        }
        lock.unlock();
        auto made = drawn(request, of, !is_new);
        is_best = made->percent == 100 && !made->draft;
        lock.lock();
        failed = !made->errors.empty();
        drawn_image = std::make_shared<const Drawn>(Drawn{request, std::move(made)});
        changed.notify_all();
    }
}

// A thread of its own: a selection shows at once, also while a large scene is drawn.
void ViewThread::Impl::run_outlines() {
    std::shared_ptr<const Drawn> done;
    Selection selection;
    std::unique_lock lock(mutex);
    while (!stop) {
        if (!drawn_image || (drawn_image == done && selection == selection_of(newest))) {
            changed.wait(lock);
            continue;
        }
        done = drawn_image;
        selection = selection_of(newest);
        const std::uint64_t of = same_scene(newest, done->request) ? number : done->image->number;
        lock.unlock();
        auto made = std::make_shared<ViewImage>(*done->image);
        made->number = of;
        outline(done->request, selection, made->image);
        lock.lock();
        image = std::move(made);
        ++images;
        if (!options.on_image || stop) continue;
        lock.unlock();
        options.on_image();
        lock.lock();
    }
}

ViewThread::ViewThread(ViewThreadOptions options) : impl_(std::make_unique<Impl>(std::move(options))) {
    impl_->thread = std::thread([this] { impl_->run(); });
    impl_->outlines = std::thread([this] { impl_->run_outlines(); });
}

ViewThread::~ViewThread() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->stop = true;
    }
    impl_->changed.notify_all();
    impl_->thread.join();
    impl_->outlines.join();
}

std::uint64_t ViewThread::request(ViewRequest request) {
    const std::lock_guard lock(impl_->mutex);
    if (impl_->number > 0 && request == impl_->newest) return impl_->number;
    if (impl_->number == 0 || !same_scene(impl_->newest, request)) ++impl_->scene;
    std::swap(impl_->newest, request);  // what it replaces is released after the lock
    impl_->changed.notify_all();
    return ++impl_->number;
}

std::shared_ptr<const ViewImage> ViewThread::image() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->image;
}

void ViewThread::retry() {
    const std::lock_guard lock(impl_->mutex);
    if (!std::exchange(impl_->failed, false)) return;
    ++impl_->number, ++impl_->scene;  // draws the request again
    impl_->changed.notify_all();
}

std::uint64_t ViewThread::count() const {
    const std::lock_guard lock(impl_->mutex);
    return impl_->images;
}

}  // namespace weft::editor
