// A window shows the same image as a file.
#include "render/renderer.h"
#include "render/host_mesh.h"
#include "render/orbit.h"

#include "on_display.h"

namespace weft::render {
namespace {

class RendererInWindow : public OnDisplay {
  protected:
    void TearDown() override {
        if (device) (void)device->wait(device->submitted());
        mesh = {};
        renderer.reset();
        OnDisplay::TearDown();
    }
    /// A square of cloth on a ground.
    bool set_up() {
        if (!show_window()) return false;
        auto made = Renderer::create(device);
        EXPECT_TRUE(made.ok()) << made.error().message();
        if (!made) return false;
        renderer.emplace(std::move(*made));
        const Triangle triangles[] = {{0, 1, 2}, {0, 2, 3}};
        const Vec2 uvs[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        const Vec3 positions[] = {{-0.5f, 0.2f, 0}, {0.5f, 0.2f, 0}, {0.5f, 1.2f, 0}, {-0.5f, 1.2f, 0}};
        const Vec3 normals[] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
        const Vec4 tangents[] = {{1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}, {1, 0, 0, 1}};
        auto square = HostMesh::create(*device, 4, triangles, uvs, positions, "square");
        EXPECT_TRUE(square.ok());
        if (!square) return false;
        mesh = std::move(*square);
        EXPECT_TRUE(mesh.update(positions, normals, tangents).ok());
        Material red;
        red.color = {0.7f, 0.05f, 0.05f};
        const auto cloth = renderer->add(red), floor = renderer->add(Material{});
        EXPECT_TRUE(cloth.ok() && floor.ok());
        if (!cloth || !floor) return false;
        object = {.surface = mesh.surface(), .rest = mesh.rest(), .material = *cloth};
        ground.material = *floor;
        drawing.camera = {.position = {0, 0.7f, 2}, .target = {0, 0.7f, 0}, .fov = 40};
        drawing.objects = {&object, 1};
        drawing.grounds = {&ground, 1};
        return true;
    }
    void draw() {
        const auto image = next();
        ASSERT_EQ(image.state, gpu::Acquired::image);
        const auto done = renderer->draw(drawing,
                                         {.view = image.view,
                                          .format = window->format(),
                                          .width = image.extent.width,
                                          .height = image.extent.height},
                                         image.semaphores);
        ASSERT_TRUE(done.ok()) << done.error().message();
        EXPECT_TRUE(window->show(image, *done).ok());
    }
    /// Compares the pixels of the window with an image that is written to a file.
    void expect_same_picture() {
        const VkExtent2D size = window->extent();
        const auto picture = renderer->picture(drawing, size.width, size.height);
        ASSERT_TRUE(picture.ok()) << picture.error().message();
        for (std::uint32_t y = 5; y < size.height; y += 23)
            for (std::uint32_t x = 5; x < size.width; x += 31) {
                const std::uint8_t* pixel = picture->at(x, y);
                EXPECT_TRUE(shown({pixel[0], pixel[1], pixel[2]}, static_cast<int>(x), static_cast<int>(y)))
                    << "at " << x << ", " << y;
            }
    }

    std::optional<Renderer> renderer;
    HostMesh mesh;
    Object object;
    Ground ground;
    Drawing drawing;
};

TEST_F(RendererInWindow, shows_the_picture_of_a_file) {
    if (!set_up()) return;
    for (int i = 0; i < 3; ++i) draw();
    expect_same_picture();
}

TEST_F(RendererInWindow, draws_on_through_another_size) {
    if (!set_up()) return;
    draw();
    for (const unsigned width : {500u, 150u}) {
        input->resize(width, 240);
        ASSERT_TRUE(until([&] { return window->extent().width == width; }));
        for (int i = 0; i < 3; ++i) draw();
        expect_same_picture();
    }
}

TEST_F(RendererInWindow, a_camera_in_hands_shows_the_other_side) {
    if (!set_up()) return;
    draw();
    input->point_at(100, 100);
    ASSERT_TRUE(until([&] { return window->input(0.02).pointer == Vec2{100, 100}; }));
    input->button(1, true);
    input->point_at(200, 100);  // half the height is a quarter of a turn
    input->button(1, false);
    float turned = 0;
    ASSERT_TRUE(until([&] {
        const WindowInput input = window->input(0.02);
        turned += input.left.x;
        drawing.camera = steered(drawing.camera, input);
        return turned == 100;
    }));
    EXPECT_NEAR(drawing.camera.position.x, -2, 1e-3f);
    draw();
    expect_same_picture();
}

}  // namespace
}  // namespace weft::render
