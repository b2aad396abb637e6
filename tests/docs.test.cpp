// The pages: links and images exist, anchors are headings, and each C++ sample is a part of a program in examples/.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace weft {
namespace {

namespace fs = std::filesystem;

const fs::path root = WEFT_SOURCE_DIR;

std::string text_of(const fs::path& path) {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<fs::path> pages() {
    std::vector<fs::path> found{root / "README.md", root / "CHANGELOG.md"};
    for (const char* folder : {"docs", "src"})
        for (const auto& entry : fs::recursive_directory_iterator(root / folder))
            if (entry.path().extension() == ".md") found.push_back(entry.path());
    return found;
}

struct Block {
    std::string language;  ///< empty for text outside of fences
    std::string text;
};

// Text and fenced samples of a page, in turn.
std::vector<Block> blocks_of(const std::string& page) {
    std::vector<Block> blocks{{}};
    std::istringstream lines(page);
    bool inside = false;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("```")) {
            inside = !inside;
            blocks.push_back({inside ? line.substr(3) + "\n" : "", ""});
        } else {
            blocks.back().text += line + '\n';
        }
    }
    EXPECT_FALSE(inside) << "a sample without an end";
    return blocks;
}

/// The anchor that GitHub and the site give a heading.
std::string anchor_of(const std::string& heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == ' ' || c == '-') anchor += '-';
        if (std::isalnum(byte) || c == '_' || byte >= 0x80) anchor += static_cast<char>(std::tolower(byte));
    }
    return anchor;
}

std::set<std::string> anchors_of(const fs::path& path) {
    std::set<std::string> anchors;
    for (const Block& block : blocks_of(text_of(path))) {
        if (!block.language.empty()) continue;
        std::istringstream lines(block.text);
        for (std::string line; std::getline(lines, line);)
            if (line.starts_with("#")) anchors.insert(anchor_of(line.substr(line.find_first_not_of("# "))));
    }
    return anchors;
}

// Targets of [text](target) and <img src="target">.
std::vector<std::string> links_of(const fs::path& path) {
    std::vector<std::string> links;
    for (const Block& block : blocks_of(text_of(path))) {
        if (!block.language.empty()) continue;
        for (const std::string start : {"](", "src=\""}) {
            for (std::size_t at = block.text.find(start); at != block.text.npos; at = block.text.find(start, at + 1)) {
                const std::size_t from = at + start.size(), to = block.text.find_first_of(")\"", from);
                links.push_back(block.text.substr(from, to - from));
            }
        }
    }
    return links;
}

TEST(Docs, every_link_leads_somewhere) {
    std::size_t count = 0;
    for (const fs::path& page : pages()) {
        for (const std::string& link : links_of(page)) {
            if (link.starts_with("http") || link.find(' ') != link.npos) continue;  // the latter is code
            const std::size_t hash = link.find('#');
            const std::string file = link.substr(0, hash);
            const fs::path target = file.empty() ? page : page.parent_path() / file;
            ++count;
            EXPECT_TRUE(fs::exists(target)) << page << ": " << link;
            if (hash == link.npos || !fs::exists(target)) continue;
            EXPECT_TRUE(anchors_of(target).contains(link.substr(hash + 1))) << page << ": " << link;
        }
    }
    EXPECT_GT(count, 100u);
}

TEST(Docs, every_image_is_shown_somewhere) {
    std::set<fs::path> shown;
    for (const fs::path& page : pages())
        for (const std::string& link : links_of(page))
            if (!link.starts_with("http")) shown.insert(fs::weakly_canonical(page.parent_path() / link));
    for (const auto& entry : fs::recursive_directory_iterator(root / "docs" / "pictures"))
        EXPECT_TRUE(entry.is_directory() || shown.contains(fs::weakly_canonical(entry.path()))) << entry.path();
}

std::string without_space(const std::string& text) {
    std::string packed;
    for (const char c : text)
        if (!std::isspace(static_cast<unsigned char>(c))) packed += c;
    return packed;
}

TEST(Docs, every_sample_of_code_is_part_of_an_example) {
    std::string examples;
    for (const auto& entry : fs::directory_iterator(root / "examples"))
        if (entry.path().extension() == ".cpp") examples += without_space(text_of(entry.path()));
    std::size_t count = 0;
    for (const char* page : {"README.md", "docs/cookbook.md", "docs/embedding.md"}) {
        for (const Block& block : blocks_of(text_of(root / page))) {
            if (block.language != "cpp\n") continue;
            std::istringstream lines(block.text);
            std::string code;  // without the includes
            for (std::string line; std::getline(lines, line);)
                if (!line.starts_with("#include")) code += without_space(line);
            EXPECT_NE(examples.find(code), examples.npos) << page << ":\n" << block.text;
            ++count;
        }
    }
    EXPECT_GE(count, 6u);
}

}  // namespace
}  // namespace weft
