#include "io/exports/film_fixtures.test.h"
#include "io/images/image_file.h"
#include "look/weave.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>

namespace weft {
namespace {

using test::Cloth;
using test::Instant;
using test::make_cloth;
using test::TestFolder;
using ::testing::Contains;
using ::testing::IsEmpty;
using ::testing::Not;

class GlbMaterial : public testing::Test {
  protected:
    /// One frame of cloths, each with its material.
    tinygltf::Model export_of(const std::vector<Cloth>& cloths, const std::vector<const Material*>& materials) {
        const std::filesystem::path path = folder / "a.glb";
        Instant instant(cloths, 0, 0);
        for (std::size_t i = 0; i < materials.size(); ++i) instant.surfaces[i].material = materials[i];
        const ExportInfo info{"s", 60, 1, folder.path()};
        auto exporter = make_exporter(path);
        EXPECT_TRUE(exporter.ok());
        const auto estimate = (*exporter)->estimate(info, instant.frame());
        EXPECT_TRUE(estimate.ok() && (*exporter)->begin(info).ok());
        EXPECT_TRUE((*exporter)->write(instant.frame()).ok() && (*exporter)->finish().ok());
        EXPECT_LE(std::filesystem::file_size(path), estimate->bytes);
        tinygltf::Model model;
        std::string error, warning;
        EXPECT_TRUE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path.string())) << error;
        EXPECT_EQ(error + warning, "");
        return model;
    }
    tinygltf::Model export_of(const Material& material) { return export_of({make_cloth("c", 4, 0)}, {&material}); }

    TestFolder folder;
};

const Material& preset(std::string_view name) {
    return find_material(name)->material;
}

std::span<const std::byte> picture_bytes(const tinygltf::Model& model, int texture) {
    const auto& image =
        model.images.at(static_cast<std::size_t>(model.textures.at(static_cast<std::size_t>(texture)).source));
    const auto& view = model.bufferViews.at(static_cast<std::size_t>(image.bufferView));
    return std::as_bytes(std::span(model.buffers.at(0).data)).subspan(view.byteOffset, view.byteLength);
}

double number(const tinygltf::ExtensionMap& extensions, const std::string& extension, const std::string& key) {
    return extensions.at(extension).Get(key).GetNumberAsDouble();
}

std::vector<double> numbers(const tinygltf::ExtensionMap& extensions, const std::string& extension,
                            const std::string& key) {
    std::vector<double> values;
    const tinygltf::Value& array = extensions.at(extension).Get(key);
    for (std::size_t i = 0; i < array.ArrayLen(); ++i) values.push_back(array.Get(i).GetNumberAsDouble());
    return values;
}

TEST_F(GlbMaterial, ThreadsAreAsFarApartAsTheyAre) {
    Cloth sheet{"c", make_grid({2, 0.5f}, {4, 4}, GridDiagonal::alternating), 0};
    Material cotton = preset("cotton");
    cotton.thread_spacing = 0.5f;
    cotton.weave_depth = 0.75f;
    const tinygltf::Model model = export_of({sheet}, {&cotton});
    const tinygltf::Material& material = model.materials.at(0);
    EXPECT_TRUE(material.doubleSided);
    EXPECT_EQ(material.alphaMode, "OPAQUE");
    EXPECT_EQ(material.normalTexture.scale, 0.75);
    // Eight threads per tile: 4 mm. Two meters are 500 tiles.
    const auto repeat = numbers(material.normalTexture.extensions, "KHR_texture_transform", "scale");
    EXPECT_NEAR(repeat.at(0), 500, 1e-3);
    EXPECT_NEAR(repeat.at(1), 125, 1e-3);
    const auto offset = numbers(material.normalTexture.extensions, "KHR_texture_transform", "offset");
    EXPECT_NEAR(std::remainder(repeat[1] * 1 + offset[1] - 1, 1), 0, 1e-6)
        << "v = 0 is 1 in a .glb, and an end of a tile";
    EXPECT_THAT(model.extensionsUsed, Contains("KHR_texture_transform"));

    const auto image = decode_image(picture_bytes(model, material.normalTexture.index), "normals");
    ASSERT_TRUE(image.ok());
    EXPECT_EQ(image->rgba, normal_map_of(make_weave(Weave::plain), 1).rgba);
    EXPECT_EQ(material.pbrMetallicRoughness.baseColorTexture.index, -1);
}

