// Changes of a scene's text: the result must read as wanted, and everything else must stay to the byte.
#include "io/scenes/scene_text_edit.h"

#include "io/scenes/json_match.h"
#include "io/scenes/json_text.h"
#include "io/scenes/random_scene.test.h"
#include "io/scenes/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

namespace weft {
namespace {

using Json = nlohmann::json;
using Pointer = Json::json_pointer;
using testing::HasSubstr;

Json json_of(std::string_view text) {
    Problems problems;
    auto json = parse_json(text, problems);
    EXPECT_TRUE(json && problems.none()) << text;
    return json.value_or(Json());
}

std::string changed(std::string_view text, const Json& wanted) {
    const auto result = edit_scene_text(text, wanted);
    EXPECT_TRUE(result) << result.error().message() << "\n" << text << "\nwanted: " << wanted;
    return result ? *result : "";
}

std::string with(std::string_view text, const char* pointer, const Json& value) {
    Json wanted = json_of(text);
    wanted[Pointer(pointer)] = value;
    return changed(text, wanted);
}

void remove_at(Json& json, const Pointer& pointer) {
    Json& parent = json.at(pointer.parent_pointer());
    if (parent.is_array())
        parent.erase(std::stoul(pointer.back()));
    else
        parent.erase(pointer.back());
}

std::string without(std::string_view text, const char* pointer) {
    Json wanted = json_of(text);
    remove_at(wanted, Pointer(pointer));
    return changed(text, wanted);
}

TEST(TextEdit, replaces_a_value_in_its_place) {
    EXPECT_EQ(with("// c\n{\"a\" : 1.50, /* x */ \"b\":2}\n", "/b", 0.25),
              "// c\n{\"a\" : 1.50, /* x */ \"b\":0.25}\n");
    EXPECT_EQ(with("{ \"p\": [0, 0.500, 1e0] }", "/p", {0, 0.25, 1}), "{ \"p\": [0, 0.25, 1e0] }");
    EXPECT_EQ(with("{ \"p\": [1, 2] // c\n}", "/p", {1, 2, 3}), "{ \"p\": [1, 2, 3] // c\n}");
    EXPECT_EQ(with("{ \"fabric\": \"silk\" }", "/fabric", {{"preset", "silk"}, {"density", 0.1}}),
              "{ \"fabric\": { \"preset\": \"silk\", \"density\": 0.1 } }");
    EXPECT_EQ(with("[1]", "", {{"a", 1}}), "{ \"a\": 1 }");
}

TEST(TextEdit, adds_a_key_as_its_neighbors_stand) {
    EXPECT_EQ(with("{\n  \"a\": 1 // one\n  // end\n}\n", "/b", 2), "{\n  \"a\": 1, // one\n  \"b\": 2\n  // end\n}\n");
    EXPECT_EQ(with("{ \"a\": 1 }", "/b", 2), "{ \"a\": 1, \"b\": 2 }");
    EXPECT_EQ(with("{\"a\":1,\"b\":2}", "/c", 3), "{\"a\":1,\"b\":2,\"c\":3}");
    EXPECT_EQ(with("{}", "/a/b", 3), "{ \"a\": { \"b\": 3 } }");
    EXPECT_EQ(with("{\n\t\"a\": {\n\t\t\"b\": 1\n\t}\n}", "/a/c", {1, 2}),
              "{\n\t\"a\": {\n\t\t\"b\": 1,\n\t\t\"c\": [1, 2]\n\t}\n}");
    EXPECT_EQ(with("{ // none yet\n}", "/a", 1), "{ // none yet\n    \"a\": 1\n}");
    EXPECT_EQ(with("{ \"a\": 1 /* one */ }", "/b", 2), "{ \"a\": 1, /* one */ \"b\": 2 }");
}

TEST(TextEdit, keeps_an_object_on_one_line_only_if_it_fits) {
    const std::string value(90, 'x');
    const std::string line = "{\n  \"a\": { \"long\": \"" + value + "\" },\n  \"z\": 1\n}";
    EXPECT_EQ(with(line, "/a/b", 1), "{\n  \"a\": { \"long\": \"" + value + "\", \"b\": 1 },\n  \"z\": 1\n}");
    EXPECT_EQ(with(line, "/a/more", "yyyyyyyyyy"),
              "{\n  \"a\": {\n    \"long\": \"" + value + "\",\n    \"more\": \"yyyyyyyyyy\"\n  },\n  \"z\": 1\n}");
    const std::string short_value = value.substr(10);
    const std::string nested = "{\"a\": [{\"x\": 1,\n       \"y\": \"" + value + "\"}]}";
    EXPECT_EQ(with(nested, "/a/1", {{"long", short_value}}),
              "{\"a\": [{\"x\": 1,\n       \"y\": \"" + value + "\"},\n       { \"long\": \"" + short_value + "\" }]}");
    const std::string longer = "{ \"a\": { \"long\": \"" + value + value + "\" } }";
    EXPECT_EQ(with(longer, "/a/b", Json::object()), "{ \"a\": { \"long\": \"" + value + value + "\", \"b\": {} } }");
}

TEST(TextEdit, fills_lines_that_hold_several_members) {
    const std::string packed = "{ \"a\": 1, \"b\": 2,\n  \"c\": 3 }";
    EXPECT_EQ(with(packed, "/d", 4), "{ \"a\": 1, \"b\": 2,\n  \"c\": 3, \"d\": 4 }");
    const std::string value(110, 'x');
    EXPECT_EQ(with(packed, "/d", value), "{ \"a\": 1, \"b\": 2,\n  \"c\": 3,\n  \"d\": \"" + value + "\" }");
}

TEST(TextEdit, appends_inserts_and_removes_elements) {
    const std::string list = "[\n    { \"name\": \"a\" }, // first\n    { \"name\": \"b\" }\n]";
    EXPECT_EQ(with(list, "/2", {{"name", "c"}}),
              "[\n    { \"name\": \"a\" }, // first\n    { \"name\": \"b\" },\n    { \"name\": \"c\" }\n]");
    EXPECT_EQ(without(list, "/1"), "[\n    { \"name\": \"a\" } // first\n]");
    EXPECT_EQ(without(list, "/0"), "[\n    { \"name\": \"b\" }\n]");
    EXPECT_EQ(changed(list, Json::parse(R"([{"name": "c"}, {"name": "a"}, {"name": "b", "x": 1}])")),
              "[\n    { \"name\": \"c\" },\n    { \"name\": \"a\" }, // first\n    { \"name\": \"b\", \"x\": 1 }\n]");
    EXPECT_EQ(changed("[1, 2, 3]", {2, 3}), "[2, 3]");
    EXPECT_EQ(changed("[1, 2, 3]", {0, 1, 2, 3}), "[0, 1, 2, 3]");
    EXPECT_EQ(changed("[1, 2, 3]", {1, 3}), "[1, 3]");
    EXPECT_EQ(changed("[1, 2]", Json::array()), "[]");
    EXPECT_EQ(changed("[]", {1, 2}), "[1, 2]");
    EXPECT_EQ(changed("[{\"a\": 1},\n {\"a\": 2}]", {{{"b", 0}}, {{"a", 1}}, {{"a", 2}}}),
              "[{ \"b\": 0 },\n {\"a\": 1},\n {\"a\": 2}]");
}

TEST(TextEdit, removes_a_key_with_its_line) {
    const std::string text =
        "{ // all\n    \"a\": 1, // one\n\n    // two\n    \"b\": 2,\n    // three\n    \"c\": 3\n}";
    EXPECT_EQ(without(text, "/a"), "{ // all\n\n    // two\n    \"b\": 2,\n    // three\n    \"c\": 3\n}");
    EXPECT_EQ(without(text, "/b"), "{ // all\n    \"a\": 1, // one\n    // three\n    \"c\": 3\n}");
    EXPECT_EQ(without(text, "/c"), "{ // all\n    \"a\": 1, // one\n\n    // two\n    \"b\": 2\n}");
    EXPECT_EQ(without("{ \"a\": 1, \"b\": 2, \"c\": 3 }", "/b"), "{ \"a\": 1, \"c\": 3 }");
    EXPECT_EQ(without("{\n  \"a\": 1, \"b\": 2,\n  \"c\": 3\n}", "/a"), "{\n  \"b\": 2,\n  \"c\": 3\n}");
    EXPECT_EQ(without("{ \"a\": 1 }", "/a"), "{}");
}

TEST(TextEdit, keeps_comments_of_others) {
    EXPECT_EQ(without("{\n  // section\n\n  // one\n  \"a\": 1\n}", "/a"), "{\n  // section\n\n}");
    EXPECT_EQ(without("{\n  // both\n  \"a\": 1,\n  \"b\": 2\n}", "/a"), "{\n  // both\n  \"b\": 2\n}");
    EXPECT_EQ(without("{ \"a\": 1, // c\n  \"b\": 2, \"c\": 3 }", "/b"), "{ \"a\": 1, // c\n  \"c\": 3 }");
    EXPECT_EQ(without("{ \"a\": 1, \"b\": 2, // both\n  \"c\": 3 }", "/b"), "{ \"a\": 1, // both\n  \"c\": 3 }");
    EXPECT_EQ(without("{ \"a\": 1 // c\n , \"b\": 2 }", "/b"), "{ \"a\": 1 // c\n  }");
}

TEST(TextEdit, swaps_members_in_one_line) {
    Json wanted = Json::parse(R"({"name": "x", "box": {}})");
    EXPECT_EQ(changed("{ \"name\": \"x\", \"sphere\": { \"radius\": 1 } }", wanted),
              "{ \"name\": \"x\", \"box\": {} }");
    EXPECT_EQ(changed("{ \"sphere\": {} }", {{"box", Json::object()}}), "{ \"box\": {} }");
}

TEST(TextEdit, keeps_line_ends_and_byte_order_mark) {
    const std::string text = "\xef\xbb\xbf{\r\n  \"a\": 1, // c\r\n  \"b\": { \"c\": 2 }\r\n}\r\n";
    EXPECT_EQ(with(text, "/d", 3),
              "\xef\xbb\xbf{\r\n  \"a\": 1, // c\r\n  \"b\": { \"c\": 2 },\r\n  \"d\": 3\r\n}\r\n");
    EXPECT_EQ(without(text, "/b"), "\xef\xbb\xbf{\r\n  \"a\": 1 // c\r\n}\r\n");
    const std::string wide(100, 'x');
    const std::string grown = with(text, "/b/d", {{"e", wide}, {"f", {1, 2}}});
    EXPECT_THAT(grown, HasSubstr("\r\n  \"b\": {\r\n    \"c\": 2,\r\n    \"d\": {\r\n      \"e\": \"" + wide));
    EXPECT_EQ(std::ranges::count(grown, '\n'), std::ranges::count(grown, '\r'));
}

TEST(TextEdit, writes_new_values_as_the_scene_writer_does) {
    const Json cloth = {{"fabric", "silk"}, {"name", "sheet"}, {"mesh", {{"file", "a.obj"}}}};
    EXPECT_EQ(with("{ \"cloths\": [] }", "/cloths/0", cloth),
              "{ \"cloths\": [{ \"name\": \"sheet\", \"mesh\": { \"file\": \"a.obj\" }, \"fabric\": \"silk\" }] }");
    EXPECT_EQ(with("{}", "/x", {2.5e-7, 0.1, 3.0}), "{ \"x\": [2.5e-7, 0.1, 3] }");
    EXPECT_EQ(with("{}", "/x", -0.0), "{ \"x\": -0.0 }");
}

TEST(TextEdit, refuses_what_it_cannot_do) {
    EXPECT_FALSE(edit_scene_text("{", {}));
    EXPECT_FALSE(edit_scene_text("{\"a\": 1, \"a\": 2}", {{"a", 3}}));
    EXPECT_FALSE(edit_scene_text("{}", {{"a", "\xff"}}));
    EXPECT_FALSE(edit_scene_text("{}", {{"\xff", 1}}));
    EXPECT_FALSE(edit_scene_text("{}", {{"a", std::numeric_limits<double>::infinity()}}));
}

// --- The scenes of the source tree

std::vector<std::filesystem::path> scene_files() {
    std::vector<std::filesystem::path> files;
    const auto scenes = std::filesystem::path(WEFT_SOURCE_DIR) / "scenes";
    for (const auto& entry : std::filesystem::recursive_directory_iterator(scenes))
        if (entry.path().extension() == ".json") files.push_back(entry.path());
    EXPECT_GE(files.size(), 30u);
    return files;
}

std::string with_line_ends(std::string_view text) {
    std::string result = "\xef\xbb\xbf";
    for (const char c : text) (result += c == '\n' ? "\r" : "") += c;
    return result;
}

void for_each_scene(const std::function<void(const std::string&)>& check) {
    for (const auto& file : scene_files()) {
        SCOPED_TRACE(file.string());
        const auto text = read_scene_text(file);
        ASSERT_TRUE(text);
        check(*text);
        check(with_line_ends(*text));
        if (testing::Test::HasFailure()) return;
    }
}

std::vector<std::string> lines_of(std::string_view text) {
    std::vector<std::string> lines(1);
    for (const char c : text) {
        lines.back() += c;
        if (c == '\n') lines.emplace_back();
    }
    return lines;
}

/// How many of the lines are not in the other text, in the same order.
std::size_t lost_lines(const std::vector<std::string>& lines, const std::vector<std::string>& other) {
    std::vector<std::vector<std::size_t>> common(lines.size() + 1, std::vector<std::size_t>(other.size() + 1));
    for (std::size_t i = lines.size(); i-- > 0;)
        for (std::size_t j = other.size(); j-- > 0;)
            common[i][j] =
                lines[i] == other[j] ? common[i + 1][j + 1] + 1 : std::max(common[i + 1][j], common[i][j + 1]);
    return lines.size() - common[0][0];
}

std::vector<std::string> comments_of(std::string_view text) {
    std::vector<std::string> comments;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') in_string = !in_string;
        if (in_string && text[i] == '\\') ++i;
        if (in_string || text[i] != '/') continue;
        const bool line = text[i + 1] == '/';
        const std::size_t end =
            line ? std::min(text.find_first_of("\r\n", i), text.size()) : text.find("*/", i + 2) + 2;
        comments.emplace_back(text.substr(i, end - i));
        i = end - 1;
    }
    return comments;
}

// Of long lists, which have like elements, the first ones and the last one are visited: the time grows with the square
// of the number of places.
constexpr std::size_t first_elements = 16;

void each_place(const Json& json, const Pointer& place, const std::function<void(const Pointer&, const Json&)>& visit) {
    if (!place.empty()) visit(place, json);
    if (json.is_object())
        for (const auto& [key, value] : json.items()) each_place(value, place / key, visit);
    if (json.is_array())
        for (std::size_t i = 0; i < json.size(); ++i)
            if (i < first_elements || i + 1 == json.size()) each_place(json[i], place / i, visit);
}

TEST(TextEditOfScenes, changes_nothing_without_a_change) {
    for_each_scene([](const std::string& text) { EXPECT_EQ(changed(text, json_of(text)), text); });
}

// Labels: no-asan
TEST(TextEditOfScenes, changes_one_line_for_a_plain_value) {
    for_each_scene([](const std::string& text) {
        const Json json = json_of(text);
        const auto before = lines_of(text);
        each_place(json, Pointer(), [&](const Pointer& place, const Json& value) {
            if (value.is_structured() || testing::Test::HasFailure()) return;
            Json wanted = json;
            wanted[place] = value.is_string() ? Json("another") : Json(0.765);
            const auto after = lines_of(changed(text, wanted));
            ASSERT_EQ(after.size(), before.size()) << place;
            EXPECT_EQ(lost_lines(before, after), 1u) << place;
        });
    });
}

// Labels: no-asan
TEST(TextEditOfScenes, changes_one_line_to_add_a_key) {
    for_each_scene([](const std::string& text) {
        const Json json = json_of(text);
        const auto before = lines_of(text);
        each_place(json, Pointer(), [&](const Pointer& place, const Json& value) {
            if (!value.is_object() || testing::Test::HasFailure()) return;
            Json wanted = json;
            wanted[place]["added"] = {1, 2};
            const std::string after = changed(text, wanted);
            EXPECT_LE(lost_lines(before, lines_of(after)), 1u) << place << after;
            EXPECT_EQ(comments_of(after), comments_of(text)) << place;
        });
    });
}

// Labels: no-asan
TEST(TextEditOfScenes, adds_at_most_one_line_to_remove_a_member) {
    for_each_scene([](const std::string& text) {
        const Json json = json_of(text);
        const auto before = lines_of(text);
        each_place(json, Pointer(), [&](const Pointer& place, const Json&) {
            if (testing::Test::HasFailure()) return;
            Json wanted = json;
            remove_at(wanted, place);
            const auto after = lines_of(changed(text, wanted));
            EXPECT_LE(lost_lines(after, before), 1u) << place;
            EXPECT_LE(after.size(), before.size()) << place;
        });
    });
}

// --- Random texts

/// JSON texts with comments and blanks at all places that allow them, and changes of values.
class RandomText {
  public:
    explicit RandomText(std::uint64_t seed) : random_(seed) {}

