#include "io/images/image_file.h"

#include "base/temporary_folder.test.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace weft {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string text_of(std::initializer_list<int> bytes) {
    std::string text;
    for (const int byte : bytes) text += static_cast<char>(byte);
    return text;
}

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

Image8 colorful(std::uint32_t width, std::uint32_t height) {
    Image8 image{width, height, std::vector<std::uint8_t>(std::size_t{width} * height * 4)};
    for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = static_cast<std::uint8_t>(i * 37 + i / 64);
    return image;
}

std::string png_of(const Image8& image) {
    const auto bytes = png_bytes(image);
    EXPECT_TRUE(bytes.ok());
    return {reinterpret_cast<const char*>(bytes->data()), bytes->size()};
}

// 2 by 2 pixels, rows from below, blue first: red, green / blue, white.
const std::string bmp =
    text_of({'B', 'M', 70,  0, 0,   0, 0, 0,  0, 0, 54, 0, 0,   0,  40, 0,   0,   0,   2, 0, 0,
             0,   2,   0,   0, 0,   1, 0, 24, 0, 0, 0,  0, 0,   16, 0,  0,   0,   0,   0, 0, 0,
             0,   0,   0,   0, 0,   0, 0, 0,  0, 0, 0,  0, 255, 0,  0,  255, 255, 255, 0, 0,  // the lower row
             0,   0,   255, 0, 255, 0, 0, 0});                                                // the upper
// The same, rows from above, uncompressed.
const std::string tga =
    text_of({0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, 24, 0x20, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255});

std::string png_header(std::uint32_t width, std::uint32_t height) {
    std::string text = "\x89PNG\r\n\x1a\n" + text_of({0, 0, 0, 13}) + "IHDR";
    for (const std::uint32_t n : {width, height})
        for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(n >> shift & 255);
    return text + text_of({8, 6, 0, 0, 0, 0, 0, 0, 0});
}

std::string hdr_of(const std::string& size, const std::string& pixels) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + "\n" + pixels;
}

std::string problem(const std::string& bytes) {
    const auto image = decode_image(bytes_of(bytes), "it");
    return image ? "none" : image.error().message();
}

/// An input file of the fuzzer, without its first byte, which only the fuzzer uses.
std::string seed(const std::string& name) {
    std::ifstream file(WEFT_SOURCE_DIR "/tests/fuzz/seeds/image/" + name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {}).substr(1);
}

std::string hdr_problem(const std::string& bytes) {
    const auto image = decode_hdr(bytes_of(bytes), "it");
    return image ? "none" : image.error().message();
}

TEST(ImageFile, WhatIsWrittenIsRead) {
    const TemporaryFolder folder;
    for (const auto& [width, height] : {std::pair{1u, 1u}, {7u, 3u}, {64u, 65u}}) {
        const Image8 image = colorful(width, height);
        const auto back = read_image(folder.write("a.png", png_of(image)));
        ASSERT_TRUE(back.ok()) << back.error().message();
        EXPECT_EQ(back->width, width);
        EXPECT_EQ(back->height, height);
        EXPECT_EQ(back->rgba, image.rgba);
        EXPECT_EQ(png_of(image), png_of(image));
    }
}