TEST_F(GlbMaterial, OneFrameHasTheTangentsThatNormalMapsNeed) {
    const Cloth cloth = make_cloth("c", 4, 0.3f);
    const tinygltf::Model model = export_of({cloth}, {&preset("cotton")});
    const tinygltf::Primitive& primitive = model.meshes.at(0).primitives.at(0);
    const auto& accessor = model.accessors.at(static_cast<std::size_t>(primitive.attributes.at("TANGENT")));
    ASSERT_EQ(accessor.count, cloth.mesh.positions.size());
    const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    std::vector<Vec4> tangents(accessor.count);
    std::memcpy(tangents.data(), model.buffers.at(0).data.data() + view.byteOffset, view.byteLength);
    const auto normals = cloth.at(0).second;
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        EXPECT_NEAR(length(tangents[i].xyz()), 1, 1e-5);
        EXPECT_NEAR(dot(tangents[i].xyz(), normals[i]), 0, 1e-5);
        EXPECT_GT(tangents[i].x, 0.3f) << "u runs along x";
        // v grows toward -z, upward in the image like the green channel of a normal map.
        EXPECT_LT((tangents[i].w * cross(normals[i], tangents[i].xyz())).z, -0.3f);
    }
    EXPECT_FALSE(export_of(preset("velvet")).meshes[0].primitives[0].attributes.contains("TANGENT"));
}

TEST_F(GlbMaterial, FromAfarSlopesAreRoughness) {
    Material smooth = preset("rubber"), woven = smooth;
    woven.weave = Weave::plain;
    EXPECT_NEAR(export_of(smooth).materials[0].pbrMetallicRoughness.roughnessFactor, smooth.roughness[0], 1e-6);
    const std::vector<float> slopes = make_weave(Weave::plain).levels.back().second;
    const double alpha = std::sqrt(std::pow(woven.roughness[0], 4) + 2 * std::min(slopes[0], slopes[1]));
    EXPECT_NEAR(export_of(woven).materials[0].pbrMetallicRoughness.roughnessFactor, std::sqrt(alpha), 1e-5);
    EXPECT_THAT(export_of(smooth).textures, IsEmpty());
}

TEST_F(GlbMaterial, SatinIsStretchedAcrossItsWarp) {
    Material silk = preset("satin");
    silk.weave = Weave::smooth;
    silk.roughness[0] = 0.2f, silk.roughness[1] = 0.6f;
    const auto check = [&](double rotation) {
        const tinygltf::Material material = export_of(silk).materials.at(0);
        EXPECT_NEAR(material.pbrMetallicRoughness.roughnessFactor, 0.2, 1e-6);
        const double strength = number(material.extensions, "KHR_materials_anisotropy", "anisotropyStrength");
        EXPECT_NEAR(0.04 + (1 - 0.04) * strength * strength, 0.36, 1e-5);
        EXPECT_NEAR(number(material.extensions, "KHR_materials_anisotropy", "anisotropyRotation"), rotation, 1e-6);
    };
    check(std::acos(-1.0) / 2);
    std::swap(silk.roughness[0], silk.roughness[1]);
    check(0);
    silk.roughness[0] = silk.roughness[1];
    EXPECT_FALSE(export_of(silk).materials[0].extensions.contains("KHR_materials_anisotropy"));
}

TEST_F(GlbMaterial, MirrorsAsMuchAsItDoes) {
    const tinygltf::Model silk = export_of(preset("silk"));
    const auto times = numbers(silk.materials[0].extensions, "KHR_materials_specular", "specularColorFactor");
    EXPECT_NEAR(times.at(1) * 0.04, preset("silk").specular, 1e-6);
    EXPECT_FALSE(export_of(preset("cotton")).materials[0].extensions.contains("KHR_materials_specular"));
}

TEST_F(GlbMaterial, VelvetIsSheenWithoutAHighlight) {
    const tinygltf::Material velvet = export_of(preset("velvet")).materials.at(0);
    const auto color = numbers(velvet.extensions, "KHR_materials_sheen", "sheenColorFactor");
    EXPECT_NEAR(color.at(0), preset("velvet").sheen_color.x, 1e-6);
    EXPECT_NEAR(color.at(2), preset("velvet").sheen_color.z, 1e-6);
    EXPECT_NEAR(number(velvet.extensions, "KHR_materials_sheen", "sheenRoughnessFactor"), preset("velvet").velvet_alpha,
                1e-6);
    EXPECT_EQ(number(velvet.extensions, "KHR_materials_specular", "specularFactor"), 0);

    const tinygltf::Material wool = export_of(preset("wool")).materials.at(0);
    EXPECT_NEAR(numbers(wool.extensions, "KHR_materials_sheen", "sheenColorFactor").at(0), preset("wool").sheen_color.x,
                1e-6);
    EXPECT_FALSE(export_of(preset("rubber")).materials[0].extensions.contains("KHR_materials_sheen"));
}

TEST_F(GlbMaterial, SheerClothIsBlended) {
    const tinygltf::Material chiffon = export_of(preset("chiffon")).materials.at(0);
    EXPECT_EQ(chiffon.alphaMode, "BLEND");
    EXPECT_NEAR(chiffon.pbrMetallicRoughness.baseColorFactor.at(3), preset("chiffon").coverage, 1e-6);
}