    std::string text() { return (one_in(4) ? "\xef\xbb\xbf" : "") + blanks() + value(0) + blanks(); }

    /// A value that differs in some places.
    Json changed(const Json& json) {
        if (one_in(12)) return small();
        Json result = json;
        if (json.is_object()) {
            result = Json::object();
            for (const auto& [key, value] : json.items())
                if (!one_in(8)) result[key] = one_in(2) ? changed(value) : value;
            while (one_in(4)) result["k" + std::to_string(random_.below(12))] = small();
        } else if (json.is_array()) {
            result = Json::array();
            for (const Json& value : json) {
                while (one_in(8)) result.push_back(small());
                if (!one_in(8)) result.push_back(one_in(2) ? changed(value) : value);
            }
            while (one_in(4)) result.push_back(small());
        } else if (one_in(3)) {
            result = small();
        }
        return result;
    }

  private:
    bool one_in(std::uint32_t count) { return random_.below(count) == 0; }

    std::string blanks() {
        static constexpr const char* parts[] = {
            " ",    "\n",        "\n    ",        "\t",           "\r\n  ", "// c \"[{\n",
            "/**/", "/* , } */", "/* a\n\n b */", "// //* x\r\n", "\n\n",   "//\n"};
        std::string text;
        while (!one_in(3)) text += parts[random_.below(std::size(parts))];
        return text;
    }