TEST(ImageFile, RowsComeFromTheTop) {
    const std::vector<std::uint8_t> expected{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
    for (const std::string& file : {bmp, tga}) {
        const auto image = decode_image(bytes_of(file), "it");
        ASSERT_TRUE(image.ok()) << image.error().message();
        EXPECT_EQ(image->rgba, expected);
    }
}

TEST(ImageFile, NamesWhatIsWrongWithThePath) {
    const TemporaryFolder folder;
    EXPECT_EQ(read_image("/no/such/file.png").error().message(), "/no/such/file.png: does not exist");
    EXPECT_EQ(read_image(folder.path()).error().what, "is a folder, not a file");
    EXPECT_EQ(read_image("/dev/null").error().what, "is not a regular file");
    EXPECT_EQ(read_image(folder.write("a.png", "")).error().what, "is empty");
    EXPECT_EQ(read_hdr("/no/such/file.hdr").error().message(), "/no/such/file.hdr: does not exist");
    EXPECT_EQ(read_hdr(folder.write("a.hdr", "")).error().what, "is empty");
    if (::geteuid() != 0) {
        const auto path = folder.write("b.png", png_of(colorful(2, 2)));
        std::filesystem::permissions(path, std::filesystem::perms::none);
        EXPECT_EQ(read_image(path).error().what, "cannot be opened: Permission denied");
    }
}

TEST(ImageFile, EveryCutIsFound) {
    const std::string png = png_of(colorful(20, 20));
    for (const std::string& file : {png, bmp, tga, seed("jpeg"), seed("jpeg_progressive"), seed("tga_runs")}) {
        ASSERT_EQ(problem(file), "none");
        // stb_image does not read the PNG's last chunk: 12 bytes without image data. A row of a BMP ends with padding.
        // A TGA may have a footer.
        const std::size_t unused = file == png ? 12 : file == bmp ? 2 : file == seed("tga_runs") ? 26 : 0;
        const std::size_t needed = file.size() - unused;
        for (std::size_t size = 1; size < needed; ++size) {
            EXPECT_THAT(problem(file.substr(0, size)), testing::AnyOf(StartsWith("it: is "), StartsWith("it: ends ")))
                << size << " of " << file.size();
        }
    }
    EXPECT_EQ(problem(png.substr(0, png.size() / 2)), "it: is cut short: it ends inside the image data");
    EXPECT_EQ(problem(tga.substr(0, 20)), "it: is cut short: it ends inside the image data");
}

TEST(ImageFile, WhatIsNoPictureIsRefused) {
    EXPECT_EQ(problem("{\"weft\": 1}"), "it: is not PNG, JPEG, TGA or BMP");
    EXPECT_EQ(problem(std::string(1000, '\xee')), "it: is not PNG, JPEG, TGA or BMP");
    EXPECT_THAT(problem("\xff\xd8\xff\xe0 and nothing that follows"), StartsWith("it: is damaged"));
    EXPECT_THAT(problem(hdr_of("-Y 1 +X 1", "abcd")), HasSubstr("is a Radiance image"));
    std::string png = png_of(colorful(20, 20));
    png[60] = static_cast<char>(png[60] + 1);
    png.replace(41, 2, "\x07\x07");  // the header of the compressed data
    EXPECT_THAT(problem(png), StartsWith("it: is damaged"));
}

TEST(ImageFile, CodeTablesOfAJpegHaveRoomForTheirCodes) {
    std::string jpeg = seed("jpeg");
    const std::size_t table = jpeg.find("\xff\xc4");
    ASSERT_NE(table, std::string::npos);
    jpeg[table + 5] = '\xff';
    jpeg[table + 6] = '\xff';
    EXPECT_THAT(problem(jpeg), HasSubstr("at most 256 are possible"));
    std::string between = seed("jpeg");
    between.insert(2, "x");
    EXPECT_THAT(problem(between), StartsWith("it: is damaged"));
}

TEST(ImageFile, TheHeaderAloneTellsWhatIsTooLarge) {
    EXPECT_EQ(problem(png_header(16385, 2)), "it: is 16385 by 2 pixels; at most 16384 per side are read");
    EXPECT_EQ(problem(png_header(3, 4000000)), "it: is 3 by 4000000 pixels; at most 16384 per side are read");
    EXPECT_EQ(problem(png_header(16384, 16384)), "it: is 16384 by 16384 pixels; at most 134217728 in total are read");
    EXPECT_THAT(problem(png_header(0, 5)), StartsWith("it: is damaged"));
    EXPECT_THAT(problem(png_header(0x7fffffff, 0x7fffffff)), StartsWith("it: is "));
    const auto limited = decode_image(bytes_of(png_of(colorful(5, 4))), "it", {.side = 4});
    EXPECT_EQ(limited.error().what, "is 5 by 4 pixels; at most 4 per side are read");
}

TEST(ImageFile, OnlyWholePicturesAreWritten) {
    EXPECT_FALSE(png_bytes({}).ok());
    EXPECT_FALSE(png_bytes({2, 2, std::vector<std::uint8_t>(15)}).ok());
    EXPECT_FALSE(png_bytes({16385, 1, std::vector<std::uint8_t>(16385 * 4)}).ok());
}

TEST(HdrFile, PixelsThatArePlain) {
    const TemporaryFolder folder;
    const std::string file = hdr_of("-Y 2 +X 2", text_of({128, 64, 32, 129, 255, 0, 0, 128,  //
                                                          9, 9, 9, 0, 128, 128, 128, 140}));
    const auto image = read_hdr(folder.write("a.hdr", file));
    ASSERT_TRUE(image.ok()) << image.error().message();
    EXPECT_EQ(image->width, 2u);
    EXPECT_EQ(image->height, 2u);
    EXPECT_EQ(image->rgba, (std::vector<float>{1, 0.5f, 0.25f, 1, 255.0f / 256, 0, 0, 1,  //
                                               0, 0, 0, 1, 2048, 2048, 2048, 1}));
}

TEST(HdrFile, RunsOfBothKinds) {
    // A row of eight, channel by channel: red repeats, green counts up, blue and exponent repeat.
    const std::string packed = text_of({2, 2, 0, 8, 136, 128, 8, 0, 16, 32, 48, 64, 80, 96, 112, 136, 0, 136, 129});
    const auto image = decode_hdr(bytes_of(hdr_of("-Y 1 +X 8", packed)), "it");
    ASSERT_TRUE(image.ok()) << image.error().message();
    for (std::uint32_t x = 0; x < 8; ++x) {
        EXPECT_EQ(image->at(x, 0)[0], 1);
        EXPECT_EQ(image->at(x, 0)[1], static_cast<float>(x) * 0.125f);
        EXPECT_EQ(image->at(x, 0)[2], 0);
    }
    // One pixel and 257 more of it: 1, then 1 · 256.
    const std::string older = text_of({128, 0, 0, 129, 1, 1, 1, 1, 1, 1, 1, 1});
    const auto old = decode_hdr(bytes_of(hdr_of("-Y 1 +X 258", older)), "it");
    ASSERT_TRUE(old.ok()) << old.error().message();
    for (std::uint32_t x = 0; x < 258; ++x) ASSERT_EQ(old->at(x, 0)[0], 1);
}

TEST(HdrFile, RefusesWhatItCannotRead) {
    const std::string packed = text_of({2, 2, 0, 8, 136, 128, 136, 0, 136, 0, 136, 129});
    const std::string whole = hdr_of("-Y 2 +X 8", packed + packed);
    EXPECT_EQ(hdr_problem(whole), "none");
    for (std::size_t size = 2; size < whole.size(); ++size) {
        EXPECT_EQ(hdr_problem(whole.substr(0, size)), "it: is cut short: it ends inside the image data") << size;
    }
    EXPECT_EQ(hdr_problem(png_of(colorful(2, 2))), "it: is not a Radiance image (.hdr)");
    EXPECT_EQ(hdr_problem("#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd"),
              "it: is not of the format 32-bit_rle_rgbe");
    for (const char* size : {"+Y 1 +X 1", "-Y 1", "-Y 1 +X 1 ", "-Y -1 +X 1", "-Y 99999999999 +X 1", "hello"}) {
        EXPECT_THAT(hdr_problem(hdr_of(size, "abcd")), StartsWith("it: must give its size")) << size;
    }
    EXPECT_THAT(hdr_problem(hdr_of("-Y 0 +X 1", "abcd")), HasSubstr("it must have at least one"));
    EXPECT_THAT(hdr_problem(hdr_of("-Y 1 +X 16385", "abcd")), HasSubstr("at most 16384 per side"));
    EXPECT_THAT(hdr_problem(hdr_of("-Y 16384 +X 16384", "abcd")), HasSubstr("in total are read"));
    // Memory is allocated for existing data, not for the size in the header.
    EXPECT_EQ(hdr_problem(hdr_of("-Y 8192 +X 8192", "abcd")), "it: is cut short: it ends inside the image data");
    for (const auto& row :
         {text_of({2, 2, 0, 8, 137, 1, 0, 0, 0, 0, 0, 0}), text_of({2, 2, 0, 8, 0, 1, 0, 0, 0, 0, 0, 0}),
          text_of({2, 2, 0, 9, 136, 1, 0, 0, 0, 0, 0, 0}), text_of({1, 1, 1, 8, 0, 0, 0, 0})}) {
        EXPECT_THAT(hdr_problem(hdr_of("-Y 1 +X 8", row)), StartsWith("it: is damaged: row 0"));
    }
}

}  // namespace
}  // namespace weft