TEST_F(GlbMaterial, DenimShowsWarpAndWeft) {
    const Material& denim = preset("denim");
    const tinygltf::Model model = export_of(denim);
    const tinygltf::PbrMetallicRoughness& pbr = model.materials[0].pbrMetallicRoughness;
    EXPECT_EQ(pbr.baseColorFactor, (std::vector<double>{1, 1, 1, 1}));
    const auto image = decode_image(picture_bytes(model, pbr.baseColorTexture.index), "colors");
    ASSERT_TRUE(image.ok());
    // Both thread colors occur, nearly as bright as without shading.
    const auto reds = [&] {
        std::vector<int> values;
        for (std::size_t i = 0; i < image->rgba.size(); i += 4) values.push_back(image->rgba[i]);
        return values;
    }();
    EXPECT_NEAR(*std::ranges::max_element(reds), 255 * (1.055 * std::pow(denim.weft_color.x, 1 / 2.4) - 0.055), 2);
    EXPECT_LT(*std::ranges::min_element(reds), 60);

    Cloth bare = make_cloth("c", 4, 0);
    bare.mesh.uvs.clear();
    const tinygltf::Model without = export_of({bare}, {&denim});
    EXPECT_THAT(without.images, IsEmpty());
    const double red = without.materials[0].pbrMetallicRoughness.baseColorFactor[0];
    EXPECT_GT(red, denim.color.x);
    EXPECT_LT(red, 0.5 * denim.weft_color.x);
}

TEST_F(GlbMaterial, PicturesOfFilesAreInIt) {
    const Image8 colors{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 255}};
    const auto png = *png_bytes(colors);
    folder.write("colors.png", {reinterpret_cast<const char*>(png.data()), png.size()});
    const auto normals = *png_bytes(normal_map_of(make_weave(Weave::knit, 16), 1));
    folder.write("normals.png", {reinterpret_cast<const char*>(normals.data()), normals.size()});
    Material material = preset("cotton");
    material.color_map = "colors.png";
    material.normal_map = "normals.png";
    material.uv_tiling[0] = 3, material.uv_tiling[1] = 2.5f;
    const tinygltf::Model model = export_of(material);
    const tinygltf::Material& to = model.materials[0];
    EXPECT_TRUE(std::ranges::equal(picture_bytes(model, to.pbrMetallicRoughness.baseColorTexture.index), png));
    EXPECT_TRUE(std::ranges::equal(picture_bytes(model, to.normalTexture.index), normals));
    for (const auto* extensions :
         {&to.pbrMetallicRoughness.baseColorTexture.extensions, &to.normalTexture.extensions}) {
        EXPECT_EQ(numbers(*extensions, "KHR_texture_transform", "scale"), (std::vector<double>{3, 2.5}));
        EXPECT_EQ(numbers(*extensions, "KHR_texture_transform", "offset"), (std::vector<double>{0, 0.5}));
    }
    EXPECT_NEAR(to.pbrMetallicRoughness.baseColorFactor[0], material.color.x, 1e-6);

    material.color_map = "none.png", material.normal_map = "none.png";
    const tinygltf::Model plain = export_of(material);
    EXPECT_EQ(plain.materials[0].pbrMetallicRoughness.baseColorTexture.index, -1);
    EXPECT_EQ(picture_bytes(plain, plain.materials[0].normalTexture.index).size(),
              png_bytes(normal_map_of(make_weave(Weave::plain), 1))->size());
}

TEST_F(GlbMaterial, EachPictureIsInItOnce) {
    const Material& cotton = preset("cotton");
    Material linen = preset("linen");
    linen.weft_color = linen.color;
    const tinygltf::Model model = export_of({make_cloth("a", 4, 0), make_cloth("b", 5, 0.1f), make_cloth("c", 6, 0.2f)},
                                            {&cotton, &linen, nullptr});
    EXPECT_EQ(model.images.size(), 1u);
    EXPECT_EQ(model.materials[0].normalTexture.index, model.materials[1].normalTexture.index);
    EXPECT_EQ(model.materials[2].normalTexture.index, -1);
    EXPECT_EQ(model.materials[2].pbrMetallicRoughness.baseColorFactor[0], 0.8);
    EXPECT_THAT(model.extensionsUsed, testing::UnorderedElementsAreArray(
                                          {"KHR_texture_transform", "KHR_materials_sheen", "KHR_materials_specular"}));
    EXPECT_THAT(model.extensionsRequired, IsEmpty());
}

TEST_F(GlbMaterial, EveryPresetIsWritten) {
    for (const MaterialPreset& one : material_presets()) {
        const tinygltf::Model model = export_of(one.material);
        EXPECT_EQ(model.materials.at(0).name, "c") << one.name;
        EXPECT_EQ(model.images.empty(), one.material.weave == Weave::smooth) << one.name;
    }
}

}  // namespace
}  // namespace weft