    std::string scalar() {
        static constexpr const char* values[] = {"1",      "1.50",         "-0.0",           "1e3",
                                                 "true",   "null",         "\"a\"",          "\"\"",
                                                 "\"//\"", "\"\\\"\\\\\"", "\"\\u00e9 /*\"", "12345678901234567890"};
        return values[random_.below(std::size(values))];
    }

    std::string value(int depth) {
        const std::uint32_t kind = random_.below(depth < 4 ? 5 : 1);
        if (kind == 0 && depth > 0) return scalar();
        const bool object = kind % 2 == 0, plain = one_in(2);
        const std::string blank = one_in(2) ? " " : "\n" + std::string(4 * static_cast<std::size_t>(depth + 1), ' ');
        const auto space = [&] { return plain ? "" : blanks(); };
        std::string text = object ? "{" : "[";
        const std::uint32_t count = random_.below(5);
        for (std::uint32_t i = 0; i < count; ++i) {
            text += plain ? blank : blanks();
            if (object) text += "\"k" + std::to_string(2 * i) + "\"" + space() + ":" + space();
            text += value(depth + 1) + space();
            if (i + 1 < count) text += ",";
            if (plain && one_in(4)) text += one_in(2) ? " // of " + std::to_string(i) + "\n" : "/* of it */";
        }
        return text + space() + (object ? "}" : "]");
    }

