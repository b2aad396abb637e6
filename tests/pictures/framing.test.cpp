// Scenes without a camera: the share of the image that cloth and colliders cover, in images and in videos.

#include "scenes.h"

#include "view/framing.h"

#include <fstream>
#include <map>

namespace weft {
namespace {

constexpr std::uint32_t picture_width = 96, picture_height = 54;

class FramedScenes : public gpu::OnDevice {
  protected:
    void SetUp() override {
        OnDevice::SetUp();
        if (!HasFatalFailure()) gpu::OnDevice::open();
    }

    /// Percent of the pixels, at each second up to the second one.
    struct Covered {
        std::vector<double> still, film;
    };
    Covered covered(const std::string& name, const std::string& body) {
        const std::filesystem::path file = std::filesystem::path(WEFT_BINARY_DIR) / (name + ".json");
        std::ofstream(file) << R"({ "weft": 1, )" << body << " }";
        Options options;
        options.backend = "cpu";
        auto session = open_scene(file, options);
        EXPECT_TRUE(session.ok()) << session.error().message();
        if (!session) return {};
        World& world = session->world();
        auto view = SceneView::create(
            device, session->scene(), world,
            {.width = picture_width, .height = picture_height, .samples = 1, .transparent = true, .overlays = {}});
        EXPECT_TRUE(view.ok()) << view.error().message();
        if (!view) return {};
        const auto part_seen = [&](const Camera& camera) {
            const auto image = view->picture(session->scene(), world, camera);
            EXPECT_TRUE(image.ok()) << image.error().message();
            std::size_t pixels = 0;
            for (std::size_t i = 3; image && i < image->rgba.size(); i += 4) pixels += image->rgba[i] > 127;
            return 100.0 * static_cast<double>(pixels) / (picture_width * picture_height);
        };
        Covered result;
        FollowingCamera following(subject_of(world), static_cast<float>(picture_width) / picture_height);
        for (int frame = 0; frame <= 120; ++frame) {
            if (frame > 0) {
                session->advance();
                following.follow(subject_of(world), static_cast<float>(session->frame_seconds()));
            }
            if (frame % 60 != 0) continue;
            result.still.push_back(part_seen(view->camera(session->scene(), world)));
            result.film.push_back(part_seen(following.camera()));
        }
        return result;
    }
    void expect_between(const std::vector<double>& parts, double least, double most) {
        ASSERT_EQ(parts.size(), 3u);
        for (std::size_t second = 0; second < parts.size(); ++second) {
            EXPECT_GE(parts[second], least) << "at " << second << " s";
            EXPECT_LE(parts[second], most) << "at " << second << " s";
        }
    }
};

const std::string sheet = R"("mesh": { "grid": { "size": [1, 1], "resolution": [13, 13] } })";

TEST_F(FramedScenes, a_sheet_that_falls_out_of_the_picture_of_its_start) {
    const Covered part = covered("falls", R"("cloths": [{ "name": "c", )" + sheet + R"(,
        "transform": { "rotation": [50, 20, 0] } }])");
    expect_between(part.still, 10, 45);
    expect_between(part.film, 8, 45);
}

TEST_F(FramedScenes, a_sheet_that_falls_off_a_ball_and_leaves_it) {
    const Covered part = covered("slips", R"("cloths": [{ "name": "c", )" + sheet + R"(,
        "transform": { "position": [0.25, 0.5, 0], "rotation": [0, 0, -30] } }],
        "colliders": [{ "name": "ball", "sphere": { "radius": 0.2 }, "friction": [0, 0] }])");
    expect_between(part.still, 5, 60);
    expect_between(part.film, 4, 60);
}

TEST_F(FramedScenes, a_flag) {
    const Covered part = covered("flies", R"("air": { "wind": [{ "velocity": [6, 0, 1] }] },
        "cloths": [{ "name": "c", )" + sheet + R"(, "transform": { "rotation": [90, 0, 0] },
        "pins": [{ "vertices": [0, 13, 26, 39, 52, 65, 78, 91, 104, 117, 130, 143, 156] }] }])");
    expect_between(part.still, 8, 50);
    expect_between(part.film, 6, 50);
}

TEST_F(FramedScenes, a_sheet_that_comes_to_rest_on_a_ball) {
    const Covered part = covered("rests", R"("cloths": [{ "name": "c", )" + sheet + R"(,
        "transform": { "position": [0, 0.7, 0] } }],
        "colliders": [{ "name": "ball", "sphere": { "radius": 0.3 } }, { "name": "ground", "plane": { "offset": -0.3 } }])");
    expect_between(part.still, 8, 60);
    expect_between(part.film, 8, 60);
}

}  // namespace
}  // namespace weft