    Json small() {
        switch (random_.below(6)) {
            case 0:
                return Json::parse(scalar());
            case 1:
                return Json{{"name", random_.below(9)}, {"b", {1, 2, {{"c", std::string(random_.below(150), 'x')}}}}};
            case 2:
                return Json::array();
            case 3:
                return Json::object();
            case 4:
                return Json{0.1, random_.below(100), "text"};
            default:
                return random_.below(1000) / 64.0;
        }
    }

    RandomScene random_;
};

TEST(TextEditOfAnyText, reads_as_wanted) {
    for (std::uint64_t seed = 1; seed <= 4000 && !testing::Test::HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        RandomText random(seed);
        const std::string text = random.text();
        Json wanted = json_of(text);
        std::string now = text;
        for (int i = 0; i < 3; ++i) {
            wanted = random.changed(wanted);
            now = changed(now, wanted);
            EXPECT_EQ(json_of(now), wanted) << text;
        }
    }
}

TEST(TextEditOfAnyText, keeps_all_comments_if_nothing_is_removed) {
    for (std::uint64_t seed = 1; seed <= 1500 && !testing::Test::HasFailure(); ++seed) {
        SCOPED_TRACE(seed);
        RandomText random(seed);
        const std::string text = random.text();
        const Json json = json_of(text);
        Json wanted = json;
        each_place(json, Pointer(), [&](const Pointer& place, const Json& value) {
            if (value.is_object()) wanted[place]["added"] = {1, 2};
            if (value.is_array()) wanted[place].push_back("added");
            if (value.is_number()) wanted[place] = 0.765;
        });
        EXPECT_EQ(comments_of(changed(text, wanted)), comments_of(text)) << text << "\nbecame\n"
                                                                         << changed(text, wanted);
    }
}

TEST(ListMatches, pair_equal_elements_and_names) {
    const auto pairs = [](const char* from, const char* to) {
        std::string text;
        for (const JsonMatch& match : match_lists(Json::parse(from), Json::parse(to)))
            text += (match.from ? std::to_string(*match.from) : "-") + ">" +
                    (match.to ? std::to_string(*match.to) : "-") + " ";
        return text;
    };
    EXPECT_EQ(pairs("[1, 2, 3]", "[1, 3]"), "0>0 1>- 2>1 ");
    EXPECT_EQ(pairs("[1, 2]", "[1, 2, 3]"), "0>0 1>1 ->2 ");
    EXPECT_EQ(pairs(R"([{"name": "a", "x": 1}, {"name": "b", "x": 2}])", R"([{"name": "b", "x": 3}])"), "0>- 1>0 ");
    EXPECT_EQ(pairs(R"([{"name": "a", "x": 1}])", R"([{"name": "b", "x": 1}])"), "0>0 ");
}

}  // namespace
}  // namespace weft
